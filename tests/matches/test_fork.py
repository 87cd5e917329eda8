"""Matches in a forked worker process, also if the parent process has a pool of threads.

A fork copies a pool without its threads, so a worker that waits for them would wait for ever.
Workers of vectorized environments are forks.
"""

import hashlib
import multiprocessing
import threading
import warnings
from collections.abc import Callable
from multiprocessing.connection import Connection
from multiprocessing.context import BaseContext

import numpy as np
import pytest

from rsoccer import Matches, parallel_env

SECONDS = 60.0
"""Time limit of a worker; far more than it needs unless it hangs."""

inherited: list[Matches] = []
"""Matches of the parent process, which forked workers inherit."""


def play_env() -> str:
    match = parallel_env("VSSSelfPlay-v0", max_cycles=100)
    observations, _ = match.reset(seed=3)
    digest = hashlib.sha256()
    while match.agents:
        for observation in observations.values():
            digest.update(observation.tobytes())
        actions = {agent: np.array([1.0, 0.6], np.float32) for agent in match.agents}
        observations = match.step(actions)[0]
    return digest.hexdigest()


def play_threads() -> str:
    matches = Matches("VSSSelfPlay-v0", worlds=8, seed=3, threads=2)
    matches.reset()
    return play(matches)


def play_inherited() -> str:
    return play(inherited[0])


def play(matches: Matches) -> str:
    digest = hashlib.sha256()
    for _ in range(50):
        digest.update(matches.step(np.full((8, 6, 2), 0.7, np.float32)).observations.tobytes())
    return digest.hexdigest()


def work(job: Callable[[], str], answer: Connection) -> None:
    answer.send(job())
    answer.close()


def run_in_worker(context: BaseContext, job: Callable[[], str]) -> str:
    """Return the result of a job in another process; fail if the job hangs."""
    ours, theirs = context.Pipe(duplex=False)
    worker = context.Process(target=work, args=(job, theirs), daemon=True)  # type: ignore[attr-defined]
    with warnings.catch_warnings():
        # Python 3.12 and later warn of forks in general; this file shows ours to be safe.
        warnings.filterwarnings("ignore", ".*multi-threaded.*fork", DeprecationWarning)
        worker.start()
    theirs.close()
    try:
        assert ours.poll(SECONDS), f"the worker has not answered in {SECONDS} s"
        return str(ours.recv())
    finally:
        worker.kill()
        worker.join()


@pytest.mark.parametrize("method", ["fork", "spawn"])
@pytest.mark.parametrize("job", [play_env, play_threads])
def test_a_worker_plays_the_same_matches(method: str, job: Callable[[], str]) -> None:
    expected = [play_env(), play_threads()]  # now the parent has a pool of threads
    assert expected[0] != expected[1]
    context = multiprocessing.get_context(method)
    assert run_in_worker(context, job) == expected[[play_env, play_threads].index(job)]


def test_a_fork_continues_the_matches_of_its_parent() -> None:
    matches = Matches("VSSSelfPlay-v0", worlds=8, seed=4, threads=2)
    matches.reset()
    play(matches)
    inherited[:] = [matches]
    in_worker = run_in_worker(multiprocessing.get_context("fork"), play_inherited)
    assert in_worker == play(matches)
    assert in_worker != play(matches), "the matches do not advance"


def test_a_worker_that_hangs_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(globals(), "SECONDS", 0.2)
    with pytest.raises(AssertionError, match="has not answered"):
        run_in_worker(multiprocessing.get_context("fork"), hang)


def hang() -> str:
    threading.Event().wait()
    return "never"

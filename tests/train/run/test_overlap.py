"""Rollouts beside updates: a fixed schedule, equal after a resume, and no thread that stays."""

import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any, Never

import numpy as np
import pytest
import torch

from rsoccer.train import Args, train
from rsoccer.train.ppo import update
from rsoccer.train.ppo.batch import Batch
from rsoccer.train.rollout.episode_stats import Row
from rsoccer.train.rollout.samples import Rollout
from rsoccer.train.run import checkpoint, overlap
from rsoccer.train.run.loop import Loop
from rsoccer.train.run.state import restore
from rsoccer.train.run.stop_signal import Stopped, StopSignal
from rsoccer.train.run.trainer import Trainer
from tests.train.runs import digest, digests_by_small_parts, progress, run_until
from tests.train.short_task import UPDATES, easy, tiny

CENTRAL = {"central_critic": True, "mirror_augmentation": True, "random_truncation": 0.1}
CASES: dict[str, dict[str, Any]] = {"self-play": {}, "central, mirrored": CENTRAL}

Check = Callable[[], None]


def overlapped(out: Path, **changes: Any) -> Args:  # noqa: ANN401  (any field)
    return tiny(out, **{"overlap": True, **changes})


def learners() -> list[threading.Thread]:
    return [thread for thread in threading.enumerate() if thread.name.startswith("learner")]


@pytest.fixture(scope="module")
def overlapped_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("overlapped")
    train(overlapped(folder))
    return folder


def recorded(trainer: Trainer) -> tuple[list[Batch], list[dict[str, torch.Tensor]]]:
    """Run to the end; return the batch of each update, and the parameters from before it."""
    batches, models = [], []
    learn = trainer.ppo.learn

    def record(batch: Batch, *rest: Any, **named: Any) -> Row:  # noqa: ANN401
        batches.append(batch)
        parts = trainer.model.state_dict().items()
        models.append({name: part.clone() for name, part in parts})
        return learn(batch, *rest, **named)

    trainer.ppo.learn = record  # type: ignore[method-assign]
    Loop(trainer, {}).run(StopSignal(), 0)
    return batches, models


def test_samples_are_one_update_old(tmp_path: Path) -> None:
    """The first ones of the run and of whole teams are not: nothing is learned before them."""
    trainer = Trainer(overlapped(tmp_path))
    batches, models = recorded(trainer)
    assert len(batches) == 6
    found = []
    for batch in batches:
        played_by = []
        for index, model in enumerate(models):
            trainer.model.load_state_dict(model)
            with torch.no_grad():
                mean = trainer.model.actor(batch.observations)
                log_probs = trainer.model.log_prob(mean, batch.actions)
            if torch.allclose(log_probs, batch.log_probs, atol=1e-5):
                played_by.append(index)
        found.append(played_by)
    # Whole teams play from the fourth update on.
    assert found == [[0], [0], [1], [3], [3], [4]]


def test_no_rollout_is_played_in_vain(tmp_path: Path, finished: Path, overlapped_run: Path) -> None:
    trainer = Trainer(overlapped(tmp_path))
    collect, solo = trainer.collector.collect, []

    def count(gamma: float, check_stop: Check) -> Rollout:
        solo.append(trainer.is_solo)
        return collect(gamma, check_stop)

    trainer.collector.collect = count  # type: ignore[method-assign]
    Loop(trainer, {}).run(StopSignal(), 0)
    assert solo == [True, True, True, False, False, False]
    counted = [
        [(row["update"], row["samples"]) for row in progress(folder)]
        for folder in (tmp_path, finished)
    ]
    assert counted[0] == counted[1]
    assert digest(tmp_path) == digest(overlapped_run) != digest(finished)
    assert trainer.pending is None


def test_a_rollout_is_played_during_an_update(tmp_path: Path) -> None:
    trainer = Trainer(overlapped(tmp_path, samples=2 * 144, solo_fraction=0.0))
    playing, learning = threading.Event(), threading.Event()
    collect, learn = trainer.collector.collect, trainer.ppo.learn

    def play(gamma: float, check_stop: Check) -> Rollout:
        if trainer.samples:  # the second rollout
            playing.set()
            assert learning.wait(60.0), "the update waits for the rollout"
        return collect(gamma, check_stop)

    def learn_meanwhile(*args: Any, **named: Any) -> Row:  # noqa: ANN401
        learning.set()
        assert playing.wait(60.0), "the rollout waits for the update"
        return learn(*args, **named)

    trainer.collector.collect = play  # type: ignore[method-assign]
    trainer.ppo.learn = learn_meanwhile  # type: ignore[method-assign]
    Loop(trainer, {}).run(StopSignal(), 0)
    assert trainer.updates == 2


@pytest.mark.parametrize("changes", CASES.values(), ids=CASES)
def test_runs_are_equal_for_any_number_of_threads(
    changes: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs = (
        overlapped(tmp_path / str(threads), threads=threads, samples=5 * 144, **changes)
        for threads in (1, 3)
    )
    assert len(digests_by_small_parts(runs, monkeypatch)) == 1


# An update has 8 checks in a rollout, 4 in the minibatches and one at the end: 21, 13 and 5 in the
# solo part, as the first one plays two rollouts and the last one none; then the same of teams.
@pytest.mark.parametrize(
    ("checks", "updates"), [(3, 0), (21 + 4, 1), (21 + 13 + 2, 2), (39 + 9, 3), (39 + 21 + 3, 4)]
)
@pytest.mark.parametrize("changes", CASES.values(), ids=CASES)
def test_a_resumed_run_equals_the_uninterrupted_one(
    checks: int,
    updates: int,
    changes: dict[str, Any],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(update, "TARGET_KL", 1e3)  # all passes
    one, other = tmp_path / "one", tmp_path / "other"
    train(overlapped(one, **changes))
    other.mkdir()
    assert run_until(overlapped(other, **changes), checks) == updates
    assert not learners()
    saved = checkpoint.load(other / checkpoint.FILE_NAME)
    assert saved.info["updates"] == updates
    pending = {name for name in saved.arrays if name.startswith("pending.")}
    assert bool(pending) == (updates in {1, 2, 4})
    assert (saved.info["pending"] is None) != bool(pending)
    train(overlapped(other, resume=True, threads=2, **changes))
    assert digest(other) == digest(one)
    assert progress(other) == progress(one)


def test_a_checkpoint_has_the_pending_rollout_whole(tmp_path: Path) -> None:
    run_until(overlapped(tmp_path, **CENTRAL), 21 + 4)
    saved = checkpoint.load(tmp_path / checkpoint.FILE_NAME)
    assert saved.info["pending"]["samples"] == 144
    assert saved.info["pending"]["episodes"]["episodes"] > 0
    assert "reward" in saved.info["pending"]["rewards"]
    assert 144 < len(saved.arrays["pending.central_inputs"]) <= 288, "with reflected samples"


def test_a_run_without_overlap_saves_as_before(finished: Path) -> None:
    saved = checkpoint.load(finished / checkpoint.FILE_NAME)
    assert "pending" not in saved.info and "run.minibatch_generator" not in saved.arrays


def test_runs_with_and_without_overlap_do_not_resume_each_other(
    tmp_path: Path, overlapped_run: Path
) -> None:
    train(overlapped(tmp_path, samples=1))
    with pytest.raises(ValueError, match=r"ppo\.overlap was True, now False"):
        train(tiny(tmp_path, resume=True))


def test_a_finished_run_goes_on(tmp_path: Path) -> None:
    train(overlapped(tmp_path, samples=3 * 144))
    train(overlapped(tmp_path, samples=5 * 144, resume=True))
    saved = checkpoint.load(tmp_path / checkpoint.FILE_NAME)
    assert (saved.info["updates"], saved.info["samples"]) == (5, 5 * 144)


def test_a_callback_may_end_the_run_which_can_be_resumed(
    tmp_path: Path, overlapped_run: Path
) -> None:
    train(overlapped(tmp_path), lambda update: update.number < 2)
    train(overlapped(tmp_path, resume=True))
    assert digest(tmp_path) == digest(overlapped_run)


def test_each_row_tells_of_the_rollout_that_was_learned_from(
    tmp_path: Path, overlapped_run: Path, finished: Path
) -> None:
    """The first two rollouts are played by the first policy; the first is that without overlap."""
    rows, others = progress(overlapped_run), progress(finished)
    assert [rows[0][name] for name in ("episodes", "reward")] == [
        others[0][name] for name in ("episodes", "reward")
    ]
    assert list(rows[0]) == list(others[0])
    assert sum(int(row["episodes"]) for row in rows) > 10
    assert len({row["reward"] for row in rows}) == 6


def test_without_saved_matches_the_pending_rollout_is_learned_from(tmp_path: Path) -> None:
    """New episodes begin, as in any run whose simulator cannot save its matches."""
    settings = {"simulator": "tests.simulators:Elsewhere"}
    run_until(overlapped(tmp_path, **settings), 21 + 4)
    saved = checkpoint.load(tmp_path / checkpoint.FILE_NAME).arrays
    assert not any(name.startswith("worlds.") for name in saved)
    trainer = Trainer(overlapped(tmp_path, resume=True, **settings))
    restore(trainer, checkpoint.load(tmp_path / checkpoint.FILE_NAME))
    batches, _ = recorded(trainer)
    assert np.array_equal(batches[0].actions.numpy(), saved["pending.actions"])
    assert trainer.updates == 6


def test_a_signal_ends_the_rollout_and_the_update(tmp_path: Path) -> None:
    trainer = Trainer(overlapped(tmp_path))
    overlap.update(trainer, lambda: None)
    before = {name: part.clone() for name, part in trainer.model.state_dict().items()}
    ended = []

    def check() -> None:
        ended.append(threading.current_thread().name)
        raise Stopped("test")

    with pytest.raises(Stopped):
        overlap.update(trainer, check)
    assert len(set(ended)) == len(ended) <= 2, "each thread ends at its first check"
    assert not learners()
    for name, part in trainer.model.state_dict().items():
        assert torch.equal(part, before[name])


class BrokenError(Exception):
    """An error of no other code."""


def fail(*args: Any, **named: Any) -> Never:  # noqa: ANN401
    raise BrokenError


def test_an_error_of_the_learner_reaches_the_caller(tmp_path: Path) -> None:
    trainer = Trainer(overlapped(tmp_path))
    trainer.ppo.learn = fail  # type: ignore[method-assign]
    with pytest.raises(BrokenError):
        Loop(trainer, {}).run(StopSignal(), 0)
    assert not learners()


@pytest.mark.parametrize("error", [BrokenError, KeyboardInterrupt, ConnectionError])
def test_an_error_of_a_rollout_ends_the_update(error: type[BaseException], tmp_path: Path) -> None:
    trainer = Trainer(overlapped(tmp_path, checkpoint_interval=1e-9))
    collect, learn, ended = trainer.collector.collect, trainer.ppo.learn, []

    def play(gamma: float, check_stop: Check) -> Rollout:
        if trainer.updates == 1:
            raise error
        return collect(gamma, check_stop)

    def learn_on(batch: Batch, rate: float, check_stop: Check, **named: bool) -> Row:
        try:
            while trainer.updates == 1:  # until the rollout has failed
                check_stop()
        finally:
            ended.append(trainer.updates)
        return learn(batch, rate, check_stop, **named)

    trainer.collector.collect = play  # type: ignore[method-assign]
    trainer.ppo.learn = learn_on  # type: ignore[assignment,method-assign]
    with pytest.raises(error):
        Loop(trainer, {}).run(StopSignal(), 0)
    assert ended == [0, 1] and not learners()
    saved = checkpoint.load(tmp_path / checkpoint.FILE_NAME)
    assert saved.info["updates"] == 1 and saved.info["pending"] is not None


def test_a_run_that_diverges_keeps_its_last_checkpoint(tmp_path: Path) -> None:
    trainer = Trainer(overlapped(tmp_path, checkpoint_interval=1e-9))
    learn = trainer.ppo.learn

    def spoil(*args: Any, **named: Any) -> Row:  # noqa: ANN401
        stats = learn(*args, **named)
        if trainer.updates == 1:
            next(trainer.ppo._learner.actor.parameters()).data[0, 0] = torch.inf
        return stats

    trainer.ppo.learn = spoil  # type: ignore[method-assign]
    with pytest.raises(ValueError, match="training diverged after 288 samples"):
        Loop(trainer, {}).run(StopSignal(), 0)
    assert checkpoint.load(tmp_path / checkpoint.FILE_NAME).info["updates"] == 1


def test_training_raises_the_reward(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(update, "TARGET_KL", 1.0)
    args = easy(tmp_path, overlap=True)
    trainer, rewards = Trainer(args), []
    for _ in range(UPDATES):
        played = overlap.update(trainer, lambda: None)
        rewards.append(played.rewards["reward"] / args.rollout.action_repeat)
    assert abs(rewards[0]) < 0.1, "untrained"
    assert rewards[-1] > 0.6, "the maximum is 1, at full power ahead"

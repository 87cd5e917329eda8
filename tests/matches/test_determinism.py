"""The same seed gives the same match, bit for bit.

This holds alone or in a batch, on any number of threads, after other matches, and from a saved
state, while robots push each other.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import rsoccer
from benches.solvers import SOLVERS
from rsoccer import Matches
from rsoccer.arrays import Floats, Mask
from rsoccer.controllers import Controllers
from rsoccer.matches import Outcome
from rsoccer.task import Play, Task
from tests.helpers import Crowd, pushing, same, ssl_crowd, touches
from tests.parallel_matches import TASKS, VSS_TASKS

WORLDS = 5
STEPS = 130

SCRIPTS = {task: script for task, script in SOLVERS.items() if task.startswith("SSL")}
ALONE: list[tuple[str, Controllers | None]] = [(name, None) for name in TASKS]
DRIVEN: list[tuple[str, Controllers | None]] = [
    ("VSSMulti-v0", {"yellow": "ou", "blue_1": "uniform"}),
    ("VSSSelfPlay-v0", {"yellow": "chase", "blue_2": "zero"}),
    ("SSLSelfPlay-v0", {"all": "ou", "blue_0": "strike"}),
    ("SSLDribbling-v0", {"all": "ou", "blue_0": "weave"}),
    ("SSLGoToBall-v0", {"all": "ou", "blue_0": "fetch"}),
    ("SSLPassEnduranceMulti-v1", {"all": "ou", "blue_0": "passer"}),
    ("SSLKeepaway-v0", {"all": "ou", "blue": "keep", "yellow": "take"}),
    ("SSLMatch-v0", {"all": "ou", "blue": "scripted"}),
]
"""Every policy once, with its random numbers and memory."""


def test_every_task_and_every_script_is_among_the_cases() -> None:
    assert {name for name, _ in ALONE} == set(TASKS) == {*VSS_TASKS, *SCRIPTS}
    driven = {policy for _, given in DRIVEN for policy in (given or {}).values()}
    assert driven >= {"chase", "ou", "uniform", "zero", *SCRIPTS.values()}


each_task = pytest.mark.parametrize(("name", "controllers"), ALONE)
everywhere = pytest.mark.parametrize(("name", "controllers"), ALONE + DRIVEN)
# Threads share the work of physics, views, observations and potentials.
every_kind = pytest.mark.parametrize(
    ("name", "controllers"),
    [*DRIVEN[:3], ("SSLStaticDefenders-v0", None), ("SSLPassEnduranceMulti-v1", None)],
)


def crowded(
    name: str,
    controllers: Controllers | None,
    worlds: int,
    seed: int = 0,
    threads: int = 1,
    autoreset: str = "same_step",
) -> Matches:
    """Matches of a task in which every episode begins with all robots close to the ball."""
    task_class = type(rsoccer.make_task(name))
    options: dict[str, Any] = {"max_steps": 40}
    if name in SCRIPTS:
        options["velocity_frame"] = "robot"  # forward actions then push toward the ball

        def late(task: Task, play: Play) -> tuple[dict[str, Floats], Mask]:
            """Ends of the task, but not in the first 20 steps."""
            terms, done = task_class.calculate_reward_and_done(task, play)
            return terms, done & (play.steps > 20)

        changed = {"get_initial_positions_frame": ssl_crowd, "calculate_reward_and_done": late}
    else:
        changed = {"get_initial_positions_frame": Crowd.get_initial_positions_frame}
    task = type("Crowded", (task_class,), {"name": name, **changed})(**options)
    return Matches(task, worlds, seed, threads, controllers=controllers, autoreset=autoreset)


def arrays_of(outcome: Outcome) -> dict[str, np.ndarray]:
    """All arrays of an outcome by name."""
    arrays = {name: value for name, value in vars(outcome).items() if isinstance(value, np.ndarray)}
    return arrays | outcome.terms | outcome.metrics


def play_both(
    ours: Matches, steps: int, compare: Callable[[np.ndarray, Outcome, int], None]
) -> tuple[int, int]:
    """Step and compare; return the number of touches and of episodes that ended."""
    rng = np.random.default_rng(1)
    touched = ended = 0
    for step in range(steps):
        actions = pushing(rng, ours)
        outcome = ours.step(actions)
        compare(actions, outcome, step)
        touched += touches(ours.frame, ours.task.config)
        ended += int(outcome.ended.sum())
    return touched, ended


def expect_equal(ours: Matches, theirs: list[Matches], steps: int = STEPS) -> None:
    """Compare one batch with several, row by row."""

    def compare(actions: np.ndarray, outcome: Outcome, step: int) -> None:
        first, parts = 0, []
        for other in theirs:
            parts.append(arrays_of(other.step(actions[first : first + other.worlds])))
            first += other.worlds
        for name, array in arrays_of(outcome).items():
            assert same(array, np.concatenate([part[name] for part in parts])), (name, step)
        rows = np.concatenate([other.frame.rows for other in theirs])
        assert same(ours.frame.rows, rows), step

    touched, ended = play_both(ours, steps, compare)
    fewest = 2 if ours.task.name in SCRIPTS else 10  # some SSL tasks have only one robot
    assert touched > ours.worlds * fewest, "without contacts the comparison would prove little"
    assert ended >= ours.worlds, "without an end no reset was compared"


@everywhere
def test_row_i_of_a_batch_equals_a_single_world(name: str, controllers: Controllers | None) -> None:
    batch = crowded(name, controllers, WORLDS, seed=7)
    singles = [crowded(name, controllers, 1, seed=7 + i) for i in range(WORLDS)]
    assert same(batch.reset(), np.concatenate([single.reset() for single in singles]))
    expect_equal(batch, singles)


@every_kind
def test_threads_do_not_change_results(name: str, controllers: Controllers | None) -> None:
    for threads in (2, 3):
        ours = crowded(name, controllers, WORLDS, threads=1)
        theirs = crowded(name, controllers, WORLDS, threads=threads)
        assert same(ours.reset(), theirs.reset())
        expect_equal(ours, [theirs])


@pytest.mark.parametrize("name", ["VSSSelfPlay-v0", "SSLSelfPlay-v0", "SSLDribbling-v0"])
def test_threads_that_share_many_worlds_do_not_change_results(name: str) -> None:
    """So many worlds that threads share observations and rewards too."""
    worlds = 600
    ours, theirs = (Matches(name, worlds, 3, threads, autoreset="same_step") for threads in (1, 3))
    assert same(ours.reset(), theirs.reset())
    rng = np.random.default_rng(0)
    for _ in range(5):
        actions = rng.uniform(-1, 1, (worlds, len(ours.agents), ours.action_size))
        outcomes = [matches.step(actions.astype(np.float32)) for matches in (ours, theirs)]
        mine, others = (
            [outcome.observations, outcome.rewards, *outcome.terms.values()] for outcome in outcomes
        )
        assert all(map(same, mine, others))
    assert same(ours.play.view.robots.data, theirs.play.view.robots.data)


@each_task
def test_matches_after_others_equal_fresh_matches(
    name: str, controllers: Controllers | None
) -> None:
    used = crowded(name, controllers, WORLDS, seed=100)
    used.reset()
    touched, _ = play_both(used, 80, lambda actions, outcome, step: None)
    assert touched > 0
    fresh = crowded(name, controllers, WORLDS, seed=7)
    assert same(used.reset(7), fresh.reset())
    expect_equal(used, [fresh])


@everywhere
def test_restored_matches_continue_exactly(name: str, controllers: Controllers | None) -> None:
    expect_restored(name, controllers, "same_step")


@every_kind
def test_restored_matches_without_autoreset_continue_exactly(
    name: str, controllers: Controllers | None
) -> None:
    expect_restored(name, controllers, "disabled")


def expect_restored(name: str, controllers: Controllers | None, autoreset: str) -> None:
    ours = crowded(name, controllers, WORLDS, seed=7, autoreset=autoreset)
    ours.reset()
    for _ in range(60):
        play_both(ours, 1, lambda actions, outcome, step: None)
        if (in_touch := touches(ours.frame, ours.task.config)) > 0:
            break
        ours.reset(mask=ours.done)
    assert in_touch > 0, "saved while in contact"
    theirs = crowded(name, controllers, WORLDS, seed=55, autoreset=autoreset)
    theirs.load_state_dict(ours.state_dict())
    if autoreset == "same_step":
        expect_equal(ours, [theirs])
    rng = np.random.default_rng(3)
    for _ in range(STEPS):
        actions = pushing(rng, ours)
        assert same(ours.step(actions).observations, theirs.step(actions).observations)
        if ours.done.any():
            assert same(ours.reset(mask=ours.done), theirs.reset(mask=theirs.done))
    ends = ours.state_dict(), theirs.state_dict()
    assert all(same(ends[0][key], ends[1][key]) for key in ends[0])


def test_a_saved_state_does_not_change_with_the_matches() -> None:
    matches = crowded("VSSSelfPlay-v0", None, 2)
    matches.reset()
    saved = matches.state_dict()
    before = {name: array.copy() for name, array in saved.items()}
    play_both(matches, 5, lambda actions, outcome, step: None)
    assert all(same(saved[name], before[name]) for name in saved)
    assert not same(matches.state_dict()["frame"], saved["frame"])


def test_global_random_numbers_are_not_used() -> None:
    np.random.seed(0)  # noqa: NPY002
    before = np.random.get_state()[1].copy()  # type: ignore[index]  # noqa: NPY002
    matches = crowded("VSSMulti-v0", {"blue_0": "chase"}, 3)
    matches.reset()
    play_both(matches, 70, lambda actions, outcome, step: None)
    assert (np.random.get_state()[1] == before).all()  # type: ignore[index]  # noqa: NPY002

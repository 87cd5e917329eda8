"""What a step that failed half way leaves of every environment."""

import copy
from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np
import pytest

from rsoccer.envs.parallel import SoccerParallelEnv, env
from rsoccer.envs.single import SoccerEnv
from rsoccer.envs.vector import SoccerVectorEnv
from rsoccer.task import LEARN
from tests.fragile import Broken, Fragile
from tests.helpers import same

Door = Callable[[Fragile], tuple[Any, Callable[[Any], object]]]


def single(task: Fragile) -> tuple[Any, Callable[[Any], object]]:
    made: gymnasium.Env[Any, Any] = SoccerEnv(task, controllers={"all": "ou", "blue_0": LEARN})
    return made, lambda env: env.step(np.zeros(2, np.float32))


def vector(task: Fragile) -> tuple[Any, Callable[[Any], object]]:
    made = SoccerVectorEnv(task, 3, controllers={"all": "ou", "blue_0": LEARN})
    return made, lambda env: env.step(np.zeros((3, 2), np.float32))


def parallel(task: Fragile) -> tuple[Any, Callable[[Any], object]]:
    still = np.zeros(2, np.float32)
    return SoccerParallelEnv(task), lambda env: env.step(dict.fromkeys(env.agents, still))


@pytest.mark.parametrize("door", [single, vector, parallel])
@pytest.mark.parametrize("what", ["get_commands", "calculate_reward_and_done"])
def test_every_environment_says_what_failed_and_a_reset_mends_it(door: Door, what: str) -> None:
    task = Fragile()
    made, step = door(task)
    other, _ = door(Fragile())
    made.reset(seed=3)
    step(made)
    task.fuse.armed = what
    with pytest.raises(Broken):
        step(made)
    calls: list[Callable[[], object]] = [lambda: step(made), lambda: copy.deepcopy(made)]
    for call in calls:
        with pytest.raises(RuntimeError, match=rf"step 2 failed with Broken: {what} fails"):
            call()
    made.reset(seed=1)
    other.reset(seed=1)
    for _ in range(3):
        step(made)
        step(other)
    assert same(made._matches.frame.rows, other._matches.frame.rows)


def test_some_of_torn_vector_matches_cannot_be_reset() -> None:
    task = Fragile()
    made, step = vector(task)
    made.reset(seed=3)
    task.fuse.armed = "metrics"
    with pytest.raises(Broken):
        step(made)
    with pytest.raises(RuntimeError, match="step 1 failed"):
        made.reset(options={"reset_mask": np.array([True, False, False])})
    made.reset()
    step(made)


def test_turn_by_turn_too_a_reset_mends_it(monkeypatch: pytest.MonkeyPatch) -> None:
    turns = env("VSSSelfPlay-v0")
    turns.reset(seed=0)
    with monkeypatch.context() as patch:
        fails = lambda task, play: (_ for _ in ()).throw(Broken("metrics fails"))  # noqa: E731
        patch.setattr("rsoccer.tasks.vss.Vss.metrics", fails)
        with pytest.raises(Broken):
            for _ in range(6):
                turns.step(np.zeros(2, np.float32))
    turns.reset(seed=0)
    for _ in range(12):
        turns.step(np.zeros(2, np.float32))

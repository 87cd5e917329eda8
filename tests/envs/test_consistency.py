"""Environments after a failure within a step: refused calls, and repair by a reset."""

import copy
from collections.abc import Callable
from typing import Any

import gymnasium
import numpy as np
import pytest

from rsoccer.envs.aec import env
from rsoccer.envs.parallel import SoccerParallelEnv
from rsoccer.envs.single import SoccerEnv
from rsoccer.envs.vector import SoccerVectorEnv
from rsoccer.task import LEARN
from tests.failing import FailingTask, InjectedError
from tests.helpers import same

Factory = Callable[[FailingTask], tuple[Any, Callable[[Any], object]]]


def single(task: FailingTask) -> tuple[Any, Callable[[Any], object]]:
    made: gymnasium.Env[Any, Any] = SoccerEnv(task, controllers={"all": "ou", "blue_0": LEARN})
    return made, lambda env: env.step(np.zeros(2, np.float32))


def vector(task: FailingTask) -> tuple[Any, Callable[[Any], object]]:
    made = SoccerVectorEnv(task, 3, controllers={"all": "ou", "blue_0": LEARN})
    return made, lambda env: env.step(np.zeros((3, 2), np.float32))


def parallel(task: FailingTask) -> tuple[Any, Callable[[Any], object]]:
    still = np.zeros(2, np.float32)
    return SoccerParallelEnv(task), lambda env: env.step(dict.fromkeys(env.agents, still))


@pytest.mark.parametrize("create", [single, vector, parallel])
@pytest.mark.parametrize("method", ["get_commands", "calculate_reward_and_done"])
def test_calls_after_a_failure_raise_until_a_reset(create: Factory, method: str) -> None:
    task = FailingTask()
    made, step = create(task)
    other, _ = create(FailingTask())
    made.reset(seed=3)
    step(made)
    task.failure.method = method
    with pytest.raises(InjectedError):
        step(made)
    calls: list[Callable[[], object]] = [lambda: step(made), lambda: copy.deepcopy(made)]
    for call in calls:
        with pytest.raises(RuntimeError, match=rf"step 2 failed with InjectedError: {method}"):
            call()
    made.reset(seed=1)
    other.reset(seed=1)
    for _ in range(3):
        step(made)
        step(other)
    assert same(made._matches.frame.rows, other._matches.frame.rows)


def test_some_matches_of_a_failed_vector_env_cannot_be_reset() -> None:
    task = FailingTask()
    made, step = vector(task)
    made.reset(seed=3)
    task.failure.method = "metrics"
    with pytest.raises(InjectedError):
        step(made)
    with pytest.raises(RuntimeError, match="step 1 failed"):
        made.reset(options={"reset_mask": np.array([True, False, False])})
    made.reset()
    step(made)


def test_a_reset_repairs_an_aec_env(monkeypatch: pytest.MonkeyPatch) -> None:
    in_turn = env("VSSSelfPlay-v0")
    in_turn.reset(seed=0)
    with monkeypatch.context() as patch:
        fails = lambda task, play: (_ for _ in ()).throw(InjectedError("metrics fails"))  # noqa: E731
        patch.setattr("rsoccer.tasks.vss.Vss.metrics", fails)
        with pytest.raises(InjectedError):
            for _ in range(6):
                in_turn.step(np.zeros(2, np.float32))
    in_turn.reset(seed=0)
    for _ in range(12):
        in_turn.step(np.zeros(2, np.float32))

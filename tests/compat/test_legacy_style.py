"""Whole episodes of environments written for the interface of rSim (rc-robosim 1.2)."""

import importlib
import sys
from collections.abc import Callable
from types import ModuleType

import numpy as np
import pytest

from rsoccer.compat import robosim
from tests.compat.legacy_style import FetchAndShoot, PushBall, State, play, to_goal, turn_and_shoot

Builder = Callable[[ModuleType, int], PushBall | FetchAndShoot]


def test_a_vss_episode_ends_in_a_goal() -> None:
    states, scored = play(PushBall(robosim, 1), to_goal)
    assert scored and 30 < len(states) < 200
    assert states.shape[1] == 5 + 3 * 6


@pytest.mark.parametrize("seed", range(5))
def test_an_ssl_episode_ends_in_a_goal(seed: int) -> None:
    states, scored = play(FetchAndShoot(robosim, seed), turn_and_shoot)
    assert scored and len(states) < 300
    assert states.shape[1] == 5 + 11
    assert states[0, 5 + 6] == 1.0, "the robot starts with the ball in its beam"
    assert states[-1, 5 + 6] == 0.0


def test_velocities_are_the_derivatives_of_positions() -> None:
    states, _ = play(PushBall(robosim, 1), to_goal)
    steady = slice(4, 12)  # before contact with the ball
    moved = np.diff(states[:, 5], axis=0)[steady] / 0.025
    assert moved == pytest.approx(states[1:, 8][steady], abs=0.03)
    assert moved.max() > 0.5


@pytest.mark.parametrize(("env", "policy"), [(PushBall, to_goal), (FetchAndShoot, turn_and_shoot)])
def test_equal_calls_give_equal_bits(env: Builder, policy: Callable[[State], State]) -> None:
    first, again = env(robosim, 3), env(robosim, 3)
    states = play(first, policy)[0]
    assert states.tobytes() == play(again, policy)[0].tobytes()
    first.random.seed(3)
    assert states.tobytes() == play(first, policy)[0].tobytes(), "a reset restores the state"


def test_an_installed_robosim_is_found_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "robosim", robosim)  # so that it is gone after the test
    del sys.modules["robosim"]
    robosim.install()
    found = importlib.import_module("robosim")
    assert play(PushBall(found, 1), to_goal)[1]

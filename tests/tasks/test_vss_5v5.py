"""VSSS with five robots per team: tasks, scripted policies and training."""

from pathlib import Path

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches, registry
from rsoccer._core import CROSSINGS
from rsoccer.evaluate import evaluate
from rsoccer.policies.network import Network
from rsoccer.registry import names as registry_names
from rsoccer.tasks import VssSelfPlay
from rsoccer.testing import check_task
from rsoccer.testing.pressure import Pressing
from rsoccer.train import train
from tests.train.one_update import one_update

NAMES = [name for name in rsoccer.list_tasks() if name.startswith("VSS")]
FIVE = VssSelfPlay(field="vss_5v5", n_blue=5, n_yellow=5)


@pytest.mark.parametrize("name", NAMES)
def test_every_task_runs_on_the_5v5_field(name: str) -> None:
    task = rsoccer.make_task(name, field="vss_5v5", n_blue=5, n_yellow=5)
    assert (task.config.field.name, task.config.field.length) == ("vss_5v5", 2.2)
    check_task(task, worlds=3, steps=60)


def test_team_sizes_do_not_depend_on_the_field() -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0", field="vss_5v5")
    assert (task.n_blue, task.n_yellow) == (3, 3)
    assert rsoccer.make_task("VSSSelfPlay-v0").config.field.name == "vss_3v3"


def test_initial_states_cover_the_field_and_observations_their_range() -> None:
    matches = Matches(FIVE, 64)
    observed = matches.reset()
    x, y = np.abs(matches.frame.robots.position).max(axis=(0, 1))
    assert 0.95 < x < 1.1
    assert 0.75 < y < 0.9
    pressing = Pressing(FIVE)
    for _ in range(100):
        observed = matches.step(pressing.actions(matches)).observations
    high = matches.observation_high
    assert (np.abs(observed) >= high - 1e-6)[
        ..., : FIVE.layout.blocks["action"].columns.start
    ].mean() < 1e-3


@pytest.mark.parametrize("policy", ["chase", "scripted", "scripted:0.5"])
def test_scripted_policies_score_on_the_5v5_field(policy: str) -> None:
    found = evaluate(policy, "ou", 20, seed=2, task=FIVE, worlds=20)
    assert found.score > 0.5
    assert min(found.sides["blue"].wins, found.sides["yellow"].wins) > 4


def test_goals_are_at_the_lines_of_the_field() -> None:
    matches = Matches(FIVE, 1, autoreset="disabled")
    matches.reset(seed=0)
    row = matches.frame.rows.copy()
    frame = matches.frame.copy()
    frame.rows[:] = row
    frame.robots.position[0] = [[0.2 * i - 0.9, 0.7] for i in range(10)]
    frame.ball.position[:] = [[1.0, 0.0]]
    frame.ball.velocity[:] = [[1.5, 0.0]]
    matches.reset(rows=frame.rows)
    for _ in range(10):
        outcome = matches.step(np.zeros((1, 10, 2), np.float32))
        if outcome.terminated[0]:
            break
    assert CROSSINGS[int(matches.frame.ball.crossed[0])] == "goal_right"
    assert matches.frame.ball.crossed_at[0, 0] == pytest.approx(1.1)


def test_a_policy_can_be_trained_on_the_5v5_field(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for table in ("_TASKS", "_ALIASES"):
        monkeypatch.setattr(registry_names, table, dict(getattr(registry_names, table)))
    registry.alias("FiveASide-v0", "VSSSelfPlay-v0", field="vss_5v5", n_blue=5, n_yellow=5)
    policy = Network.load(train(one_update("FiveASide-v0", tmp_path)))
    policy.check_fits(FIVE, FIVE.layout.size)
    matches = Matches(FIVE, 2, controllers={"blue": policy})
    matches.reset()
    assert np.isfinite(matches.step(np.zeros((2, 5, 2), np.float32)).rewards).all()

"""The scripted side of SSL: it plays whole matches, obeys the referee, and repeats itself."""

from typing import Any

import numpy as np
import pytest

from rsoccer import Matches, make_task
from rsoccer.arrays import Floats
from rsoccer.game import Stage
from rsoccer.policies import make_policy
from rsoccer.policies.base import PolicyInput
from rsoccer.policies.ssl.team import ScriptedSsl
from rsoccer.rng import WorldRng
from tests.helpers import same


def played(seconds: float, worlds: int = 2, threads: int = 1, **options: Any) -> Matches:  # noqa: ANN401  (options of the task)
    controllers = {"blue": "scripted", "yellow": "scripted:0.3"}
    matches = Matches(
        "SSLMatch-v0", worlds, seed=3, threads=threads, controllers=controllers, **options
    )
    matches.reset()
    actions = np.zeros((worlds, 0, matches.action_size), np.float32)
    for _ in range(round(seconds / matches.task.config.time_step)):
        matches.step(actions)
    return matches


def test_it_plays_a_match_with_passes_and_few_fouls() -> None:
    matches = played(70.0)
    metrics = matches.task.metrics(matches.play)
    assert (matches.play.game.stage == Stage.NORMAL_FIRST_HALF).all()
    assert (metrics["in_play"] > 15.0).all()
    assert metrics["blue_passes"].sum() >= 3 and metrics["blue_shots"].sum() >= 1
    assert (metrics["blue_possession"] > metrics["yellow_possession"]).all()
    assert metrics["blue_fouls"].sum() + metrics["yellow_fouls"].sum() <= 4


def test_teams_of_all_sizes_place_the_ball_themselves() -> None:
    for n_blue, n_yellow in ((1, 3), (11, 2)):
        matches = played(
            20.0, 1, division="A", n_blue=n_blue, n_yellow=n_yellow, placement="robots"
        )
        assert matches.task.metrics(matches.play)["in_play"][0] > 2.0


def test_results_depend_on_neither_batch_nor_threads() -> None:
    one, many = played(8.0, 1), played(8.0, 20, threads=2)
    assert same(one.frame.rows[0], many.frame.rows[0])
    state = one.state_dict()
    assert any(name.endswith(".blue") for name in state), "memory is saved"


def test_it_plays_tasks_without_a_referee_too() -> None:
    task = make_task("SSLSelfPlay-v0")
    assert isinstance(make_policy("scripted:0.5", task), ScriptedSsl)
    matches = Matches(task, 2, controllers={"all": "scripted"})
    matches.reset()
    start: Floats = matches.frame.robots.position.copy()
    for _ in range(20):
        matches.step(np.zeros((2, 0, matches.action_size), np.float32))
    assert np.abs(matches.frame.robots.position - start).max() > 0.1


def test_wrong_skills_and_inputs_are_refused() -> None:
    task = make_task("SSLMatch-v0")
    with pytest.raises(ValueError, match=r"scripted: expected a skill from 0 to 1, got 1\.5"):
        ScriptedSsl(task, 1.5)
    policy = ScriptedSsl(task)
    rng = WorldRng.seeded(0, 1)
    inputs = PolicyInput((1, 6, 6), None, None)
    with pytest.raises(ValueError, match="needs the state of a match"):
        policy.act(inputs, rng, policy.new_memory((1, 6, 6), rng))

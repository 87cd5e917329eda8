"""Policies that try actions in a model of the match."""

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, Matches, Policy, WorldRng, make_task
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.policies import list_policies, make_policy
from rsoccer.policies.base import MatchState
from rsoccer.policies.lookahead import CANDIDATES, GROUP, Lookahead
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import Value
from rsoccer.task import Learn, Task
from tests.policies.networks import network_for

NAME = "VSSSelfPlay-v0"


def planner(task: Task | str = NAME, shield: str | None = None) -> Lookahead:
    """One that begins with actions of 0 and expects nothing after the next rewards."""
    source = make_task(NAME)
    layers = [(np.zeros((1, source.layout.size), np.float32), np.zeros(1, np.float32))]
    network = Network.from_layers(
        source,
        network_for(source).layers,
        [0.4, 0.4],
        shield=shield,
        value=Value(layers, 0.95, 3, 2.0),
    )
    return Lookahead(network, make_task(task) if isinstance(task, str) else task)


def ball_ahead(worlds: int = 1) -> Floats:
    """A ball before a robot of blue, and before the open goal; all other robots far away."""
    frame = Frame.empty(worlds, 3, 3)
    frame.robots.position[:, :, 0] = -0.6
    frame.robots.position[:, :, 1] = np.linspace(-0.5, 0.5, 6)
    frame.robots.position[:, 0] = 0.3, 0.0
    frame.robots.heading[:] = 1.0, 0.0
    frame.ball.position[:] = 0.37, 0.0
    return frame.rows


def played(policy: Policy, worlds: int, steps: int, *, seed: int = 0, threads: int = 1) -> Matches:
    """Matches from `ball_ahead`, of blue with a policy against robots that stand."""
    controllers: dict[str, Policy | str] = {"blue": policy, "yellow": "zero"}
    matches = Matches(NAME, worlds, seed, threads, controllers=controllers, autoreset="disabled")
    matches.reset(rows=ball_ahead(worlds))
    for _ in range(steps):
        matches.step(np.zeros((worlds, 0, 2), np.float32))
    return matches


def test_it_finds_actions_that_its_network_does_not_know() -> None:
    """The network drives at random around a stand; rewards of the next 75 ms lead the ball on."""
    start, policy = ball_ahead()[0, 0], planner()
    with_it, alone = (
        played(each, 8, 40).frame.ball.position[:, 0] - start for each in (policy, policy.network)
    )
    assert with_it.mean() > 0.15
    assert alone.mean() < 0.5 * with_it.mean()


def test_worlds_do_not_depend_on_each_other_or_on_threads() -> None:
    many = played(planner(), GROUP + 5, 6, threads=2).frame.rows
    for seed in (0, GROUP + 3):
        one = played(planner(), 1, 6, seed=seed).frame.rows
        np.testing.assert_allclose(many[seed], one[0], atol=1e-4)
    assert np.abs(many[0] - many[1]).max() > 1e-3, "each draws for itself"


def test_both_teams_plan_for_themselves() -> None:
    """What one gains the other loses: with the sum of both no ball would be worth a move."""
    matches = Matches(NAME, 8, controllers={"all": planner()}, autoreset="disabled")
    matches.reset(rows=ball_ahead(8))
    for _ in range(40):
        matches.step(np.zeros((8, 0, 2), np.float32))
    assert (matches.frame.ball.position[:, 0] > ball_ahead()[0, 0] + 0.1).mean() > 0.7


def test_ended_matches_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    policy = planner()
    plan, planned = policy._planned, list[int]()

    def counting(rows: Floats, match: MatchState, rng: WorldRng) -> Floats:
        planned.append(len(rows))
        return plan(rows, match, rng)

    monkeypatch.setattr(policy, "_planned", counting)
    matches = Matches(NAME, 4, controllers={"blue": policy}, autoreset="disabled", max_steps=2)
    matches.reset()
    matches.step(np.zeros((4, 3, 2), np.float32))
    matches.reset(mask=np.array([True, True, True, False]))
    matches.step(np.zeros((4, 3, 2), np.float32))
    matches.step(np.zeros((4, 3, 2), np.float32))
    assert planned == [4, 4, 4]
    matches.step(np.zeros((4, 3, 2), np.float32))
    assert planned == [4, 4, 4]


def test_a_single_robot_may_plan_beside_others() -> None:
    players: dict[str, Policy | str | Learn] = {"all": "zero", "blue_0": LEARN}
    matches = Matches(NAME, 2, controllers={**players, "blue_1": planner()})
    matches.reset(seed=0)
    outcome = matches.step(np.zeros((2, 1, 2), np.float32))
    assert np.isfinite(outcome.rewards).all()
    assert np.abs(matches.play.actions[:, 1]).max() > 0.0


@pytest.mark.parametrize(
    ("task", "options"),
    [
        ("VSSMatch-v0", {"half_seconds": 2.0}),
        ("VSSMatch-v0", {"half_seconds": 2.0, "n_blue": 5, "n_yellow": 5, "field": "vss_5v5"}),
        ("VSSMulti-v0", {}),
        ("VSS-v0", {"robot": "vss_firasim"}),
    ],
)
def test_it_plays_other_tasks_with_their_own_robots(task: str, options: dict[str, Any]) -> None:
    chosen = make_task(task, **options)
    policy = planner(chosen, shield="vsss")
    assert policy.task.config == chosen.config
    found = rsoccer.evaluate(policy, "zero", 2, task=chosen, threads=1)
    assert found.matches == 2


def test_it_plays_from_what_its_robots_know() -> None:
    found = rsoccer.evaluate(planner(), "zero", 2, task=NAME, threads=1, sensing="rc2021")
    assert found.matches == 2


def test_a_file_plays_with_it(tmp_path: Path) -> None:
    path = tmp_path / "own.safetensors"
    planner().network.save(path)
    policy = make_policy(f"{path}:lookahead", NAME)
    assert isinstance(policy, Lookahead)
    assert policy.task_name == NAME
    assert policy.network.value is not None
    assert policy.network.value.discount == 0.95
    copy = pickle.loads(pickle.dumps(policy))
    a, b = (played(each, 2, 3).frame.rows for each in (policy, copy))
    np.testing.assert_array_equal(a, b)
    assert "lookahead" not in list_policies()


def test_policies_that_cannot_plan_are_refused(tmp_path: Path) -> None:
    task, network = make_task(NAME), planner().network
    with pytest.raises(ValueError, match="with a value network and without a history"):
        Lookahead(network_for(task), task)
    with pytest.raises(ValueError, match=r"field and robots that VSSSelfPlay-v0 can have"):
        Lookahead(network, make_task("SSLGoToBall-v0"))
    path = tmp_path / "own.safetensors"
    network_for(task).save(path)
    with pytest.raises(ValueError, match=r"own.safetensors: lookahead: expected a policy with"):
        make_policy(f"{path}:lookahead", task)
    with pytest.raises(ValueError, match="scripted: expected a skill"):
        make_policy("scripted:lookahead", task)


def test_robots_that_its_network_does_not_play_are_refused() -> None:
    task = make_task("VSSMulti-v0")
    layers = [(np.zeros((1, task.layout.size), np.float32), np.zeros(1, np.float32))]
    value = Value(layers, 0.95, 3, 2.0)
    network = Network.from_layers(task, network_for(task).layers, value=value)
    matches = Matches(NAME, 1, controllers={"yellow": Lookahead(network, make_task(NAME))})
    matches.reset()
    with pytest.raises(ValueError, match=r"robots that learn in VSSMulti-v0.*got \['yellow_0'"):
        matches.step(np.zeros((1, 3, 2), np.float32))


def test_the_means_are_among_what_is_tried() -> None:
    policy = planner()
    means = np.full((2, 6, 2), 0.25, np.float32)
    rng = WorldRng.seeded(0, 2)
    tried = policy._tried(means, np.array([0, 2]), rng)
    assert tried.shape == (2, CANDIDATES, 6, 2)
    np.testing.assert_array_equal(tried[:, 0], means)
    np.testing.assert_array_equal(tried[:, :, [1, 3, 4, 5]], 0.25)
    assert (np.abs(tried) <= 1.0).all()
    assert tried[:, 1:, [0, 2]].std() > 0.25

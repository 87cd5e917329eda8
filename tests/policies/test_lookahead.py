"""Policies that try actions in a model of the match."""

import copy
import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, Matches, Policy, WorldRng, make_task
from rsoccer._core import Threads
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.policies import list_policies, lookahead, make_policy, trained_on
from rsoccer.policies.base import MatchState
from rsoccer.policies.lookahead import CANDIDATES, DECISIONS, GROUP, SEQUENCES, Lookahead
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import Value
from rsoccer.task import Learn, Task
from rsoccer.tasks import VssSelfPlay
from tests.policies.networks import network_for

NAME = "VSSSelfPlay-v0"


def network(source: Task | str = NAME, weights: float = 0.0, **changes: Any) -> Network:  # noqa: ANN401
    """One of mean actions near 0, whose value network has random weights of some size."""
    source = make_task(source) if isinstance(source, str) else source
    rng = np.random.default_rng(0)
    layers = [
        (
            np.asarray(weights * rng.normal(size=(size, source.layout.size)), np.float32),
            np.zeros(size, np.float32),
        )
        for size in (source.action_size, 1)
    ]
    given = {"action_std": [0.4] * source.action_size, "value": Value(layers[1:], 0.95, 3, 2.0)}
    return Network.from_layers(source, layers[:1], **{**given, **changes})


def planner(task: Task | str = NAME, **changes: Any) -> Lookahead:  # noqa: ANN401
    """A policy that begins with actions of 0, and expects nothing after the next rewards."""
    return Lookahead(network(**changes), task)


def beside_the_ball(worlds: int = 1, side: float = 1.0) -> Floats:
    """A robot of blue (side 1) or yellow (-1) with its back to the ball, others far away."""
    frame = Frame.empty(worlds, 3, 3)
    frame.robots.position[:, :, 0] = -0.6 * side
    frame.robots.position[:, :, 1] = np.linspace(-0.5, 0.5, 6)
    frame.robots.position[:, 0 if side > 0 else 3] = 0.2 * side, 0.0
    frame.robots.heading[:] = 1.0, 0.0
    frame.ball.position[:] = 0.3 * side, 0.02
    return frame.rows


def played(
    policy: Policy, worlds: int, steps: int, *, seed: int = 0, threads: int = 1, side: float = 1.0
) -> Matches:
    """Matches in which a policy drives both teams, from `beside_the_ball`."""
    matches = Matches(
        NAME, worlds, seed, threads, controllers={"all": policy}, autoreset="disabled"
    )
    matches.reset(rows=beside_the_ball(worlds, side))
    for _ in range(steps):
        matches.step(np.zeros((worlds, 0, 2), np.float32))
    return matches


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_each_team_finds_actions_that_its_network_does_not_know(side: float) -> None:
    """The network stands still; rewards of the next 75 ms lead the ball to the other goal."""
    policy = planner()
    policy.network.mode = "mean"
    ways = [
        side * (played(each, 16, 40, side=side).frame.ball.position[:, 0] - 0.3 * side)
        for each in (policy, policy.network)
    ]
    assert (ways[1] == 0.0).all()
    assert (ways[0] > -0.01).all()
    assert ways[0].mean() > 0.08


def test_the_joint_action_has_the_greatest_sum_of_rewards_and_value() -> None:
    """Hand-made: the values of what follows, without those of copies that ended in a goal."""
    policy = planner(weights=0.3)
    rows = np.concatenate([beside_the_ball(2), beside_the_ball(1)])
    frame = Frame.empty(3, 3, 3)
    frame.rows[:] = rows
    frame.ball.position[2], frame.ball.velocity[2] = (0.72, 0.0), (2.0, 0.0)  # a goal at once
    matches = Matches(NAME, 3, autoreset="disabled")
    matches.reset(rows=frame.rows)
    match = MatchState(frame.rows, matches.play.game, np.arange(3), Threads(), policy.task.config)
    tried = policy._tried(np.zeros((3, 6, 2), np.float32), np.arange(3), WorldRng.seeded(0, 3))
    found = policy._returns(match, np.arange(3), tried)
    for candidate in (0, 7, CANDIDATES - 1):
        matches.reset(rows=frame.rows)
        total = np.zeros((3, 6))
        for _ in range(3):
            outcome = matches.step(tried[:, candidate])
            total += outcome.rewards
        worth = 0.95 * policy.network.values(outcome.observations)
        worth[2] = 0.0
        np.testing.assert_allclose(
            found[:, candidate], (total / 2.0 + worth)[:, :3].sum(axis=1), rtol=1e-3, atol=1e-3
        )
    assert found[2].mean() > 3 * 10.0 / 2.0 * 0.9
    assert found[0].std() > 0.01


@pytest.mark.parametrize("own", [[0, 1, 2], [3, 4, 5]])
def test_in_danger_a_team_plays_the_first_action_of_the_best_sequence(own: list[int]) -> None:
    """Against the same sequences, played in matches."""
    policy, rng = planner(weights=0.3), np.random.default_rng(1)
    alone = Matches(NAME, seed=3)
    means = policy.network.mean_actions(alone.reset())
    rows = alone.frame.rows.copy()
    match = MatchState(rows, alone.play.game, np.array(own), Threads(), policy.task.config)
    tried = np.repeat(means[:, None], SEQUENCES, axis=1)
    noise = np.asarray(rng.normal(size=(1, SEQUENCES, DECISIONS, 3, 2)) * 0.5, np.float32)
    found = policy._best_first(match, np.array(own), tried.copy(), noise)
    matches = Matches(NAME, SEQUENCES, autoreset="disabled")
    matches.reset(rows=np.repeat(rows, SEQUENCES, axis=0))
    actions, returns, weight = tried[0].copy(), np.zeros(SEQUENCES), np.ones(SEQUENCES)
    for decision in range(DECISIONS):
        actions[:, own] = np.clip(actions[:, own] + noise[0, :, decision], -1.0, 1.0)
        if decision == 0:
            begun = actions[:, own].copy()
        for _ in range(3):
            outcome = matches.step(actions)
            returns += weight * outcome.rewards[:, own].sum(axis=1) / 2.0
            weight = np.where(outcome.ended, 0.0, weight)
        weight = weight * 0.95
        actions = policy.network.mean_actions(outcome.observations)
    returns += weight * policy.network.values(outcome.observations)[:, own].sum(axis=1)
    best = returns.argmax()
    assert returns.std() > 0.1
    assert np.sort(returns)[-1] - np.sort(returns)[-2] > 1e-3, "one is the best"
    np.testing.assert_array_equal(found[0], begun[best])


def test_worlds_in_danger_alone_try_sequences(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each as if it were alone; the others play the best joint action."""
    worlds = GROUP + 5

    def first_actions(danger: float, seeds: range) -> Floats:
        monkeypatch.setattr(lookahead, "DANGER", danger)
        policy = planner(weights=0.1)
        policy.network.mode = "mean"
        matches = Matches(NAME, len(seeds), seeds[0], controllers={"blue": policy})
        matches.reset()
        matches.step(np.zeros((len(seeds), 3, 2), np.float32))
        return matches.play.actions[:, :3].copy()

    def in_danger(danger: float) -> Mask:
        changed = first_actions(danger, range(worlds)) != first_actions(-np.inf, range(worlds))
        mask: Mask = changed.any(axis=(1, 2))
        return mask

    danger = next(d for d in np.linspace(-4.0, 4.0, 33) if in_danger(d).sum() >= worlds // 3)
    found = in_danger(danger)
    assert 2 < found.sum() < worlds - 2, "some are, some are not"
    many = first_actions(danger, range(worlds))
    for world in (int(found.argmax()), int((~found).argmax())):
        alone = first_actions(danger, range(world, world + 1))
        np.testing.assert_allclose(many[world], alone[0], atol=1e-4)


def test_noise_of_sequences() -> None:
    noise = lookahead._sequence_noise(WorldRng.seeded(0, 3), (2, 2))
    assert noise.shape == (3, SEQUENCES, DECISIONS, 2, 2)
    assert not noise[:, :2].any(), "the means, and the best joint action"
    assert (noise[:, 3::2] == noise[:, 3::2, :1]).all(), "constant"
    assert (noise[:, 2::2, 1:] != noise[:, 2::2, :1]).all()
    halves = noise[:, 2 : SEQUENCES // 2], noise[:, SEQUENCES // 2 :]
    for half, spread in zip(halves, lookahead.SEQUENCE_SPREADS, strict=True):
        assert abs(half.std() / spread - 1.0) < 0.1


def test_sequences_save_starts_that_one_decision_loses(monkeypatch: pytest.MonkeyPatch) -> None:
    """A robot of the other team drives the ball at the own goal, and the defenders are near."""
    rng, worlds = np.random.default_rng(0), 32
    frame = Frame.empty(worlds, 3, 3)
    frame.ball.position[:] = rng.uniform((-0.35, -0.3), (-0.1, 0.3), (worlds, 2))
    frame.robots.heading[:] = 1.0, 0.0
    frame.yellow.heading[:] = -1.0, 0.0
    frame.yellow.position[:, 0] = frame.ball.position + np.array([0.1, 0.0], np.float32)
    frame.yellow.position[:, 1:] = (0.6, 0.3), (0.6, -0.3)
    frame.blue.position[:, 0] = rng.uniform((-0.7, -0.5), (-0.5, 0.5), (worlds, 2))
    frame.blue.position[:, 1:] = (0.3, 0.4), (0.3, -0.4)
    lost = []
    for danger in (lookahead.DANGER, -np.inf):
        monkeypatch.setattr(lookahead, "DANGER", danger)
        controllers = {"blue": "best:lookahead", "yellow": "chase"}
        matches = Matches(NAME, worlds, controllers=controllers, autoreset="disabled")
        matches.reset(rows=frame.rows)
        score = np.zeros(worlds)
        for _ in range(60):
            running = ~matches.done
            outcome = matches.step(np.zeros((worlds, 0, 2), np.float32))
            score = np.where(running & outcome.ended, outcome.metrics["goal_score"], score)
        lost.append(int((score < 0.0).sum()))
    assert lost[0] < lost[1] - 1


def test_networks_see_their_last_actions(monkeypatch: pytest.MonkeyPatch) -> None:
    """The plan begins with the observation that the network alone would have."""
    policy, seen = planner(weights=0.2), list[Floats]()
    matches = Matches(NAME, 2, controllers={"all": policy}, autoreset="disabled")
    matches.reset()
    choose = policy.network.mean_actions

    def noting(observations: Floats) -> Floats:
        if len(observations) == matches.worlds:  # not those of what is tried
            seen.append(observations.copy())
        return choose(observations)

    monkeypatch.setattr(policy.network, "mean_actions", noting)
    for _ in range(4):
        expected = matches.task.layout.observe(matches.play)
        matches.step(np.zeros((2, 0, 2), np.float32))
        np.testing.assert_allclose(seen[-1], expected, atol=1e-6)
    assert np.abs(expected[..., -2:]).min() > 0.0


def test_worlds_do_not_depend_on_each_other_or_on_threads() -> None:
    policy = planner(weights=0.1)
    many = played(policy, GROUP + 5, 6, threads=2).frame.rows
    for seed in (0, GROUP + 3):
        one = played(policy, 1, 6, seed=seed).frame.rows
        np.testing.assert_allclose(many[seed], one[0], atol=1e-4)
    assert np.abs(many[0] - many[1]).max() > 1e-3, "each draws for itself"


def test_one_policy_may_play_in_several_threads_at_once() -> None:
    policy = planner(weights=0.1)
    expected = played(policy, 4, 10).frame.rows
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda _: played(policy, 4, 10).frame.rows, range(8)))
    for rows in found:
        np.testing.assert_array_equal(rows, expected)


def test_ended_matches_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    policy = planner()
    plan, planned = policy._planned, list[int]()

    def counting(match: MatchState, last: Floats, rng: WorldRng, count: int) -> Floats:
        planned.append(len(match.rows))
        return plan(match, last, rng, count)

    monkeypatch.setattr(policy, "_planned", counting)
    matches = Matches(NAME, 4, controllers={"blue": policy}, autoreset="disabled", max_steps=2)
    matches.reset()
    actions = np.zeros((4, 3, 2), np.float32)
    matches.step(actions)
    matches.reset(mask=np.array([True, True, False, False]))
    matches.step(actions)
    matches.step(actions)
    assert planned == [4, 4, 2]
    matches.step(actions)
    assert planned == [4, 4, 2], "all have ended"


def test_robots_that_the_shield_has_stand_do_not_plan(monkeypatch: pytest.MonkeyPatch) -> None:
    task = make_task("VSSMatch-v0", half_seconds=5.0)
    policy = planner(task, shield="vsss")
    plan, planned = policy._planned, list[int]()

    def counting(match: MatchState, last: Floats, rng: WorldRng, count: int) -> Floats:
        planned.append(len(match.rows))
        return plan(match, last, rng, count)

    monkeypatch.setattr(policy, "_planned", counting)
    matches = Matches(task, 2, controllers={"all": policy}, autoreset="disabled")
    matches.reset()
    stopped = 0
    for _ in range(200):
        before, may = len(planned), matches.play.game.may_touch.any(axis=1).copy()
        matches.step(np.zeros((2, 0, 2), np.float32))
        assert (len(planned) > before) == may.any()
        assert (matches.play.actions[~may] == 0.0).all()
        stopped += int(not may.any())
    assert 0 < stopped < 200


def test_a_single_robot_may_plan_beside_others() -> None:
    players: dict[str, Policy | str | Learn] = {"all": "zero", "blue_0": LEARN}
    matches = Matches(NAME, 2, controllers={**players, "blue_1": planner()})
    matches.reset(seed=0)
    outcome = matches.step(np.zeros((2, 1, 2), np.float32))
    assert np.isfinite(outcome.rewards).all()
    assert np.abs(matches.play.actions[:, 1]).max() > 0.0


@pytest.mark.parametrize(
    ("source", "task", "options"),
    [
        (NAME, "VSSMatch-v0", {"half_seconds": 2.0}),
        (NAME, "VSSMatch-v0", {"half_seconds": 2.0, "n_blue": 5, "n_yellow": 4}),
        (NAME, "VSSMulti-v0", {}),
        ("VSSMulti-v0", "VSSMulti-v0", {"max_steps": 40}),
        (NAME, "VSS-v0", {"robot": "vss_firasim", "max_steps": 40}),
        ("SSLStaticDefenders-v0", "SSLStaticDefenders-v0", {"max_steps": 20, "n_opponents": 2}),
        ("SSLSelfPlay-v0", "SSLSelfPlay-v0", {"max_steps": 20}),
    ],
)
def test_it_plays_tasks_with_their_own_robots(
    source: str, task: str, options: dict[str, Any]
) -> None:
    chosen = make_task(task, **options)
    shield = {} if source.startswith("SSL") else {"shield": "vsss"}
    policy = Lookahead(network(source, weights=0.05, **shield), chosen)
    assert policy.task.config == chosen.config
    assert (policy.task_name, policy.task_options) == (source, {})
    found = rsoccer.evaluate(policy, matches=2, task=chosen, threads=1)
    assert found.matches == 2


def test_it_plays_from_what_its_robots_know(monkeypatch: pytest.MonkeyPatch) -> None:
    policy = planner()
    plan, rows = policy._planned, list[Floats]()

    def noting(match: MatchState, last: Floats, rng: WorldRng, count: int) -> Floats:
        rows.append(match.rows.copy())
        return plan(match, last, rng, count)

    monkeypatch.setattr(policy, "_planned", noting)
    matches = Matches(NAME, 2, controllers={"blue": policy}, sensing="rc2021")
    matches.reset()
    for _ in range(10):
        known, true = matches.play.sensed.rows.copy(), matches.play.frame.rows.copy()
        matches.step(np.zeros((2, 3, 2), np.float32))
        np.testing.assert_array_equal(rows[-1], known)
    assert np.abs(known - true).max() > 1e-3


def test_a_file_plays_with_it(tmp_path: Path) -> None:
    path = tmp_path / "own.safetensors"
    source = make_task(NAME, n_blue=2, n_yellow=2)
    network(source, weights=0.1).save(path)
    policy = make_policy(f"{path}:lookahead", source)
    assert isinstance(policy, Lookahead)
    assert policy.network.value is not None
    assert policy.network.value.discount == 0.95
    task = trained_on(f"{path}:lookahead")
    assert task is not None
    assert (task.name, task.n_blue) == (NAME, 2), "the options of the file"
    assert "lookahead" not in list_policies()


def test_copies_play_alike() -> None:
    policy = planner(weights=0.1)
    expected = played(policy, 2, 3).frame.rows
    for other in (pickle.loads(pickle.dumps(policy)), copy.deepcopy(policy)):
        np.testing.assert_array_equal(played(other, 2, 3).frame.rows, expected)


def test_shipped_policies_play_with_it() -> None:
    for task in (NAME, "VSSMatch-v0", "VSS-v0"):
        for name in ("best:lookahead", "best:robust:lookahead"):
            assert isinstance(make_policy(name, task), Lookahead)
    with pytest.raises(ValueError, match="best: lookahead: expected a policy with a value network"):
        make_policy("best:lookahead", "VSSMulti-v0")
    with pytest.raises(ValueError, match="best: lookahead: expected a network, but SSLMatch"):
        make_policy("best:lookahead", "SSLMatch-v0")


@dataclass(frozen=True)
class OtherActions(VssSelfPlay):
    """Actions of another meaning."""

    name = "OtherActions-v0"

    @property
    def action_meaning(self) -> str:
        return "something else"


@pytest.mark.parametrize(
    ("changes", "lacking"),
    [
        ({"value": None}, "that lacks a value network"),
        ({"action_std": None}, "that lacks a constant action_std"),
        ({"head": "squashed"}, "that lacks a plain Gaussian head"),
    ],
)
def test_policies_that_cannot_plan_are_refused(changes: dict[str, Any], lacking: str) -> None:
    with pytest.raises(ValueError, match=f"expected a policy with .*{lacking}"):
        planner(**changes)


@pytest.mark.parametrize("task", ["SSLGoToBall-v0", OtherActions()], ids=["league", "actions"])
def test_tasks_of_other_bodies_and_actions_are_refused(task: Task | str) -> None:
    with pytest.raises(ValueError, match="expected field, robots and actions that VSSSelfPlay-v0"):
        planner(task)


def test_texts_that_name_no_such_policy_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "own.safetensors"
    network_for(make_task(NAME)).save(path)
    with pytest.raises(ValueError, match=r"own.safetensors: lookahead: expected a policy with"):
        make_policy(f"{path}:lookahead", NAME)
    with pytest.raises(ValueError, match="scripted: expected a skill"):
        make_policy("scripted:lookahead", NAME)


def test_the_means_are_among_what_is_tried() -> None:
    means = np.full((2, 6, 2), 0.25, np.float32)
    tried = planner()._tried(means, np.array([0, 2]), WorldRng.seeded(0, 2))
    assert tried.shape == (2, CANDIDATES, 6, 2)
    np.testing.assert_array_equal(tried[:, 0], means)
    np.testing.assert_array_equal(tried[:, :, [1, 3, 4, 5]], 0.25)
    assert (np.abs(tried) <= 1.0).all()
    assert tried[:, 1:, [0, 2]].std() > 0.25

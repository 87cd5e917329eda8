"""Shields of policies against fouls."""

from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, Matches, list_tasks, make_task
from rsoccer._core import AreaShield, AttackShield, Threads
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.game import EventKind
from rsoccer.history import ObservationStack
from rsoccer.policies import Policy, PolicyInput, make_policy
from rsoccer.policies.base import Memory
from rsoccer.policies.network import Network
from rsoccer.policies.shield import SHIELDS, Shield, shield_error
from rsoccer.rng import WorldRng
from rsoccer.tasks import SslMatch, SslStaticDefenders, VssMatch
from rsoccer.train import Args
from rsoccer.train.rollout.transition import repeat_action
from tests.games import begin_play
from tests.helpers import same
from tests.policies.networks import network_for
from tests.test_view import rotated

TASK = VssMatch(half_seconds=20.0, halves=1)


def crowd(worlds: int = 1) -> Floats:
    """Two robots of blue before yellow's goal area, and the ball in it."""
    frame = Frame.empty(worlds, 3, 3)
    frame.ball.position[:] = 0.68, 0.1
    frame.robots.position[:, :, 1] = np.linspace(-0.5, 0.5, 6)
    frame.robots.position[:, :2] = (0.55, 0.1), (0.53, -0.2)
    frame.robots.heading[:] = 1.0, 0.0
    return frame.rows


def fouls(policy: str | Network) -> Counter[tuple[str, int]]:
    """Events of 8 matches of a policy, as blue, against a script."""
    controllers = {"blue": policy, "yellow": "scripted"}
    matches = Matches(TASK, 8, controllers=controllers, autoreset="disabled")
    matches.reset()
    found: Counter[tuple[str, int]] = Counter()
    for _ in range(1200):
        matches.step(np.zeros((8, 0, 2), np.float32))
        for world in range(8):
            events = matches.play.events.of_world(world)
            found.update((event.kind.name, event.team) for event in events)
    return found


def test_it_stops_all_but_the_nearest_robot_for_any_number_of_threads() -> None:
    shield, robots = AreaShield(TASK.config), [0, 1, 2]
    actions = np.ones((600, 3, 2), np.float32)
    shield.apply(crowd(600), robots, actions)
    assert (actions[:, [0, 2]] == 1.0).all()
    assert (actions[:, 1] == 0.0).all()
    shared = np.ones((600, 3, 2), np.float32)
    shield.apply(crowd(600), robots, shared, Threads(2))
    assert same(shared, actions)


@pytest.mark.parametrize(
    ("changes", "error", "message"),
    [
        ({"rows": crowd()[:, :-1].copy()}, ValueError, "rows"),
        ({"robots": [6]}, ValueError, "robots: expected indices below 6, got 6"),
        ({"actions": np.ones((1, 2, 2), np.float32)}, ValueError, "actions"),
        ({"actions": np.ones((1, 1, 2))}, TypeError, "actions"),
    ],
)
def test_wrong_arrays_are_named(changes: dict[str, Any], error: type, message: str) -> None:
    right = {"rows": crowd(), "robots": [0], "actions": np.ones((1, 1, 2), np.float32)}
    with pytest.raises(error, match=message):
        AreaShield(TASK.config).apply(**{**right, **changes})


def test_other_drives_and_other_names_are_refused() -> None:
    with pytest.raises(ValueError, match="expected robots with a differential drive"):
        AreaShield(SslMatch().config)
    with pytest.raises(ValueError, match="expected robots with an omnidirectional drive"):
        AttackShield(TASK.config)
    names = r"\('vsss', 'ssl_attack'\)"
    with pytest.raises(ValueError, match=rf"shield: expected one of {names}, got 'walls'"):
        Shield("walls")
    with pytest.raises(
        ValueError, match=r"network\.shield must be one of vsss, ssl_attack, got 'w"
    ):
        Args.from_json({"task": "VSSMatch-v0", "network.shield": "walls"})


def test_it_belongs_to_a_policy_file_and_acts_under_a_referee_alone(tmp_path: Path) -> None:
    network = network_for(TASK)
    assert network.shield is None
    network.metadata["shield"] = "vsss"
    network.save(tmp_path / "a.safetensors")
    assert Network.load(tmp_path / "a.safetensors").shield is not None
    network.metadata["shield"] = "walls"
    network.save(tmp_path / "b.safetensors")
    with pytest.raises(ValueError, match="metadata 'shield' should be one of"):
        Network.load(tmp_path / "b.safetensors")
    shielded = make_policy("best:mean", "VSSSelfPlay-v0")
    bare = make_policy("best:mean", "VSSSelfPlay-v0")
    assert isinstance(bare, Network)
    bare.shield = None
    rows, would = [], False
    for policy in (shielded, bare):
        matches = Matches("VSSSelfPlay-v0", controllers={"all": policy})
        matches.reset(rows=crowd())
        core = AreaShield(matches.task.config)
        for _ in range(40):
            before = matches.frame.rows.copy()
            matches.step(np.zeros((1, 0, 2), np.float32))
            changed = matches.play.actions.copy()
            core.apply(before, list(range(6)), changed)
            would |= not same(changed, matches.play.actions)
        rows.append(matches.frame.rows.copy())
    assert same(*rows)
    assert would, "under a referee it would have acted"


def test_robots_stand_while_they_may_not_touch_the_ball() -> None:
    matches = Matches(TASK, 2, controllers={"all": "best"})
    matches.reset()
    assert not matches.play.game.may_touch.any()
    for _ in range(4):
        matches.step(np.zeros((2, 0, 2), np.float32))
        assert not matches.play.actions.any()
    while not matches.play.game.may_touch.all():
        matches.step(np.zeros((2, 0, 2), np.float32))
    matches.step(np.zeros((2, 0, 2), np.float32))
    assert matches.play.actions.all(axis=2).any()


def test_goals_that_did_not_count_count() -> None:
    bare = make_policy("best", TASK)
    assert isinstance(bare, Network)
    bare.shield = None
    without, behind = fouls(bare), fouls("best")
    assert without["INVALID_GOAL", 0] > 3
    assert behind["INVALID_GOAL", 0] < without["INVALID_GOAL", 0] / 3
    assert behind["GOAL", 0] > without["GOAL", 0] + 4
    crowded = EventKind.ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA.name
    assert behind[crowded, 0] <= without[crowded, 0]


def test_trainings_act_behind_it(tmp_path: Path) -> None:
    settings = {
        "task": "VSSMatch-v0",
        "out": str(tmp_path / "run"),
        "samples": 400,
        "rollout.worlds": 4,
        "ppo.n_minibatches": 2,
        "network.shield": "vsss",
        "task_options": {"half_seconds": 1.0, "halves": 1},
    }
    rsoccer.train.train(Args.from_json(settings))
    trained = Network.load(tmp_path / "run" / "policy.safetensors")
    assert trained.metadata["shield"] == "vsss"
    with pytest.raises(ValueError, match=r"^network\.shield: config: expected robots with a diff"):
        rsoccer.train.train(Args.from_json({**settings, "task": "SSLMatch-v0"}))
    attack = {**settings, "network.shield": "ssl_attack"}
    with pytest.raises(
        ValueError, match=r"^network\.shield: expected an attack challenge of the S"
    ):
        rsoccer.train.train(Args.from_json(attack))


TASKS_OF_SHIELDS = {
    "vsss": {"VSSMatch-v0", "VSSSelfPlay-v0", "VSS-v0", "VSSMulti-v0"},
    "ssl_attack": {"SSLStaticDefenders-v0", "SSLContestedPossession-v0"},
}


@pytest.mark.parametrize("name", SHIELDS)
def test_policies_of_some_tasks_can_have_a_shield(name: str) -> None:
    fitting = {task for task in list_tasks() if shield_error(name, make_task(task)) is None}
    assert fitting == TASKS_OF_SHIELDS[name]


def test_velocities_in_the_axes_of_the_robot_have_no_shield() -> None:
    task = SslStaticDefenders(velocity_frame="robot")
    assert "velocity_frame 'field'" in str(shield_error("ssl_attack", task))


def attack_ends(shield: str | None) -> Counter[str]:
    """Ends of 200 attacks of a robot that drives at the ball with full speed."""

    changes = None if shield is None else Shield(shield)

    class Rush(Policy):
        observes = "view"

        def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
            view = inputs.required_view("rush")
            actions = np.zeros(inputs.action_shape, np.float32)
            offset = view.ball.position - view.ego.position
            actions[..., :2] = offset / np.maximum(np.abs(offset).max(-1, keepdims=True), 1e-6)
            if changes is not None and inputs.match is not None:
                changes.apply(inputs.match, actions)
            return actions

    task = SslStaticDefenders(max_steps=200)
    matches = Matches(task, 200, controllers={"blue": Rush()}, autoreset="disabled")
    matches.reset()
    ends: Counter[str] = Counter()
    for _ in range(200):
        running = ~matches.done
        matches.step(np.zeros((200, 0, 5), np.float32))
        ended = running & matches.done
        frame = matches.frame
        ends["touch"] += int((ended & (frame.blue.touched_opponent[:, 0] > 0.5)).sum())
        position = frame.blue.position[:, 0]
        outside = task.is_off_field(position) | (position[:, 0] < -0.2)
        ends["outside"] += int((ended & outside).sum())
        ends["area"] += int((ended & task.is_in_goal_area(position)).sum())
    return ends


def test_a_robot_at_full_speed_stops_before_opponents_lines_and_the_goal_area() -> None:
    """Hardly any end so, where the same robot without the shield ends many episodes."""
    without, behind = attack_ends(None), attack_ends("ssl_attack")
    assert without["touch"] > 40
    assert without["outside"] + without["area"] > 10
    assert behind["touch"] <= 2
    assert behind["outside"] + behind["area"] <= 2


def test_the_shield_of_attacks_is_the_same_for_any_number_of_threads() -> None:
    config = SslStaticDefenders().config
    rng = np.random.default_rng(0)
    rows = Frame.empty(600, 1, 6)
    rows.robots.position[:] = rng.uniform((0.0, -2.0), (3.0, 2.0), (600, 7, 2))
    drawn = rng.uniform(-1.0, 1.0, (600, 1, 5)).astype(np.float32)
    alone, shared = drawn.copy(), drawn.copy()
    AttackShield(config).apply(rows.rows, [0], alone)
    AttackShield(config).apply(rows.rows, [0], shared, Threads(2))
    assert same(alone, shared)
    assert same(alone[..., 2:], drawn[..., 2:])
    changed = (alone != drawn).any(axis=(1, 2))
    assert 50 < changed.sum() < 550
    assert np.abs(alone).max() <= 1.0
    with pytest.raises(ValueError, match="actions: expected at least 2 numbers a robot, got 1"):
        AttackShield(config).apply(rows.rows, [0], drawn[..., :1].copy())


@pytest.mark.parametrize("sensing", [None, "rc2021, forecast=1"])
def test_actions_of_learners_of_both_teams_are_changed(sensing: str | None) -> None:
    task = VssMatch()
    matches = Matches(task, 2, controllers={"all": LEARN}, sensing=sensing)
    matches.reset()
    actions = np.full((2, 6, 2), 1.5, np.float32)
    repeat_action(matches, actions, 1, shield=Shield("vsss"))
    assert not matches.play.actions.any(), "before the kick-off"
    begin_play(matches)
    rows = crowd(2)
    rows[1] = rotated(Frame(rows[1:].copy(), 3, 3)).rows[0]  # yellow before blue's area
    matches.reset(rows=rows)
    begin_play(matches)
    matches.step(np.zeros_like(actions))  # from now on all may touch the ball
    repeat_action(matches, actions, 1, shield=Shield("vsss"))
    stopped = (matches.play.actions == 0.0).all(axis=2)
    assert stopped.tolist() == [[False, True] + [False] * 4, [False] * 4 + [True, False]]


def test_a_history_has_the_actions_that_robots_did() -> None:
    """As in training, where `Matches` stacks them."""
    stack = ObservationStack.of(TASK, 3)
    network = Network.from_layers(
        TASK,
        [(np.zeros((2, stack.size), np.float32), np.full(2, 0.5, np.float32))],
        history=3,
        action_repeat=3,
        shield="vsss",
    )
    matches = Matches(TASK, controllers={"all": network})
    matches.reset()
    group = matches.assignment.groups[0]
    for _ in range(4):
        matches.step(np.zeros((1, 0, 2), np.float32))
        assert not group.memory["past_actions"].any(), "all robots stand in the stop"
        assert group.memory["held"].any()

"""The option `chip_kick` of all SSL tasks."""

import numpy as np
import pytest

import rsoccer
from rsoccer import Frame, Matches, Policy, make_task
from rsoccer.arrays import Floats
from rsoccer.controllers import Controllers
from rsoccer.evaluate import evaluate
from rsoccer.policies import make_policy
from rsoccer.policies.base import Memory, PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.tasks.ssl import DISCRETE_ACTIONS, DISCRETE_ACTIONS_WITH_CHIP, MAX_LEGAL_KICK_SPEED
from rsoccer.testing import check_task
from rsoccer.train.clock import Clock
from rsoccer.train.opponents.policy_mix import PolicyMix
from tests.helpers import same, zeros

NAMES = [name for name in rsoccer.list_tasks() if name.startswith("SSL")]
FLAT, CHIP = [0.0, 0.0, 0.0, 0.6, -1.0, -1.0], [0.0, 0.0, 0.0, 0.6, -1.0, 0.2]


def kicked(action: list[float], velocity_frame: str) -> tuple[float, float]:
    """Greatest height and speed of a ball that is kicked from the mouth."""
    options = {"max_steps": 100, "chip_kick": True, "velocity_frame": velocity_frame}
    task = make_task("SSLGoToBall-v0", **options)
    matches = Matches(task, autoreset="disabled")
    frame = Frame.empty(1, 1, 0)
    frame.ball.position[0] = task.config.robot.front_distance + task.config.ball.radius, 0.0
    matches.reset(rows=frame.rows)
    heights, speeds = [], []
    for _ in range(10):
        matches.step(np.array([[action]], np.float32))
        heights.append(float(matches.frame.ball.height[0]))
        speeds.append(float(np.linalg.norm(matches.frame.ball.velocity[0])))
        if matches.done[0]:
            matches.reset(rows=matches.frame.rows)
    return max(heights), max(speeds)


@pytest.mark.parametrize("velocity_frame", ["field", "robot"])
def test_a_chip_flies_and_a_kick_does_not(velocity_frame: str) -> None:
    height, speed = kicked(CHIP, velocity_frame=velocity_frame)
    assert height > 0.2
    assert speed > 1.5
    height, speed = kicked(FLAT, velocity_frame=velocity_frame)
    assert height == 0.0
    assert speed > 3.0


def test_commands_of_a_chip_are_at_45_degrees_and_have_the_speed_of_the_kick() -> None:
    plain, chips = make_task("SSLSelfPlay-v0"), make_task("SSLSelfPlay-v0", chip_kick=True)
    play = Matches(plain, 4, seed=1).play
    actions = np.random.default_rng(0).uniform(-1, 1, (4, 6, 6)).astype(np.float32)
    flat = plain.get_commands(play, np.ascontiguousarray(actions[..., :5]))
    commands = chips.get_commands(play, actions)
    columns = list(plain.config.command_columns)
    along, up = columns.index("kick_v_x"), columns.index("kick_v_z")
    chip = actions[..., 5] > 0.0
    assert same(commands[~chip], flat[~chip])
    others = [i for i in range(6) if i not in (along, up)]
    assert same(commands[..., others], flat[..., others])
    speed = np.maximum(actions[..., 3], 0.0)[chip] * min(
        plain.config.robot.max_chip_speed, MAX_LEGAL_KICK_SPEED
    )
    np.testing.assert_allclose(commands[chip][:, along], speed * 0.5**0.5, rtol=1e-5)
    np.testing.assert_allclose(commands[chip][:, up], speed * 0.5**0.5, rtol=1e-5)
    assert commands[chip][:, up].any()


@pytest.mark.parametrize("name", NAMES)
def test_only_the_option_changes_actions_and_layout(name: str) -> None:
    plain, chips = make_task(name, chip_kick=False), make_task(name, chip_kick=True)
    assert (plain.action_size, chips.action_size) == (5, 6)
    assert "chip" not in plain.layout.text
    assert chips.layout.text.endswith("; chip kick")
    assert chips.layout.size == plain.layout.size + 1
    robot = make_task(name, chip_kick=True, velocity_frame="robot")
    assert robot.action_meaning == "velocity in the robot's axes; chip kick"
    with pytest.raises(TypeError, match="chip_kick: expected True or False, got 1"):
        make_task(name, chip_kick=1)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("discrete", [False, True])
def test_tasks_with_chips_keep_the_promises_of_tasks(name: str, discrete: bool) -> None:
    check_task(make_task(name, chip_kick=True, discrete=discrete), steps=40)


def test_the_table_of_a_discrete_task_has_one_more_row() -> None:
    task = make_task("SSLSelfPlay-v0", discrete=True, chip_kick=True)
    table = task.action_table
    assert table is not None
    assert same(table, DISCRETE_ACTIONS_WITH_CHIP)
    assert same(table[:-1, :5], DISCRETE_ACTIONS)
    assert (table[:-1, 5] == -1.0).all()
    assert table[-1].tolist() == [0.0, 0.0, 0.0, 1.0, -1.0, 1.0]
    matches = Matches(task)
    matches.reset()
    matches.step(np.full((1, 6), 12))
    assert (matches.play.actions == table[-1]).all()


def test_the_reflection_keeps_the_switch() -> None:
    symmetry = make_task("SSLSelfPlay-v0", chip_kick=True).symmetry
    assert symmetry is not None
    action = np.array([1, 2, 3, 4, 5, 6], np.float32)
    assert symmetry.action.apply(action).tolist() == [1, -2, -3, 4, 5, 6]
    assert make_task("SSLSelfPlay-v0", chip_kick=True).layout.reflection is not None


class FiveNumbers(Policy):
    """A script of one's own for the tasks without chips."""

    observes = "nothing"

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        return np.full((*inputs.action_shape[:2], 5), 0.3, np.float32)


@pytest.mark.parametrize(
    ("name", "script"),
    [
        ("SSLSelfPlay-v0", "strike"),
        ("SSLSelfPlay-v0", "fetch"),
        ("SSLSelfPlay-v0", "hold"),
        ("SSLSelfPlay-v0", "receive"),
        ("SSLPassEnduranceMulti-v1", "passer"),
        ("SSLDribbling-v0", "weave"),
        ("SSLSelfPlay-v0", FiveNumbers()),
    ],
)
def test_scripts_play_the_same_match_with_the_option(name: str, script: str | Policy) -> None:
    rows = []
    for chip_kick in (False, True):
        controllers: Controllers = {"all": script}
        task = make_task(name, chip_kick=chip_kick)
        matches = Matches(task, 3, seed=2, controllers=controllers)
        matches.reset()
        for _ in range(120):
            matches.step(zeros(matches))
        assert not chip_kick or not matches.play.actions[..., 5].any()
        rows.append(matches.frame.rows.copy())
    assert same(*rows)


def test_policies_that_were_trained_without_chips_are_refused() -> None:
    task = make_task("SSLGoToBall-v0", chip_kick=True)
    with pytest.raises(ValueError, match=r"best: .*trained on 'SSLGoToBall-v0'.*; chip kick"):
        make_policy("best", task)


def test_evaluation_takes_the_option() -> None:
    results = evaluate("fetch", task=make_task("SSLGoToBall-v0", chip_kick=True), matches=4)
    assert results.metrics


def test_a_mixture_of_opponents_may_hold_scripts_without_chips() -> None:
    task = make_task("SSLSelfPlay-v0", chip_kick=True)
    mix = PolicyMix(task, {"strike": 1.0, "zero": 1.0}, Clock())
    matches = Matches(task, 4, controllers={"all": mix})
    matches.reset()
    matches.step(zeros(matches))
    assert matches.play.actions.any()
    assert not matches.play.actions[..., 5].any()


def test_an_action_may_not_lack_more_than_the_optional_numbers() -> None:
    class FourNumbers(FiveNumbers):
        def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
            return super().act(inputs, rng, memory)[..., :4]

    task = make_task("SSLSelfPlay-v0", chip_kick=True)
    matches = Matches(task, controllers={"all": FourNumbers()})
    matches.reset()
    with pytest.raises(ValueError, match=r"FourNumbers.act: expected shape \(1, 6, 6\), got"):
        matches.step(zeros(matches))

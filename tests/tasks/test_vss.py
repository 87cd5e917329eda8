import math
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches
from rsoccer._core import MAX_PLACED_SPEED
from rsoccer.controllers import Controllers
from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT, Frame
from rsoccer.rng import WorldRng
from rsoccer.tasks import VssMulti, VssSelfPlay
from rsoccer.tasks.vss import Vss
from tests.helpers import body_columns, pushing

NAMES = [name for name in rsoccer.list_tasks() if name.startswith("VSS")]
ENDED_BY_GOALS = [name for name in NAMES if name != "VSSMatch-v0"]


def test_agents() -> None:
    blue = ("blue_0", "blue_1", "blue_2")
    assert Matches("VSSMulti-v0").agents == blue
    assert Matches("VSSSelfPlay-v0").agents == (*blue, "yellow_0", "yellow_1", "yellow_2")


def test_the_opponent_is_an_option() -> None:
    matches = Matches(VssMulti(opponent="zero"), 2)
    matches.reset()
    matches.step(np.ones((2, 3, 2), np.float32))
    assert not matches.play.actions[:, 3:].any()
    with pytest.raises(ValueError, match="unknown policy 'nobody'"):
        Matches(VssMulti(opponent="nobody"))


def test_initial_states_are_random_without_overlap() -> None:
    task = VssSelfPlay(ball_speed=0.5)
    frame = task.get_initial_positions_frame(WorldRng.seeded(0, 3000))
    robots, ball = frame.robots.position, frame.ball.position[:, None]
    everything = np.concatenate([ball, robots], axis=1).astype(np.float64)
    gaps = np.linalg.norm(everything[:, :, None] - everything[:, None], axis=-1) + np.eye(7)
    assert gaps.min() >= 0.1
    speed = np.hypot(*frame.ball.velocity.T)
    assert 0.45 < speed.max() <= 0.5 + 1e-6
    assert not frame.robots.velocity.any()
    assert np.abs(frame.robots.heading.mean(axis=(0, 1))).max() < 0.05
    still = VssSelfPlay().get_initial_positions_frame(WorldRng.seeded(0, 10))
    assert not still.ball.velocity.any()


def test_commands_are_fractions_of_the_top_wheel_speed() -> None:
    for robot in ("vss_440rpm", "vss_650rpm"):
        task = VssSelfPlay(robot=robot)
        play = Matches(task, 1).play
        actions = np.array([[[1.0, -0.5]] * 6], np.float32)
        top = task.config.robot.max_wheel_speed
        assert task.get_commands(play, actions)[0, 0] == pytest.approx([top, -top / 2])
        assert task.get_commands(play, actions).dtype == np.float32


def test_full_power_drives_at_top_speed_straight_ahead() -> None:
    task = VssSelfPlay(n_blue=1, n_yellow=0)
    frame = Frame.empty(1, 1, 0)
    frame.blue.position[:] = [[-0.6, 0.3]]
    frame.ball.position[:] = [[0.5, -0.5]]
    matches = Matches(task, 1)
    matches.reset(rows=frame.rows)
    for _ in range(30):
        matches.step(np.ones((1, 1, 2), np.float32))
    ego = matches.frame.blue
    assert ego.velocity[0, 0] == pytest.approx(
        [task.config.robot.top_speed, 0.0], rel=0.02, abs=1e-4
    )
    assert ego.position[0, 0, 1] == pytest.approx(0.3, abs=1e-4)


def test_observed_positions_of_ball_and_goal_are_true() -> None:
    frame = Frame.empty(1, 1, 1)
    frame.blue.position[:] = [[0.25, 0.0]]
    frame.blue.heading[:] = [[0.0, 1.0]]
    frame.yellow.position[:] = [[0.6, 0.4]]
    frame.ball.position[:] = [[0.25, 0.3]]
    matches = Matches(VssSelfPlay(n_blue=1, n_yellow=1), 1)
    flat = matches.reset(rows=frame.rows)[0, 0]
    blocks = {name: flat[block.columns] for name, block in matches.task.layout.blocks.items()}
    # The robot faces +y, so the goal at +x is on its right. Lengths are in half fields, 0.75 m.
    assert blocks["ball_polar"] == pytest.approx([0.4, 1.0, 0.0], abs=1e-5)
    assert blocks["goal_polar"] == pytest.approx([0.5 / 0.75, 0.0, -1.0], abs=1e-5)
    # The own goal is 1 m behind on the left; the ball ahead is not pushed toward it.
    assert blocks["own_goal_polar"] == pytest.approx([1.0 / 0.75, 0.0, 1.0], abs=1e-5)
    to_own_goal = math.hypot(1.0, 0.3)
    near = math.exp(-0.3 / 0.125)
    assert blocks["own_goal_shot"] == pytest.approx(
        [-0.3 / to_own_goal, 1.0 / to_own_goal, near * -0.3 / to_own_goal], abs=1e-5
    )
    assert blocks["ball"] == pytest.approx([0.25 / 0.75, 0.4, 0.0, 0.0], abs=1e-5)
    assert blocks["ego"] == pytest.approx([0.25 / 0.75, 0, 0, 1, 0, 0, 0], abs=1e-5)
    assert blocks["opponents"][:2] == pytest.approx([0.8, 0.4 / 0.75], abs=1e-5)


def test_the_last_action_is_observed() -> None:
    matches = Matches(VssSelfPlay(), 2)
    columns = matches.task.layout.blocks["action"].columns
    assert not matches.reset()[..., columns].any()
    actions = np.random.default_rng(0).uniform(-1, 1, (2, 6, 2)).astype(np.float32)
    assert (matches.step(actions).observations[..., columns] == actions).all()


@pytest.mark.parametrize("name", NAMES)
def test_observations_use_their_range_and_are_rarely_clipped(name: str) -> None:
    matches = Matches(name, 64, controllers={"blue": rsoccer.LEARN})
    matches.reset()
    rng = np.random.default_rng(0)
    observed = np.concatenate(
        [matches.step(pushing(rng, matches)).observations for _ in range(100)]
    )
    high = matches.observation_high
    bodies = body_columns(matches.task)
    assert (np.abs(observed) >= high - 1e-6)[..., bodies].mean() < 1e-3
    assert np.abs(observed[..., bodies]).max(axis=(0, 1)).min() > 0.2
    assert 0.2 < observed.std() < 1.5


@pytest.mark.parametrize("name", ENDED_BY_GOALS)
def test_goals_are_the_largest_part_of_the_return(name: str) -> None:
    """Measured with the scripted policy `chase` against robots at rest."""
    worlds = 60
    task = rsoccer.make_task(name)
    learners: Controllers = {"all": rsoccer.LEARN, "yellow": "zero"}
    chase = rsoccer.policies.make_policy("chase", task)
    matches = Matches(task, worlds, seed=1, controllers=learners, autoreset="disabled", threads=2)
    matches.reset()
    rng, memory = (
        WorldRng.seeded(0, worlds),
        chase.new_memory((worlds, 3, 2), WorldRng.seeded(0, 1)),
    )
    totals = dict.fromkeys(Vss.REWARD_WEIGHTS, 0.0)
    goals = 0
    for _ in range(task.max_steps):
        inputs = rsoccer.policies.PolicyInput((worlds, 3, 2), matches.play.view, None)
        outcome = matches.step(chase.act(inputs, rng, memory))
        for term, value in outcome.terms.items():
            totals[term] += float(np.abs(value).sum())
        goals += int(outcome.terminated.sum())
        if matches.done.all():
            break
    share = {term: total / sum(totals.values()) for term, total in totals.items()}
    assert goals > 0.8 * worlds
    assert share["goal"] == max(share.values()), share
    assert share["energy"] < 0.02, share
    assert min(share.values()) > 0.0, share


@pytest.mark.parametrize("name", ENDED_BY_GOALS)
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_goal_of_either_team_terminates_and_sets_the_score(name: str, side: float) -> None:
    frame = Frame.empty(1, 3, 3)
    frame.blue.position[:] = [[-0.5, 0.45], [-0.4, 0.45], [-0.3, 0.45]]
    frame.yellow.position[:] = [[0.3, 0.45], [0.4, 0.45], [0.5, 0.45]]
    frame.ball.position[:] = [[0.6 * side, 0.1]]
    frame.ball.velocity[:] = [[1.2 * side, 0.0]]
    controllers: Controllers = {"all": rsoccer.LEARN}
    matches = Matches(name, 1, controllers=controllers, autoreset="disabled")
    matches.reset(rows=frame.rows)
    for _ in range(30):
        outcome = matches.step(np.zeros((1, 6, 2), np.float32))
        if outcome.ended[0]:
            break
        assert outcome.metrics["goal_score"][0] == 0.0
    assert outcome.terminated[0]
    assert not outcome.truncated[0]
    assert outcome.metrics["goal_score"][0] == side
    assert matches.frame.ball.crossed[0] == (GOAL_RIGHT if side > 0 else GOAL_LEFT)
    assert outcome.terms["goal"][0].tolist() == [10.0 * side] * 3 + [-10.0 * side] * 3


def test_reward_weights_are_options() -> None:
    task = VssSelfPlay(reward_weights={"approach": 0.0})
    assert task.reward_weights == {**Vss.REWARD_WEIGHTS, "approach": 0.0}
    matches = Matches(task, 2)
    matches.reset()
    outcome = matches.step(np.ones((2, 6, 2), np.float32))
    assert not outcome.terms["approach"].any()
    assert outcome.terms["energy"].any()


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"n_blue": 0}, ValueError, "n_blue: expected at least 1"),
        ({"n_blue": 1.5}, TypeError, "n_blue: expected a whole number"),
        ({"n_blue": 99}, ValueError, "99|robots"),
        ({"n_yellow": -1}, ValueError, "n_yellow: expected at least 0"),
        ({"max_steps": 0}, ValueError, "max_steps: expected at least 1"),
        ({"ball_speed": -0.1}, ValueError, "ball_speed: expected 0 to 20, got -0.1"),
        ({"ball_speed": float("nan")}, ValueError, "ball_speed: expected 0 to 20, got nan"),
        ({"ball_speed": 30}, ValueError, "ball_speed: expected 0 to 20, got 30"),
        ({"ball_speed": "fast"}, TypeError, "ball_speed: expected a number, got 'fast'"),
        ({"ball_speed": None}, TypeError, "ball_speed: expected a number, got None"),
        (
            {"reward_weights": None},
            TypeError,
            "reward_weights: expected a mapping or 'paper', got None",
        ),
        ({"reward_weights": ["goal"]}, TypeError, "reward_weights: expected a mapping or 'paper'"),
        (
            {"reward_weights": {"goal": "3"}},
            TypeError,
            "reward_weights: expected a number for 'goal', got '3'",
        ),
        (
            {"reward_weights": {1: 3.0, "style": 1}},
            ValueError,
            r"reward_weights: unknown \[1, 'style'\]",
        ),
        ({"discrete": "no"}, TypeError, "discrete: expected True or False, got 'no'"),
        ({"robot": "ssl_generic"}, ValueError, "robot: expected one with a differential drive"),
        ({"robot": ["vss_440rpm"] * 3 + ["vss_650rpm"] * 3}, ValueError, "robot: expected one mod"),
        ({"field": "vss_9v9"}, ValueError, "field: expected one of.*vss_9v9"),
        (
            {"field": "ssl_b"},
            ValueError,
            "field: expected one of VSSS, like .vss_5v5.",
        ),
        (
            {"reward_weights": {"style": 1.0}},
            ValueError,
            r"reward_weights: unknown \['style'\]; valid.*'goal'",
        ),
        (
            {"reward_weights": {"goal": float("inf")}},
            ValueError,
            "reward_weights: expected a finite number",
        ),
        ({"robot": "vss_9000rpm"}, ValueError, "vss_9000rpm"),
        (
            {"robot": 3},
            TypeError,
            "robot: expected a preset's name, the path of a .json file or a RobotModel, got 3$",
        ),
        (
            {"robot": [3] * 6},
            TypeError,
            "robot: expected a preset's name, the path of a .json file or a RobotModel, got 3$",
        ),
        (
            {"field": 3},
            TypeError,
            "field: expected a preset's name, the path of a .json file or a Field, got 3$",
        ),
    ],
)
def test_invalid_options_are_refused(
    options: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        VssSelfPlay(**options)


def test_the_ball_may_start_at_the_fastest_speed_of_the_simulator() -> None:
    """A task with 30 m/s was valid, and its matches failed at a later reset."""
    task = VssSelfPlay(ball_speed=MAX_PLACED_SPEED)
    frame = task.get_initial_positions_frame(WorldRng.seeded(0, 2000))
    fastest = np.hypot(*frame.ball.velocity.T).max()
    assert fastest > 0.99 * MAX_PLACED_SPEED
    frame.ball.velocity[0] = [
        0.6 * MAX_PLACED_SPEED * (1 + 1e-7),
        0.8 * MAX_PLACED_SPEED * (1 + 1e-7),
    ]
    Matches(task, 2000).reset(rows=frame.rows)


def test_tasks_are_immutable_values() -> None:
    assert VssSelfPlay(n_blue=2) == VssSelfPlay(n_blue=2)
    assert VssSelfPlay(n_blue=2) != VssSelfPlay(n_blue=1)
    with pytest.raises(AttributeError):
        VssSelfPlay().n_blue = 2  # type: ignore[misc]
    assert issubclass(VssMulti, Vss)

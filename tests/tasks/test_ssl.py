"""Options, actions and observations of all SSL tasks."""

from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, Matches
from rsoccer._core import Field, Steering
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.tasks import SslContestedPossession, SslGoToBall, SslSelfPlay, SslStaticDefenders
from rsoccer.tasks.ssl import VELOCITY_FRAMES, Ssl
from tests.helpers import body_columns, pushing
from tests.tasks import steering_reference
from tests.tasks.ssl_scenes import make, scene

NAMES = [name for name in rsoccer.list_tasks() if name.startswith("SSL")]


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        (
            {"velocity_frame": "ball"},
            ValueError,
            r"velocity_frame: expected one of \('field', 'robot'\), got 'ball'",
        ),
        (
            {"reward_weights": {"style": 1.0}},
            ValueError,
            r"reward_weights: unknown \['style'\]; valid are",
        ),
        (
            {"reward_weights": "old"},
            ValueError,
            "reward_weights: expected a mapping or 'paper', got 'old'",
        ),
        (
            {"reward_weights": {"energy": float("nan")}},
            ValueError,
            "reward_weights: expected a finite number",
        ),
        ({"max_steps": 0}, ValueError, "max_steps: expected at least 1"),
        ({"robot": "vss_440rpm"}, ValueError, "robot: expected one with an omnidirectional"),
        ({"robot": "ssl_9000"}, ValueError, "ssl_9000"),
        ({"field": "ssl_z"}, ValueError, "ssl_z"),
        ({"field": "vss_5v5"}, ValueError, "field: expected one of the SSL|at most 5 on a vss_5v5"),
        ({"ball": "tennis"}, ValueError, "ball: expected one of.*tennis"),
        (
            {"field": None},
            TypeError,
            "field: expected a preset's name, the path of a .json file or a Field, got None$",
        ),
        (
            {"robot": 3},
            TypeError,
            "robot: expected a preset's name, the path of a .json file or a RobotModel, got 3$",
        ),
        (
            {"ball": 3},
            TypeError,
            "ball: expected a preset's name, the path of a .json file or a BallModel, got 3$",
        ),
        (
            {"reward_weights": None},
            TypeError,
            "reward_weights: expected a mapping or 'paper', got None",
        ),
        (
            {"reward_weights": {"energy": "3"}},
            TypeError,
            "reward_weights: expected a number for 'energy'",
        ),
        ({"discrete": 1}, TypeError, "discrete: expected True or False, got 1"),
        ({"color": 1}, TypeError, "unexpected keyword argument .color."),
    ],
)
@pytest.mark.parametrize("name", NAMES)
def test_invalid_options_are_refused(
    name: str, options: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        make(name, **options)


@pytest.mark.parametrize("name", NAMES)
def test_reward_weights_are_data_and_paper_is_a_preset(name: str) -> None:
    task, paper = make(name), make(name, reward_weights="paper")
    assert isinstance(task, Ssl)
    assert isinstance(paper, Ssl)
    assert task.reward_weights == task.REWARD_WEIGHTS
    assert paper.reward_weights == paper.PAPER_REWARD_WEIGHTS
    assert set(task.REWARD_WEIGHTS) == set(task.PAPER_REWARD_WEIGHTS)
    for each in (task, paper):
        matches = Matches(each, 3)
        matches.reset()
        outcome = matches.step(pushing(np.random.default_rng(0), matches))
        assert set(outcome.terms) == set(task.REWARD_WEIGHTS)


def moved(task: Ssl, action: list[float]) -> tuple[Floats, float]:
    """Position and heading after half a second of a robot that starts at the center facing +y."""
    matches = Matches(task, 1, autoreset="disabled")
    matches.reset(rows=scene(task, ball=(2.0, -1.5), blue_0=(0.0, 0.0, np.pi / 2)).rows)
    for _ in range(20):
        matches.step(np.array([[action]], np.float32))
    heading = matches.frame.blue.heading[0, 0]
    return matches.frame.blue.position[0, 0].copy(), float(np.arctan2(heading[1], heading[0]))


def test_velocities_are_along_the_axes_of_the_field() -> None:
    task = SslGoToBall()
    (x, y), angle = moved(task, [0.2, 0.0, 0.0, -1.0, -1.0])
    assert x > 0.2
    assert abs(y) < 0.01
    assert angle == pytest.approx(np.pi / 2, abs=0.01)


def test_velocity_frame_robot_is_along_the_axes_of_the_body() -> None:
    by_field = moved(SslGoToBall(), [-0.1, 0.2, 0.0, -1.0, -1.0])
    by_robot = moved(SslGoToBall(velocity_frame="robot"), [0.2, 0.1, 0.0, -1.0, -1.0])
    assert by_robot[0] == pytest.approx(by_field[0], abs=1e-4)
    # While the robot turns, only velocities in the field frame keep their direction.
    assert moved(SslGoToBall(), [0.2, 0.0, 0.3, -1.0, -1.0])[0][1] == pytest.approx(0.0, abs=0.05)
    assert moved(SslGoToBall(velocity_frame="robot"), [0.2, 0.0, 0.3, -1.0, -1.0])[0][1] > 0.1


def test_commands_are_fractions_of_the_limits() -> None:
    task = SslGoToBall(velocity_frame="robot")
    play = Matches(task, 1).play
    commands = task.get_commands(play, np.array([[[0.5, -1.0, 0.1, 0.5, 1.0]]], np.float32))
    assert commands[0, 0] == pytest.approx([1.85, -3.7, 1.0, 3.25, 0.0, 1.0])
    commands = task.get_commands(play, np.array([[[0.0, 0.0, 0.0, -0.5, -1.0]]], np.float32))
    assert not commands.any()


@pytest.mark.parametrize("velocity_frame", VELOCITY_FRAMES)
@pytest.mark.parametrize("worlds", [1, 5])
def test_commands_equal_the_reference(velocity_frame: str, worlds: int) -> None:
    task = SslSelfPlay(n_blue=3, n_yellow=2, velocity_frame=velocity_frame)
    matches = Matches(task, worlds)
    matches.reset(0)
    actions = np.random.default_rng(0).uniform(-1, 1, (worlds, 5, 5)).astype(np.float32)
    commands = task.get_commands(matches.play, actions)
    assert commands.dtype == np.float32
    expected = steering_reference.commands(task, matches.frame, actions)
    np.testing.assert_allclose(commands, expected, rtol=1e-6, atol=1e-6)


def test_steering_refuses_wrong_arrays() -> None:
    steering = Steering([1.0] * 5, True, 1)
    actions, rows = np.zeros((3, 2, 5), np.float32), Frame.empty(3, 1, 1).rows
    assert steering.commands(actions, rows).shape == (3, 2, 6)
    with pytest.raises(ValueError, match=r"actions must have shape \(3, 2, 5\), got \(3, 2, 4\)"):
        steering.commands(actions[..., :4], rows)
    with pytest.raises(ValueError, match=r"rows must have shape \(3, 41\), got \(2, 41\)"):
        steering.commands(actions, rows[:2])
    with pytest.raises(TypeError, match="actions must be an array of float32, got float64"):
        steering.commands(actions.astype(np.float64), rows)
    with pytest.raises(ValueError, match="scales must be finite, got inf"):
        Steering([1.0, np.inf, 1.0, 1.0, 1.0], True, 1)
    with pytest.raises(ValueError, match="n_blue must not be negative, got -1"):
        Steering([1.0] * 5, True, -1)
    with pytest.raises(ValueError, match="expected a sequence of length 5"):
        Steering([1.0], True, 1)


def test_yellow_plays_in_coordinates_rotated_by_180_degrees() -> None:
    task = SslSelfPlay(n_blue=1, n_yellow=1)
    start = scene(task, ball=(0.0, 1.5), blue_0=(1.0, 0.0), yellow_0=(-1.0, 0.0, np.pi))
    matches = Matches(task, 1)
    matches.reset(rows=start.rows)
    action = [0.2, 0.1, 0.0, -1.0, -1.0]
    for _ in range(20):
        matches.step(np.array([[action, action]], np.float32))
    blue, yellow = matches.frame.robots.position[0]
    assert blue == pytest.approx(-yellow, abs=1e-5)
    assert blue[0] > 1.1


@pytest.mark.parametrize("name", NAMES)
def test_discrete_agents_choose_from_a_table(name: str) -> None:
    match = rsoccer.parallel_env(name, discrete=True)
    table = match.task.action_table
    assert table is not None
    match.reset(seed=0)
    for agent in match.agents:
        assert match.action_space(agent).n == len(table)  # type: ignore[union-attr]
    match.step({agent: np.array(len(table) - 1) for agent in match.agents})
    last = match._matches.play.actions[0, 0]
    assert last.tolist() == table[-1].tolist()


@pytest.mark.parametrize("name", NAMES)
def test_observations_are_rarely_clipped(name: str) -> None:
    matches = Matches(name, 32, controllers={"blue_0": LEARN})
    matches.reset()
    rng = np.random.default_rng(0)
    observed = np.concatenate([matches.step(pushing(rng, matches)).observations for _ in range(80)])
    high = matches.observation_high
    assert (np.abs(observed) >= high - 1e-6)[..., body_columns(matches.task)].mean() < 1e-3
    assert 0.1 < observed.std() < 1.5
    assert np.isfinite(observed).all()


def test_the_break_beam_is_observed() -> None:
    task = SslContestedPossession()
    start = scene(task, ball=(0.593, 0.0), blue_0=(0.5, 0.0), yellow_0=(2.0, 0.0))
    matches = Matches(task, 1)
    observed = matches.reset(rows=start.rows)[0, 0]
    ego, opponents = (observed[task.layout.blocks[name].columns] for name in ("ego", "opponents"))
    assert ego[-1] == 1.0
    assert opponents[-1] == 0.0
    assert ego[:4] == pytest.approx([0.5 / 3.0, 0.0, 1.0, 0.0], abs=1e-6)


def test_tasks_are_immutable_values() -> None:
    assert SslStaticDefenders(scenario=3) == SslStaticDefenders(scenario=3)
    assert SslStaticDefenders(scenario=3) != SslStaticDefenders()
    with pytest.raises(AttributeError):
        SslStaticDefenders().scenario = 3  # type: ignore[misc]


def test_a_field_without_space_for_the_initial_state_is_refused() -> None:
    small = Field("ssl_challenge", length=1.5, width=1.2)
    for name, options in (
        ("SSLDribbling-v0", {}),
        ("SSLSelfPlay-v0", {"n_blue": 11, "n_yellow": 11}),
        ("SSLContestedPossession-v0", {"scenario": 4}),
        ("SSLStaticDefenders-v0", {}),
    ):
        with pytest.raises(
            ValueError, match="field: no space for the initial state of this task on"
        ):
            make(name, field=small, **options)


@pytest.mark.parametrize("name", NAMES)
def test_matches_start_on_every_ssl_field(name: str) -> None:
    # The smallest field is narrower than the usual area of keepaway.
    area = {"area_width": 4.0} if name == "SSLKeepaway-v0" else {}
    for field in ("ssl_a", "ssl_b", "ssl_challenge"):
        Matches(make(name, field=field, **area), 8).reset()


def test_strict_contact_is_a_boolean() -> None:
    with pytest.raises(TypeError, match="strict_contact: expected True or False, got 'no'"):
        SslContestedPossession(strict_contact="no")  # type: ignore[arg-type]


def test_the_goal_area_with_and_without_a_margin() -> None:
    task = SslGoToBall()
    field = task.config.field
    front, side = field.half_length - field.goal_area_depth, field.goal_area_width / 2
    points = [(front + 0.01, 0.0), (front - 0.01, 0.0), (front + 0.01, -side - 0.01), (-3.0, 0.0)]
    positions = np.array(points, np.float32)
    assert task.is_in_goal_area(positions).tolist() == [True, False, False, False]
    assert task.is_in_goal_area(positions, 0.02).tolist() == [True, True, True, False]

import numpy as np
import pytest

import rsoccer
from rsoccer import SimConfig, Simulator, entities
from rsoccer.entities import Ball, Entities, FieldParameters, Robot
from rsoccer.frame import Frame


def example() -> Entities:
    """Numbers that a float32 holds exactly, all different."""
    robot = Robot(False, 0, x=0.5, y=-0.25, theta=90.0, v_x=1.5, v_y=-0.125)
    other = Robot(True, 0, x=-0.5, y=0.125, theta=180.0, infrared=True)
    ball = Ball(0.25, 0.75, 0.0625, -2.0, 3.0, 4.0)
    return Entities(ball, {0: robot}, {0: other})


def framed(rows: np.ndarray, n_blue: int, n_yellow: int) -> Frame:
    return Frame(np.ascontiguousarray(rows, np.float32), n_blue, n_yellow)


def test_entities_survive_a_round_trip_through_a_row() -> None:
    row = entities.to_row(example(), 1, 1)
    assert entities.from_frame(framed(row[None], 1, 1), 0) == example()


def test_a_row_survives_a_round_trip_through_entities() -> None:
    matches = rsoccer.Matches("VSSSelfPlay-v0", worlds=3, seed=4)
    matches.reset()
    for _ in range(30):
        matches.step(np.ones((3, 6, 2), np.float32))
    frame = matches.play.frame
    columns = ("position", "heading", "velocity", "angular_velocity", "infrared")
    for world in range(3):
        row = entities.to_row(entities.from_frame(frame, world), 3, 3)
        again = framed(row[None], 3, 3)
        assert abs(frame.robots.velocity[world]).max() > 0.1
        for name in columns:
            expected = getattr(frame.robots, name)[world]
            np.testing.assert_allclose(getattr(again.robots, name)[0], expected, rtol=1e-6)
        assert (again.ball.position[0] == frame.ball.position[world]).all()
        assert (again.ball.velocity[0] == frame.ball.velocity[world]).all()


def test_robots_are_found_by_team_and_number() -> None:
    frame = Frame.empty(2, 2, 3)
    frame.yellow.position[1, 2] = 0.5, -0.5
    frame.blue.angular_velocity[1, 0] = np.pi
    read_back = entities.from_frame(frame, 1)
    assert list(read_back.robots_blue) == [0, 1]
    assert (read_back.robots_yellow[2].x, read_back.robots_yellow[2].y) == (0.5, -0.5)
    assert read_back.robots_yellow[2].yellow and read_back.robots_yellow[2].id == 2
    assert read_back.robots_blue[0].v_theta == pytest.approx(180.0, abs=1e-4)
    assert not read_back.robots_blue[0].yellow


def test_a_match_can_start_from_a_row() -> None:
    simulator = Simulator(SimConfig("vss_3v3", 1, 1))
    start = example()
    start.ball = Ball(0.0, 0.25, v_x=0.5)
    rows = entities.to_row(start, 1, 1)[None]
    out = np.zeros_like(rows)
    simulator.place(np.ones(1, np.bool_), rows, out)
    placed = entities.from_frame(framed(out, 1, 1), 0)
    assert placed.ball == start.ball
    assert placed.robots_blue[0] == start.robots_blue[0]
    assert entities.to_row(placed, 1, 1).tolist()[:9] == rows[0].tolist()[:9]


@pytest.mark.parametrize(
    ("given", "read"),
    [(0, 0), (90, 90), (180, 180), (-180, 180), (270, -90), (360, 0), (-450, -90), (540, 180)],
)
def test_right_angles_are_exact(given: float, read: float) -> None:
    heading = entities.headings(given)
    assert sorted(abs(heading).tolist()) == [0.0, 1.0]
    assert entities.degrees(heading).item() == read


def test_angles_are_read_within_one_turn() -> None:
    angles = np.linspace(-1000.0, 1000.0, 20_001)
    read = entities.degrees(entities.headings(angles).astype(np.float32))
    assert read.min() > -180.0 and read.max() == 180.0
    turned_by = np.mod(read - angles + 180.0, 360.0) - 180.0
    assert abs(turned_by).max() < 1e-5


def test_a_half_turn_reads_the_same_from_either_direction() -> None:
    assert entities.degrees(np.array([-1.0, -0.0])).item() == 180.0
    assert str(entities.degrees(np.array([1.0, -0.0])).item()) == "0.0"


@pytest.mark.parametrize("missing", ["robots_blue", "robots_yellow"])
def test_missing_robots_are_named(missing: str) -> None:
    incomplete = example()
    getattr(incomplete, missing).clear()
    with pytest.raises(ValueError, match=rf"{missing}: expected robots \[0\], got \[\]"):
        entities.to_row(incomplete, 1, 1)


@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_numbers_that_are_not_finite_are_refused(number: float) -> None:
    broken = example()
    broken.robots_blue[0].theta = number
    with pytest.raises(ValueError, match="expected finite numbers, got\nball at"):
        entities.to_row(broken, 1, 1)


def test_entities_print_for_people() -> None:
    assert str(example()).splitlines() == [
        "ball at (0.250, 0.750, 0.062) m, moving (-2.00, 3.00, 4.00) m/s",
        "blue 0 at (0.500, -0.250) m facing 90.0 deg, moving (1.50, -0.12) m/s, turning 0.0 deg/s",
        "yellow 0 at (-0.500, 0.125) m facing 180.0 deg, moving (0.00, 0.00) m/s, "
        "turning 0.0 deg/s, ball in its beam",
    ]


def test_a_robot_converts_to_a_command() -> None:
    robot = Robot(v_x=1.0, v_y=-1.0, v_theta=180.0, kick_v_x=5.0, dribbler=True, v_wheel0=7.0)
    assert entities.to_command(robot, "omni").tolist() == [1, -1, np.float32(np.pi), 5, 0, 1]
    assert entities.to_command(robot, "differential").tolist() == [7, 0]
    assert entities.to_command(robot, "omni_wheels").tolist() == [7, 0, 0, 0, 5, 0, 1]


def test_field_parameters_have_the_configurations_dimensions() -> None:
    table, pitch = (
        FieldParameters.from_config(SimConfig("vss_5v5", 5, 5)),
        FieldParameters.from_config(SimConfig("ssl_a", 1, 0)),
    )
    assert (table.length, table.goal_depth, table.penalty_length) == (2.2, 0.15, 0.35)
    assert (table.robot_radius, table.robot_front, table.wheel_angles) == (
        0.0375,
        0.0375,
        (90, 270),
    )
    assert (pitch.width, pitch.robot_radius, pitch.robot_front) == (9.0, 0.09, 0.0715)
    assert pitch.wheel_angles == (60, 135, 225, 300)

"""Control of the simulator in the simulation protocol."""

import numpy as np
import pytest

from rsoccer.protocols.errors import Code
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import simulation_pb2
from rsoccer.protocols.simulator_control import ControlResult, read_command, to_command
from tests.protocols.matches import SSL, codes, layout, state


def read(message: simulation_pb2.Command, *, positive: bool = False) -> ControlResult:
    sent = parse(simulation_pb2.Command, message.SerializeToString())
    return read_command(layout(positive=positive), sent, state(), 1)


def test_an_empty_command_asks_for_nothing() -> None:
    result = read(simulation_pb2.Command())
    assert np.array_equal(result.placement.row, state().rows[1])
    assert (result.simulation_speed, result.vision_port, result.robot_models) == (None, None, {})
    assert not result.problems


def test_partial_teleports() -> None:
    message = simulation_pb2.Command()
    ball = message.control.teleport_ball
    ball.x, ball.vz, ball.roll, ball.teleport_safely = 0.5, 1.0, True, True
    robot = message.control.teleport_robot.add(y=1.0, v_x=2.0)
    robot.id.id, robot.id.team = 7, simulation_pb2.YELLOW
    result, before = read(message), state()
    ball_now = result.placement.frame.ball
    assert ball_now.position[0, 0] == 0.5
    assert np.isclose(ball_now.position[0, 1], before.ball.position[1, 1])
    assert ball_now.vertical_velocity[0] == 1.0
    assert ball_now.spin[0, :2].any()
    assert result.placement.safely
    robots = result.placement.frame.robots
    assert np.allclose(robots.position[0, 3], (before.robots.position[1, 3, 0], 1.0))
    assert robots.velocity[0, 3].tolist() == [2.0, 0.0]
    assert result.placement.robots.tolist() == [False] * 3 + [True] + [False] * 3
    assert not result.problems


def test_robots_leave_and_the_speed_changes() -> None:
    message = simulation_pb2.Command()
    robot = message.control.teleport_robot.add(present=False)
    robot.id.id, robot.id.team = 5, simulation_pb2.BLUE
    message.control.simulation_speed = 2.5
    message.config.vision_port = 10020
    result = read(message)
    assert result.placement.frame.robots.absent[0, 0] == 1.0
    assert (result.simulation_speed, result.vision_port) == (2.5, 10020)


def test_what_is_not_honored_is_listed_with_its_code() -> None:
    message = simulation_pb2.Command()
    message.control.teleport_ball.x = 90.0
    message.control.simulation_speed = -1.0
    for number, team, force in ((5, 2, True), (99, 2, False), (5, 0, False)):
        robot = message.control.teleport_robot.add(x=0.0, by_force=force)
        robot.id.id, robot.id.team = number, team  # type: ignore[assignment]
    field = message.config.geometry.field
    field.field_length = field.field_width = field.goal_width = field.goal_depth = 1
    field.boundary_width = 1
    message.config.realism_config.custom.add(type_url="a")
    message.config.vision_port = 70000
    result = read(message)
    assert codes(result.problems) == [
        *(Code.OUT_OF_RANGE, Code.UNSUPPORTED_BY_FORCE, Code.UNKNOWN_ROBOT, Code.UNKNOWN_TEAM),
        *(Code.OUT_OF_RANGE, Code.UNSUPPORTED_GEOMETRY, Code.UNSUPPORTED_REALISM),
        Code.OUT_OF_RANGE,
    ]
    assert np.array_equal(result.placement.row, state().rows[1])


def test_robots_get_other_numbers() -> None:
    message = simulation_pb2.Command()
    specs = message.config.robot_specs.add(mass=1.5)
    specs.id.id, specs.id.team = 15, simulation_pb2.YELLOW
    bad = message.config.robot_specs.add(mass=-1.0)
    bad.id.id, bad.id.team = 0, simulation_pb2.BLUE
    bad.custom.add(type_url="a")
    result = read(message)
    assert list(result.robot_models) == [6]
    assert result.robot_models[6].mass == 1.5
    assert result.robot_models[6] != SSL.robot
    assert codes(result.problems) == [Code.UNSUPPORTED_CUSTOM, Code.INVALID_SPEC]


def test_of_two_places_of_a_robot_the_first_counts() -> None:
    message = simulation_pb2.Command()
    for x in (1.0, 2.0):
        robot = message.control.teleport_robot.add(x=x, y=0.5)
        robot.id.id, robot.id.team = 15, simulation_pb2.YELLOW
    result = read(message)
    assert codes(result.problems) == [Code.DUPLICATE_ROBOT]
    assert result.placement.frame.robots.position[0, 6].tolist() == [1.0, 0.5]


def test_a_ball_is_not_pulled() -> None:
    message = simulation_pb2.Command()
    message.control.teleport_ball.by_force = True
    assert codes(read(message).problems) == [Code.UNSUPPORTED_BY_FORCE]


def test_two_descriptions_of_a_robot_add_up() -> None:
    message = simulation_pb2.Command()
    for numbers in ({"mass": 1.5}, {"radius": 0.08}):
        specs = message.config.robot_specs.add(**numbers)
        specs.id.id, specs.id.team = 15, simulation_pb2.YELLOW
    result = read(message)
    assert not result.problems
    model = result.robot_models[6]
    assert (model.mass, model.radius) == (1.5, 0.08)


def test_teleports_without_fields_put_nothing() -> None:
    message = simulation_pb2.Command()
    message.control.teleport_ball.SetInParent()
    for number, there in ((7, {"present": True}), (3, {})):
        robot = message.control.teleport_robot.add(**there)
        robot.id.id, robot.id.team = number, simulation_pb2.YELLOW
    before = state()
    before.ball.spin[1] = 1.0, 2.0, 3.0
    assert before.robots.velocity[1, 3:5].any(axis=1).all()
    placement = read_command(layout(), message, before, 1).placement
    assert np.array_equal(placement.row, before.rows[1])
    assert not placement.ball
    assert not placement.robots.any()
    assert not placement.problems


def test_a_robot_that_enters_without_a_place_is_refused() -> None:
    message = simulation_pb2.Command()
    robot = message.control.teleport_robot.add(present=True)
    robot.id.id, robot.id.team = 7, simulation_pb2.YELLOW
    frame = state()
    frame.robots.absent[1, 3] = 1.0
    assert codes(read_command(layout(), message, frame, 1).problems) == [Code.INCOMPLETE]


@pytest.mark.parametrize("positive", [False, True])
def test_a_state_is_put_as_a_whole(positive: bool) -> None:
    wire, wanted = layout(positive=positive), state()
    wanted.ball.position[0] = 0.5, -0.25
    wanted.ball.height[0] = 0.1
    wanted.ball.velocity[0] = 1.0, 2.0
    wanted.robots.absent[0, 2] = 1.0
    start = state()
    start.rows[:] = 0.0
    start.robots.heading[..., 0] = 1.0
    stranger = (1, 77)
    message = to_command(wire, wanted, removed=[stranger])
    sent = parse(simulation_pb2.Command, message.SerializeToString())
    result = read_command(wire, sent, start)
    assert codes(result.problems) == [Code.UNKNOWN_ROBOT]  # the stranger alone
    placed = result.placement.frame
    np.testing.assert_allclose(placed.ball.position[0], [0.5, -0.25], atol=1e-6)
    np.testing.assert_allclose(placed.ball.velocity[0], [1.0, 2.0], atol=1e-6)
    assert placed.ball.height[0] == pytest.approx(0.1)
    here = wanted.robots.absent[0] == 0
    for name in ("position", "heading", "velocity", "angular_velocity"):
        found, expected = (getattr(f.robots, name)[0, here] for f in (placed, wanted))
        np.testing.assert_allclose(found, expected, atol=1e-5)
    assert placed.robots.absent[0].tolist() == wanted.robots.absent[0].tolist()
    assert not message.control.teleport_robot[-1].present

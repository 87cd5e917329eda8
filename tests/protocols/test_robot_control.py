"""Control of robots in the simulation protocol."""

import math

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols.commands import FULL_DRIBBLER_RPM, motion
from rsoccer.protocols.errors import Code
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.robot_control import read_robot_control, to_robot_control
from rsoccer.protocols.schemas import simulation_pb2
from tests.protocols.matches import SIDES, SSL, VSSS, WHEELS, codes, commands, layout, state


@pytest.mark.parametrize("config", [SSL, WHEELS, VSSS])
@pytest.mark.parametrize("team", [BLUE, YELLOW])
def test_commands_survive_the_wire(config: SimConfig, team: int) -> None:
    made, rows = layout(config), commands(config)
    sent = to_robot_control(made, rows, team).SerializeToString()
    result = read_robot_control(made, parse(simulation_pb2.RobotControl, sent), team, state(config))
    assert not result.problems
    assert result.given.tolist() == [slot in made.slots(team) for slot in range(config.n_robots)]
    slots = list(made.slots(team))
    if config is WHEELS:  # wheels that contradict each other have the nearest velocities
        models = config.robots
        for slot in slots:
            now, then = (
                motion(models[slot], result.commands[slot]),
                motion(models[slot], rows[slot]),
            )
            assert np.allclose(now.velocity, then.velocity, atol=1e-4)
    else:
        assert np.allclose(result.commands[slots], rows[slots], atol=1e-5)
    assert not result.commands[~result.given].any()


@pytest.mark.parametrize("positive", SIDES)
def test_global_velocities_are_along_the_axes_of_the_wire(positive: bool) -> None:
    frame, message = state(), simulation_pb2.RobotControl()
    frame.robots.heading[1, 0] = (0.0, 1.0)
    moved = message.robot_commands.add(id=5).move_command.global_velocity
    moved.x, moved.y, moved.angular = 1.0, 0.25, 3.0
    result = read_robot_control(layout(positive=positive), message, BLUE, frame, 1)
    sign = -1.0 if positive else 1.0
    assert np.allclose(result.commands[0, :3], (sign * 0.25, sign * -1.0, 3.0))


def test_wheels_have_names_and_rim_speeds() -> None:
    message, radius = simulation_pb2.RobotControl(), WHEELS.robot.wheel_radius
    wheels = message.robot_commands.add(id=5).move_command.wheel_velocity
    wheels.front_left, wheels.back_left, wheels.back_right, wheels.front_right = 1, 2, 3, 4
    result = read_robot_control(layout(WHEELS), message, BLUE, state(WHEELS))
    assert np.allclose(result.commands[0, :4] * radius, (1, 2, 3, 4), rtol=1e-5)


def test_kicks_and_dribblers() -> None:
    message = simulation_pb2.RobotControl()
    message.robot_commands.add(
        id=5, kick_speed=4.0, kick_angle=30.0, dribbler_speed=FULL_DRIBBLER_RPM / 4
    )
    columns = read_robot_control(layout(), message, BLUE, state()).commands[0, 3:]
    assert np.allclose(columns, (4 * math.cos(math.pi / 6), 2.0, 0.25))


def test_movement_and_dribbler_hold_and_kicks_do_not() -> None:
    previous, message = commands(), simulation_pb2.RobotControl()
    message.robot_commands.add(id=5, kick_speed=2.0)
    result = read_robot_control(layout(), message, BLUE, state(), previous=previous)
    expected = previous.copy()
    expected[0, 3:5] = 2.0, 0.0
    assert np.array_equal(result.commands, expected)


def test_what_is_not_honored_is_listed_and_the_rest_counts() -> None:
    message = simulation_pb2.RobotControl()
    first = message.robot_commands.add(id=5, kick_speed=2.0, kick_angle=120.0, dribbler_speed=-1)
    first.move_command.SetInParent()
    local = message.robot_commands.add(id=0).move_command.local_velocity
    local.forward, local.left, local.angular = 1.0, 2.0, 3.0
    message.robot_commands.add(id=99)
    message.robot_commands.add(id=0)
    result = read_robot_control(layout(), message, BLUE, state())
    assert codes(result.problems) == [
        *(Code.UNSUPPORTED_MOVE, Code.OUT_OF_RANGE, Code.OUT_OF_RANGE),
        *(Code.UNKNOWN_ROBOT, Code.DUPLICATE_ROBOT),
    ]
    assert result.commands[1].tolist() == [1, 2, 3, 0, 0, 0]


def test_only_some_robots_are_commanded() -> None:
    chosen = np.array([True, False, True, True, True, True, True])
    message = to_robot_control(layout(), commands(), BLUE, chosen)
    assert [command.id for command in message.robot_commands] == [5, 11]

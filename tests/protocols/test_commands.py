"""Commands of robots, whatever the protocol."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from rsoccer import RobotModel, SimConfig
from rsoccer.arrays import Floats
from rsoccer.game import BLUE
from rsoccer.protocols.commands import Collector, CommandRow, motion
from rsoccer.protocols.errors import Code, MessageError
from tests.protocols.matches import SSL, VSSS, WHEELS, codes, commands, layout

OMNI = RobotModel("ssl_generic")
FOUR = RobotModel("ssl_generic_wheels")
TWO = RobotModel("vss_440rpm")
MODELS = pytest.mark.parametrize("model", [OMNI, FOUR, TWO], ids=lambda model: model.drive)


def blank(model: RobotModel) -> Floats:
    return np.zeros(len(model.command_columns), np.float32)


@MODELS
def test_velocities_become_commands_and_back(model: RobotModel) -> None:
    command, left = blank(model), 0.0 if model is TWO else -0.5
    CommandRow(model, command).drive(0.75, left, 2.0)
    assert np.allclose(motion(model, command).velocity, (0.75, left, 2.0), atol=1e-5)


@MODELS
def test_wheels_become_commands_and_back(model: RobotModel) -> None:
    command, forward = blank(model), blank(model)
    CommandRow(model, forward).drive(1.0, 0.0, 3.0)
    wheels = motion(model, forward).wheels
    assert len(wheels) == (2 if model is TWO else 4)
    CommandRow(model, command).turn_wheels(wheels)
    assert np.allclose(command, forward, atol=1e-4)


def test_equal_wheels_turn_counterclockwise() -> None:
    for model in (OMNI, FOUR):
        command = blank(model)
        CommandRow(model, command).turn_wheels([10.0] * 4)
        expected = 10.0 * model.wheel_radius / model.wheel_distance
        assert np.allclose(motion(model, command).velocity, (0, 0, expected), atol=1e-5)
    command = blank(TWO)
    CommandRow(TWO, command).turn_wheels([-10.0, 10.0])
    assert motion(TWO, command).velocity[2] > 0


def test_robots_on_two_wheels_refuse_what_they_cannot_do() -> None:
    row = CommandRow(TWO, blank(TWO))
    cases: list[tuple[Callable[[], None], Code]] = [
        (lambda: row.drive(1.0, 0.1, 0.0), Code.UNSUPPORTED_MOVE),
        (lambda: row.turn_wheels([1.0] * 4), Code.UNSUPPORTED_MOVE),
        (lambda: row.kick(1.0, 0.0), Code.UNSUPPORTED_KICK),
        (lambda: row.dribble(0.5), Code.UNSUPPORTED_DRIBBLER),
    ]
    for call, code in cases:
        with pytest.raises(MessageError) as error:
            call()
        assert error.value.code is code
    row.kick(0.0, 0.0)
    row.dribble(0.0)


def test_kicks_have_a_speed_and_an_angle() -> None:
    command = blank(OMNI)
    row = CommandRow(OMNI, command)
    row.kick_at(4.0, 0.0)
    assert motion(OMNI, command).kick == (4.0, 0.0)
    row.kick_at(4.0, 60.0)
    assert np.allclose(motion(OMNI, command).kick, (2.0, 4.0 * math.sin(math.pi / 3)))


@pytest.mark.parametrize(("speed", "angle"), [(-1.0, 0.0), (1.0, -1.0), (1.0, 91.0), (-1.0, 45.0)])
def test_kicks_out_of_range_are_refused(speed: float, angle: float) -> None:
    command = blank(OMNI)
    with pytest.raises(MessageError, match=r"^kick") as error:
        CommandRow(OMNI, command).kick_at(speed, angle)
    assert error.value.code is Code.OUT_OF_RANGE
    assert not command.any()


def test_dribblers_run_at_most_at_their_full_speed() -> None:
    command = blank(OMNI)
    row = CommandRow(OMNI, command)
    row.dribble(7.0)
    assert motion(OMNI, command).dribbler == 1.0
    with pytest.raises(MessageError, match=r"^dribbler: expected 0 or above, got -1"):
        row.dribble(-1.0)


@pytest.mark.parametrize("config", [SSL, WHEELS, VSSS])
def test_previous_commands_hold_without_the_kicks_of_given_robots(config: SimConfig) -> None:
    previous = commands(config)
    collector = Collector(layout(config), previous)
    assert np.array_equal(collector.result().commands, previous)
    assert not collector.result().given.any()
    slot = layout(config).slots(BLUE)[0]
    assert collector.row(*layout(config).identity(slot)) is not None
    result = collector.result()
    expected = previous.copy()
    for name in ("kick_v_x", "kick_v_z"):
        if name in config.command_columns:
            expected[slot, config.command_columns.index(name)] = 0.0
    assert np.array_equal(result.commands, expected)
    assert np.flatnonzero(result.given).tolist() == [slot]
    assert previous.any()


def test_unknown_and_repeated_robots_are_listed() -> None:
    collector = Collector(layout(), None)
    assert collector.row(BLUE, 5) is not None
    assert collector.row(BLUE, 5) is None
    assert collector.row(BLUE, 6) is None
    result = collector.result()
    assert codes(result.problems) == [Code.DUPLICATE_ROBOT, Code.UNKNOWN_ROBOT]
    assert result.given.tolist() == [True] + [False] * 6


def test_previous_commands_of_another_shape_are_refused() -> None:
    with pytest.raises(ValueError, match=r"^previous: expected shape \(7, 6\), got \(2,\)"):
        Collector(layout(), np.zeros(2, np.float32))

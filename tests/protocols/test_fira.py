"""FIRASim's packets."""

import numpy as np
import pytest

from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols import fira
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import fira_pb2
from tests.protocols.matches import SIDES, SSL, VSSS, codes, commands, layout, state


@pytest.mark.parametrize("team", [BLUE, YELLOW])
def test_commands_survive_the_wire(team: int) -> None:
    made, rows = layout(VSSS), commands(VSSS)
    sent = fira.to_commands(made, rows, team).SerializeToString()
    result = fira.read_commands(made, parse(fira_pb2.Packet, sent), -rows)
    assert not result.problems
    slots = list(made.slots(team))
    assert np.array_equal(result.commands[slots], rows[slots])
    assert np.array_equal(result.commands[~result.given], -rows[~result.given])


def test_zeros_are_not_on_the_wire() -> None:
    packet = fira_pb2.Packet()
    packet.cmd.robot_commands.add()
    made = layout(VSSS)
    result = fira.read_commands(made, packet, commands(VSSS))
    slot = made.slot(BLUE, 0)
    assert result.given.tolist() == [i == slot for i in range(6)]
    assert not result.commands[slot].any()


def test_robots_with_other_wheels_are_refused() -> None:
    with pytest.raises(MessageError, match=r"^drive: expected differential, got omni"):
        fira.to_commands(layout(), commands(), BLUE)
    packet = fira_pb2.Packet()
    packet.cmd.robot_commands.add(id=5)
    packet.cmd.robot_commands.add(id=6)
    result = fira.read_commands(layout(), packet)
    assert codes(result.problems) == [Code.UNSUPPORTED_MOVE, Code.UNKNOWN_ROBOT]


@pytest.mark.parametrize("positive", SIDES)
def test_states_survive_the_wire(positive: bool) -> None:
    made, frame = layout(VSSS, positive=positive), state(VSSS)
    frame.robots.absent[1, 1] = 1.0
    sent = fira.to_environment(made, frame, 1, seconds=1.25, score=(2, 3)).SerializeToString()
    message = parse(fira_pb2.Environment, sent)
    found = fira.read_environment(made, message)
    assert (found.timestamp, found.ball, fira.read_score(message)) == (1.25, True, (2, 3))
    there = [0, 2, 3, 4, 5]
    assert found.seen.nonzero()[0].tolist() == there
    assert np.allclose(found.frame.robots.data[0, there], frame.robots.data[1, there], atol=1e-6)
    for name in ("position", "velocity", "height", "vertical_velocity"):
        now, then = getattr(found.frame.ball, name)[0], getattr(frame.ball, name)[1]
        assert np.allclose(now, then, atol=1e-6), name
    assert message.field.length == pytest.approx(1.5)
    assert message.field.penalty_width == pytest.approx(VSSS.field.goal_area_width)


@pytest.mark.parametrize("positive", SIDES)
def test_replacements_survive_the_wire(positive: bool) -> None:
    made, frame = layout(VSSS, positive=positive), state(VSSS)
    frame.robots.absent[1, 4] = 1.0
    sent = fira.to_replacement(made, frame, 1).SerializeToString()
    placement = fira.read_replacement(made, parse(fira_pb2.Packet, sent), state(VSSS, seed=5))
    assert not placement.problems
    robots, there = placement.frame.robots, [0, 1, 2, 3, 5]
    assert np.allclose(robots.data[0, there], frame.robots.data[1, there], atol=1e-5)
    assert robots.absent[0].tolist() == [0, 0, 0, 0, 1, 0]
    assert np.allclose(placement.frame.ball.velocity[0], frame.ball.velocity[1], atol=1e-6)
    assert placement.frame.ball.height[0] == 0.0


def test_directions_are_degrees_and_robots_without_turnon_leave() -> None:
    packet, made = fira_pb2.Packet(), layout(VSSS)
    on = packet.replace.robots.add(turnon=True)
    on.position.robot_id, on.position.orientation = 5, 90.0
    off = packet.replace.robots.add(yellowteam=True)
    off.position.robot_id = 7
    unknown = packet.replace.robots.add(turnon=True)
    unknown.position.robot_id = 99
    packet.replace.ball.x = 50.0
    placement = fira.read_replacement(made, packet, state(VSSS))
    assert np.allclose(placement.frame.robots.heading[0, 0], (0.0, 1.0), atol=1e-6)
    assert placement.frame.robots.absent[0].tolist() == [0, 0, 0, 1, 0, 0]
    assert codes(placement.problems) == [Code.UNKNOWN_ROBOT, Code.OUT_OF_RANGE]


def test_frames_of_other_teams_are_refused() -> None:
    with pytest.raises(ValueError, match=r"^frame: expected"):
        fira.to_environment(layout(VSSS), state(SSL), seconds=0.0, score=(0, 0))

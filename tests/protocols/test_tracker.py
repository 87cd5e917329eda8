"""Packets of trackers."""

import numpy as np
import pytest

from rsoccer.protocols import tracker
from rsoccer.protocols.errors import Code
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import tracker_pb2
from tests.protocols.matches import SIDES, VSSS, layout, state


@pytest.mark.parametrize("positive", SIDES)
def test_states_survive_the_wire(positive: bool) -> None:
    made, frame = layout(positive=positive), state()
    frame.robots.absent[1, 2] = 1.0
    packet = tracker.to_packet(made, frame, 1, frame_number=4, timestamp=1.7e9, uuid="a")
    sent = parse(tracker_pb2.Packet, packet.SerializeToString())
    found = tracker.to_frame(made, sent.tracked_frame)
    assert found.timestamp == 1.7e9
    assert found.ball
    assert found.seen.tolist() == [True, True, False, True, True, True, True]
    there = found.seen
    assert np.allclose(found.frame.robots.data[0, there], frame.robots.data[1, there], atol=1e-6)
    assert found.frame.robots.absent[0].tolist() == [0, 0, 1, 0, 0, 0, 0]
    for name in ("position", "velocity", "height", "vertical_velocity"):
        now, then = getattr(found.frame.ball, name)[0], getattr(frame.ball, name)[1]
        assert np.allclose(now, then, atol=1e-6), name


def test_numbers_on_the_wire_are_si_and_turned() -> None:
    frame = state()
    frame.robots.position[0, 3], frame.robots.velocity[0, 3] = (0.25, -0.5), (1.0, 2.0)
    made = layout(positive=True)
    packet = tracker.to_packet(made, frame, frame_number=4, timestamp=0.0, uuid="a")
    robot = packet.tracked_frame.robots[3]
    assert (robot.robot_id.id, robot.robot_id.team_color) == (7, tracker_pb2.TEAM_COLOR_YELLOW)
    assert (robot.pos.x, robot.pos.y, robot.vel.x, robot.vel.y) == (-0.25, 0.5, -1.0, -2.0)
    assert packet.source_name == "rSoccer"


def test_what_a_frame_lacks_is_as_before() -> None:
    frame, message = state(), tracker_pb2.TrackedFrame(frame_number=1, timestamp=0.0)
    found = tracker.to_frame(layout(), message, frame.take(np.array([0])))
    assert np.array_equal(found.frame.rows[0], frame.rows[0])
    assert not found.ball
    assert not found.seen.any()
    empty = tracker.to_frame(layout(), message)
    assert empty.frame.robots.absent.all()


def test_unknown_robots_are_listed() -> None:
    message = tracker_pb2.TrackedFrame(frame_number=1, timestamp=0.0)
    for number, color in ((99, 1), (5, 0)):
        robot = message.robots.add(orientation=0.0)
        robot.robot_id.id, robot.robot_id.team_color = number, color  # type: ignore[assignment]
        robot.pos.x = robot.pos.y = 0.0
    found = tracker.to_frame(layout(), message)
    assert [problem.code for problem in found.problems] == [Code.UNKNOWN_ROBOT, Code.UNKNOWN_TEAM]


def test_balls_are_not_below_the_floor() -> None:
    message = tracker_pb2.TrackedFrame(frame_number=1, timestamp=0.0)
    ball = message.balls.add()
    ball.pos.x = ball.pos.y = 0.0
    ball.pos.z = -0.5
    assert tracker.to_frame(layout(), message).frame.ball.height[0] == 0.0


def test_frames_of_other_teams_are_refused() -> None:
    message = tracker_pb2.TrackedFrame(frame_number=1, timestamp=0.0)
    with pytest.raises(ValueError, match=r"^frame: expected"):
        tracker.to_frame(layout(), message, state(VSSS))

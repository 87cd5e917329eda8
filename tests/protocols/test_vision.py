"""Packets of SSL-Vision."""

import math

import numpy as np
import pytest

from rsoccer.protocols import vision
from rsoccer.protocols.cameras import Camera
from rsoccer.protocols.errors import Code
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import vision_pb2
from tests.protocols.matches import SIDES, SSL, layout, state


@pytest.mark.parametrize("positive", SIDES)
def test_states_survive_the_wire(positive: bool) -> None:
    made, frame = layout(positive=positive), state()
    packet = vision.to_packet(made, frame, 1, frame_number=9, t_capture=2.5, t_sent=2.75)
    sent = parse(vision_pb2.Packet, packet.SerializeToString())
    seen = vision.to_detections(made, sent.detection)
    assert (seen.frame_number, seen.camera_id, seen.t_capture, seen.t_sent) == (9, 0, 2.5, 2.75)
    assert sorted(seen.slots) == list(range(SSL.n_robots))
    slots = list(seen.slots)
    assert np.allclose(seen.robots[:, :2], frame.robots.position[1, slots], atol=1e-6)
    assert np.allclose(seen.robots[:, 2:], frame.robots.heading[1, slots], atol=1e-6)
    assert np.allclose(seen.balls[0, :2], frame.ball.position[1], atol=1e-6)
    assert np.isclose(seen.balls[0, 2], frame.ball.height[1], atol=1e-6)
    assert seen.has_heading.all()
    assert seen.ball_confidence.tolist() == [1.0]
    assert not seen.problems


def test_numbers_on_the_wire_are_mm_and_turned() -> None:
    frame = state()
    frame.robots.position[0, 0] = (0.25, -0.5)
    frame.robots.heading[0, 0] = (0.0, 1.0)
    packet = vision.to_packet(
        layout(positive=True), frame, frame_number=1, t_capture=0.0, t_sent=0.0
    )
    robot = packet.detection.robots_blue[0]
    assert (robot.robot_id, robot.x, robot.y) == (5, -250.0, 500.0)
    assert math.isclose(robot.orientation, -math.pi / 2, abs_tol=1e-6)
    assert math.isclose(robot.height, 1000 * SSL.robot.height, rel_tol=1e-6)


def test_cameras_see_some_bodies() -> None:
    frame = state()
    frame.robots.absent[0, 1] = 1.0
    chosen = np.array([True, True, False, True, False, False, False])
    packet = vision.to_packet(
        layout(),
        frame,
        frame_number=2**32 + 3,
        t_capture=0.0,
        t_sent=0.0,
        camera=Camera(3),
        robots=chosen,
        ball=False,
        geometry=[Camera(3)],
    )
    detection = packet.detection
    assert [robot.robot_id for robot in detection.robots_blue] == [5]
    assert [robot.robot_id for robot in detection.robots_yellow] == [7]
    assert not detection.balls
    assert (detection.frame_number, detection.camera_id) == (3, 3)
    assert packet.geometry.calib[0].camera_id == 3


def test_unknown_robots_are_left_out_and_listed() -> None:
    message = vision_pb2.DetectionFrame(frame_number=1, t_capture=0, t_sent=0, camera_id=0)
    for number in (5, 9, 5, None):
        robot = message.robots_blue.add(confidence=1, x=1, y=2, pixel_x=0, pixel_y=0)
        if number is not None:
            robot.robot_id = number
    seen = vision.to_detections(layout(), message)
    assert seen.slots == (0,)
    assert seen.has_heading.tolist() == [False]
    assert [problem.code for problem in seen.problems] == [Code.UNKNOWN_ROBOT] * 2


def test_empty_detections() -> None:
    message = vision_pb2.DetectionFrame(frame_number=1, t_capture=0, t_sent=0, camera_id=0)
    seen = vision.to_detections(layout(), message)
    assert (seen.balls.shape, seen.robots.shape) == ((0, 3), (0, 4))

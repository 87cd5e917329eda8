"""Packets of SSL-Vision: from a state to what a camera sees, and back to SI."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer.arrays import Doubles, Mask
from rsoccer.frame import Frame
from rsoccer.game import BLUE
from rsoccer.protocols.cameras import Camera
from rsoccer.protocols.errors import MessageError, Problem
from rsoccer.protocols.geometry import to_geometry
from rsoccer.protocols.layout import MILLIMETERS, TEAMS, WireLayout
from rsoccer.protocols.schemas import vision_pb2

DEFAULT_CAMERA: Final = Camera()
"""A camera over the center of the field."""


@dataclass(frozen=True)
class Detections:
    """Sight of one camera, in SI units and the axes of the package.

    Attributes:
        frame_number: number of the image.
        camera_id: number of the camera.
        t_capture: time of the exposure by the sender's clock, s.
        t_sent: time of sending by the same clock, s.
        balls: (k, 3) positions x, y, z of k balls, m.
        ball_confidence: (k,) confidences, 0 to 1.
        slots: (m,) indices of m robots in a state row.
        robots: (m, 4) positions x, y and headings as cosine and sine.
        has_heading: (m,) whether the message has the orientation.
        robot_confidence: (m,) confidences, 0 to 1.
        problems: robots that are left out, because they are unknown.
    """

    frame_number: int
    camera_id: int
    t_capture: float
    t_sent: float
    balls: Doubles
    ball_confidence: Doubles
    slots: tuple[int, ...]
    robots: Doubles
    has_heading: Mask
    robot_confidence: Doubles
    problems: tuple[Problem, ...]


def to_packet(
    layout: WireLayout,
    frame: Frame,
    world: int = 0,
    *,
    frame_number: int,
    t_capture: float,
    t_sent: float,
    camera: Camera = DEFAULT_CAMERA,
    robots: Mask | None = None,
    ball: bool = True,
    geometry: Sequence[Camera] | None = None,
    source: int = vision_pb2.SOURCE_OTHER,
) -> vision_pb2.Packet:
    """Return the packet of one camera.

    Args:
        layout: the match.
        frame: states, or what senses made of them.
        world: index of the world.
        frame_number: number of the image; taken modulo 2**32.
        t_capture: time of the exposure, s.
        t_sent: time of sending, s.
        camera: the camera.
        robots: (robots,) robots that the camera sees; None for all. Absent ones are never seen.
        ball: whether the camera sees the ball.
        geometry: cameras of a geometry to include; None for no geometry.
        source: kind of the sender, a value of `vision_pb2.Source`.

    Returns:
        The packet. Confidences are 1.

    Raises:
        ValueError: a frame of other teams, or no such world.
    """
    layout.check_frame(frame, world)
    message = vision_pb2.Packet(source=source)  # type: ignore[arg-type]
    detection = message.detection
    detection.frame_number = frame_number % 2**32
    detection.camera_id = camera.camera_id
    detection.t_capture = detection.t_capture_camera = t_capture
    detection.t_sent = t_sent
    if ball:
        _add_ball(detection, layout, frame, world, camera)
    seen = frame.robots.absent[world] == 0
    if robots is not None:
        seen = seen & robots
    _add_robots(detection, layout, frame, world, np.flatnonzero(seen).tolist(), camera)
    if geometry is not None:
        message.geometry.CopyFrom(to_geometry(layout, geometry))
    return message


def _add_ball(
    detection: vision_pb2.DetectionFrame,
    layout: WireLayout,
    frame: Frame,
    world: int,
    camera: Camera,
) -> None:
    x, y = layout.rotated(frame.ball.position[world]).tolist()
    z, radius = float(frame.ball.height[world]), layout.config.ball.radius
    pixel_x, pixel_y = camera.pixels(np.array([x, y, z + radius])).tolist()
    detection.balls.add(
        confidence=1.0,
        area=camera.area(radius, z + radius),
        x=MILLIMETERS * x,
        y=MILLIMETERS * y,
        z=MILLIMETERS * z,
        pixel_x=pixel_x,
        pixel_y=pixel_y,
    )


def _add_robots(
    detection: vision_pb2.DetectionFrame,
    layout: WireLayout,
    frame: Frame,
    world: int,
    slots: list[int],
    camera: Camera,
) -> None:
    positions = layout.rotated(frame.robots.position[world])
    angles = layout.angle_to_wire(frame.robots.heading[world])
    models = layout.config.robots
    heights = np.array([model.height for model in models]).reshape(-1, 1)
    pixels = camera.pixels(np.concatenate([positions, heights], axis=1))
    for slot in slots:
        team, number = layout.identity(slot)
        group = detection.robots_blue if team == BLUE else detection.robots_yellow
        group.add(
            confidence=1.0,
            robot_id=number,
            x=MILLIMETERS * positions[slot, 0],
            y=MILLIMETERS * positions[slot, 1],
            orientation=angles[slot],
            pixel_x=pixels[slot, 0],
            pixel_y=pixels[slot, 1],
            height=MILLIMETERS * models[slot].height,
        )


def to_detections(layout: WireLayout, message: vision_pb2.DetectionFrame) -> Detections:
    """Return what a camera saw.

    Args:
        layout: the match.
        message: the detections, from `rsoccer.protocols.parsing.parse`.

    Returns:
        The detections, in SI units. Robots that the match does not have, or without a number, are
        left out and listed.
    """
    robots, problems, found = [], [], set()
    groups = (message.robots_blue, message.robots_yellow)
    for team, group in zip(TEAMS, groups, strict=True):
        for robot in group:
            try:
                slot = layout.slot(team, robot.robot_id if robot.HasField("robot_id") else -1)
            except MessageError as error:
                problems.append(Problem(error.code, str(error)))
                continue
            if slot not in found:  # a camera that sees one twice names the likelier one first
                robots.append((slot, robot))
                found.add(slot)
    places = np.array([(robot.x, robot.y) for _, robot in robots]).reshape(-1, 2)
    headings = layout.heading_from_wire(np.array([robot.orientation for _, robot in robots]))
    balls = np.array([(ball.x, ball.y, ball.z) for ball in message.balls]).reshape(-1, 3)
    balls[:, :2] = layout.rotated(balls[:, :2])
    return Detections(
        frame_number=message.frame_number,
        camera_id=message.camera_id,
        t_capture=message.t_capture,
        t_sent=message.t_sent,
        balls=balls / MILLIMETERS,
        ball_confidence=np.array([ball.confidence for ball in message.balls], np.float64),
        slots=tuple(slot for slot, _ in robots),
        robots=np.concatenate([layout.rotated(places) / MILLIMETERS, headings], axis=1),
        has_heading=np.array([robot.HasField("orientation") for _, robot in robots], np.bool_),
        robot_confidence=np.array([robot.confidence for _, robot in robots], np.float64),
        problems=tuple(problems),
    )

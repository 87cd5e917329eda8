"""Packets of SSL-Vision from the detections of the simulator's cameras."""

from __future__ import annotations

from typing import Final

import numpy as np

from rsoccer._core import Sensing, SimConfig
from rsoccer.arrays import Floats
from rsoccer.bridge.arena import CameraFrame
from rsoccer.game import BLUE
from rsoccer.protocols.cameras import Camera
from rsoccer.protocols.geometry import to_geometry
from rsoccer.protocols.layout import MILLIMETERS, WireLayout
from rsoccer.protocols.schemas import vision_pb2
from rsoccer.protocols.tracked import Triple

CAMERA_HEIGHT: Final = 4.0
"""Height of cameras that the senses do not place, m."""


def cameras_of(config: SimConfig, sensing: Sensing) -> list[Camera]:
    """Return the cameras of some senses, in their order.

    Args:
        config: the match.
        sensing: the senses.
    """
    along, across = (max(1, int(n)) for n in (sensing.cameras_along, sensing.cameras_across))
    height = float(sensing.camera_height) or CAMERA_HEIGHT
    field = config.field
    return [
        Camera(
            camera_id=column * across + row,
            position=(
                field.length * ((column + 0.5) / along - 0.5),
                field.width * ((row + 0.5) / across - 0.5),
                height,
            ),
        )
        for column in range(along)
        for row in range(across)
    ]


class VisionPackets:
    """Makes the packets of the cameras of a match.

    Attributes:
        layout: the match.
        cameras: the cameras, in their order.
    """

    def __init__(self, layout: WireLayout, sensing: Sensing, epoch: float) -> None:
        """Prepare what does not change.

        Args:
            layout: the match.
            sensing: the senses, which have the cameras.
            epoch: time of the start of the simulation, Unix time, s.
        """
        self.layout = layout
        self.cameras = cameras_of(layout.config, sensing)
        self._epoch = epoch
        self._radius = layout.config.ball.radius
        self._robots = [
            (*layout.identity(slot), model.height)
            for slot, model in enumerate(layout.config.robots)
        ]

    def of(
        self, frame: CameraFrame, sent: float, *, geometry: bool = False
    ) -> list[vision_pb2.Packet]:
        """Return the packets of a frame, one for each camera.

        Args:
            frame: what the cameras saw.
            sent: simulated time of sending, s.
            geometry: whether the first packet has the geometry.
        """
        packets = []
        for camera in self.cameras:
            packet = vision_pb2.Packet(source=vision_pb2.SOURCE_OTHER)  # type: ignore[arg-type]
            detection = packet.detection
            detection.frame_number = frame.number % 2**32
            detection.camera_id = camera.camera_id
            detection.t_capture = detection.t_capture_camera = self._epoch + frame.seconds
            detection.t_sent = self._epoch + sent
            packets.append(packet)
        for index, x, y, z in self._on_wire(frame.balls[:, :4]):
            place = int(index)
            self._add_ball(packets[place].detection, self.cameras[place], (x, y, z))
        for index, slot, x, y, angle in self._poses(frame):
            place = int(index)
            detection, camera = packets[place].detection, self.cameras[place]
            self._add_robot(detection, camera, int(slot), (x, y, angle))
        if geometry:
            packets[0].geometry.CopyFrom(to_geometry(self.layout, self.cameras))
        return packets

    def _on_wire(self, balls: Floats) -> list[list[float]]:
        """Camera, x, y and z in the axes of the wire, m."""
        turned = balls.astype(np.float64)
        turned[:, 1:3] *= self.layout.sign
        rows: list[list[float]] = turned.tolist()
        return rows

    def _poses(self, frame: CameraFrame) -> list[list[float]]:
        """Camera, slot, x, y (m) and direction (rad) in the axes of the wire."""
        robots = frame.robots.astype(np.float64)
        robots[:, 2:] *= self.layout.sign
        robots[:, 4] = np.arctan2(robots[:, 5], robots[:, 4])
        rows: list[list[float]] = robots[:, :5].tolist()
        return rows

    def _add_ball(
        self, detection: vision_pb2.DetectionFrame, camera: Camera, ball: Triple
    ) -> None:
        x, y, z = ball
        pixel_x, pixel_y = _pixel(camera, x, y, z + self._radius)
        detection.balls.add(
            confidence=1.0,
            area=camera.area(self._radius, z + self._radius),
            x=MILLIMETERS * x,
            y=MILLIMETERS * y,
            z=MILLIMETERS * z,
            pixel_x=pixel_x,
            pixel_y=pixel_y,
        )

    def _add_robot(
        self, detection: vision_pb2.DetectionFrame, camera: Camera, slot: int, pose: Triple
    ) -> None:
        x, y, angle = pose
        team, number, height = self._robots[slot]
        pixel_x, pixel_y = _pixel(camera, x, y, height)
        group = detection.robots_blue if team == BLUE else detection.robots_yellow
        group.add(
            confidence=1.0,
            robot_id=number,
            x=MILLIMETERS * x,
            y=MILLIMETERS * y,
            orientation=angle,
            pixel_x=pixel_x,
            pixel_y=pixel_y,
            height=MILLIMETERS * height,
        )


def _pixel(camera: Camera, x: float, y: float, z: float) -> tuple[float, float]:
    """Place in the image, as `Camera.pixels` has it for arrays."""
    scale = camera.focal_length / min(z - camera.position[2], -1e-3)
    width, height = camera.image_size
    return (
        width / 2 - (x - camera.position[0]) * scale,
        height / 2 + (y - camera.position[1]) * scale,
    )

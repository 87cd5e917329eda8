"""Packets of SSL-Vision from the detections of the simulator's cameras."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from rsoccer._core import Sensing
from rsoccer.arrays import Doubles
from rsoccer.bridge.arena import CameraFrame
from rsoccer.bridge.message_rows import MessageRows, field_of
from rsoccer.game import BLUE
from rsoccer.protocols.cameras import Camera
from rsoccer.protocols.geometry import to_geometry
from rsoccer.protocols.layout import MILLIMETERS, WireLayout
from rsoccer.protocols.schemas import vision_pb2

CAMERA_HEIGHT: Final = 4.0
"""Height of cameras that the senses do not place, m."""
_DETECTION: Final = vision_pb2.Packet.DETECTION_FIELD_NUMBER
_NUMBERS: Final = np.array([2, 3, 4, 2, 3])
"""Columns of a frame's robots of which numbers of a message are made: x, y, angle and pixels."""


def cameras_of(layout: WireLayout, sensing: Sensing) -> list[Camera]:
    """Return the cameras of some senses, in their order, with their places on the wire.

    Args:
        layout: the match.
        sensing: the senses.
    """
    along, across = (max(1, int(n)) for n in (sensing.cameras_along, sensing.cameras_across))
    height = float(sensing.camera_height) or CAMERA_HEIGHT
    field, sign = layout.config.field, layout.sign
    return [
        Camera(
            camera_id=column * across + row,
            position=(
                sign * field.length * ((column + 0.5) / along - 0.5),
                sign * field.width * ((row + 0.5) / across - 0.5),
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
        self.cameras = cameras_of(layout, sensing)
        self._epoch = epoch
        self._radius = layout.config.ball.radius
        self._heights: Doubles = np.array([model.height for model in layout.config.robots])
        self._rows = MessageRows(layout.config.n_robots, 5, self._template)
        # Numbers of a robot are those of `_NUMBERS` times a scale plus a shift: its place in
        # millimeters, and where it appears, which depends on its height.
        self._scales, self._shifts = [], []
        for camera in self.cameras:
            x, y, z = camera.position
            width, height = camera.image_size
            scale = camera.focal_length / np.maximum(z - self._heights, 1e-3)
            same = np.ones_like(scale)
            units = MILLIMETERS * same, MILLIMETERS * same, same
            nothing = -0.0 * same  # a sum with -0.0 has the sign of the other number
            shifts = nothing, nothing, nothing, width / 2 - x * scale, height / 2 + y * scale
            self._scales.append(np.stack([*units, scale, -scale], axis=-1))
            self._shifts.append(np.stack(shifts, axis=-1))
        wrapper = vision_pb2.Packet(source=vision_pb2.SOURCE_OTHER)
        self._wrapper = wrapper.SerializeToString()
        wrapper.geometry.CopyFrom(to_geometry(layout, self.cameras))
        self._with_geometry = wrapper.SerializeToString()

    def _template(self, slot: int, numbers: Sequence[float]) -> vision_pb2.DetectionFrame:
        """The message of a robot with numbers x, y, angle and pixels."""
        team, number = self.layout.identity(slot)
        frame = vision_pb2.DetectionFrame()
        group = frame.robots_blue if team == BLUE else frame.robots_yellow
        x, y, angle, pixel_x, pixel_y = numbers
        group.add(
            confidence=1.0,
            robot_id=number,
            x=x,
            y=y,
            orientation=angle,
            pixel_x=pixel_x,
            pixel_y=pixel_y,
            height=MILLIMETERS * float(self._heights[slot]),
        )
        return frame

    def of(self, frame: CameraFrame, sent: float, *, geometry: bool = False) -> list[bytes]:
        """Return the packets of a frame, one for each camera.

        Args:
            frame: what the cameras saw.
            sent: simulated time of sending, s.
            geometry: whether the first packet has the geometry.
        """
        robots = frame.robots.astype(np.float64)
        robots[:, 2:] *= self.layout.sign
        packets, alone = [], len(self.cameras) == 1
        number, balls = frame.number % 2**32, frame.balls.tolist()
        captured = self._epoch + frame.seconds
        for index, camera in enumerate(self.cameras):
            detection = vision_pb2.DetectionFrame(
                frame_number=number,
                camera_id=camera.camera_id,
                t_capture=captured,
                t_capture_camera=captured,
                t_sent=self._epoch + sent,
            )
            for which, x, y, z in balls:
                if which == index:
                    self._add_ball(detection, camera, (x, y, z))
            seen = robots if alone else robots[robots[:, 0] == index]
            content = detection.SerializeToString() + self._robots(index, seen)
            wrapper = self._with_geometry if geometry and index == 0 else self._wrapper
            packets.append(field_of(_DETECTION, content) + wrapper)
        return packets

    def _add_ball(
        self,
        detection: vision_pb2.DetectionFrame,
        camera: Camera,
        ball: tuple[float, float, float],
    ) -> None:
        x, y, z = ball[0] * self.layout.sign, ball[1] * self.layout.sign, ball[2]
        top = z + self._radius
        scale = camera.focal_length / max(camera.position[2] - top, 1e-3)
        detection.balls.add(
            confidence=1.0,
            area=camera.area(self._radius, top),
            x=MILLIMETERS * x,
            y=MILLIMETERS * y,
            z=MILLIMETERS * z,
            pixel_x=camera.image_size[0] / 2 + (x - camera.position[0]) * scale,
            pixel_y=camera.image_size[1] / 2 - (y - camera.position[1]) * scale,
        )

    def _robots(self, index: int, seen: Doubles) -> bytes:
        """Messages of the robots that a camera saw: camera, slot, x, y (m), cosine and sine."""
        if not len(seen):
            return b""
        slots = seen[:, 1].astype(np.intp)
        numbers = seen.take(_NUMBERS, axis=1)
        np.arctan2(seen[:, 5], seen[:, 4], out=numbers[:, 2])
        numbers *= self._scales[index].take(slots, axis=0)
        numbers += self._shifts[index].take(slots, axis=0)
        return self._rows.write(slots, numbers)

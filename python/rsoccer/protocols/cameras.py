"""Ideal cameras over the field, which look straight down."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rsoccer.arrays import Array, Doubles
from rsoccer.protocols.layout import MILLIMETERS
from rsoccer.protocols.schemas import vision_pb2


@dataclass(frozen=True)
class Camera:
    """A pinhole camera without distortion, in the axes of the wire.

    Attributes:
        camera_id: number of the camera.
        position: place x, y, z, m.
        focal_length: focal length in pixels.
        image_size: width and height of the image in pixels.
    """

    camera_id: int = 0
    position: tuple[float, float, float] = (0.0, 0.0, 4.0)
    focal_length: float = 390.0
    image_size: tuple[int, int] = (780, 580)

    def __post_init__(self) -> None:
        """Check the numbers.

        Raises:
            ValueError: a camera that is not above the floor, or sizes that are not positive.
        """
        numbers = (*self.position, self.focal_length, *self.image_size)
        if not np.isfinite(numbers).all() or min(numbers[2:]) <= 0:
            raise ValueError(f"camera: expected finite sizes above 0, got {self}")

    def pixels(self, positions: Array) -> Doubles:
        """Return where points appear in the image.

        Args:
            positions: (..., 3) points x, y, z on the wire, m, below the camera.

        Returns:
            (..., 2) pixels to the right and down from the upper left corner.
        """
        offsets = np.asarray(positions, np.float64) - self.position
        scale = self.focal_length / np.minimum(offsets[..., 2], -1e-3)
        # Seen from above x is to the right, and y up in the image.
        pixels = np.stack([-offsets[..., 0] * scale, offsets[..., 1] * scale], axis=-1)
        centered: Doubles = pixels + np.asarray(self.image_size) / 2
        return centered

    def area(self, radius: float, height: float) -> int:
        """Return the area of a ball in the image, in pixels.

        Args:
            radius: radius of the ball, m.
            height: height of its center, m.
        """
        size = radius * self.focal_length / max(self.position[2] - height, 1e-3)
        return round(np.pi * size**2)

    def calibration(self) -> vision_pb2.CameraCalibration:
        """Return the calibration of the camera: half a turn about x, then a shift, mm."""
        x, y, z = (MILLIMETERS * value for value in self.position)
        width, height = self.image_size
        return vision_pb2.CameraCalibration(
            camera_id=self.camera_id,
            focal_length=self.focal_length,
            principal_point_x=width / 2,
            principal_point_y=height / 2,
            distortion=0.0,
            q0=1.0,
            q1=0.0,
            q2=0.0,
            q3=0.0,
            tx=-x,
            ty=y,
            tz=z,
            derived_camera_world_tx=x,
            derived_camera_world_ty=y,
            derived_camera_world_tz=z,
            pixel_image_width=width,
            pixel_image_height=height,
        )

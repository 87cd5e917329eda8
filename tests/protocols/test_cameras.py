"""Ideal cameras."""

import numpy as np
import pytest

from rsoccer.protocols.cameras import Camera


def projected(camera: Camera, point: tuple[float, float, float]) -> list[float]:
    """Pixels by the calibration: turned by the quaternion, shifted, and scaled by the depth."""
    sent = camera.calibration()
    x, y, z, w = sent.q0, sent.q1, sent.q2, sent.q3
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    inside = turn @ (1000 * np.array(point)) + (sent.tx, sent.ty, sent.tz)
    plane = sent.focal_length * inside[:2] / inside[2]
    return [plane[0] + sent.principal_point_x, plane[1] + sent.principal_point_y]


@pytest.mark.parametrize("point", [(0.0, 0.0, 0.0), (1.0, -2.0, 0.0), (-0.7, 0.4, 0.15)])
def test_pixels_are_those_of_the_calibration(point: tuple[float, float, float]) -> None:
    camera = Camera(1, (0.5, -0.25, 4.5), 400.0, (800, 600))
    assert np.allclose(camera.pixels(np.array(point)), projected(camera, point), atol=1e-3)


def test_a_point_to_the_right_is_to_the_right() -> None:
    camera = Camera()
    center, right, up = camera.pixels(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]]))
    assert center.tolist() == [390.0, 290.0]
    assert (right > center).tolist() == [True, False]
    assert up[1] < center[1]


def test_near_balls_are_larger() -> None:
    camera = Camera()
    assert camera.area(0.0215, 0.02) == round(np.pi * (0.0215 * 390 / 3.98) ** 2)
    assert camera.area(0.0215, 2.0) > 3 * camera.area(0.0215, 0.0)


@pytest.mark.parametrize(
    "arguments",
    [
        {"position": (0, 0, 0)},
        {"focal_length": 0},
        {"image_size": (0, 9)},
        {"position": (np.nan, 0, 1)},
    ],
)
def test_impossible_cameras_are_refused(arguments: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=r"^camera: expected finite sizes above 0"):
        Camera(**arguments)  # type: ignore[arg-type]

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.arrays import Floats
from rsoccer.derived.outlines import Outlines, Poses

VSS = Outlines(SimConfig(n_blue=1, n_yellow=1))
SSL = Outlines(SimConfig("ssl_challenge", 1, 1, robot="ssl_generic"))


def poses(*bodies: tuple[float, float, float]) -> Poses:
    x, y, angle = np.array(bodies, np.float32).T
    return Poses(np.stack([x, y], -1), np.stack([np.cos(angle), np.sin(angle)], -1))


def apart(outlines: Outlines, robots: Poses) -> tuple[float, Floats, Floats]:
    gap, normal, point = outlines.separation(robots, np.array([0]), np.array([1]))
    return float(gap[0]), normal[0], point[0]


def test_gaps_to_the_ball() -> None:
    robots = poses((0.0, 0.0, np.pi / 4), (0.0, 0.0, np.pi))
    ball = np.array([0.2, 0.0], np.float32)
    half, radius = VSS.size[0], VSS.ball_radius
    assert VSS.ball_gaps(robots, ball) == pytest.approx(
        [0.2 - half * 2**0.5 - radius, 0.2 - half - radius], abs=1e-6
    )
    front = poses((0.0, 0.0, 0.0), (0.0, 0.0, np.pi))
    assert SSL.ball_gaps(front, ball) == pytest.approx(
        [0.2 - SSL.front[0] - SSL.ball_radius, 0.2 - SSL.size[0] - SSL.ball_radius], abs=1e-6
    )
    assert (VSS.ball_gaps(robots, np.zeros(2, np.float32)) < 0.0).all()


def test_squares_meet_with_faces_and_corners() -> None:
    side = 2 * VSS.size[0]
    gap, normal, point = apart(VSS, poses((0.0, 0.0, 0.0), (side + 0.01, 0.02, 0.0)))
    assert gap == pytest.approx(0.01, abs=1e-6)
    assert normal == pytest.approx([1.0, 0.0], abs=1e-6)
    assert point == pytest.approx([side / 2 + 0.01, 0.02], abs=1e-6)  # middle of the other's face
    corner = side / 2 * 2**0.5
    gap, normal, point = apart(VSS, poses((0.0, 0.0, 0.0), (0.2, 0.0, np.pi / 4)))
    assert gap == pytest.approx(0.2 - side / 2 - corner, abs=1e-6)
    assert point == pytest.approx([0.2 - corner, 0.0], abs=1e-6)


def test_discs_meet_on_the_line_of_their_centers() -> None:
    gap, normal, point = apart(SSL, poses((0.0, 0.0, 0.3), (0.3, 0.4, 1.0)))
    assert gap == pytest.approx(0.5 - 2 * SSL.size[0], abs=1e-6)
    assert normal == pytest.approx([0.6, 0.8], abs=1e-6)
    assert np.linalg.norm(point) == pytest.approx(SSL.size[0], abs=1e-6)

import numpy as np
import pytest

from rsoccer import derived
from rsoccer.frame import Frame


def test_velocities_are_differences_over_the_time_of_each_world() -> None:
    last, frame = Frame.empty(2, 1, 0), Frame.empty(2, 1, 0)
    frame.ball.position[:] = 0.1, -0.2
    frame.ball.height[:] = 0.05
    frame.robots.position[:] = 0.02, 0.04
    angles = np.array([3.1, -3.1])  # the heading turns through half a turn
    last.robots.heading[:, 0] = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    frame.robots.heading[:, 0] = np.stack([np.cos(-angles), np.sin(-angles)], axis=-1)
    derived.differentiate(last, frame, np.array([0.1, 0.2], np.float32))
    np.testing.assert_allclose(frame.ball.velocity, [(1.0, -2.0), (0.5, -1.0)], rtol=1e-6)
    np.testing.assert_allclose(frame.ball.vertical_velocity, [0.5, 0.25], rtol=1e-6)
    np.testing.assert_allclose(frame.robots.velocity[:, 0], [(0.2, 0.4), (0.1, 0.2)], rtol=1e-6)
    turned = 2.0 * (np.pi - 3.1)
    assert frame.robots.angular_velocity[:, 0] == pytest.approx([turned / 0.1, -turned / 0.2], 1e-4)


def test_a_ball_that_rolls_spins_with_its_velocity() -> None:
    frame = Frame.empty(1, 0, 0)
    frame.ball.velocity[0] = 2.0, 1.0
    derived.roll(frame, 0.0215)
    assert frame.ball.spin[0] == pytest.approx([-1.0 / 0.0215, 2.0 / 0.0215, 0.0])

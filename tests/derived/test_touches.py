import numpy as np
import pytest

from rsoccer import SimConfig, derived
from rsoccer.frame import Frame
from rsoccer.game import NOBODY

SSL = SimConfig("ssl_challenge", 1, 1, robot="ssl_generic")
MOUTH = SSL.robot.front_distance + SSL.ball.radius


def frame_with(ball: tuple[float, float], height: float = 0.0) -> Frame:
    """Blue at the center facing +x, yellow far away."""
    frame = Frame.empty(1, 1, 1)
    frame.ball.position[0], frame.ball.height[0] = ball, height
    frame.robots.position[0, 1] = 2.0, 1.0
    return frame


def test_who_has_the_ball() -> None:
    assert derived.ball_holder(frame_with((MOUTH, 0.0)), SSL).tolist() == [0]
    assert derived.ball_holder(frame_with((MOUTH + 0.05, 0.0)), SSL).tolist() == [NOBODY]
    beside = SSL.robot.radius + SSL.ball.radius
    assert derived.ball_holder(frame_with((-beside, 0.0)), SSL).tolist() == [0]
    assert derived.ball_holder(frame_with((1.0, 1.0)), SSL).tolist() == [NOBODY]


def test_no_robots_touch_nothing() -> None:
    config = SimConfig("ssl_challenge", 0, 0, robot=[])
    frame = Frame.empty(2, 0, 0)
    touched = derived.ball_touches(frame, frame, config, 0.025)
    assert touched.shape == (2, 0)
    assert derived.ball_holder(frame, config).tolist() == [NOBODY, NOBODY]
    assert derived.last_touch(frame.ball.last_touch, touched, frame, config).tolist() == [-1, -1]
    assert derived.collisions(frame, frame, config, 0.025).speed.shape == (2, 0)


@pytest.mark.parametrize(("height", "touched"), [(0.0, True), (0.5, False)])
def test_a_ball_above_a_robot_does_not_touch_it(height: float, touched: bool) -> None:
    last, frame = frame_with((-0.15, 0.0), height), frame_with((-0.15, 0.0), height)
    last.ball.velocity[0] = 4.0, 0.0
    frame.ball.velocity[0] = -4.0, 0.0
    assert derived.ball_touches(last, frame, SSL, 0.025).tolist() == [[touched, False]]


def test_a_ball_that_passes_by_is_not_touched() -> None:
    last, frame = frame_with((-0.15, 0.2)), frame_with((-0.05, 0.2))
    last.ball.velocity[0] = frame.ball.velocity[0] = 4.0, 0.0
    assert not derived.ball_touches(last, frame, SSL, 0.025).any()


def test_the_nearest_of_several_robots_touched_last() -> None:
    frame = frame_with((MOUTH, 0.0))
    both = np.ones((1, 2), np.bool_)
    assert derived.last_touch(frame.ball.last_touch, both, frame, SSL).tolist() == [0]
    nobody = np.zeros((1, 2), np.bool_)
    assert derived.last_touch(np.ones(1, np.float32), nobody, frame, SSL).tolist() == [1]


def test_time_speed_and_height_since_a_touch_begin_anew_with_each() -> None:
    last, frame = frame_with((0.5, 0.0)), frame_with((0.6, 0.0), height=0.3)
    frame.ball.last_touch[0] = last.ball.last_touch[0] = 1
    last.ball.seconds_since_touch[0], last.ball.speed_after_touch[0] = 0.5, 4.0
    last.ball.height_since_touch[0] = 0.4
    frame.ball.velocity[0], frame.ball.vertical_velocity[0] = (3.0, 4.0), 12.0
    nobody, somebody = np.zeros((1, 2), np.bool_), np.array([[False, True]])
    after = derived.since_touch(last, frame, nobody, 0.025)
    assert [float(part[0]) for part in after] == pytest.approx([0.525, 4.0, 0.4])
    last.ball.height_since_touch[0] = 0.2
    assert derived.since_touch(last, frame, nobody, 0.025).height[0] == np.float32(0.3)
    anew = derived.since_touch(last, frame, somebody, 0.025)
    assert [float(part[0]) for part in anew] == pytest.approx([0.0, 13.0, 0.3])
    frame.ball.last_touch[0] = NOBODY
    assert [float(part[0]) for part in derived.since_touch(last, frame, nobody, 0.025)] == [0, 0, 0]

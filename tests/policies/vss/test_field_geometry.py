import numpy as np
import pytest

from rsoccer import Matches, spawn
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.policies.vss.field_geometry import FieldGeometry
from rsoccer.tasks import VssSelfPlay

TASK = VssSelfPlay()
FIELD = FieldGeometry(TASK.config)


def column(*values: float) -> Floats:
    """(n, 1) values of one robot in n worlds."""
    return np.array(values, np.float32)[:, None]


def test_clamped_positions_let_a_robot_turn() -> None:
    clearance = TASK.config.robot.bounding_radius + 0.005
    x, y = FIELD.clamp(column(0.9, 0.9, 0.1, -0.9), column(0.6, 0.0, -0.9, 0.1))
    assert x[:, 0] == pytest.approx([0.75 - clearance, 0.85 - clearance, 0.1, -0.85 + clearance])
    assert y[:, 0] == pytest.approx([0.65 - clearance, 0.0, clearance - 0.65, 0.1])
    assert FIELD.clamp_error(column(0.1, 0.9), column(0.2, 0.0))[:, 0] == pytest.approx(
        [0.0, 0.05 + clearance]
    )


def test_the_predicted_ball_rolls_as_in_the_simulator() -> None:
    """First far from walls, then into a wall, from which it rebounds."""
    rng = np.random.default_rng(0)
    frame = Frame.empty(30, 3, 3)
    frame.robots.position[..., 0] = np.linspace(-0.65, 0.65, 6)
    frame.robots.position[..., 1] = -0.55
    frame.ball.velocity[:] = rng.uniform(-0.6, 0.6, (30, 2)).astype(np.float32)
    frame.ball.velocity[:, 1] = np.abs(frame.ball.velocity[:, 1])
    spawn.set_rolling_spin(frame.ball, TASK.config.ball)
    matches = Matches(TASK, 30, controllers={"all": "zero"})
    matches.reset(rows=frame.rows)
    start = matches.frame.copy()
    for _ in range(20):
        matches.step(np.zeros((30, 0, 2), np.float32))
    x, y = FIELD.predict_ball(start.ball, np.float32(0.5))
    assert np.abs(np.stack([x, y], axis=-1) - matches.frame.ball.position).max() < 0.005
    start.ball.position[:], start.ball.velocity[:] = [0.7, 0.4], [1.0, 0.0]
    x, _ = FIELD.predict_ball(start.ball, np.float32(0.5))
    assert (x < 0.7).all()


def test_a_resting_ball_stays() -> None:
    frame = Frame.empty(1, 3, 3)
    frame.ball.position[:] = [0.2, -0.3]
    x, y = FIELD.predict_ball(frame.ball, np.float32(0.5))
    assert (x[0], y[0]) == pytest.approx((0.2, -0.3))


@pytest.mark.parametrize(
    ("ball", "direction"),
    [
        ((0.0, 0.0), (1.0, 0.0)),  # toward the goal
        ((0.35, 0.4), (1.0, -1.0)),
        ((-0.7, 0.19), (0.05, 0.19)),  # away from the own goal
        ((0.2, 0.62), (1.0, 0.0)),  # along a side wall
        ((0.72, 0.4), (0.0, -1.0)),  # along the opponents' end wall, to the goal
        ((-0.72, 0.4), (0.0, 1.0)),  # along the own end wall, away from the goal
    ],
)
def test_the_ball_is_pushed_toward_the_goal_and_away_from_the_own_one(
    ball: tuple[float, float], direction: tuple[float, float]
) -> None:
    x, y = FIELD.push_direction(column(ball[0]), column(ball[1]))
    expected = np.array(direction) / np.hypot(*direction)
    assert [x[0, 0], y[0, 0]] == pytest.approx(expected.tolist(), abs=1e-5)


def test_the_geometry_is_mirror_symmetric() -> None:
    rng = np.random.default_rng(1)
    x, y = rng.uniform(-0.75, 0.75, (2, 200, 1)).astype(np.float32)
    for function in (FIELD.clamp, FIELD.push_direction):
        original, mirrored = function(x, y), function(x, -y)
        assert np.array_equal(original[0], mirrored[0])
        assert np.array_equal(original[1], -mirrored[1])

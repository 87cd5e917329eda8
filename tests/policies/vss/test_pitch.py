import numpy as np
import pytest

from rsoccer import Matches, spawn
from rsoccer.frame import Floats, Frame
from rsoccer.policies.vss.pitch import Pitch
from rsoccer.tasks import VssSelfPlay

TASK = VssSelfPlay()
PITCH = Pitch(TASK.config)


def column(*values: float) -> Floats:
    """(n, 1): one robot's, in n worlds."""
    return np.array(values, np.float32)[:, None]


def test_places_inside_are_where_a_robot_can_turn() -> None:
    clear = TASK.config.robot.bounding_radius + 0.005
    x, y = PITCH.inside(column(0.9, 0.9, 0.1, -0.9), column(0.6, 0.0, -0.9, 0.1))
    assert x[:, 0] == pytest.approx([0.75 - clear, 0.85 - clear, 0.1, -0.85 + clear])
    assert y[:, 0] == pytest.approx([0.65 - clear, 0.0, clear - 0.65, 0.1])
    assert PITCH.outside(column(0.1, 0.9), column(0.2, 0.0))[:, 0] == pytest.approx(
        [0.0, 0.05 + clear]
    )


def test_the_ball_rolls_to_where_it_says() -> None:
    """As in the simulator, far from walls; then into a wall, from which it comes back."""
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
    x, y = PITCH.rolled(start.ball, np.float32(0.5))
    assert np.abs(np.stack([x, y], axis=-1) - matches.frame.ball.position).max() < 0.005
    start.ball.position[:], start.ball.velocity[:] = [0.7, 0.4], [1.0, 0.0]
    x, _ = PITCH.rolled(start.ball, np.float32(0.5))
    assert (x < 0.7).all()


def test_a_ball_that_lies_stays() -> None:
    frame = Frame.empty(1, 3, 3)
    frame.ball.position[:] = [0.2, -0.3]
    x, y = PITCH.rolled(frame.ball, np.float32(0.5))
    assert (x[0], y[0]) == pytest.approx((0.2, -0.3))


@pytest.mark.parametrize(
    ("ball", "course"),
    [
        ((0.0, 0.0), (1.0, 0.0)),  # at the goal
        ((0.35, 0.4), (1.0, -1.0)),
        ((-0.7, 0.19), (0.05, 0.19)),  # off the own one
        ((0.2, 0.62), (1.0, 0.0)),  # along a side wall
        ((0.72, 0.4), (0.0, -1.0)),  # along the opponents' end wall, to the goal
        ((-0.72, 0.4), (0.0, 1.0)),  # along the own one, away from it
    ],
)
def test_the_ball_is_pushed_at_the_goal_and_off_the_own(
    ball: tuple[float, float], course: tuple[float, float]
) -> None:
    x, y = PITCH.course(column(ball[0]), column(ball[1]))
    expected = np.array(course) / np.hypot(*course)
    assert [x[0, 0], y[0, 0]] == pytest.approx(expected.tolist(), abs=1e-5)


def test_a_mirror_shows_the_same_pitch() -> None:
    rng = np.random.default_rng(1)
    x, y = rng.uniform(-0.75, 0.75, (2, 200, 1)).astype(np.float32)
    for ask in (PITCH.inside, PITCH.course):
        ours, theirs = ask(x, y), ask(x, -y)
        assert np.array_equal(ours[0], theirs[0])
        assert np.array_equal(ours[1], -theirs[1])

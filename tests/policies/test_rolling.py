import numpy as np
import pytest

from rsoccer import Frame, SimConfig, Simulator
from rsoccer._core import BallModel, Field
from rsoccer.arrays import Floats
from rsoccer.policies.rolling import RollingLaw

SPEEDS = np.array([0.0, 0.05, 0.4, 1.5, 4.0], np.float32)
BALLS = (
    BallModel("ssl_tigers"),
    BallModel("ssl_robocup_2023"),
    BallModel("ssl_lab_2023", rolling_drag=0.8),
    BallModel("ssl_tigers", rolling_drag=1e-4),
)


def kicked(ball: BallModel, speeds: Floats, rolls: bool, steps: int) -> tuple[Floats, Floats]:
    """Return distances and speeds after each step of 25 ms, (steps, kicks)."""
    config = SimConfig(Field("ssl_b", length=100.0, width=100.0), 0, 0, ball=ball)
    frame = Frame.empty(len(speeds), 0, 0)
    frame.ball.velocity[:, 0] = speeds
    frame.ball.spin[:, 1] = speeds / ball.radius if rolls else 0.0
    simulator = Simulator(config, len(speeds))
    simulator.place(np.ones(len(speeds), np.bool_), frame.rows, frame.rows.copy())
    commands = np.zeros((len(speeds), 0, 0), np.float32)
    found = []
    for _ in range(steps):
        simulator.step(commands, frame.rows)
        found.append((frame.ball.position[:, 0].copy(), frame.ball.velocity[:, 0].copy()))
    distances, after = map(np.stack, zip(*found, strict=True))
    return distances, after


@pytest.mark.parametrize("ball", BALLS, ids=str)
@pytest.mark.parametrize("seconds", [0.5, 20.0])
def test_a_ball_rolls_as_far_as_predicted(ball: BallModel, seconds: float) -> None:
    distances, _ = kicked(ball, SPEEDS, True, round(seconds / 0.025))
    until, behind = RollingLaw(ball).slowing(SPEEDS, np.float32(seconds))
    assert (until <= seconds).all()
    assert SPEEDS * until - behind == pytest.approx(distances[-1], rel=2e-3, abs=2e-3)


@pytest.mark.parametrize("ball", BALLS, ids=str)
def test_a_kick_arrives_with_its_speed(ball: BallModel) -> None:
    ratio = ball.slide_to_roll_ratio
    slides = np.float32((1.0 - ratio**2) / (2.0 * ball.sliding_deceleration))
    way, arrival = np.array([3.0, 4.0, 5.0], np.float32), np.array([1.0, 1.8, 2.4], np.float32)
    kicks = RollingLaw(ball).kick_speed(way, arrival, ratio, slides)
    assert kicks.dtype == np.float32
    distances, speeds = kicked(ball, kicks, False, 400)
    for kick in range(3):
        at = np.interp(way[kick], distances[:, kick], speeds[:, kick])
        assert at == pytest.approx(arrival[kick], rel=5e-3)

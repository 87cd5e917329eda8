import numpy as np
import pytest

from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from rsoccer.tasks import SslPassEndurance
from tests.tasks.ssl_scenes import DRIBBLE, KICK, expect_solved, run, scene

TASK = SslPassEndurance()


def towards(speed: float, teammate: tuple[float, float] = (1.0, 0.0)) -> Frame:
    """Ball that rolls along the x axis, far from the passer."""
    return scene(TASK, ball=(0.0, 0.0, speed, 0.0), blue_0=(-1.0, 0.0), blue_1=(*teammate, np.pi))


def test_a_received_pass_terminates() -> None:
    outcome, _ = run(TASK, towards(2.0))
    assert outcome.terminated[0]
    assert outcome.metrics["received"][0] == 1.0
    assert outcome.terms["received"][0, 0] == 5.0
    assert outcome.terms["failed"][0, 0] == 0.0
    assert outcome.metrics["inverse_distance"][0] == pytest.approx(
        1.0 / float(TASK.mouth_offset), rel=0.1
    )


@pytest.mark.parametrize(
    ("start", "reason"),
    [
        (towards(0.3), "stopped on its way"),
        (towards(2.0, (1.0, 0.5)), "passed by"),
        (towards(-2.0), "goes away"),
        (scene(TASK, ball=(0.0, 1.9, 0.5, 1.5), blue_0=(-1.0, 0.0), blue_1=(0.5, 1.9)), "out"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_failed_pass_terminates(start: Frame, reason: str) -> None:
    outcome, matches = run(TASK, start)
    assert outcome.terminated[0], reason
    assert outcome.metrics["received"][0] == 0.0
    assert outcome.terms["failed"][0, 0] == -1.0
    if reason == "out":
        assert abs(matches.frame.ball.position[0, 1]) > 2.0


def test_holding_the_ball_is_no_failure_and_is_truncated() -> None:
    start = scene(TASK, ball=(-0.907, 0.0), blue_0=(-1.0, 0.0), blue_1=(1.0, 0.0))
    outcome, matches = run(TASK, start, DRIBBLE, 200)
    assert outcome.truncated[0]
    assert not outcome.terminated[0]
    assert matches.play.steps[0] == 120


def test_a_kick_at_full_power_bounces_off_or_is_received_but_never_both() -> None:
    start = scene(TASK, ball=(-0.907, 0.0), blue_0=(-1.0, 0.0), blue_1=(1.0, 0.0, np.pi))
    outcome, _ = run(TASK, start, KICK)
    assert outcome.terminated[0]
    assert (outcome.terms["received"][0, 0] > 0.0) != (outcome.terms["failed"][0, 0] < 0.0)


def test_initial_positions_are_apart_and_inside() -> None:
    frame = TASK.get_initial_positions_frame(WorldRng.seeded(0, 400))
    distance = np.linalg.norm(frame.blue.position[:, 0] - frame.blue.position[:, 1], axis=-1)
    assert distance.min() >= 1.6
    assert (np.abs(frame.ball.position) < [3.0, 2.0]).all()


def test_passer_solves_the_task() -> None:
    solved = expect_solved(TASK, "passer", "received", 0.95)
    assert solved.largest_term() == "received"

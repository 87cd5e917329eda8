import numpy as np
import pytest

from rsoccer.rng import WorldRng
from rsoccer.tasks import SslGoToBall
from tests.tasks.ssl_scenes import expect_solved, play, run, scene


def test_the_ball_in_the_mouth_terminates() -> None:
    task = SslGoToBall()
    start = scene(task, ball=(0.5, 0.0), blue_0=(0.3, 0.0))
    outcome, matches = run(task, start, (0.1, 0.0, 0.0, -1.0, 1.0))
    assert outcome.terminated[0]
    assert outcome.metrics["reached"][0] == 1.0
    assert outcome.terms["reached"][0, 0] == 5.0
    assert outcome.metrics["seconds"][0] == pytest.approx(matches.play.steps[0] * 0.025)


def test_the_ball_behind_the_robot_is_not_reached() -> None:
    task = SslGoToBall(max_steps=60)
    start = scene(task, ball=(0.5, 0.0), blue_0=(0.3, 0.0, np.pi))
    outcome, _ = run(task, start, (0.1, 0.0, 0.0, -1.0, 1.0))
    assert outcome.truncated[0]
    assert not outcome.terminated[0]
    assert outcome.metrics["reached"][0] == 0.0


@pytest.mark.parametrize(
    ("position", "direction"),
    [
        ((2.95, 0.8), (1.0, 0.0)),
        ((-2.95, 0.0), (-1.0, 0.0)),
        ((0.0, 1.95), (0.0, 1.0)),
        ((0.0, -1.95), (0.0, -1.0)),
    ],
)
def test_leaving_the_field_terminates(
    position: tuple[float, float], direction: tuple[float, float]
) -> None:
    task = SslGoToBall()
    outcome, _ = run(
        task, scene(task, ball=(0.5, 0.5), blue_0=position), (*direction, 0.0, -1.0, -1.0)
    )
    assert outcome.terminated[0]
    assert outcome.terms["left_field"][0, 0] == -2.0
    assert outcome.metrics["reached"][0] == 0.0


def test_initial_positions_cover_the_field_without_overlap() -> None:
    frame = SslGoToBall(n_opponents=6).get_initial_positions_frame(WorldRng.seeded(0, 400))
    positions = np.concatenate([frame.ball.position[:, None], frame.robots.position], axis=1)
    gaps = np.linalg.norm(positions[:, :, None] - positions[:, None], axis=-1) + np.eye(8)
    assert gaps.min() >= 0.2 - 1e-6
    assert (np.abs(positions).max(axis=(0, 1)) > [2.8, 1.8]).all()


def test_fetch_solves_the_task() -> None:
    task = SslGoToBall()
    expect_solved(task, "fetch", "reached", 0.98)
    assert play(task, "fetch").largest_term() == "reached"


def test_fetch_avoids_opponents() -> None:
    task = SslGoToBall(n_opponents=6)
    assert play(task, "fetch").metrics["reached"].mean() >= 0.95


@pytest.mark.parametrize("n_opponents", [-1, 7])
def test_too_many_opponents_are_refused(n_opponents: int) -> None:
    with pytest.raises(ValueError, match="n_opponents: expected at"):
        SslGoToBall(n_opponents=n_opponents)

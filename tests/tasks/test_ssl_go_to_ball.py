import numpy as np
import pytest

from rsoccer import Matches
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


@pytest.mark.parametrize(("speed", "dribbler", "held"), [(0.1, 1.0, True), (1.0, -1.0, False)])
def test_a_hold_asks_for_a_ball_that_stays(speed: float, dribbler: float, held: bool) -> None:
    """A robot that rams the ball reaches it for some steps only."""
    start = {"ball": (0.5, 0.0), "blue_0": (0.3 if held else -1.5, 0.0)}
    action = (speed, 0.0, 0.0, -1.0, dribbler)
    for hold_steps in (1, 20):
        task = SslGoToBall(max_steps=100, hold_steps=hold_steps)
        outcome, _ = run(task, scene(task, **start), action, 100)
        assert outcome.metrics["reached"][0] == float(held or hold_steps == 1)
        assert outcome.terms["reached"][0, 0] == (5.0 if held or hold_steps == 1 else 0.0)


def test_the_steps_of_a_hold_are_in_a_row() -> None:
    task = SslGoToBall(hold_steps=3)
    matches = Matches(task, 2, autoreset="disabled")
    matches.reset()
    play = matches.play
    found = []
    for beam in ((1, 1), (1, 0), (0, 1), (1, 1), (1, 1), (1, 0)):
        play.frame.blue.infrared[:, 0] = beam
        found.append(task.calculate_reward_and_done(play)[1].tolist())
    expected = [[False, False]] * 4 + [[False, True], [True, False]]
    assert found == expected


def test_a_hold_is_at_least_one_step() -> None:
    with pytest.raises(ValueError, match="hold_steps: expected at least 1, got 0"):
        SslGoToBall(hold_steps=0)

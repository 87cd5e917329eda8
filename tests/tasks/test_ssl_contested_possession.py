import numpy as np
import pytest

from rsoccer.rng import WorldRng
from rsoccer.tasks import SslContestedPossession
from tests.tasks.ssl_scenes import expect_solved, play, run, scene

TASK = SslContestedPossession()


def terminates_on_contact(task: SslContestedPossession, speed: float) -> bool:
    """Drive into the opponent's back at a fraction of the top speed; whether it terminates."""
    start = scene(task, ball=(1.593, 0.0), blue_0=(1.0, 0.0), yellow_0=(1.5, 0.0))
    outcome, matches = run(task, start, (speed, 0.0, 0.0, -1.0, -1.0), 80)
    gap = np.linalg.norm(matches.frame.blue.position - matches.frame.yellow.position)
    assert gap < 0.185, "they have not met"
    return bool(outcome.terminated[0])


@pytest.mark.parametrize(
    ("speed", "strict", "ends"),
    [(0.08, False, False), (0.4, False, True), (0.08, True, True), (0.4, True, True)],
)
def test_contact_above_half_a_meter_per_second_terminates(
    speed: float, strict: bool, ends: bool
) -> None:
    assert terminates_on_contact(SslContestedPossession(strict_contact=strict), speed) == ends


def test_a_goal_and_a_lost_ball_terminate() -> None:
    for ball, score in (((2.8, 0.1, 2.0, 0.0), 1.0), ((0.1, 1.0, -1.0, 0.0), 0.0)):
        start = scene(TASK, ball=ball, blue_0=(1.0, 0.0), yellow_0=(2.0, -1.5))
        outcome, _ = run(TASK, start)
        assert outcome.terminated[0]
        assert outcome.metrics["goal_score"][0] == score
        assert (outcome.terms["failed"][0, 0] == -1.0) == (score == 0.0)


def test_the_opponent_starts_with_the_ball_and_keeps_it() -> None:
    frame = TASK.get_initial_positions_frame(WorldRng.seeded(0, 300))
    gap = np.linalg.norm(frame.ball.position - frame.yellow.position[:, 0], axis=-1)
    assert gap == pytest.approx(float(TASK.mouth_offset), abs=1e-5)
    assert frame.ball.position[:, 0].min() > 0.0
    assert (np.abs(frame.ball.position) < [3.0, 2.0]).all()
    start = scene(TASK, ball=(1.593, 0.0), blue_0=(0.0, 0.0), yellow_0=(1.5, 0.0))
    _, matches = run(TASK, start, steps=80)
    assert matches.frame.yellow.infrared[0, 0] == 1.0


def test_official_scenarios_are_the_published_ones_rotated_by_180_degrees() -> None:
    frame = SslContestedPossession(scenario=2).get_initial_positions_frame(WorldRng.seeded(0, 1))
    assert frame.yellow.position[0, 0] == pytest.approx([1.0, 1.25])
    assert frame.blue.position[0, 0] == pytest.approx([0.647, 1.604])
    # Published: ball 15 cm in front of the opponent's center. Here it touches the mouth.
    published = [(0.85, 0.0), (0.894, 1.356), (0.394, -1.606), (1.894, 1.306), (2.74, -1.4)]
    for scenario, ball in enumerate(published, start=1):
        task = SslContestedPossession(scenario=scenario)
        frame = task.get_initial_positions_frame(WorldRng.seeded(0, 1))
        assert np.linalg.norm(frame.ball.position[0] - ball) == pytest.approx(0.057, abs=2e-3)
        offset = frame.ball.position - frame.blue.position[:, 0]
        cosine = (offset * frame.blue.heading[:, 0]).sum() / np.linalg.norm(offset)
        assert cosine > 0.999, f"scenario {scenario}: the attacker does not face the ball"


def test_strike_solves_the_task() -> None:
    solved = expect_solved(TASK, "strike", "goal_score", 0.8)
    assert solved.largest_term() == "goal"


@pytest.mark.parametrize("scenario", range(1, 6))
def test_strike_solves_every_official_scenario(scenario: int) -> None:
    task = SslContestedPossession(scenario=scenario)
    assert play(task, "strike", worlds=1).metrics["goal_score"][0] == 1.0


@pytest.mark.parametrize("scenario", [0, 6])
def test_other_scenarios_are_refused(scenario: int) -> None:
    with pytest.raises(ValueError, match="scenario: expected"):
        SslContestedPossession(scenario=scenario)

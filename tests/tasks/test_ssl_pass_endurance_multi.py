import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.frame import Frame
from rsoccer.game import BLUE, EventKind
from rsoccer.rng import WorldRng
from rsoccer.tasks import SslPassEnduranceMulti
from tests.tasks.ssl_scenes import DRIBBLE, KICK, STAND, play, run, scene

TASK = SslPassEnduranceMulti()


def passing(distance: float, speed: float = 0.0) -> Frame:
    """Ball in the mouth of blue_0, or rolling out of it, toward blue_1, which faces the ball."""
    return scene(
        TASK,
        ball=(-1.0 + float(TASK.mouth_offset), 0.0, speed, 0.0),
        blue_0=(-1.0, 0.0),
        blue_1=(-1.0 + distance, 0.0, np.pi),
    )


def received(start: Frame, speed: float = 0.4) -> tuple[float, Matches]:
    """Sum of the term `passes` after a kick until blue_1 has the ball, with its dribbler on."""
    matches = Matches(TASK, 1, autoreset="disabled")
    matches.reset(rows=start.rows)
    total = 0.0
    for step in range(80):
        kick = (*KICK[:3], speed, -1.0) if step < 2 else STAND
        outcome = matches.step(np.array([[kick, DRIBBLE]], np.float32))
        total += float(outcome.terms["passes"][0, 0])
        assert not outcome.ended[0]
        if matches.play.memory["holder"][0] == 1:
            break
    assert matches.play.memory["holder"][0] == 1
    return total, matches


def test_a_pass_counts_once_and_play_continues() -> None:
    total, matches = received(passing(2.0))
    [event] = matches.play.events.of_world(0)
    assert event[:3] == (EventKind.PASS, BLUE, 1)
    assert total == 5.0
    for _ in range(20):
        outcome = matches.step(np.array([[STAND, DRIBBLE]], np.float32))
        assert outcome.terms["passes"][0, 0] == 0.0
    assert not outcome.ended[0]
    assert outcome.metrics["passes"][0] == 1.0


def test_short_passes_do_not_count() -> None:
    total, matches = received(passing(1.75), 0.25)
    assert total == 0.0
    assert matches.play.game.passes[0].tolist() == [0, 0]


@pytest.mark.parametrize(
    "ball",
    [
        (0.0, 0.0, 0.3, 0.0),  # it stops on its way
        (0.0, 0.3, 2.0, 0.0),  # it passes by
        (0.0, 0.0, -2.0, 0.0),  # it goes away
        (0.0, 1.9, 0.5, 1.5),  # it leaves the field
    ],
)
def test_a_failed_pass_terminates(ball: tuple[float, ...]) -> None:
    start = scene(TASK, ball=ball, blue_0=(-1.0, 0.0), blue_1=(1.0, 0.0, np.pi))
    outcome, _ = run(TASK, start)
    assert outcome.terminated[0]
    assert outcome.terms["failed"][0].tolist() == [-1.0, -1.0]
    assert outcome.metrics["passes"][0] == 0.0


def test_holding_the_ball_is_not_rewarded() -> None:
    start = scene(TASK, ball=(-0.907, 0.0), blue_0=(-1.0, 0.0), blue_1=(1.0, 0.0, np.pi))
    task = SslPassEnduranceMulti(max_steps=60)
    outcome, _ = run(task, start, DRIBBLE)
    assert outcome.truncated[0]
    assert abs(sum(float(np.abs(term).sum()) for term in outcome.terms.values())) < 1e-3


def approach_rewards(start: Frame) -> list[float]:
    """Sum of the term `approach` of both robots while blue_1 drives to blue_0 for .5 s."""
    matches = Matches(TASK, 1, autoreset="disabled")
    matches.reset(rows=start.rows)
    total = np.zeros(2)
    for _ in range(20):
        outcome = matches.step(np.array([[DRIBBLE, (-0.2, 0.0, 0.0, -1.0, 1.0)]], np.float32))
        total += outcome.terms["approach"][0]
    return [float(value) for value in total]


def test_the_receiver_is_rewarded_for_going_to_a_ball_on_its_way_alone() -> None:
    held = scene(TASK, ball=(-0.907, 0.0), blue_0=(-1.0, 0.0), blue_1=(2.0, 0.0, np.pi))
    assert approach_rewards(held) == [0.0, 0.0]
    holder, receiver = approach_rewards(passing(3.0, 2.0))
    assert holder == 0.0
    assert receiver > 0.3


def test_passer_solves_the_task() -> None:
    task = SslPassEnduranceMulti(max_steps=500)
    solved, uniform = play(task, "passer", worlds=10), play(task, "uniform", worlds=10)
    assert solved.metrics["passes"].mean() >= 6.0
    assert uniform.metrics["passes"].mean() < 0.2
    assert solved.returns.mean() > uniform.returns.mean() + 10.0
    assert solved.largest_term() == "passes"
    assert solved.term_totals["energy"] < 0.02 * sum(solved.term_totals.values())


def test_either_robot_starts_with_the_ball() -> None:
    task = SslPassEnduranceMulti(random_holder=True)
    matches = Matches(task, 200, seed=1, autoreset="disabled")
    matches.reset()
    holder = matches.play.memory["holder"]
    assert 0.4 < holder.mean() < 0.6
    infrared = matches.frame.blue.infrared > 0.5
    assert infrared[np.arange(200), holder].all()
    assert (matches.play.game.released_at == matches.frame.ball.position).all()
    assert not matches.step(np.zeros((200, 2, 5), np.float32)).ended.any()
    matches = Matches(SslPassEnduranceMulti(), 50, seed=1)
    matches.reset()
    assert (matches.play.memory["holder"] == 0).all()


def test_opponents_that_have_the_ball_end_the_episode() -> None:
    task = SslPassEnduranceMulti(n_opponents=1, opponent="hold")
    mouth = float(task.mouth_offset)
    poses = {"blue_0": (0.0, 0.0), "blue_1": (2.5, 1.0, np.pi), "yellow_0": (2 * mouth, 0.0, np.pi)}
    start = scene(task, ball=(mouth, 0.0), **poses)
    outcome, matches = run(task, start)
    assert outcome.terminated[0]
    assert outcome.terms["failed"][0].tolist() == [-1.0, -1.0]
    assert 10 <= matches.play.steps[0] <= 12


def test_a_pass_that_an_opponent_catches_is_an_interception() -> None:
    task = SslPassEnduranceMulti(n_opponents=1, opponent="hold")
    poses = {"blue_0": (-1.5, 0.0), "blue_1": (2.5, 0.0, np.pi), "yellow_0": (0.5, 0.0, np.pi)}
    start = scene(task, ball=(-1.5 + float(task.mouth_offset), 0.0), **poses)
    outcome, _ = run(task, start, KICK)
    assert outcome.terminated[0]
    assert outcome.metrics["interceptions"][0] == 1.0
    assert outcome.metrics["passes"][0] == 0.0
    assert 0.2 < outcome.metrics["possession"][0] < 2.0


def test_opponents_start_away_from_the_passers() -> None:
    task = SslPassEnduranceMulti(n_opponents=3)
    assert list(task.sides) == ["blue", "yellow"]
    assert list(SslPassEnduranceMulti().sides) == ["blue"], "without opponents as before"
    frame = task.get_initial_positions_frame(WorldRng.seeded(0, 40))
    offset = frame.yellow.position[:, :, None] - frame.blue.position[:, None]
    assert np.linalg.norm(offset, axis=-1).min() > 1.0
    assert task.agents == ("blue_0", "blue_1")
    with pytest.raises(ValueError, match="n_opponents: expected at most 6, got 7"):
        SslPassEnduranceMulti(n_opponents=7)

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from rsoccer.tasks import SslDribbling
from tests.tasks.ssl_scenes import STAND, play, run, scene

TASK = SslDribbling()


def initial_frame(task: SslDribbling) -> Frame:
    return task.get_initial_positions_frame(WorldRng.seeded(0, 1))


def rolling(x: float, v_y: float) -> Frame:
    """Course of the paper, with the ball rolling across the line of gates at x."""
    start = initial_frame(TASK)
    start.ball.position[0] = [x, -0.15 * np.sign(v_y)]
    start.ball.velocity[0] = [0.0, v_y]
    return start


def test_the_ball_through_the_first_gate_counts() -> None:
    matches = Matches(TASK, 1, autoreset="disabled")
    matches.reset(rows=rolling(-0.75, -1.0).rows)
    gate_reward = 0.0
    for _ in range(12):
        outcome = matches.step(np.array([[STAND]], np.float32))
        gate_reward += float(outcome.terms["gate"][0, 0])
        assert not outcome.ended[0]
    assert outcome.metrics["gates"][0] == 1.0
    assert gate_reward == 5.0
    assert matches.frame.ball.position[0, 1] < 0.0


def test_the_last_gate_terminates() -> None:
    low, high, direction = TASK.course.gates[-1]
    matches = Matches(TASK, 1, autoreset="disabled")
    matches.reset(rows=rolling((low + high) / 2, direction).rows)
    matches.play.memory["passed"][:] = len(TASK.course.gates) - 1
    for _ in range(12):
        outcome = matches.step(np.array([[STAND]], np.float32))
        if outcome.ended[0]:
            break
    assert outcome.terminated[0]
    assert outcome.metrics["gates"][0] == 7.0
    assert outcome.terms["failed"][0, 0] == 0.0


def test_the_first_gate_in_the_wrong_direction_terminates() -> None:
    outcome, _ = run(TASK, rolling(-0.75, 1.0))
    assert outcome.terminated[0]
    assert outcome.metrics["gates"][0] == 0.0
    assert outcome.terms["failed"][0, 0] == -2.0


@pytest.mark.parametrize(("x", "v_y"), [(-1.25, 1.0), (-1.25, -1.0), (-0.2, -1.0)])
def test_only_the_next_gate_counts(x: float, v_y: float) -> None:
    outcome, _ = run(TASK, rolling(x, v_y), steps=12)
    assert not outcome.ended[0]
    assert outcome.metrics["gates"][0] == 0.0


@pytest.mark.parametrize(
    ("position", "direction"),
    [
        ((0.9, 0.5), (1.0, 0.0)),
        ((0.5, 0.9), (0.0, 1.0)),
        ((0.5, -0.9), (0.0, -1.0)),
        ((-2.9, 0.5), (-1.0, 0.0)),
        ((-0.2, 0.0), (-1.0, 0.0)),  # into a robot
    ],
)
def test_out_of_bounds_or_into_a_robot_terminates(
    position: tuple[float, float], direction: tuple[float, float]
) -> None:
    start = initial_frame(TASK)
    start.blue.position[0, 0] = position
    start.ball.position[0] = [-0.2, 0.6]
    assert not run(TASK, start, STAND, 1)[0].ended[0]
    outcome, _ = run(TASK, start, (*direction, 0.0, -1.0, -1.0), 20)
    assert outcome.terminated[0]
    assert outcome.terms["failed"][0, 0] == -2.0


def test_the_ball_off_the_field_terminates() -> None:
    start = initial_frame(TASK)
    start.ball.position[0], start.ball.velocity[0] = [0.5, 1.9], [0.0, 1.5]
    outcome, _ = run(TASK, start)
    assert outcome.terminated[0]
    assert outcome.terms["failed"][0, 0] == -2.0


def test_episodes_start_with_the_ball_on_the_dribbler() -> None:
    for task, ball, opponents in (
        (TASK, (-0.093, 0.0), [(-0.5, 0), (-1, 0), (-1.5, 0), (-2, 0)]),
        (
            SslDribbling(scenario="official"),
            (-1.5, -1.807),
            [(-1.5, 1.5), (-1.5, 0.9), (-1.5, 0.4), (-1.5, -0.2), (-1.5, -1.0)],
        ),
    ):
        frame = initial_frame(task)
        assert frame.ball.position[0] == pytest.approx(ball, abs=1e-6)
        assert frame.yellow.position[0] == pytest.approx(np.array(opponents))


def test_the_next_gate_is_observed() -> None:
    matches = Matches(TASK, 1)
    observed = matches.reset()[0, 0, matches.task.layout.blocks["gate"].columns]
    # The robot faces -x, so the middle of the gate is 0.75 m ahead; direction -1; none crossed.
    assert observed == pytest.approx([0.25, 0.0, -1.0, 0.0], abs=1e-6)


@pytest.mark.parametrize(("scenario", "gates"), [("paper", 7), ("official", 6)])
def test_weave_crosses_all_gates(scenario: str, gates: int) -> None:
    task = SslDribbling(scenario=scenario)
    solved = play(task, "weave", worlds=1)
    assert solved.metrics["gates"][0] == gates
    assert solved.largest_term() == "gate"
    assert solved.term_totals["energy"] < 0.02 * solved.term_totals["gate"]
    for other in ("zero", "uniform"):
        unsolved = play(SslDribbling(scenario=scenario, max_steps=600), other, worlds=8)
        assert unsolved.metrics["gates"].max() == 0.0
        assert unsolved.returns.max() < 0.2 * solved.returns[0]


def test_other_scenarios_are_refused() -> None:
    with pytest.raises(ValueError, match=r"scenario: expected one of .*'paper'.*got 'hard'"):
        SslDribbling(scenario="hard")


def test_a_scene_refuses_unknown_robots() -> None:
    with pytest.raises(AssertionError, match="no such robots"):
        scene(TASK, ball=(0.0, 0.0), yellow_9=(0.0, 1.0))


@pytest.mark.parametrize("scenario", ["paper", "official"])
def test_a_random_start_is_before_every_gate_in_turn(scenario: str) -> None:
    task = SslDribbling(scenario=scenario, random_start=True)
    worlds, gates = 600, len(task.course.gates)
    matches = Matches(task, worlds, seed=3, autoreset="disabled")
    matches.reset()
    passed = matches.play.memory["passed"]
    assert set(passed.tolist()) == set(range(gates))
    x, y, _ = task.course.start
    at_start = (matches.frame.blue.position[:, 0] == np.array([x, y], np.float32)).all(axis=1)
    assert 0.4 < at_start.mean() < 0.6
    assert (passed[at_start] == 0).all()
    low, high, direction = task.course.table[passed[~at_start]].T
    ball = matches.frame.ball.position[~at_start]
    along, across = ball[:, 1 - task.course.crosses], ball[:, task.course.crosses]
    assert ((low < along) & (along < high)).all()
    assert (direction * (across - np.float32(task.course.line)) < 0.0).all()
    assert (matches.frame.blue.infrared[:, 0] > 0.5).all()
    assert not matches.step(np.zeros((worlds, 1, 5), np.float32)).ended.any()


def test_the_next_crossing_after_a_random_start_counts() -> None:
    task = SslDribbling(random_start=True)
    matches = Matches(task, 1, autoreset="disabled")
    matches.reset(rows=rolling(-1.25, 1.0).rows)  # the second gate is ahead, upwards
    assert matches.play.memory["passed"][0] == 1
    gates = [matches.step(np.array([[STAND]], np.float32)).metrics["gates"][0] for _ in range(12)]
    assert gates[-1] == 2.0


def test_a_start_before_no_gate_counts_no_crossing() -> None:
    task = SslDribbling(random_start=True)
    matches = Matches(task, 1, autoreset="disabled")
    matches.reset(rows=initial_frame(TASK).rows)
    assert matches.play.memory["passed"][0] == 0


def test_random_starts_are_refused_unless_true_or_false() -> None:
    with pytest.raises(TypeError, match="random_start"):
        SslDribbling(random_start="yes")  # type: ignore[arg-type]

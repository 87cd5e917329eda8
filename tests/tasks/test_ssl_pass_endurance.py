import numpy as np
import pytest

from rsoccer import Matches, Outcome
from rsoccer.arrays import Floats
from rsoccer.controllers import Controllers
from rsoccer.frame import Frame
from rsoccer.game import YELLOW, EventKind
from rsoccer.policies import Policy
from rsoccer.policies.base import Memory, PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.task import LEARN
from rsoccer.tasks import SslPassEndurance
from tests.tasks.ssl_scenes import DRIBBLE, KICK, STAND, expect_solved, run, scene

TASK = SslPassEndurance()


def toward(speed: float, teammate: tuple[float, float] = (1.0, 0.0)) -> Frame:
    """Ball that rolls along the x axis, far from the passer."""
    return scene(TASK, ball=(0.0, 0.0, speed, 0.0), blue_0=(-1.0, 0.0), blue_1=(*teammate, np.pi))


def kicked(speed: float = 0.4, distance: float = 2.1) -> Outcome:
    """End of an episode in which blue_0 kicks from its mouth to a dribbling blue_1."""
    matches = Matches(TASK, autoreset="disabled")
    start = scene(
        TASK,
        ball=(-1.0 + float(TASK.mouth_offset), 0.0),
        blue_0=(-1.0, 0.0),
        blue_1=(-1.0 + distance, 0.0, np.pi),
    )
    matches.reset(rows=start.rows)
    for step in range(TASK.max_steps):
        action = (*KICK[:3], speed, -1.0) if step < 2 else STAND
        outcome = matches.step(np.array([[action]], np.float32))
        if outcome.ended[0]:
            break
    return outcome


def test_a_received_pass_terminates() -> None:
    outcome = kicked()
    assert outcome.terminated[0]
    assert outcome.metrics["received"][0] == 1.0
    assert outcome.terms["received"][0, 0] == 5.0
    assert outcome.terms["failed"][0, 0] == 0.0
    assert outcome.metrics["inverse_distance"][0] == pytest.approx(
        1.0 / float(TASK.mouth_offset), rel=0.1
    )


def test_a_ball_that_is_handed_over_is_a_failure() -> None:
    """Formerly a policy that carried the ball to the teammate had the full score."""
    outcome = kicked(0.25, 1.75)
    assert outcome.terminated[0]
    assert outcome.metrics["received"][0] == 0.0
    assert outcome.terms["failed"][0, 0] == -1.0
    start = scene(TASK, ball=(-0.907, 0.0), blue_0=(-1.0, 0.0), blue_1=(0.4, 0.0, np.pi))
    outcome, matches = run(TASK, start, (0.25, 0.0, 0.0, -1.0, 1.0), 120)
    assert outcome.terminated[0]
    assert matches.frame.blue.infrared[0].all(), "from mouth to mouth"
    assert outcome.metrics["received"][0] == 0.0
    assert outcome.terms["failed"][0, 0] == -1.0


@pytest.mark.parametrize(
    ("start", "reason"),
    [
        (toward(0.3), "stopped on its way"),
        (toward(2.0, (1.0, 0.5)), "passed by"),
        (toward(-2.0), "goes away"),
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
    assert distance.min() >= 2.0
    assert (np.abs(frame.ball.position) < [3.0, 2.0]).all()


def test_passer_solves_the_task() -> None:
    solved = expect_solved(TASK, "passer", "received", 0.95)
    assert solved.largest_term() == "received"


class KicksAtFirst(Policy):
    """Kicks in the first steps, and stands."""

    observes = "nothing"

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        return {"step": np.zeros(shape[0], np.int64)}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        action = (*KICK[:3], 0.5, -1.0) if memory["step"][0] < 2 else STAND
        memory["step"] += 1
        return np.broadcast_to(np.array(action, np.float32), inputs.action_shape).copy()


def test_a_pass_between_opponents_is_nothing_to_blue() -> None:
    task = SslPassEndurance(n_opponents=2)
    frame = scene(
        task,
        ball=(-1.5 + float(task.mouth_offset), 0.0),
        blue_0=(-1.0, 1.5),
        blue_1=(2.5, 1.5),
        yellow_0=(-1.5, 0.0),
        yellow_1=(1.5, 0.0, np.pi),
    )
    yellow: Controllers = {"yellow_0": KicksAtFirst(), "yellow_1": "receive"}
    matches = Matches(task, autoreset="disabled", controllers=yellow)
    matches.reset(rows=frame.rows)
    passes = 0
    for _ in range(80):
        outcome = matches.step(np.array([[STAND]], np.float32))
        passes += int(matches.play.events.by_team(EventKind.PASS)[0, YELLOW])
        assert outcome.terms["received"][0, 0] == 0.0
        if outcome.ended[0]:
            break
    assert passes == 1
    assert outcome.metrics["received"][0] == 0.0


def test_what_is_good_for_blue_is_bad_for_a_yellow_learner() -> None:
    task = SslPassEndurance(n_opponents=1)
    both: Controllers = {"blue_0": LEARN, "blue_1": "receive", "yellow_0": LEARN}
    matches = Matches(task, 16, 0, controllers=both)
    matches.reset()
    names = ("received", "ball_to_teammate", "failed")
    seen = dict.fromkeys(names, 0.0)
    rng = np.random.default_rng(0)
    for _ in range(300):
        matches.step(rng.uniform(-1.0, 1.0, (16, 2, 5)).astype(np.float32))
        for name in names:
            terms = matches.observer_terms[name]
            blue = [i for i, r in enumerate(matches.play.observers) if r < 2]
            yellow = [i for i, r in enumerate(matches.play.observers) if r >= 2]
            assert (terms[:, yellow] == -terms[:, blue][:, :1]).all()
            seen[name] += float(np.abs(terms).sum())
    assert seen["failed"] > 0.0
    assert seen["ball_to_teammate"] > 0.0

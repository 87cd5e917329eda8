"""Passes that `SSLSelfPlay-v0` counts, in scenes with one kick or a rolling ball."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer._core import GAME_COLUMNS
from rsoccer.arrays import Array
from rsoccer.frame import Frame
from rsoccer.game import BLUE, NOBODY, EventKind
from rsoccer.new_play import new_play, new_viewpoint
from rsoccer.rng import WorldRng
from rsoccer.rules import Passes, PassesInPlay
from rsoccer.tasks import SslMatch, SslSelfPlay
from tests.tasks.ssl_scenes import DRIBBLE, KICK, STAND, scene

TASK = SslSelfPlay()
MOUTH = float(TASK.mouth_offset)
FACING = {"blue_0": (-1.0, 0.0, 0.0), "blue_1": (1.0, 0.0, np.pi)}
"""Two teammates 2 m apart, face to face."""


@dataclass
class Kicked:
    """Passes, broken beams and touches after a kick."""

    passes: tuple[float, float]
    """Of blue and yellow."""
    beams: set[int] = field(default_factory=set)
    """Robots whose break beam the ball broke after the kick."""
    touches: set[int] = field(default_factory=set)
    """Robots that touched the ball."""


def kick(
    poses: Mapping[str, tuple[float, ...]], kicker: str = "blue_0", speed: float = 0.5
) -> Kicked:
    """Let a robot kick, `speed` 1 being the hardest; all others dribble where they stand."""
    matches = Matches(TASK, 1, autoreset="disabled")
    matches.reset(rows=scene(TASK, **poses).rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, len(matches.agents), 1))
    kicked = Kicked((0.0, 0.0))
    for step in range(60):
        actions[0, TASK.robots.index(kicker)] = (*KICK[:3], speed, -1.0) if step < 2 else STAND
        outcome = matches.step(actions)
        robots = matches.frame.robots
        kicked.beams |= set(np.flatnonzero(robots.infrared[0] > 0.5).tolist())
        kicked.touches.add(int(matches.frame.ball.last_touch[0]))
    blue, yellow = (float(outcome.metrics[f"{team}_passes"][0]) for team in ("blue", "yellow"))
    kicked.passes = (blue, yellow)
    return kicked


def test_a_ball_from_mouth_to_mouth_of_teammates_is_one_pass() -> None:
    """At some speeds the ball breaks the beam one step before it touches the robot."""
    arrived = 0
    for speed in np.linspace(0.2, 0.7, 26):
        kicked = kick({**FACING, "ball": (-1.0 + MOUTH, 0.0)}, speed=float(speed))
        assert kicked.passes == (float(1 in kicked.beams), 0.0), speed
        arrived += 1 in kicked.beams
    assert arrived > 15


def test_passes_are_those_of_the_team() -> None:
    poses = {"yellow_0": FACING["blue_0"], "yellow_1": FACING["blue_1"]}
    kicked = kick({**poses, "ball": (-1.0 + MOUTH, 0.0)}, "yellow_0")
    assert kicked.passes == (0.0, 1.0)


@pytest.mark.parametrize(
    ("case", "poses", "beam", "touch"),
    [
        ("to an opponent", {"blue_0": FACING["blue_0"], "yellow_0": FACING["blue_1"]}, 3, 3),
        ("too short", {"blue_0": (-0.25, 0.0, 0.0), "blue_1": (0.25, 0.0, np.pi)}, 1, 1),
        ("past an opponent", {**FACING, "yellow_0": (0.55, 0.1112, np.pi / 2)}, 1, 3),
    ],
)
def test_other_balls_are_no_passes(
    case: str, poses: dict[str, tuple[float, ...]], beam: int, touch: int
) -> None:
    kicked = kick({**poses, "ball": (poses["blue_0"][0] + MOUTH, 0.0)})
    assert kicked.passes == (0.0, 0.0), case
    assert beam in kicked.beams
    assert touch in kicked.touches


def test_a_ball_that_nobody_touched_is_no_pass() -> None:
    kicked = kick({**FACING, "ball": (0.0, 0.0, 1.5, 0.0)})
    assert 1 in kicked.beams
    assert kicked.passes == (0.0, 0.0)


def test_a_pass_is_an_event_of_its_receiver_where_it_arrived() -> None:
    matches = Matches(TASK, 1, autoreset="disabled")
    matches.reset(rows=scene(TASK, **FACING, ball=(-1.0 + MOUTH, 0.0)).rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, 6, 1))
    found = []
    for step in range(60):
        actions[0, 0] = (*KICK[:3], 0.5, -1.0) if step < 2 else STAND
        matches.step(actions)
        found += matches.play.events.of_world(0)
    [event] = found
    assert event[:3] == (EventKind.PASS, BLUE, 1)
    assert event.position == pytest.approx((1.0 - MOUTH, 0.0), abs=0.03)


def test_worlds_and_episodes_have_their_own_passes() -> None:
    """The ball of world 1 is nearer, so its pass arrives sooner, and a new episode begins at 0."""
    far = scene(TASK, **FACING, ball=(-1.0 + MOUTH, 0.0))
    near = scene(TASK, **{**FACING, "blue_0": (0.2, 0.0, 0.0)}, ball=(0.2 + MOUTH, 0.0))
    rows = np.concatenate([far.rows, near.rows])
    matches = Matches(TASK, 2, autoreset="disabled")
    matches.reset(rows=rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (2, 6, 1))
    counts = []
    for step in range(60):
        actions[:, 0] = (*KICK[:3], 0.5, -1.0) if step < 2 else STAND
        counts.append(matches.step(actions).metrics["blue_passes"].tolist())
    assert [0.0, 1.0] in counts
    assert counts[-1] == [1.0, 1.0]
    matches.reset(mask=np.array([True, False]), rows=rows[:1])
    assert matches.step(actions).metrics["blue_passes"].tolist() == [0.0, 1.0]


def test_a_ball_that_stopped_is_no_pass() -> None:
    task = SslSelfPlay(n_yellow=0)
    matches = Matches(task, 1, autoreset="disabled")
    poses = {"blue_0": (-2.0, 0.0, 0.0), "blue_1": (1.5, 0.0, np.pi)}
    matches.reset(rows=scene(task, **poses, ball=(-2.0 + MOUTH, 0.0)).rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, 3, 1))
    for step in range(400):
        actions[0, 0] = (*KICK[:3], 0.25, -1.0) if step < 2 else STAND
        matches.step(actions)
    ball = matches.frame.ball
    assert ball.position[0, 0] > -2.0 + MOUTH + 0.5, "the kick is long enough for a pass"
    assert not ball.velocity.any()
    assert matches.frame.blue.position[0, 1, 0] > ball.position[0, 0] + 0.3, "blue_1 is beyond it"
    actions[0, 1] = (-0.15, 0.0, 0.0, -1.0, 1.0)
    for _ in range(400):
        outcome = matches.step(actions)
        if matches.frame.robots.infrared[0, 1]:
            break
    assert matches.frame.robots.infrared[0, 1], "blue_1 collected the ball"
    assert outcome.metrics["blue_passes"][0] == 0.0


def test_a_ball_that_left_the_field_is_no_pass() -> None:
    """blue_1 waits beside the place 0.2 m inside the line where the ball is put."""
    matches = Matches(TASK, 1, autoreset="disabled")
    poses = {"blue_0": (0.0, 0.9, np.pi / 2), "blue_1": (-0.5, 1.8, 0.0)}
    matches.reset(rows=scene(TASK, **poses, ball=(0.0, 0.9 + MOUTH)).rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, 6, 1))
    beams = set()
    for step in range(120):
        actions[0, 0] = KICK if step < 2 else STAND
        actions[0, 1] = (0.1 if step > 30 else 0.0, 0.0, 0.0, -1.0, 1.0)
        outcome = matches.step(actions)
        beams |= set(np.flatnonzero(matches.frame.robots.infrared[0] > 0.5).tolist())
        if 1 in beams:
            break
    assert 1 in beams, "blue_1 collected the ball"
    assert matches.frame.ball.position[0, 1] - (0.9 + MOUTH) > 0.5
    assert outcome.metrics["blue_passes"][0] == 0.0


Step = tuple[float, float, int, int]
"""A made-up step: x of the ball, its speed, the robot that touched it last, the broken beam."""
RESTART: Step = (0.0, 0.0, NOBODY, NOBODY)
"""In place of a step: a restart puts the ball at x = 0."""


def passes_in(worlds: Sequence[Sequence[Step]]) -> list[list[int]]:
    """Passes of both teams in worlds with as many made-up steps.

    The robots stand 0.6 m apart on the x axis, blue ones from x = 0 on.
    """
    n = len(worlds)
    play = new_play(TASK, n, new_viewpoint(TASK, [0]), WorldRng.seeded(0, n))
    frame = Frame.empty(n, 3, 3)
    frame.robots.position[..., 0] = 0.6 * np.arange(6)
    play.start(frame.rows)
    rule, ball = Passes(min_length=0.5), play.frame.ball
    rule.begin(play, np.arange(n))
    for steps in zip(*worlds, strict=True):
        play.events.forget()
        ball.position[:, 0], ball.velocity[:, 0], ball.last_touch[:], beams = np.transpose(steps)
        play.frame.robots.infrared[:] = np.arange(6) == beams[:, None]
        if steps[0] == RESTART:
            rule.begin(play, np.arange(n))
        else:
            assert rule.judge(play) is None
    passes: list[list[int]] = play.game.passes.tolist()
    return passes


def passes_of(*steps: Step) -> list[int]:
    """Passes of both teams in one world."""
    return passes_in([steps])[0]


def test_passes_of_many_worlds_are_those_of_each_alone() -> None:
    rng, n = np.random.default_rng(0), 40
    worlds: list[list[Step]] = []
    for _ in range(n):
        x, touched = rng.uniform(0.0, 3.0, 60), np.repeat(rng.integers(0, 6, 15), 4)
        speed, beams = rng.choice([0.0, 3.0], 60, p=[0.1, 0.9]), rng.integers(-6, 6, 60)
        beams = np.maximum(beams, NOBODY)
        worlds.append(
            list(zip(x.tolist(), speed.tolist(), touched.tolist(), beams.tolist(), strict=True))
        )
    found = passes_in(worlds)
    assert found == [passes_of(*steps) for steps in worlds]
    assert sum(max(passes) > 1 for passes in found) > n / 2, "several passes in most worlds"


def test_a_pass_may_be_as_short_as_the_least_length() -> None:
    kicked = (0.0, 3.0, 0, NOBODY)
    assert passes_of(kicked, (0.5, 3.0, 0, 1)) == [1, 0]
    assert passes_of(kicked, (0.49, 3.0, 0, 1)) == [0, 0]


def test_a_pass_begins_at_its_passer_even_if_the_ball_is_out_of_reach_at_once() -> None:
    """The hardest kick takes the ball out of reach within the step of the touch."""
    first, kicked = (0.0, 3.0, 0, NOBODY), (0.9, 6.5, 1, NOBODY)
    assert passes_of(first, kicked, (1.2, 6.5, 1, 2)) == [0, 0], "0.3 m from blue_1"
    assert passes_of(first, kicked, (1.45, 6.5, 1, 2)) == [1, 0]


def test_a_ball_that_a_restart_has_placed_arrives_from_nobody() -> None:
    kicked, arrived = (0.0, 3.0, 0, NOBODY), (0.55, 3.0, NOBODY, 1)
    assert passes_of(kicked, RESTART, arrived) == [0, 0]
    assert passes_of(kicked, arrived) == [1, 0], "without the restart it is a pass"


@pytest.mark.parametrize(
    ("in_play", "command_steps", "expected"),
    [(1.0, 40.0, 1), (0.0, 0.0, 1), (0.0, 1.0, 0), (0.0, 40.0, 0)],
    ids=["in play", "the step that stops play", "a step later", "in a stop"],
)
def test_no_pass_arrives_while_play_is_stopped(
    in_play: float, command_steps: float, expected: int
) -> None:
    """Formerly a ball that rolled on in a stop, or that robots placed, was passed."""
    task = SslMatch(placement="robots")
    play = new_play(task, 1, new_viewpoint(task, [0]), WorldRng.seeded(0, 1))
    frame = Frame.empty(1, task.n_blue, task.n_yellow)
    frame.robots.position[0, :, 0] = 0.6 * np.arange(12)
    play.start(frame.rows)
    rule, ball = task.rules[1], play.frame.ball
    assert isinstance(rule, PassesInPlay)
    rule.begin(play, np.arange(1))
    columns = [GAME_COLUMNS.index(name) for name in ("in_play", "command_steps")]
    for x, beams, state in ((0.0, NOBODY, (1.0, 39.0)), (0.5, 1, (in_play, command_steps))):
        ball.position[0, 0], ball.velocity[0, 0], ball.last_touch[0] = x, 3.0, 0
        play.frame.robots.infrared[0] = np.arange(12) == beams
        play.game.referee[0, columns] = state
        assert rule.judge(play) is None
    assert play.game.passes.tolist() == [[expected, 0]]


def test_a_derived_task_with_memory_of_its_own_counts_passes() -> None:
    class Counting(SslSelfPlay):
        def new_memory(self, n: int) -> dict[str, Array]:
            return {"own": np.zeros(n, np.float32)}

    matches = Matches(Counting(), 2, 0)
    matches.reset()
    outcome = matches.step(np.zeros((2, 6, 5), np.float32))
    assert outcome.metrics["blue_passes"].tolist() == [0.0, 0.0]
    assert "own" in matches.play.memory


def test_passes_are_rewarded_on_demand() -> None:
    task = SslSelfPlay(reward_weights={"passes": 2.0})
    matches = Matches(task, 1, autoreset="disabled")
    matches.reset(rows=scene(task, **FACING, ball=(-1.0 + MOUTH, 0.0)).rows)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, 6, 1))
    total = np.zeros(6, np.float32)
    for step in range(60):
        actions[0, 0] = (*KICK[:3], 0.5, -1.0) if step < 2 else STAND
        total += matches.step(actions).terms["passes"][0]
    assert total.tolist() == [2.0, 2.0, 2.0, 0.0, 0.0, 0.0]

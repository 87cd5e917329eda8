"""Free balls of the VSSS tasks: when they are called, where all bodies go, and what is kept."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import Field, Matches, RobotModel, SimConfig, Simulator
from rsoccer.arrays import Floats, Mask
from rsoccer.controllers import Controllers
from rsoccer.frame import Frame
from rsoccer.game import NOBODY, EventKind
from rsoccer.new_play import new_play, new_viewpoint
from rsoccer.play import Play
from rsoccer.replay import Recorder, Replay
from rsoccer.rng import WorldRng
from rsoccer.rules import FreeBalls, free_ball
from rsoccer.tasks import VssSelfPlay
from rsoccer.tasks.vss import Vss
from rsoccer.testing import check_task
from rsoccer.vectors import norm
from tests.helpers import same, zeros

NAMES = ["VSS-v0", "VSSMulti-v0", "VSSSelfPlay-v0"]
STEPS = 400
EVERYONE: Controllers = {"all": rsoccer.LEARN}


def wedge(x: float = 0.2, y: float = -0.3) -> Frame:
    """Two robots that face each other with the ball between them, and four others."""
    frame = Frame.empty(1, 3, 3)
    frame.ball.position[:] = (x, y)
    frame.blue.position[:] = [(x - 0.07, y), (x - 0.1, y - 0.2), (0.6, y)]
    frame.yellow.position[:] = [(x + 0.07, y), (x + 0.1, y - 0.2), (-0.6, 0.1)]
    frame.yellow.heading[:] = (-1.0, 0.0)
    return frame


def pushes(matches: Matches) -> Floats:
    """Actions with which the two robots push the ball, and the others stand still."""
    actions = zeros(matches)
    actions[:, [0, 3]] = 1.0
    return actions


def started(task: rsoccer.Task, frame: Frame, **options: Any) -> Matches:  # noqa: ANN401
    matches = Matches(task, len(frame), controllers=EVERYONE, **options)
    matches.reset(rows=frame.rows)
    return matches


def in_play(task: rsoccer.Task, frame: Frame) -> Play:
    """State of the first step of episodes, for calls of the rule without a simulator."""
    viewpoint = new_viewpoint(task, [0])
    play = new_play(task, len(frame), viewpoint, WorldRng.seeded(0, len(frame)))
    play.start(frame.rows)
    rule_of(task).begin(play, np.arange(len(frame)))
    return play


def rule_of(task: rsoccer.Task) -> FreeBalls:
    """The rule of free balls of a task."""
    [rule] = [rule for rule in task.rules if isinstance(rule, FreeBalls)]
    return rule


def steps_to_free_ball(ball_at: Callable[[int], tuple[float, float]], steps: int) -> list[int]:
    """Steps, counted from 1, at which a ball on a path leads to free balls."""
    task = VssSelfPlay(free_ball=True)
    frame = wedge()
    frame.ball.position[:] = ball_at(0)
    play, found = in_play(task, frame), []
    for step in range(1, steps + 1):
        play.frame.ball.position[:] = ball_at(step)
        restart = rule_of(task).judge(play)
        if restart is not None:
            found.append(step)
            rule_of(task).begin(play, restart.worlds)  # the ball stays where the path has it
    return found


@pytest.mark.parametrize("engine", ["compact", "rapier"])
@pytest.mark.parametrize("name", NAMES)
def test_a_wedged_ball_leads_to_a_free_ball_after_ten_seconds(name: str, engine: str) -> None:
    task = rsoccer.make_task(name, free_ball=True, engine=engine)
    matches = started(task, wedge(), autoreset="disabled")
    without = started(rsoccer.make_task(name, engine=engine), wedge(), autoreset="disabled")
    touched = 0.0
    for step in range(1, STEPS + 1):
        last, outcome = matches.frame.rows.copy(), matches.step(pushes(matches))
        expected = without.step(pushes(without)).terms
        touched += float(matches.frame.robots.touched_ball.sum())
        assert outcome.metrics["free_balls"][0] == float(step == STEPS)
    assert touched > STEPS / 2, "robots pushed the ball"
    frame = matches.frame
    assert not same(last, frame.rows)
    assert same(frame.ball.position[0], np.array([0.375, -0.4], np.float32))
    assert same(frame.robots.position[0, [0, 3]], np.array([[0.175, -0.4], [0.575, -0.4]], "f4"))
    assert same(frame.robots.heading[0, [0, 3]], np.array([[1, 0], [-1, 0]], "f4"))
    assert frame.robots.position[0, 5] == pytest.approx((-0.6, 0.1), abs=1e-3), "it kept its place"
    assert not frame.robots.velocity.any()
    assert not frame.ball.velocity.any()
    assert not outcome.ended.any()
    for term in ("ball_to_goal", "approach"):
        assert same(outcome.terms[term], expected[term]), "the move is not rewarded"
    assert same(matches.play.frame.rows, matches.play.last_frame.rows)
    outcome = matches.step(pushes(matches))
    assert np.abs(matches.frame.robots.velocity[0, [0, 3], 0]).min() > 0.0, "play continues"


class Varied:
    """A simulator that draws new masses, frictions and accelerations for every match."""

    def __init__(self, config: SimConfig) -> None:
        self.simulator, self.rng = Simulator(config), np.random.default_rng(0)
        self.parameters = np.empty((1, config.parameters_size), np.float32)

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401
        return getattr(self.simulator, name)

    def place(
        self, worlds: Mask, rows: Floats, out: Floats, parameters: Floats | None = None
    ) -> None:
        self.parameters[:] = self.rng.uniform(0.7, 1.3, self.parameters.shape)
        self.simulator.place(
            worlds, rows, out, self.parameters if parameters is None else parameters
        )


def test_free_balls_leave_the_parameters_of_a_world_as_they_are() -> None:
    task = VssSelfPlay(free_ball=True)
    varied = Varied(task.config)
    matches = started(task, wedge(), simulator=varied, autoreset="disabled")
    parameters = varied.parameters.copy()
    for _ in range(STEPS):
        outcome = matches.step(zeros(matches))
    assert outcome.metrics["free_balls"][0] == 1.0
    # A match that begins in the same state with the parameters of this one has the same future.
    new, rows = Simulator(task.config), np.empty_like(matches.frame.rows)
    new.place(np.ones(1, np.bool_), matches.frame.rows, rows, parameters)
    for _ in range(20):
        matches.step(zeros(matches) + 1.0)
        new.step(matches.play.commands, rows)
        assert same(rows, matches.frame.rows)
    assert np.abs(matches.frame.robots.velocity).max() > 0.1


def test_a_ball_that_moves_is_never_stuck() -> None:
    just_outside = 1.01 * free_ball.STUCK_DISTANCE
    assert steps_to_free_ball(lambda step: (0.001 * step - 0.6, 0.1), 1300) == []
    jumps = steps_to_free_ball(lambda step: (just_outside * (step // (STEPS - 1) % 2), 0.1), 1300)
    assert jumps == []
    across = steps_to_free_ball(lambda step: (0.3, just_outside * (step // (STEPS - 1) % 2)), 1300)
    assert across == []


def test_a_ball_that_moves_a_little_is_stuck() -> None:
    inside = 0.99 * free_ball.STUCK_DISTANCE
    assert steps_to_free_ball(lambda step: (0.3 + inside * np.sin(step), 0.1), 399) == []
    assert steps_to_free_ball(lambda step: (0.3 + inside * np.sin(step), 0.1), 600) == [STEPS]


def test_the_time_begins_again_after_a_free_ball_and_after_a_move() -> None:
    mark = rule_of(VssSelfPlay()).mark
    resting = steps_to_free_ball(lambda step: (mark[0], mark[1]), 1200)
    assert resting == [STEPS, 2 * STEPS, 3 * STEPS]
    moved = steps_to_free_ball(lambda step: (0.1 if step < 300 else 0.4, 0.1), 750)
    assert moved == [300 + STEPS]


def test_each_free_ball_of_an_episode_counts_and_is_an_event_where_the_ball_was_stuck() -> None:
    task = VssSelfPlay(free_ball=True)
    play = in_play(task, wedge(0.2, -0.3))
    for count in (1, 2, 3):
        play.game.stuck_steps[:] = STEPS
        play.events.forget()
        assert rule_of(task).judge(play) is not None
        assert play.game.free_balls.tolist() == [count]
        [event] = play.events.of_world(0)
        assert event[:3] == (EventKind.NO_PROGRESS_IN_GAME, NOBODY, NOBODY)
        assert event.position == pytest.approx((0.2, -0.3))


def test_a_ball_that_crosses_a_goal_line_is_not_moved() -> None:
    task = VssSelfPlay(free_ball=True)
    play = in_play(task, wedge())
    play.game.stuck_steps[:] = STEPS
    play.frame.ball.crossed[:] = 1.0
    assert rule_of(task).judge(play) is None
    play.frame.ball.crossed[:] = 0.0
    assert rule_of(task).judge(play) is not None


def crowded(task: VssSelfPlay, n: int, seed: int) -> Frame:
    frame = task.get_initial_positions_frame(WorldRng.seeded(seed, n))
    frame.robots.position[:] *= np.float32(0.98)
    return frame


def free_balls(task: VssSelfPlay, frame: Frame) -> Frame:
    """States after free balls in all worlds."""
    play = in_play(task, frame)
    play.game.stuck_steps[:] = STEPS
    restart = rule_of(task).judge(play)
    assert restart is not None
    assert restart.worlds.tolist() == list(range(len(frame)))
    assert restart.rows is not None
    return Frame(restart.rows, frame.n_blue, frame.n_yellow)


@pytest.mark.parametrize(
    ("options", "mark", "distance"),
    [
        ({}, (0.375, 0.4), 0.2),
        ({"n_blue": 5, "n_yellow": 5}, (0.375, 0.4), 0.2),
        ({"n_blue": 2, "n_yellow": 0}, (0.375, 0.4), 0.2),
        ({"field": "vss_5v5", "n_blue": 5, "n_yellow": 5}, (0.55, 0.6), 0.3),
    ],
)
def test_all_bodies_are_placed_as_the_rule_says(
    options: dict[str, Any], mark: tuple[float, float], distance: float
) -> None:
    task = VssSelfPlay(free_ball=True, **options)
    before = crowded(task, 300, seed=4)
    after = free_balls(task, before)
    n, robots = len(before), task.n_blue + task.n_yellow
    quarter = np.sign(before.ball.position)
    assert after.ball.position == pytest.approx(mark * quarter)
    gaps = np.linalg.norm(before.robots.position - before.ball.position[:, None], axis=-1)
    takers = np.zeros((n, robots), np.bool_)
    takers[np.arange(n), gaps[:, : task.n_blue].argmin(axis=1)] = True
    if task.n_yellow:
        takers[np.arange(n), task.n_blue + gaps[:, task.n_blue :].argmin(axis=1)] = True
    side = np.where(np.arange(robots) < task.n_blue, -1.0, 1.0)
    offset = after.robots.position - after.ball.position[:, None]
    wanted = np.stack([np.broadcast_to(side * distance, (n, robots)), np.zeros((n, robots))], -1)
    assert offset[takers] == pytest.approx(wanted[takers], abs=1e-6)
    facing = np.stack([np.broadcast_to(-side, (n, robots)), np.zeros((n, robots))], axis=-1)
    assert after.robots.heading[takers].tolist() == facing[takers].tolist(), "they face the ball"
    assert same(after.robots.heading[~takers], before.robots.heading[~takers])
    assert not same(after.robots.heading[takers], before.robots.heading[takers])
    was_inside = (before.robots.position * quarter[:, None] > 0.0).all(axis=-1)
    is_inside = (after.robots.position * quarter[:, None] > 0.0).all(axis=-1)
    assert not (is_inside & ~takers).any()
    kept = ~takers & ~was_inside
    assert same(after.robots.position[kept], before.robots.position[kept])
    if robots > 2:
        assert (was_inside & ~takers).sum() > n / 4, "some robots had to leave"
    bodies = np.concatenate([after.ball.position[:, None], after.robots.position], axis=1)
    between = np.linalg.norm(bodies[:, :, None] - bodies[:, None], axis=-1) + np.eye(robots + 1)
    assert between.min() > 0.09, "no robot touches another body"
    Matches(task, n, controllers=EVERYONE).reset(rows=after.rows)  # raises where bodies overlap


def test_robots_leave_the_quarter_for_the_nearest_free_place_those_near_the_ball_first() -> None:
    task = VssSelfPlay(free_ball=True)
    radius = task.config.robot.bounding_radius + free_ball.MARGIN
    field, spacing = task.config.field, free_ball.GRID_SPACING
    before, rng = Frame.empty(150, 3, 3), np.random.default_rng(6)
    before.ball.position[:] = rng.uniform(0.05, 0.5, (150, 2))
    before.robots.position[:] = rng.uniform((-0.2, -0.2), (0.69, 0.55), (150, 6, 2))
    after = free_balls(task, before)
    reach = np.array([field.half_length, field.half_width]) - radius
    grid = np.stack(np.meshgrid(*[spacing * np.arange(-20, 21)] * 2), axis=-1)
    outside = (grid < -radius).any(axis=-1) & (np.abs(grid) < reach).all(axis=-1)
    blocks = field.half_length + field.half_width - field.corner_leg - np.sqrt(2.0) * radius
    places = grid[outside & (np.abs(grid).sum(axis=-1) < blocks)]
    left = 0
    for was, now, ball in zip(
        before.robots.position, after.robots.position, before.ball.position, strict=True
    ):
        gaps = np.linalg.norm(was - ball, axis=1)
        takers = {int(gaps[:3].argmin()), 3 + int(gaps[3:].argmin())}
        leaving = set(np.flatnonzero((was != now).any(axis=1)).tolist()) - takers
        settled = [robot for robot in range(6) if robot not in leaving]
        for robot in sorted(leaving, key=lambda robot: gaps[robot]):
            between = np.linalg.norm(places[:, None] - now[settled], axis=-1)
            free = places[(between > 2.0 * radius).all(axis=1)]
            shortest = np.linalg.norm(free - was[robot], axis=1).min()
            assert np.linalg.norm(now[robot] - was[robot]) == pytest.approx(shortest, abs=1e-4)
            settled.append(robot)
        left += len(leaving) > 1
    assert left > 75, "worlds in which robots compete for places"


def test_free_balls_are_symmetric_between_the_teams_and_between_left_and_right() -> None:
    task = VssSelfPlay(free_ball=True)
    before = crowded(task, 100, seed=9)
    mirrored, flip = before.copy(), np.array([1.0, -1.0], np.float32)
    mirrored.ball.position[:] *= flip
    mirrored.robots.position[:] *= flip
    assert same(
        free_balls(task, mirrored).robots.position, flip * free_balls(task, before).robots.position
    )
    rotated = Frame.empty(100, 3, 3)
    rotated.ball.position[:] = -before.ball.position
    rotated.blue.position[:] = -before.yellow.position
    rotated.yellow.position[:] = -before.blue.position
    ours, theirs = free_balls(task, before), free_balls(task, rotated)
    assert same(ours.ball.position, -theirs.ball.position)
    assert same(ours.blue.position, -theirs.yellow.position)
    assert same(ours.yellow.position, -theirs.blue.position)


def test_worlds_are_independent_and_a_saved_state_continues() -> None:
    task = VssSelfPlay(free_ball=True)
    rolling = wedge(-0.3, 0.2)
    rolling.ball.position[:] = (0.0, 0.55)
    frame = Frame(np.concatenate([wedge().rows, rolling.rows]), 3, 3)
    batch = started(task, frame, autoreset="disabled")
    singles = [started(task, frame.take(np.array([i])), autoreset="disabled") for i in (0, 1)]
    resumed = Matches(task, 2, controllers=EVERYONE, autoreset="disabled")
    rng, counts = np.random.default_rng(0), []
    for step in range(2 * STEPS):
        actions = pushes(batch)
        actions[1] = rng.uniform(0.0, 1.0, (6, 2))
        if step == STEPS // 2:
            resumed.load_state_dict(batch.state_dict())
        outcome = batch.step(actions)
        for i, single in enumerate(singles):
            single.step(actions[i : i + 1])
            assert same(single.frame.rows[0], batch.frame.rows[i])
        if step >= STEPS // 2:
            resumed.step(actions)
            assert same(resumed.frame.rows, batch.frame.rows)
        counts.append(outcome.metrics["free_balls"].tolist())
    assert counts[STEPS - 2][0] == 0
    assert counts[STEPS - 1][0] == 1
    assert counts[-1][1] in (0, 1)


@pytest.mark.parametrize("autoreset", ["disabled", "next_step"])
def test_a_reset_begins_the_time_again_and_waiting_worlds_keep_their_state(autoreset: str) -> None:
    task = VssSelfPlay(free_ball=True, max_steps=300)
    matches = started(task, wedge(), autoreset=autoreset)
    for _ in range(300):
        outcome = matches.step(pushes(matches))
    assert outcome.truncated.all()
    before = matches.frame.rows.copy()
    assert matches.play.game.stuck_steps[0] == 300
    if autoreset == "disabled":
        for _ in range(150):
            matches.step(pushes(matches))
        assert same(matches.frame.rows, before)
    else:
        matches.step(pushes(matches))
    matches.reset(rows=wedge().rows)
    assert matches.play.game.stuck_steps[0] == 0
    for _ in range(299):
        assert matches.step(pushes(matches)).metrics["free_balls"][0] == 0.0


def test_check_task_accepts_free_balls(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(free_ball, "STUCK_SECONDS", 0.2)
    task = VssSelfPlay(free_ball=True, n_blue=2, n_yellow=2)
    matches = Matches(task, 8)
    matches.reset()
    for _ in range(10):
        outcome = matches.step(zeros(matches))
    assert outcome.metrics["free_balls"].all()
    check_task(task, worlds=3, steps=60)


def test_the_option_is_off_in_the_tasks_of_the_paper() -> None:
    tasks = [rsoccer.make_task(name) for name in NAMES]
    assert [t.name for t in tasks if isinstance(t, Vss) and t.free_ball] == ["VSSSelfPlay-v0"]


def test_the_option_can_be_off_and_is_checked() -> None:
    for name in NAMES:
        task = rsoccer.make_task(name, free_ball=False)
        matches = started(task, wedge(), autoreset="disabled")
        for _ in range(STEPS + 1):
            outcome = matches.step(pushes(matches))
        assert set(outcome.metrics) == {"goal_score"}
        assert set(matches.play.game) == {"score"}
        assert rsoccer.make_task(name, free_ball=True).layout.text == matches.task.layout.text
    with pytest.raises(TypeError, match="free_ball: expected True or False, got 'yes'"):
        rsoccer.make_task("VSS-v0", free_ball="yes")
    narrow = Field("vss_3v3", width=0.6)
    rsoccer.make_task("VSS-v0", field=narrow)
    with pytest.raises(ValueError, match=r"free_ball: expected False.*1.5 x 0.6 m, got True"):
        rsoccer.make_task("VSS-v0", field=narrow, free_ball=True)


@pytest.mark.parametrize(
    "numbers",
    [
        {"length": 1.0},  # no room behind the yellow robot
        {"length": 1.22},
        {"free_ball_x": 0.2},  # the blue robot would stand on the middle line
        {"free_ball_y": 0.03},
        {"free_ball_y": 0.62},
    ],
)
def test_fields_without_room_around_the_mark_have_no_free_balls(numbers: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="free_ball: expected False for robots of radius"):
        FreeBalls(SimConfig(Field("vss_3v3", **numbers)))


def test_free_balls_need_room_for_the_largest_robot() -> None:
    usual, field = SimConfig().robot, Field("vss_3v3", free_ball_y=0.065)
    large = RobotModel(usual.name, side_length=0.1)
    assert usual.bounding_radius < 0.065 < large.bounding_radius
    FreeBalls(SimConfig(field, 3, 3, robot=[usual] * 6))
    for models in ([large, *[usual] * 5], [*[usual] * 5, large]):
        with pytest.raises(
            ValueError, match=r"free_ball: expected False for robots of radius 0\.07"
        ):
            FreeBalls(SimConfig(field, 3, 3, robot=models))


def test_a_replay_shows_free_balls_and_keeps_the_option() -> None:
    task = replace(VssSelfPlay(), max_steps=450)
    matches = started(task, wedge(), autoreset="disabled")
    recorder = Recorder(matches, controllers=EVERYONE)
    recorder.begin()
    while not matches.done[0]:
        recorder.add(matches.step(pushes(matches)))
    replay = Replay.from_bytes(recorder.replay().to_bytes())
    assert [event.frame for event in replay.events if event.kind == "free_ball"] == [STEPS]
    assert replay.options == {"max_steps": 450}
    assert replay.episodes[0].metrics["free_balls"] == 1.0


@pytest.mark.parametrize("absent", [(0,), (1,), (0, 1, 2), (3, 5), (1, 4), (0, 1, 2, 3, 4, 5)])
def test_absent_robots_stay_absent_and_take_no_free_ball(absent: tuple[int, ...]) -> None:
    frame = wedge()
    frame.robots.absent[0, list(absent)] = 1.0
    matches = started(VssSelfPlay(), frame)
    matches.play.game.stuck_steps[:] = STEPS - 1
    matches.step(zeros(matches))
    assert matches.play.events.happened(EventKind.NO_PROGRESS_IN_GAME).all()
    robots = matches.frame.robots
    assert np.flatnonzero(robots.absent[0]).tolist() == list(absent)
    near = norm(*(robots.position[0] - matches.frame.ball.position[0]).T) < 0.21
    present = [[r for r in team if r not in absent] for team in ((0, 1, 2), (3, 4, 5))]
    assert np.flatnonzero(near).tolist() == [team[0] for team in present if team]

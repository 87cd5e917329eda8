"""Chip kicks: parabola, hops, and collisions with robots, the goal's bar and VSSS walls."""

from itertools import pairwise
from math import radians, sin, sqrt

import numpy as np

from rsoccer._core import BALL_COLUMNS, CROSSINGS, Field
from rsoccer.arrays import Array
from rsoccer.vectors import norm
from tools.physics.check import EXACT, Checks, Criterion, absolute, percent
from tools.physics.cited import BALLS, GENERIC, Ball, G
from tools.physics.closed_form import apex, rise_to
from tools.physics.scene import TICK, Scene, Trajectory, make_config

TOPIC = "ball_flight"
LONG = Field("ssl_b", length=60.0)
CHIP = 5.5  # m/s, at 45 degrees
DIAMETER = 0.043
BAR_BOTTOM, BAR_TOP = 0.16, 0.18
HEIGHT = BALL_COLUMNS.index("crossed_z")

WALL_HEIGHT = "wall height 50 mm"
PARABOLA = "parabola, 9.81 m/s²"
APEX = Criterion(TOPIC, "chip of 5.5 m/s at 45 degrees: apex height", "m", percent(2), PARABOLA)
LANDING = Criterion(
    TOPIC, "chip of 5.5 m/s at 45 degrees: first landing distance", "m", percent(2), PARABOLA
)
HOP_FIRST = Criterion(
    TOPIC, "first hop: ratio of horizontal speed after to before", "", absolute(0.01), "preset"
)
HOP_LATER = Criterion(
    TOPIC, "later hops: ratio of horizontal speed after to before", "", absolute(0.01), "preset"
)
HOP_UP = Criterion(
    TOPIC, "each hop: ratio of vertical speed after to before", "", absolute(0.02), "preset"
)
ROLLS = Criterion(TOPIC, "slip after the last hop", "m/s", absolute(0.001), "rolling")
OVER = Criterion(TOPIC, "chips that clear a robot: distance in 0.7 s", "m", percent(2), PARABOLA)
STOPPED = Criterion(
    TOPIC, "chips below a robot's height: stopped by the robot", "of 6", EXACT, PARABOLA
)
ON_TOP = Criterion(
    TOPIC, "balls dropped onto a robot: at rest on the floor beside it", "of 4", EXACT, "no support"
)
GOALS = Criterion(TOPIC, "shots below the goal's bar: goals", "of 15", EXACT, PARABOLA)
NO_GOALS = Criterion(TOPIC, "shots above the goal's bar: goals", "of 15", EXACT, PARABOLA)
OVER_BAR = Criterion(
    TOPIC, "shots above the goal's bar: height at the goal line", "m", percent(2), PARABOLA
)
OFF_TABLE = Criterion(TOPIC, "balls above a VSSS wall: leave the table", "of 2", EXACT, WALL_HEIGHT)
ON_TABLE = Criterion(TOPIC, "balls below a VSSS wall: leave the table", "of 2", EXACT, WALL_HEIGHT)


def checks() -> Checks:
    """Yield all checks of flight."""
    for name, ball in BALLS.items():
        yield from _arc(name)
        yield from _hops(name, ball)
    yield from _over_a_robot()
    yield from _onto_a_robot()
    yield from _at_the_bar()
    yield from _off_the_table()


def chip(name: str, speed: float, seconds: float, degrees: float = 45.0) -> Trajectory:
    """Simulate a chip along x (m/s) on an empty field, one row per tick."""
    scene = Scene(make_config(LONG, 0, 0, ball=name, time_step=TICK))
    scene.ball.velocity[:, 0] = speed * np.cos(radians(degrees))
    scene.ball.vertical_velocity[:] = speed * sin(radians(degrees))
    return scene.play(seconds)


def touch_downs(trajectory: Trajectory) -> Array:
    """Return the indices of ticks in which the ball hopped or landed for good."""
    rises = np.diff(trajectory.ball.vertical_velocity[:, 0], prepend=np.inf) > 0
    down = trajectory.ball.height[:, 0] == 0.0
    came_down = down & ~np.roll(down, 1)
    found: Array = np.flatnonzero((rises & ~down) | came_down)
    return found


def _arc(name: str) -> Checks:
    trajectory = chip(name, CHIP, 1.0)
    yield APEX(f"`{name}`", apex(CHIP * sin(radians(45))), trajectory.ball.height.max())
    yield LANDING(
        f"`{name}`", CHIP**2 / G, trajectory.ball.position[touch_downs(trajectory)[0], 0, 0]
    )


def _hops(name: str, ball: Ball) -> Checks:
    trajectory = chip(name, 6.5, 6.0)
    downs, high = touch_downs(trajectory), trajectory.ball.height[:, 0]
    during = np.append(downs - 1, downs[-1])  # one tick of each hop, then one of rolling
    speeds = trajectory.ball.velocity[during, 0, 0]
    tops = [part.max() for part in np.split(high, downs)[:-1]]
    for nth, (before, after) in enumerate(pairwise(speeds[:-1])):
        criterion, ratio = (
            (HOP_LATER, ball.later_hop_factor) if nth else (HOP_FIRST, ball.first_hop_factor)
        )
        yield criterion(f"`{name}`, hop {nth + 1}", ratio, after / before)
    for nth, (before, after) in enumerate(pairwise(tops)):
        if after > 0.02:
            yield HOP_UP(
                f"`{name}`, hop {nth + 1}", ball.vertical_restitution, sqrt(after / before)
            )
    rim = trajectory.ball.spin[-1, 0, 1] * ball.radius
    yield ROLLS(f"`{name}`", 0.0, trajectory.ball.velocity[-1, 0, 0] - rim)


def _chips_at_a_robot(rises: Array) -> Trajectory:
    """Chip at a robot 1.2 m away, 3 m/s horizontally, one world per vertical speed (m/s)."""
    scene = Scene(make_config("ssl_b", 1, 0), len(rises))
    scene.robots.position[:, 0] = (1.2, 0.0)
    scene.face(0, 180.0)
    scene.ball.velocity[:, 0] = 3.0
    scene.ball.vertical_velocity[:] = rises
    return scene.play(0.7)


def _over_a_robot() -> Checks:
    # Still in the air after 0.7 s, so well above the robot that is reached after 0.4 s.
    high = np.linspace(rise_to(0.01, 0.7), 5.0, 6)
    ball = _chips_at_a_robot(high).ball
    for world, rise in enumerate(high):
        yield OVER(f"{rise:.2f} m/s up", 3.0 * 0.7, ball.position[-1, world, 0])
    # Between the floor and the robot's top at the time of contact with its front.
    met = (1.2 - GENERIC.front_distance - DIAMETER / 2) / 3
    low = np.linspace(rise_to(0.01, met), rise_to(GENERIC.height - 0.01, met), 6)
    ball = _chips_at_a_robot(low).ball
    stopped = (ball.last_touch[-1] == 0) & (ball.position[-1, :, 0] < 1.2)
    yield STOPPED(f"{low[0]:.2f} to {low[-1]:.2f} m/s up", 6, stopped.sum())


def _onto_a_robot() -> Checks:
    scene = Scene(make_config("ssl_b", 1, 0), 4)
    scene.face(0, 30.0)
    scene.ball.position[:] = [[0.0, 0.01], [0.03, 0.01], [-0.4, 0.01], [0.0, 0.01]]
    scene.ball.velocity[:, 0] = [0.0, 0.0, 0.5, 0.2]
    scene.ball.height[:] = 1.0
    ball = scene.play(4.0).ball
    beside = norm(*ball.position[-1].T) > GENERIC.radius
    down = (ball.height[-1] == 0.0) & (ball.last_touch[-1] == 0)
    yield ON_TOP("from 1 m", 4, (beside & down).sum())


def _at_the_bar() -> Checks:
    """Shoot from 1.5 m at 6 m/s; the ball crosses the goal line after 0.25 s."""
    for criterion, lowest, highest in (
        (GOALS, 0.005, BAR_BOTTOM - DIAMETER - 0.005),
        (NO_GOALS, BAR_TOP + 0.005, 0.5),
    ):
        heights = np.linspace(lowest, highest, 15)
        scene = Scene(make_config("ssl_b", 0, 0), len(heights))
        scene.ball.position[:, 0], scene.ball.velocity[:, 0] = 3.0, 6.0
        scene.ball.vertical_velocity[:] = rise_to(heights, 0.25)
        ball = scene.play(0.5).ball
        goals = (ball.crossed == CROSSINGS.index("goal_right")).any(axis=0).sum()
        if criterion is NO_GOALS:
            yield NO_GOALS("ball's lowest point at 0.185 to 0.5 m", 0, goals)
            over = (ball.crossed == CROSSINGS.index("goal_line_right")).argmax(axis=0)
            crossed = ball.data[over, range(len(heights)), HEIGHT]
            for expected, got in zip(heights, crossed, strict=True):
                yield OVER_BAR(f"{expected:.3f} m", expected, got)
        else:
            yield GOALS("ball's highest point at 0.048 to 0.155 m", 15, goals)


def _off_the_table() -> Checks:
    for criterion, start, leave in ((OFF_TABLE, 0.2, 2), (ON_TABLE, 0.02, 0)):
        scene = Scene(make_config("vss_3v3", 0, 0), 2)
        scene.ball.position[:] = [[0.5, 0.4], [0.5, -0.4]]
        scene.ball.velocity[:, 1] = [2.0, -2.0]
        scene.ball.height[:] = start
        ball = scene.play(1.5).ball
        yield criterion(
            f"from {start:g} m", leave, (abs(ball.position[..., 1]) > 0.65).any(axis=0).sum()
        )

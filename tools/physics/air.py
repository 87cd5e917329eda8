"""A ball in the air: the parabola, its hops, what it clears and what stops it."""

from itertools import pairwise
from math import radians, sin, sqrt

import numpy as np

from rsoccer import SimConfig
from rsoccer._core import CROSSINGS, Field
from rsoccer.frame import Array, length
from tools.physics.check import EXACT, Checks, Line, percent, within
from tools.physics.cited import BALLS, GENERIC, Ball, G
from tools.physics.closed_form import apex, rise_to
from tools.physics.scene import TICK, Scene, Track

TOPIC = "air"
LONG = Field("ssl_b", length=60.0)
CHIP = 5.5  # m/s, at 45 degrees
DIAMETER = 0.043
BAR_BOTTOM, BAR_TOP = 0.16, 0.18

RULES = "wall of 50 mm"
PARABOLA = "parabola, 9.81 m/s²"
APEX = Line(TOPIC, "apex of a chip of 5.5 m/s at 45 degrees", "m", percent(2), PARABOLA)
LANDING = Line(TOPIC, "its first landing", "m", percent(2), PARABOLA)
HOP_FIRST = Line(TOPIC, "speed along the floor kept by the first hop", "", within(0.01), "preset")
HOP_LATER = Line(TOPIC, "kept by each later hop", "", within(0.01), "preset")
HOP_UP = Line(TOPIC, "vertical speed kept by each hop", "", within(0.02), "preset")
ROLLS = Line(TOPIC, "after its hops it rolls: slip", "m/s", within(0.001), "rolling")
OVER = Line(TOPIC, "way in 0.7 s of chips that clear a robot", "m", percent(2), PARABOLA)
STOPPED = Line(TOPIC, "low chips that the robot stops", "of 6", EXACT, PARABOLA)
ON_TOP = Line(TOPIC, "balls dropped on a robot that end beside it", "of 4", EXACT, "no hold")
GOALS = Line(TOPIC, "shots under the bar that are goals", "of 15", EXACT, PARABOLA)
NO_GOALS = Line(TOPIC, "shots over the bar that are goals", "of 15", EXACT, PARABOLA)
OVER_BAR = Line(TOPIC, "height of those at the goal line", "m", percent(2), PARABOLA)
OFF_TABLE = Line(TOPIC, "balls over the wall of a VSSS table that leave it", "of 2", EXACT, RULES)
ON_TABLE = Line(TOPIC, "lower ones that leave it", "of 2", EXACT, RULES)


def checks() -> Checks:
    """Every line of the acceptance about flight."""
    for name, ball in BALLS.items():
        yield from _arc(name)
        yield from _hops(name, ball)
    yield from _over_a_robot()
    yield from _onto_a_robot()
    yield from _at_the_bar()
    yield from _off_the_table()


def chip(name: str, speed: float, seconds: float, degrees: float = 45.0) -> Track:
    """A chip along x with nothing in its way, tick by tick."""
    scene = Scene(SimConfig(LONG, 0, 0, ball=name, time_step=TICK))
    scene.ball.velocity[:, 0] = speed * np.cos(radians(degrees))
    scene.ball.vertical_velocity[:] = speed * sin(radians(degrees))
    return scene.play(seconds)


def touch_downs(track: Track) -> Array:
    """Ticks in which the ball hopped or came to stay down."""
    rises = np.diff(track.ball.vertical_velocity[:, 0], prepend=np.inf) > 0
    down = track.ball.height[:, 0] == 0.0
    came_down = down & ~np.roll(down, 1)
    found: Array = np.flatnonzero((rises & ~down) | came_down)
    return found


def _arc(name: str) -> Checks:
    track = chip(name, CHIP, 1.0)
    yield APEX(f"`{name}`", apex(CHIP * sin(radians(45))), track.ball.height.max())
    yield LANDING(f"`{name}`", CHIP**2 / G, track.ball.position[touch_downs(track)[0], 0, 0])


def _hops(name: str, ball: Ball) -> Checks:
    track = chip(name, 6.5, 6.0)
    downs, high = touch_downs(track), track.ball.height[:, 0]
    speeds = track.ball.velocity[np.append(downs - 1, downs[-1]), 0, 0]  # of each hop, then rolling
    tops = [part.max() for part in np.split(high, downs)[:-1]]
    for nth, (before, after) in enumerate(pairwise(speeds[:-1])):
        line, keeps = (HOP_LATER, ball.hop_later) if nth else (HOP_FIRST, ball.hop_first)
        yield line(f"`{name}`, hop {nth + 1}", keeps, after / before)
    for nth, (before, after) in enumerate(pairwise(tops)):
        if after > 0.02:
            yield HOP_UP(f"`{name}`, hop {nth + 1}", ball.hop_up, sqrt(after / before))
    rim = track.ball.spin[-1, 0, 1] * ball.radius
    yield ROLLS(f"`{name}`", 0.0, track.ball.velocity[-1, 0, 0] - rim)


def _chips_at_a_robot(rises: Array) -> Track:
    """Chips of 3 m/s along the floor at a robot 1.2 m away, a world for each vertical speed."""
    scene = Scene(SimConfig("ssl_b", 1, 0), len(rises))
    scene.robots.position[:, 0] = (1.2, 0.0)
    scene.face(0, 180.0)
    scene.ball.velocity[:, 0] = 3.0
    scene.ball.vertical_velocity[:] = rises
    return scene.play(0.7)


def _over_a_robot() -> Checks:
    # Still in the air after 0.7 s, so high above a robot that it reaches after 0.4 s.
    high = np.linspace(rise_to(0.01, 0.7), 5.0, 6)
    ball = _chips_at_a_robot(high).ball
    for world, rise in enumerate(high):
        yield OVER(f"{rise:.2f} m/s up", 3.0 * 0.7, ball.position[-1, world, 0])
    # Between the floor and its top when they meet its front.
    met = (1.2 - GENERIC.front - DIAMETER / 2) / 3
    low = np.linspace(rise_to(0.01, met), rise_to(GENERIC.height - 0.01, met), 6)
    ball = _chips_at_a_robot(low).ball
    stopped = (ball.last_touch[-1] == 0) & (ball.position[-1, :, 0] < 1.2)
    yield STOPPED(f"{low[0]:.2f} to {low[-1]:.2f} m/s up", 6, stopped.sum())


def _onto_a_robot() -> Checks:
    scene = Scene(SimConfig("ssl_b", 1, 0), 4)
    scene.face(0, 30.0)
    scene.ball.position[:] = [[0.0, 0.01], [0.03, 0.01], [-0.4, 0.01], [0.0, 0.01]]
    scene.ball.velocity[:, 0] = [0.0, 0.0, 0.5, 0.2]
    scene.ball.height[:] = 1.0
    ball = scene.play(4.0).ball
    beside = length(*ball.position[-1].T) > GENERIC.radius
    down = (ball.height[-1] == 0.0) & (ball.last_touch[-1] == 0)
    yield ON_TOP("from 1 m", 4, (beside & down).sum())


def _at_the_bar() -> Checks:
    """From 1.5 m at 6 m/s, over the line after 0.25 s."""
    for line, lowest, highest in (
        (GOALS, 0.005, BAR_BOTTOM - DIAMETER - 0.005),
        (NO_GOALS, BAR_TOP + 0.005, 0.5),
    ):
        heights = np.linspace(lowest, highest, 15)
        scene = Scene(SimConfig("ssl_b", 0, 0), len(heights))
        scene.ball.position[:, 0], scene.ball.velocity[:, 0] = 3.0, 6.0
        scene.ball.vertical_velocity[:] = rise_to(heights, 0.25)
        ball = scene.play(0.5).ball
        goals = (ball.crossed == CROSSINGS.index("goal_right")).any(axis=0).sum()
        if line is NO_GOALS:
            yield NO_GOALS("bottom at 0.185 to 0.5 m", 0, goals)
            over = (ball.crossed == CROSSINGS.index("goal_line_right")).argmax(axis=0)
            crossed = ball.data[over, range(len(heights)), -1]
            for height_there, got in zip(heights, crossed, strict=True):
                yield OVER_BAR(f"{height_there:.3f} m", height_there, got)
        else:
            yield GOALS("top at 0.048 to 0.155 m", 15, goals)


def _off_the_table() -> Checks:
    for line, start, leave in ((OFF_TABLE, 0.2, 2), (ON_TABLE, 0.02, 0)):
        scene = Scene(SimConfig("vss_3v3", 0, 0), 2)
        scene.ball.position[:] = [[0.5, 0.4], [0.5, -0.4]]
        scene.ball.velocity[:, 1] = [2.0, -2.0]
        scene.ball.height[:] = start
        ball = scene.play(1.5).ball
        yield line(
            f"from {start:g} m", leave, (abs(ball.position[..., 1]) > 0.65).any(axis=0).sum()
        )

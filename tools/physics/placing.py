"""Placing and reading: what was placed is what is read, and what rows say of a step."""

import numpy as np

from rsoccer import Frame, SimConfig
from rsoccer._core import BALL_COLUMNS, CROSSINGS, ROBOT_COLUMNS
from rsoccer.frame import Array, Floats
from tools.physics.check import EXACT, Checks, Line, percent, within
from tools.physics.scene import STEP, Match, Scene

TOPIC = "placing"
PLACED = "what was placed"
READ = Line(
    TOPIC, "largest difference of what is read, velocities and spins included", "", EXACT, PLACED
)
AGAIN = Line(TOPIC, "largest difference when it is read twice", "", EXACT, "first reading")
ON = Line(TOPIC, "a state of a match, placed again: largest difference", "", EXACT, PLACED)
REPEATED = Line(TOPIC, "columns that differ when a match is played twice", "", EXACT, "first time")
CRASH = Line(TOPIC, "closing speed of a crash", "m/s", percent(4), "sum of both commands")
OPPONENT = Line(TOPIC, "robots that touched an opponent in it", "of 2", EXACT, "they are opponents")
LINE = Line(TOPIC, "lines told when the ball crosses them", "of 6", EXACT, "where it was aimed")
LINE_AT = Line(TOPIC, "farthest off the place told", "mm", within(1), "straight line")
TOLD_ONCE = Line(TOPIC, "steps in which they are told", "of 6", EXACT, "once each")
TOUCH = Line(
    TOPIC, "last toucher after a ball goes from one robot to another", "", EXACT, "the other"
)

SHOTS = {  # from, velocity, what it crosses, where
    "goal_right": ((4.0, 0.2), (4.0, 0.0), (4.5, 0.2)),
    "goal_left": ((-4.0, 0.2), (-4.0, 0.0), (-4.5, 0.2)),
    "goal_line_right": ((4.0, 1.2), (4.0, 0.0), (4.5, 1.2)),
    "goal_line_left": ((-4.0, 1.2), (-4.0, 0.0), (-4.5, 1.2)),
    "touch_line_left": ((1.0, 2.5), (0.0, 4.0), (1.0, 3.0)),
    "touch_line_right": ((1.0, -2.5), (0.0, -4.0), (1.0, -3.0)),
}


def checks() -> Checks:
    """Every line of the acceptance about placing and reading."""
    for name, config in (("VSSS", SimConfig("vss_3v3", 3, 2)), ("SSL", SimConfig("ssl_b", 2, 4))):
        yield from _read(name, moving(config))
    yield from _crash()
    yield from _lines()
    yield from _touches()


def moving(config: SimConfig) -> Scene:
    """A start in which everything moves, always the same."""
    scene, rng = Scene(config), np.random.default_rng(5)
    robots = config.n_robots
    scene.robots.position[0, :, 0] = np.linspace(-0.6, 0.6, robots)
    scene.robots.position[0, :, 1] = 0.3
    headings = rng.uniform(-np.pi, np.pi, robots)
    scene.robots.heading[0] = np.stack([np.cos(headings), np.sin(headings)], axis=-1)
    scene.robots.velocity[:] = rng.uniform(-1, 1, (robots, 2))
    scene.robots.spin[:] = rng.uniform(-5, 5, robots)
    scene.ball.velocity[:] = rng.uniform(-1, 1, 2)
    scene.ball.height[:], scene.ball.vertical_velocity[:] = 0.3, 0.7
    scene.ball.spin[:] = rng.uniform(-30, 30, 3)
    return scene


def motion(frame: Frame) -> Floats:
    """The columns that a start consists of."""
    ball = frame.ball.data[:, : BALL_COLUMNS.index("last_touch")]
    robots = frame.robots.data[..., : ROBOT_COLUMNS.index("infrared")]
    return np.concatenate([ball, robots.reshape(len(frame), -1)], axis=1)


def _apart(a: Array, b: Array) -> float:
    return float(abs(a - b).max())


def _read(name: str, scene: Scene) -> Checks:
    match = scene.begin()
    yield READ(name, 0.0, _apart(motion(match.frame), motion(scene.start)))
    first, second = scene.start.copy(), scene.start.copy()
    match.simulator.read(first.rows)
    match.simulator.read(second.rows)
    yield AGAIN(name, 0.0, _apart(first.rows, second.rows))
    scene.commands[:] = 1.0
    match.run(4 * STEP)
    later = Scene(scene.config)
    later.start.rows[:] = match.frame.rows
    yield ON(name, 0.0, _apart(motion(Match(later).frame), motion(match.frame)))
    once, twice = scene.play(2.0).rows, scene.play(2.0).rows
    yield REPEATED(name, 0, (once != twice).sum())


def _crash() -> Checks:
    scene = Scene(SimConfig("ssl_b", 1, 1))
    scene.robots.position[0, :, 0] = (-0.5, 0.5)
    scene.face(1, 180.0)
    scene.ball.position[:] = (0.0, -2.0)
    scene.tell(0, v_x=2.0)
    scene.tell(1, v_x=1.0)
    robots = scene.play(1.5).robots
    yield CRASH("2 and 1 m/s, head on", 3.0, robots.crash_speed.max())
    yield OPPONENT("2 and 1 m/s, head on", 2, (robots.touched_foe == 1).any(axis=0).sum())


def _lines() -> Checks:
    scene = Scene(SimConfig("ssl_b", 0, 0), len(SHOTS))
    scene.ball.position[:] = [start for start, _, _ in SHOTS.values()]
    scene.ball.velocity[:] = [velocity for _, velocity, _ in SHOTS.values()]
    ball = scene.play(0.3).ball
    told = ball.crossed != 0
    step, worlds = told.argmax(axis=0), range(len(SHOTS))
    names = [CROSSINGS[int(code)] for code in ball.crossed[step, worlds]]
    yield LINE("division B", 6, sum(a == b for a, b in zip(names, SHOTS, strict=True)))
    yield TOLD_ONCE("division B", 6, told.sum())
    places = np.array([place for _, _, place in SHOTS.values()])
    yield LINE_AT("division B", 0.0, 1000 * _apart(ball.crossed_at[step, worlds], places))


def _touches() -> Checks:
    scene = Scene(SimConfig("ssl_b", 1, 1))
    scene.robots.position[0, :, 0] = (0.5, -0.5)
    scene.face(0, 180.0)
    scene.ball.position[:], scene.ball.velocity[:] = (0.2, 0.0), (3.0, 0.0)
    ball = scene.play(1.0).ball
    touchers = ball.last_touch[:, 0]
    yield TOUCH("blue, then yellow", 1.0, touchers[-1] if 0.0 in touchers else np.nan)

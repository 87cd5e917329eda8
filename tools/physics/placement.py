"""Placing and reading of states; events reported in state rows."""

import numpy as np

from rsoccer import Frame, SimConfig
from rsoccer._core import BALL_COLUMNS, CROSSINGS, ROBOT_COLUMNS
from rsoccer.arrays import Array, Floats
from tools.physics.check import EXACT, Checks, Criterion, absolute, percent
from tools.physics.scene import STEP, Match, Scene, make_config

TOPIC = "placement"
PLACED = "placed state"
READ = Criterion(
    TOPIC,
    "state read after placing, velocities and spins included: largest difference",
    "",
    EXACT,
    PLACED,
)
AGAIN = Criterion(TOPIC, "state read twice: largest difference", "", EXACT, "first reading")
RESTORED = Criterion(
    TOPIC, "state of a running match placed again: largest difference", "", EXACT, PLACED
)
REPEATED = Criterion(TOPIC, "match simulated twice: columns that differ", "", EXACT, "first run")
CRASH = Criterion(
    TOPIC, "collision of two robots: closing speed", "m/s", percent(4), "sum of both commands"
)
OPPONENT = Criterion(
    TOPIC,
    "collision of two robots: robots with a reported opponent contact",
    "of 2",
    EXACT,
    "they are opponents",
)
CROSSED = Criterion(TOPIC, "line crossings of the ball: correct lines", "of 6", EXACT, "aim")
CROSSED_AT = Criterion(
    TOPIC, "line crossings of the ball: position error", "mm", absolute(1), "straight line"
)
CROSSED_ONCE = Criterion(
    TOPIC, "line crossings of the ball: steps that report one", "of 6", EXACT, "once each"
)
TOUCH = Criterion(
    TOPIC, "ball passes from one robot to another: last touch", "", EXACT, "second robot"
)

SHOTS = {  # line: start, velocity, position of the crossing
    "goal_right": ((4.0, 0.2), (4.0, 0.0), (4.5, 0.2)),
    "goal_left": ((-4.0, 0.2), (-4.0, 0.0), (-4.5, 0.2)),
    "goal_line_right": ((4.0, 1.2), (4.0, 0.0), (4.5, 1.2)),
    "goal_line_left": ((-4.0, 1.2), (-4.0, 0.0), (-4.5, 1.2)),
    "touch_line_left": ((1.0, 2.5), (0.0, 4.0), (1.0, 3.0)),
    "touch_line_right": ((1.0, -2.5), (0.0, -4.0), (1.0, -3.0)),
}


def checks() -> Checks:
    """Yield all checks of placing and reading."""
    for name, config in (
        ("VSSS", make_config("vss_3v3", 3, 2)),
        ("SSL", make_config("ssl_b", 2, 4)),
    ):
        yield from _read_back(name, moving(config))
    yield from _crash()
    yield from _crossings()
    yield from _touches()


def moving(config: SimConfig) -> Scene:
    """Return a reproducible start in which ball and robots move."""
    scene, rng = Scene(config), np.random.default_rng(5)
    robots = config.n_robots
    scene.robots.position[0, :, 0] = np.linspace(-0.6, 0.6, robots)
    scene.robots.position[0, :, 1] = 0.3
    headings = rng.uniform(-np.pi, np.pi, robots)
    scene.robots.heading[0] = np.stack([np.cos(headings), np.sin(headings)], axis=-1)
    scene.robots.velocity[:] = rng.uniform(-1, 1, (robots, 2))
    scene.robots.angular_velocity[:] = rng.uniform(-5, 5, robots)
    scene.ball.velocity[:] = rng.uniform(-1, 1, 2)
    scene.ball.height[:], scene.ball.vertical_velocity[:] = 0.3, 0.7
    scene.ball.spin[:] = rng.uniform(-30, 30, 3)
    return scene


def start_columns(frame: Frame) -> Floats:
    """Return the columns that define a start, without reported events."""
    ball = frame.ball.data[:, : BALL_COLUMNS.index("last_touch")]
    robots = frame.robots.data[..., : ROBOT_COLUMNS.index("infrared")]
    return np.concatenate([ball, robots.reshape(len(frame), -1)], axis=1)


def _max_difference(a: Array, b: Array) -> float:
    return float(abs(a - b).max())


def _read_back(name: str, scene: Scene) -> Checks:
    match = scene.begin()
    yield READ(name, 0.0, _max_difference(start_columns(match.frame), start_columns(scene.start)))
    first, second = scene.start.copy(), scene.start.copy()
    match.simulator.read(first.rows)
    match.simulator.read(second.rows)
    yield AGAIN(name, 0.0, _max_difference(first.rows, second.rows))
    scene.commands[:] = 1.0
    match.run(4 * STEP)
    later = Scene(scene.config)
    later.start.rows[:] = match.frame.rows
    yield RESTORED(
        name, 0.0, _max_difference(start_columns(Match(later).frame), start_columns(match.frame))
    )
    once, twice = scene.play(2.0).rows, scene.play(2.0).rows
    yield REPEATED(name, 0, (once != twice).sum())


def _crash() -> Checks:
    scene = Scene(make_config("ssl_b", 1, 1))
    scene.robots.position[0, :, 0] = (-0.5, 0.5)
    scene.face(1, 180.0)
    scene.ball.position[:] = (0.0, -2.0)
    scene.command(0, v_x=2.0)
    scene.command(1, v_x=1.0)
    robots = scene.play(1.5).robots
    yield CRASH("2 and 1 m/s, head on", 3.0, robots.collision_speed.max())
    yield OPPONENT("2 and 1 m/s, head on", 2, (robots.touched_opponent == 1).any(axis=0).sum())


def _crossings() -> Checks:
    scene = Scene(make_config("ssl_b", 0, 0), len(SHOTS))
    scene.ball.position[:] = [start for start, _, _ in SHOTS.values()]
    scene.ball.velocity[:] = [velocity for _, velocity, _ in SHOTS.values()]
    ball = scene.play(0.3).ball
    crossed = ball.crossed != 0
    step, worlds = crossed.argmax(axis=0), range(len(SHOTS))
    names = [CROSSINGS[int(code)] for code in ball.crossed[step, worlds]]
    yield CROSSED("division B", 6, sum(a == b for a, b in zip(names, SHOTS, strict=True)))
    yield CROSSED_ONCE("division B", 6, crossed.sum())
    positions = np.array([position for _, _, position in SHOTS.values()])
    yield CROSSED_AT(
        "division B", 0.0, 1000 * _max_difference(ball.crossed_at[step, worlds], positions)
    )


def _touches() -> Checks:
    scene = Scene(make_config("ssl_b", 1, 1))
    scene.robots.position[0, :, 0] = (0.5, -0.5)
    scene.face(0, 180.0)
    scene.ball.position[:], scene.ball.velocity[:] = (0.2, 0.0), (3.0, 0.0)
    ball = scene.play(1.0).ball
    touchers = ball.last_touch[:, 0]
    yield TOUCH("blue, then yellow", 1.0, touchers[-1] if 0.0 in touchers else np.nan)

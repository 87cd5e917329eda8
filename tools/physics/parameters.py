"""Per-world parameters: each factor does what its name says, in its own world only."""

import numpy as np

from rsoccer import SimConfig
from rsoccer._core import BALL_PARAMETERS, ROBOT_PARAMETERS
from rsoccer.frame import Array
from tools.parts import table
from tools.physics.check import EXACT, Checks, Line, percent
from tools.physics.cited import BALLS, GENERIC, G
from tools.physics.dribbler import turning
from tools.physics.kicker import with_ball
from tools.physics.omni import alone, speeds
from tools.physics.scene import TICK, Scene

TOPIC = "parameters"
BALL = BALLS["ssl_tigers"]
FACTORS = np.array([1.0, 1.5, 0.5])

MEANINGS = {
    "ball": {
        "mass": "Against robots: a heavier ball pushes harder.",
        "sliding_deceleration": "How soon a kick comes to roll.",
        "rolling_deceleration": "How far it rolls.",
        "hop": "Vertical speed that a hop keeps, to at most all of it.",
        "robot_restitution": "Speed that comes back from robots, to at most all of it.",
        "robot_friction": "Spin and speed across that robots give and take.",
        "wall_restitution": "As for robots; walls, goals and their backs.",
        "wall_friction": "Likewise.",
    },
    "robot": {
        "mass": "Shoving, and what a ball or a kick does to the robot. Accelerations stay.",
        "height": "What flies over it.",
        "acceleration": "SSL: all four limits. VSSS: torque of the motors, and forward grip.",
        "speed": "Top speed and turn rate, and the wheels' top speed.",
        "traction": "What the wheels transmit: pushing, standing firm, skidding.",
        "kick": "Speed of kicks and chips, after the device's limit.",
        "grip": "Force with which the dribbler holds the ball.",
    },
}

RATIO = "the factor"
LAW = Line(TOPIC, "the number that a factor is on, by the model's", "", percent(2), RATIO)
ONES = Line(TOPIC, "columns that differ when every factor is 1", "", EXACT, "without factors")
HEIGHT = Line(
    TOPIC, "a chip at 0.17 m flies over robots of these heights", "", EXACT, "robot 0.143 m"
)
GRIP = Line(
    TOPIC, "a turn of 7 rad/s keeps the ball at these grips", "", EXACT, "0.12 N times factor"
)
MASS = Line(TOPIC, "speed that a ball gives a robot, by the model's", "", percent(2), "momentum")


def checks() -> Checks:
    """Every parameter, by what it changes."""
    yield from _ones()
    yield from _floor()
    yield from _bounces()
    yield from _drive()
    yield from _masses()
    yield from _mouth()
    yield from _heights()


def _ratios(name: str, values: Array) -> Checks:
    """Values by the first one, which has the factor 1."""
    for factor, value in zip(FACTORS[1:], values[1:], strict=True):
        yield LAW(f"{name} x {factor:g}", factor, value / values[0])


def _ones() -> Checks:
    scene = with_ball(worlds=2)
    scene.tell(0, v_x=1.0, v_y=0.5, v_theta=2.0, dribbler=1.0)
    scene.vary_ball("mass", np.array([1.0, 1.5]))  # a world apart, so that factors are passed
    plain = with_ball()
    plain.tell(0, v_x=1.0, v_y=0.5, v_theta=2.0, dribbler=1.0)
    differs = scene.play(1.5).rows[:, 0] != plain.play(1.5).rows[:, 0]
    yield ONES("driving with the ball", 0, differs.sum())


def _ball(name: str, worlds: int = 3) -> Scene:
    scene = Scene(SimConfig("ssl_b", 0, 0, time_step=TICK), worlds)
    scene.vary_ball(name, FACTORS)
    return scene


def _floor() -> Checks:
    scene = _ball("sliding_deceleration")
    scene.ball.velocity[:, 0] = 2.0
    yield from _ratios("ball sliding_deceleration", 2 - scene.play(0.1).ball.velocity[-1, :, 0])
    scene = _ball("rolling_deceleration")
    scene.ball.velocity[:, 0], scene.ball.spin[:, 1] = 2.0, 2.0 / BALL.radius
    yield from _ratios("ball rolling_deceleration", 2 - scene.play(0.5).ball.velocity[-1, :, 0])
    scene = _ball("hop")
    scene.ball.vertical_velocity[:], fall = 3.0, 2 * 3.0 / G
    after = round((fall + TICK) / TICK) * TICK
    yield from _ratios(
        "ball hop", scene.play(after).ball.vertical_velocity[-1] + G * (after - fall)
    )


def _bounces() -> Checks:
    scene = _ball("wall_restitution")
    scene.ball.position[:, 1], scene.ball.velocity[:, 1] = 3.275, 3.0
    yield from _ratios("ball wall_restitution", -scene.play(TICK).ball.velocity[-1, :, 1])
    scene = _ball("wall_friction")
    scene.ball.position[:, 1], scene.ball.velocity[:] = 3.275, (9.0, 3.0)
    spin = scene.play(TICK).ball.spin[-1, :, 2]
    yield from _ratios("ball wall_friction", spin)
    for name, velocity in (("robot_restitution", (-3.0, 0.0)), ("robot_friction", (-3.0, 6.0))):
        scene = with_ball(worlds=3)
        scene.vary_ball(name, FACTORS)
        scene.ball.position[:, 0] += 0.003
        scene.ball.velocity[:] = velocity
        track = scene.play(TICK)
        apart = track.ball.velocity[-1] - track.robots.velocity[-1, :, 0]
        spins = track.ball.spin[-1, :, 2]
        yield from _ratios(f"ball {name}", spins if "friction" in name else apart[:, 0])


def _drive() -> Checks:
    for name, seconds in (("speed", 1.4), ("acceleration", 0.2)):
        scene = alone(worlds=3)
        scene.vary_robot(0, "traction", 2.0)  # or it would be the limit
        scene.vary_robot(0, name, FACTORS)
        scene.tell(0, v_x=9.0)
        yield from _ratios(f"robot {name}", speeds(scene.play(seconds))[-1])
    scene = alone(worlds=3)
    # Beyond what the limits ask for, traction changes nothing: less of it does.
    scene.vary_robot(0, "traction", 0.4 * FACTORS)
    scene.tell(0, v_x=9.0)
    yield from _ratios("robot traction", speeds(scene.play(0.2))[-1])


def _masses() -> Checks:
    """A ball at 3 m/s at a robot: both give and take the same momentum, within a tick."""
    for who in ("ball", "robot"):
        scene = with_ball(worlds=3)
        scene.ball.position[:, 0] += 0.003
        scene.ball.velocity[:, 0] = -3.0
        masses = np.array([[BALL.mass], [GENERIC.mass]]) * np.ones(3)
        if who == "ball":
            scene.vary_ball("mass", FACTORS)
            masses[0] *= FACTORS
        else:
            scene.vary_robot(0, "mass", FACTORS)
            masses[1] *= FACTORS
        given = masses[0] / masses.sum(axis=0)  # of the closing speed, times 1 + restitution
        speed = scene.play(TICK).robots.velocity[-1, :, 0, 0]
        for world in (1, 2):
            case = f"{who} mass x {FACTORS[world]:g}"
            yield MASS(case, given[world] / given[0], speed[world] / speed[0])


def _mouth() -> Checks:
    scene = with_ball(worlds=3)
    scene.vary_robot(0, "kick", FACTORS)
    scene.tell(0, kick_v_x=4.0)
    yield from _ratios("robot kick", scene.play(TICK).ball.velocity[-1, :, 0])
    scene = turning(7.0, worlds=3)
    scene.vary_robot(0, "grip", FACTORS)
    kept = scene.play(2.0).robots.infrared[-1, :, 0]
    for factor, got in zip(FACTORS, kept, strict=True):
        yield GRIP(f"robot grip x {factor:g}", float(factor >= 1), got)


def _heights() -> Checks:
    """Over a robot 0.6 m away; the tallest reaches 0.21 m."""
    scene = Scene(SimConfig("ssl_b", 1, 0), 3)
    scene.robots.position[:, 0] = (0.6, 0.0)
    scene.vary_robot(0, "height", FACTORS)
    scene.ball.velocity[:, 0] = 3.0
    scene.ball.vertical_velocity[:] = 0.17 / 0.2 + G * 0.2 / 2  # 0.17 m up after 0.2 s
    over = scene.play(0.35).ball.position[-1, :, 0] > 0.8
    for factor, got in zip(FACTORS, over, strict=True):
        yield HEIGHT(f"robot height x {factor:g}", float(factor <= 1), got)


def table_of_names() -> str:
    """Every parameter and what it does; KeyError for one that nobody has described."""
    rows = []
    for who, names in (("ball", BALL_PARAMETERS), ("robot", ROBOT_PARAMETERS)):
        rows += [(who, f"`{name}`", MEANINGS[who][name]) for name in names]
    return table(("of", "factor on", "what it changes"), rows)

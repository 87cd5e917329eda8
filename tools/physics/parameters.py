"""Per-world parameter factors: each one scales its number, in its own world only."""

import numpy as np

from benches.markdown import table
from rsoccer._core import BALL_PARAMETERS, ROBOT_PARAMETERS
from rsoccer.arrays import Array
from tools.physics.check import EXACT, Checks, Criterion, percent
from tools.physics.cited import BALLS, GENERIC, G
from tools.physics.dribbler import turning_scene
from tools.physics.kicker import with_ball
from tools.physics.omni_drive import lone_robot, speeds
from tools.physics.scene import TICK, Scene, make_config

TOPIC = "parameters"
BALL = BALLS["ssl_tigers"]
FACTORS = np.array([1.0, 1.5, 0.5])

EFFECTS = {
    "ball": {
        "mass": "Momentum in contacts with robots: a heavier ball pushes harder.",
        "sliding_deceleration": "Sliding deceleration: time until a kicked ball rolls.",
        "rolling_deceleration": "Rolling deceleration and drag: distance that the ball rolls.",
        "hop": "Ratio of vertical speed after a hop to before, at most 1.",
        "robot_restitution": "Restitution off robots, at most 1.",
        "robot_friction": "Friction coefficient between ball and robots.",
        "wall_restitution": "Restitution off walls, goals and the goals' backs, at most 1.",
        "wall_friction": "Friction coefficient between ball and walls, goals and the goals' backs.",
    },
    "robot": {
        "mass": "Momentum in pushing, ball contacts and kicks. Accelerations do not change.",
        "height": "Height above which the ball flies over the robot.",
        "acceleration": "SSL: all four acceleration limits. VSSS: motor torque and forward grip.",
        "speed": "Top speed, top angular velocity and maximum wheel speed.",
        "traction": "Maximum force of the wheels: pushing, holding position, skidding.",
        "kick": "Speed of kicks and chips, after the limit of the kicker.",
        "grip": "Holding force of the dribbler.",
    },
}

LAW = Criterion(TOPIC, "scaled number by the model's number", "", percent(2), "the factor")
ONES = Criterion(
    TOPIC, "all factors 1: columns that differ", "", EXACT, "simulation without factors"
)
HEIGHT = Criterion(
    TOPIC, "robot height scaled: chip at 0.17 m passes over it", "", EXACT, "robot 0.143 m"
)
GRIP = Criterion(
    TOPIC, "grip scaled: ball kept in a turn of 7 rad/s", "", EXACT, "0.12 N times factor"
)
MASS = Criterion(
    TOPIC, "mass scaled: speed given to a robot by the ball, ratio", "", percent(2), "momentum"
)


def checks() -> Checks:
    """Yield all checks of parameter factors."""
    yield from _ones()
    yield from _floor()
    yield from _bounces()
    yield from _drive()
    yield from _masses()
    yield from _mouth()
    yield from _heights()


def _ratios(name: str, values: Array) -> Checks:
    """Compare the ratio of each value to the first one, whose factor is 1, with the factor."""
    for factor, value in zip(FACTORS[1:], values[1:], strict=True):
        yield LAW(f"{name} x {factor:g}", factor, value / values[0])


def _ones() -> Checks:
    scene = with_ball(worlds=2)
    scene.command(0, v_x=1.0, v_y=0.5, v_theta=2.0, dribbler=1.0)
    scene.vary_ball(
        "mass", np.array([1.0, 1.5])
    )  # factor 1.5 in another world, so that factors are passed
    plain = with_ball()
    plain.command(0, v_x=1.0, v_y=0.5, v_theta=2.0, dribbler=1.0)
    differs = scene.play(1.5).rows[:, 0] != plain.play(1.5).rows[:, 0]
    yield ONES("driving with the ball", 0, differs.sum())


def _ball(name: str, worlds: int = 3) -> Scene:
    scene = Scene(make_config("ssl_b", 0, 0, time_step=TICK), worlds)
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
        trajectory = scene.play(TICK)
        apart = trajectory.ball.velocity[-1] - trajectory.robots.velocity[-1, :, 0]
        spins = trajectory.ball.spin[-1, :, 2]
        yield from _ratios(f"ball {name}", spins if "friction" in name else apart[:, 0])


def _drive() -> Checks:
    for name, seconds in (("speed", 1.4), ("acceleration", 0.2)):
        scene = lone_robot(worlds=3)
        scene.vary_robot(0, "traction", 2.0)  # otherwise traction would be the limit
        scene.vary_robot(0, name, FACTORS)
        scene.command(0, v_x=9.0)
        yield from _ratios(f"robot {name}", speeds(scene.play(seconds))[-1])
    scene = lone_robot(worlds=3)
    # Traction above the acceleration limit has no effect, so reduce it.
    scene.vary_robot(0, "traction", 0.4 * FACTORS)
    scene.command(0, v_x=9.0)
    yield from _ratios("robot traction", speeds(scene.play(0.2))[-1])


def _masses() -> Checks:
    """Hit a robot with a ball at 3 m/s: momentum is conserved within the tick."""
    for body in ("ball", "robot"):
        scene = with_ball(worlds=3)
        scene.ball.position[:, 0] += 0.003
        scene.ball.velocity[:, 0] = -3.0
        masses = np.array([[BALL.mass], [GENERIC.mass]]) * np.ones(3)
        if body == "ball":
            scene.vary_ball("mass", FACTORS)
            masses[0] *= FACTORS
        else:
            scene.vary_robot(0, "mass", FACTORS)
            masses[1] *= FACTORS
        share = masses[0] / masses.sum(axis=0)  # of the closing speed, times 1 + restitution
        speed = scene.play(TICK).robots.velocity[-1, :, 0, 0]
        for world in (1, 2):
            case = f"{body} mass x {FACTORS[world]:g}"
            yield MASS(case, share[world] / share[0], speed[world] / speed[0])


def _mouth() -> Checks:
    scene = with_ball(worlds=3)
    scene.vary_robot(0, "kick", FACTORS)
    scene.command(0, kick_v_x=4.0)
    yield from _ratios("robot kick", scene.play(TICK).ball.velocity[-1, :, 0])
    scene = turning_scene(7.0, worlds=3)
    scene.vary_robot(0, "grip", FACTORS)
    kept = scene.play(2.0).robots.infrared[-1, :, 0]
    for factor, got in zip(FACTORS, kept, strict=True):
        yield GRIP(f"robot grip x {factor:g}", float(factor >= 1), got)


def _heights() -> Checks:
    """Chip over a robot 0.6 m away; the tallest of the three is 0.21 m high."""
    scene = Scene(make_config("ssl_b", 1, 0), 3)
    scene.robots.position[:, 0] = (0.6, 0.0)
    scene.vary_robot(0, "height", FACTORS)
    scene.ball.velocity[:, 0] = 3.0
    scene.ball.vertical_velocity[:] = 0.17 / 0.2 + G * 0.2 / 2  # 0.17 m up after 0.2 s
    over = scene.play(0.35).ball.position[-1, :, 0] > 0.8
    for factor, got in zip(FACTORS, over, strict=True):
        yield HEIGHT(f"robot height x {factor:g}", float(factor <= 1), got)


def parameter_table() -> str:
    """Return a table of all parameters and their effects.

    Raises:
        KeyError: A parameter has no entry in EFFECTS.
    """
    rows = []
    for model, names in (("ball", BALL_PARAMETERS), ("robot", ROBOT_PARAMETERS)):
        rows += [(model, f"`{name}`", EFFECTS[model][name]) for name in names]
    return table(("model", "factor", "effect"), rows)

"""Dribbler: holding the ball while driving and turning, the limits of its grip, and release."""

from math import hypot, sqrt

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Array
from rsoccer.vectors import norm
from tools.physics.check import EXACT, Checks, Criterion, absolute, percent
from tools.physics.cited import BALLS, GENERIC, SSL_SHARED, TURN_WITH_BALL, WITH_BALL
from tools.physics.kicker import front_offset, with_ball
from tools.physics.scene import STEP, TICK, Scene, Trajectory, make_config

TOPIC = "dribbler"
BALL = BALLS["ssl_tigers"]
FAST = 7.0  # rad/s: 4.6 m/s² centripetal, more than floor friction provides
GRIP = SSL_SHARED["dribbler_grip"].value  # N
BAR_SPEED = SSL_SHARED["dribbler_speed"].value  # m/s
MOVES = {
    "turning left at 3 rad/s": (0.0, 0.0, 3.0),
    "turning right at 3 rad/s": (0.0, 0.0, -3.0),
    "backwards at 0.5 m/s": (-0.5, 0.0, 0.0),
    "backwards at 1.9 m/s": (-1.9, 0.0, 0.0),
    "forwards at 1 m/s": (1.0, 0.0, 0.0),
    "sideways at 0.5 m/s": (0.0, 0.5, 0.0),
}
DIRECTIONS = {
    "forwards at 1 m/s": (1.0, 0.0),
    "backwards at 1 m/s": (-1.0, 0.0),
    "sideways at 1 m/s": (0.0, 1.0),
}

HOLDS = Criterion(TOPIC, "share of 2 s with the ball in the mouth", "", EXACT, "below the grip")
GAP = Criterion(TOPIC, "distance from front to ball after 2 s", "mm", absolute(5), "held")
WITHOUT = Criterion(
    TOPIC, "dribbler off: ball in the mouth after 2 s", "of 3", EXACT, "no holding force"
)
TURN = Criterion(
    TOPIC,
    "maximum angular velocity from rest that keeps the ball",
    "rad/s",
    percent(10),
    "driving limit of TIGERs",
)
STEADY = Criterion(
    TOPIC,
    "maximum steady angular velocity that keeps the ball",
    "rad/s",
    percent(5),
    "0.12 N and floor",
)
BRAKE = Criterion(
    TOPIC, "maximum deceleration that keeps the ball", "m/s²", percent(5), "0.12 N and floor"
)
PUBLISHED = Criterion(
    TOPIC,
    "from 3 m/s to 1.9 m/s backwards at 1.2 m/s²: ball kept",
    "",
    EXACT,
    "driving limit of TIGERs",
)
FULL_BRAKE = Criterion(
    TOPIC,
    "from 3 m/s to 1.9 m/s backwards at a robot's full braking: ball kept",
    "",
    EXACT,
    "above that deceleration",
)
BACKWARDS = Criterion(
    TOPIC, "maximum backward speed that keeps the ball", "m/s", percent(5), "dribbler bar speed"
)
NO_SLOWER = Criterion(
    TOPIC, "distance in 1.5 s with the ball by that without it", "", percent(5), "no drag"
)
BACK_SPIN = Criterion(
    TOPIC, "surface speed of the ball after 1 s", "m/s", absolute(0.1), "dribbler bar speed"
)
TURN_CHANGE = Criterion(
    TOPIC,
    "held while turning: ball's velocity change per tick",
    "m/s",
    percent(5),
    "circular motion",
)
RELEASE_CHANGE = Criterion(
    TOPIC,
    "dribbler turned off: ball's velocity change in each of the next 3 ticks",
    "m/s",
    percent(5),
    "floor friction only",
)
LEAVES = Criterion(
    TOPIC, "dribbler turned off: ball in the mouth 1 s later", "", EXACT, "no holding force"
)
STEAL = Criterion(
    TOPIC,
    "opponent dribbles and backs off: opponent has the ball",
    "",
    EXACT,
    "holding force is bounded",
)
KNOCK = Criterion(
    TOPIC,
    "opponent drives across: ball still in the mouth",
    "",
    EXACT,
    "holding force is bounded",
)


def checks() -> Checks:
    """Yield all checks of the dribbler."""
    yield from _holding()
    yield from _losing()
    yield from _speed()
    yield from _back_spin()
    yield from _releasing()
    yield from _stealing()


def _drive(bodies: Array, dribbler: float, seconds: float, time_step: float = STEP) -> Trajectory:
    """Drive robots with the ball in the mouth, one world per body velocity (worlds, 3)."""
    scene = with_ball(worlds=len(bodies), time_step=time_step)
    scene.command(0, v_x=bodies[:, 0], v_y=bodies[:, 1], v_theta=bodies[:, 2], dribbler=dribbler)
    return scene.play(seconds)


def gaps(trajectory: Trajectory) -> Array:
    """Return the distance from the robot's front to the ball, m, shape (steps, worlds)."""
    heading = trajectory.robots.heading[:, :, 0]
    away = trajectory.ball.position - trajectory.robots.position[:, :, 0]
    found: Array = (away * heading).sum(axis=-1) - front_offset()
    return found


def _holding() -> Checks:
    trajectory = _drive(np.array(list(MOVES.values())), 1.0, 2.0)
    detected, gap = trajectory.robots.infrared[:, :, 0], gaps(trajectory)
    for world, move in enumerate(MOVES):
        yield HOLDS(move, 1.0, detected[:, world].mean())
        yield GAP(move, 0.0, 1000 * gap[-1, world])
    trajectory = _drive(np.array(list(MOVES.values()))[:3], 0.0, 2.0)
    yield WITHOUT(
        "turning left, turning right, backwards", 0, trajectory.robots.infrared[-1, :, 0].sum()
    )


def _losing() -> Checks:
    angular_velocities = np.arange(3.0, 10.0, 0.1)
    turns = np.stack([0 * angular_velocities, 0 * angular_velocities, angular_velocities], axis=-1)
    kept = _drive(turns, 1.0, 3.0).robots.infrared[-1, :, 0] == 1.0
    yield TURN("full dribbler", TURN_WITH_BALL, highest_kept(angular_velocities, kept))
    kept = turning_scene(angular_velocities).play(3.0).robots.infrared[-1, :, 0] == 1.0
    yield STEADY("full dribbler", max_angular_velocity(), highest_kept(angular_velocities, kept))
    # The back-spin makes floor friction decelerate the ball as well, up to sliding friction.
    hardest = GRIP / BALL.mass + BALL.sliding_deceleration
    candidates = np.append(np.arange(1.0, GENERIC.max_deceleration, 0.1), GENERIC.max_deceleration)
    kept = np.array([_keeps_ball(brake) for brake in candidates])
    yield BRAKE("3 m/s to 1.9 m/s backwards", hardest, highest_kept(candidates, kept))
    yield PUBLISHED(f"{WITH_BALL:g} m/s²", 1.0, _keeps_ball(WITH_BALL))
    yield FULL_BRAKE(f"{GENERIC.max_deceleration:g} m/s²", 0.0, kept[-1])
    # Backwards faster than the bar the slip reverses, and floor friction exceeds the grip.
    speeds = np.arange(1.0, 3.0, 0.05)
    kept = _driving_scene(-speeds).play(1.0).robots.infrared[-1, :, 0] == 1.0
    yield BACKWARDS("full dribbler", BAR_SPEED, highest_kept(speeds, kept))


def highest_kept(values: Array, kept: Array) -> float:
    """Return the last value before the first one that loses the ball.

    NaN if no value or the very first value loses it.
    """
    lost = np.flatnonzero(~kept)
    return float(values[lost[0] - 1]) if len(lost) and lost[0] else np.nan


def turning_scene(
    angular_velocities: Array | float, worlds: int | None = None, time_step: float = STEP
) -> Scene:
    """Return robots that already turn (rad/s), each with the ball and its back-spin."""
    scene = with_ball(worlds=worlds or np.size(angular_velocities), time_step=time_step)
    scene.robots.angular_velocity[:, 0] = angular_velocities
    scene.ball.velocity[:, 1] = np.asarray(angular_velocities) * front_offset()
    scene.ball.spin[:, 1] = -BAR_SPEED / BALL.radius
    scene.command(0, v_theta=angular_velocities, dribbler=1.0)
    return scene


def _driving_scene(speeds: Array, robot: RobotModel | str = "ssl_generic") -> Scene:
    """Return robots that already drive along x (m/s), each with the ball and its back-spin."""
    scene = with_ball(robot, worlds=len(speeds), time_step=STEP)
    scene.robots.velocity[:, 0, 0] = scene.ball.velocity[:, 0] = speeds
    scene.ball.spin[:, 1] = -BAR_SPEED / BALL.radius
    scene.command(0, v_x=speeds, dribbler=1.0)
    return scene


def _keeps_ball(brake: float) -> bool:
    """Return whether a robot keeps the ball from 3 m/s to 1.9 m/s backwards at `brake`, m/s²."""
    scene = _driving_scene(
        np.array([3.0]), RobotModel("ssl_generic", max_deceleration=brake, max_acceleration=brake)
    )
    scene.command(0, v_x=-1.9)
    kept = scene.play(np.ceil(4.9 / brake / STEP) * STEP + 0.25).robots.infrared[-1, 0, 0]
    return bool(kept)


def max_angular_velocity() -> float:
    """Return the angular velocity (rad/s) at which the grip just holds the ball on its circle.

    Floor friction opposes the slip of the ball. Its tangential part loads the grip; its radial
    part, caused by the back-spin, points to the robot and relieves the grip.
    """
    turn = 10.0
    floor = BALL.mass * BALL.sliding_deceleration
    for _ in range(20):
        along = turn * front_offset()
        slip = hypot(along, BAR_SPEED)
        inward = sqrt(max(GRIP**2 - (floor * along / slip) ** 2, 0.0)) + floor * BAR_SPEED / slip
        turn = sqrt(inward / (BALL.mass * front_offset()))
    return turn


def _speed() -> Checks:
    bodies = np.array([(*direction, 0.0) for direction in DIRECTIONS.values()])
    distances = []
    for without_ball in (False, True):
        scene = with_ball(worlds=len(bodies), time_step=STEP)
        if without_ball:
            scene.ball.position[:] = (0.0, 2.5)
        scene.command(0, v_x=bodies[:, 0], v_y=bodies[:, 1], dribbler=1.0)
        distances.append(norm(*scene.play(1.5).robots.position[-1, :, 0].T))
    for world, direction in enumerate(DIRECTIONS):
        yield NO_SLOWER(direction, 1.0, distances[0][world] / distances[1][world])


def _back_spin() -> Checks:
    spin = _drive(np.zeros((1, 3)), 1.0, 1.0).ball.spin[-1, 0, 1]
    yield BACK_SPIN("robot at rest", -BAR_SPEED, spin * BALL.radius)


def _releasing() -> Checks:
    """Turn the dribbler off in a fast turn: the grip curves the path, then only the floor acts."""
    scene = turning_scene(FAST, time_step=TICK)
    match = scene.begin()
    bend = np.diff(match.run(1.0).ball.velocity[-2:, 0], axis=0)[0]
    yield TURN_CHANGE(f"at {FAST:g} rad/s", FAST**2 * front_offset() * TICK, norm(*bend))
    held = match.frame.ball.velocity.copy()
    scene.command(0, dribbler=0.0)
    velocity = np.concatenate([held[None], match.run(3 * TICK).ball.velocity])[:, 0]
    for tick, change in enumerate(np.diff(velocity, axis=0), start=1):
        yield RELEASE_CHANGE(f"tick {tick}", BALL.sliding_deceleration * TICK, norm(*change))
    yield LEAVES("while turning", 0.0, match.run(1.0).robots.infrared[-1, 0, 0])


def _stealing() -> Checks:
    scene = Scene(make_config("ssl_b", 1, 1))
    scene.robots.position[:, 1] = (2 * front_offset(), 0.0)
    scene.face(1, 180.0)
    scene.ball.position[:] = (front_offset(), 0.0)
    scene.command(1, v_x=-0.3, dribbler=1.0)
    yield STEAL("nose to nose", 1.0, scene.play(1.5).robots.infrared[-1, 0, 1])
    scene = Scene(make_config("ssl_b", 1, 1))
    scene.robots.position[:, 1] = (front_offset(), 0.16)
    scene.face(1, -90.0)
    scene.ball.position[:] = (front_offset(), 0.0)
    scene.command(0, dribbler=1.0)
    scene.command(1, v_x=1.0, dribbler=1.0)
    yield KNOCK("at 1 m/s", 0.0, scene.play(1.5).robots.infrared[-1, 0, 0])

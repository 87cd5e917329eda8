"""The dribbler: holding the ball while driving, up to its grip, and letting go."""

from math import hypot, sqrt

import numpy as np

from rsoccer import SimConfig
from rsoccer._core import RobotModel
from rsoccer.frame import Array, length
from tools.physics.check import EXACT, Checks, Line, percent, within
from tools.physics.cited import BALLS, GENERIC, SSL_SHARED, TURN_WITH_BALL, WITH_BALL
from tools.physics.kicker import reach, with_ball
from tools.physics.scene import STEP, TICK, Scene, Track

TOPIC = "dribbler"
BALL = BALLS["ssl_tigers"]
FAST = 7.0  # rad/s: 4.6 m/s² on the circle, more than the floor gives
GRIP = SSL_SHARED["grip"].value  # N
BAR_SPEED = SSL_SHARED["bar_speed"].value  # m/s
MOVES = {
    "turning left at 3 rad/s": (0.0, 0.0, 3.0),
    "turning right at 3 rad/s": (0.0, 0.0, -3.0),
    "backwards at 0.5 m/s": (-0.5, 0.0, 0.0),
    "backwards at 1.9 m/s": (-1.9, 0.0, 0.0),
    "forwards at 1 m/s": (1.0, 0.0, 0.0),
    "sideways at 0.5 m/s": (0.0, 0.5, 0.0),
}
WAYS = {
    "forwards at 1 m/s": (1.0, 0.0),
    "backwards at 1 m/s": (-1.0, 0.0),
    "sideways at 1 m/s": (0.0, 1.0),
}

HOLDS = Line(TOPIC, "share of 2 s with the ball in the mouth", "", EXACT, "below the grip")
GAP = Line(TOPIC, "from front to ball after 2 s", "mm", within(5), "held")
WITHOUT = Line(
    TOPIC, "without the dribbler: still in the mouth after 2 s", "of 3", EXACT, "no hold"
)
TURN = Line(
    TOPIC, "fastest turn from rest that keeps the ball", "rad/s", percent(10), "TIGERs drive so"
)
STEADY = Line(
    TOPIC, "of one that turns already, ball and all", "rad/s", percent(5), "0.12 N and the floor"
)
BRAKE = Line(TOPIC, "hardest brake that keeps it", "m/s²", percent(5), "0.12 N and the floor")
PUBLISHED = Line(TOPIC, "3 m/s to 1.9 m/s backwards: keeps it", "", EXACT, "TIGERs drive so")
FULL_BRAKE = Line(TOPIC, "the same at a robot's full brake", "", EXACT, "beyond that brake")
BACKWARDS = Line(
    TOPIC, "fastest way backwards that keeps it", "m/s", percent(5), "speed of the bar"
)
NO_SLOWER = Line(TOPIC, "way in 1.5 s with the ball, by that without", "", percent(5), "as without")
BACK_SPIN = Line(TOPIC, "speed of the ball's rim after 1 s", "m/s", within(0.1), "speed of the bar")
BENDS = Line(TOPIC, "held in a turn: change of velocity in a tick", "m/s", percent(5), "circle")
RELEASE = Line(TOPIC, "off: the same in each of the next 3 ticks", "m/s", percent(5), "floor alone")
LEAVES = Line(TOPIC, "off: in the mouth 1 s later", "", EXACT, "no hold")
STEAL = Line(
    TOPIC, "an opponent that dribbles and backs off takes the ball", "", EXACT, "can be taken"
)
KNOCK = Line(TOPIC, "an opponent that drives across: still in the mouth", "", EXACT, "can be taken")


def checks() -> Checks:
    """Every line of the acceptance about the dribbler."""
    yield from _holding()
    yield from _losing()
    yield from _speed()
    yield from _spinning()
    yield from _releasing()
    yield from _taking()


def _told(bodies: Array, dribbler: float, seconds: float, time_step: float = STEP) -> Track:
    """Robots with the ball, a world for each velocity of the body."""
    scene = with_ball(worlds=len(bodies), time_step=time_step)
    scene.tell(0, v_x=bodies[:, 0], v_y=bodies[:, 1], v_theta=bodies[:, 2], dribbler=dribbler)
    return scene.play(seconds)


def gaps(track: Track) -> Array:
    """From the robot's front to the ball, m; (steps, worlds)."""
    heading = track.robots.heading[:, :, 0]
    away = track.ball.position - track.robots.position[:, :, 0]
    found: Array = (away * heading).sum(axis=-1) - reach()
    return found


def _holding() -> Checks:
    track = _told(np.array(list(MOVES.values())), 1.0, 2.0)
    seen, gap = track.robots.infrared[:, :, 0], gaps(track)
    for world, move in enumerate(MOVES):
        yield HOLDS(move, 1.0, seen[:, world].mean())
        yield GAP(move, 0.0, 1000 * gap[-1, world])
    track = _told(np.array(list(MOVES.values()))[:3], 0.0, 2.0)
    yield WITHOUT(
        "turning left, turning right, backwards", 0, track.robots.infrared[-1, :, 0].sum()
    )


def _losing() -> Checks:
    rates = np.arange(3.0, 10.0, 0.1)
    turns = np.stack([0 * rates, 0 * rates, rates], axis=-1)
    kept = _told(turns, 1.0, 3.0).robots.infrared[-1, :, 0] == 1.0
    yield TURN("full dribbler", TURN_WITH_BALL, fastest(rates, kept))
    kept = turning(rates).play(3.0).robots.infrared[-1, :, 0] == 1.0
    yield STEADY("full dribbler", fastest_turn(), fastest(rates, kept))
    # The bar's back-spin has the floor brake the ball, too, up to its slide.
    hardest = GRIP / BALL.mass + BALL.sliding_deceleration
    tried = np.append(np.arange(1.0, GENERIC.brake, 0.1), GENERIC.brake)
    kept = np.array([_braking(brake) for brake in tried])
    yield BRAKE("3 m/s to 1.9 m/s backwards", hardest, fastest(tried, kept))
    yield PUBLISHED(f"{WITH_BALL:g} m/s²", 1.0, _braking(WITH_BALL))
    yield FULL_BRAKE(f"{GENERIC.brake:g} m/s²", 0.0, kept[-1])
    # Backwards faster than the bar, the ball slips the other way, and the floor beats the grip.
    speeds = np.arange(1.0, 3.0, 0.05)
    kept = _going(-speeds).play(1.0).robots.infrared[-1, :, 0] == 1.0
    yield BACKWARDS("full dribbler", BAR_SPEED, fastest(speeds, kept))


def fastest(tried: Array, kept: Array) -> float:
    """The last one before the first that loses the ball; no number if none or the first does."""
    lost = np.flatnonzero(~kept)
    return float(tried[lost[0] - 1]) if len(lost) and lost[0] else np.nan


def turning(rates: Array | float, worlds: int | None = None, time_step: float = STEP) -> Scene:
    """Robots that turn already, the ball and its back-spin with them."""
    scene = with_ball(worlds=worlds or np.size(rates), time_step=time_step)
    scene.robots.spin[:, 0] = rates
    scene.ball.velocity[:, 1] = np.asarray(rates) * reach()
    scene.ball.spin[:, 1] = -BAR_SPEED / BALL.radius
    scene.tell(0, v_theta=rates, dribbler=1.0)
    return scene


def _going(speeds: Array, robot: RobotModel | str = "ssl_generic") -> Scene:
    """Robots that drive along x already, the ball and its back-spin with them."""
    scene = with_ball(robot, worlds=len(speeds), time_step=STEP)
    scene.robots.velocity[:, 0, 0] = scene.ball.velocity[:, 0] = speeds
    scene.ball.spin[:, 1] = -BAR_SPEED / BALL.radius
    scene.tell(0, v_x=speeds, dribbler=1.0)
    return scene


def _braking(brake: float) -> bool:
    """Whether one that brakes like this from 3 m/s, and drives back like this, keeps the ball."""
    scene = _going(np.array([3.0]), RobotModel("ssl_generic", brake=brake, speed_up=brake))
    scene.tell(0, v_x=-1.9)
    seen = scene.play(np.ceil(4.9 / brake / STEP) * STEP + 0.25).robots.infrared[-1, 0, 0]
    return bool(seen)


def fastest_turn() -> float:
    """Turn rate (rad/s) at which the grip just holds the ball on its circle.

    The floor acts against the slip: a part is spent along the circle, but the back-spin, which
    wants to roll the ball to the robot, helps across it.
    """
    turn = 10.0
    floor = BALL.mass * BALL.sliding_deceleration
    for _ in range(20):
        along = turn * reach()
        slip = hypot(along, BAR_SPEED)
        inward = sqrt(max(GRIP**2 - (floor * along / slip) ** 2, 0.0)) + floor * BAR_SPEED / slip
        turn = sqrt(inward / (BALL.mass * reach()))
    return turn


def _speed() -> Checks:
    bodies = np.array([(*way, 0.0) for way in WAYS.values()])
    ways = []
    for away in (False, True):
        scene = with_ball(worlds=len(bodies), time_step=STEP)
        if away:
            scene.ball.position[:] = (0.0, 2.5)
        scene.tell(0, v_x=bodies[:, 0], v_y=bodies[:, 1], dribbler=1.0)
        ways.append(length(*scene.play(1.5).robots.position[-1, :, 0].T))
    for world, way in enumerate(WAYS):
        yield NO_SLOWER(way, 1.0, ways[0][world] / ways[1][world])


def _spinning() -> Checks:
    spin = _told(np.zeros((1, 3)), 1.0, 1.0).ball.spin[-1, 0, 1]
    yield BACK_SPIN("robot at rest", -BAR_SPEED, spin * BALL.radius)


def _releasing() -> Checks:
    """In a fast turn the grip bends the ball's way; after it, only the floor acts."""
    scene = turning(FAST, time_step=TICK)
    match = scene.begin()
    bend = np.diff(match.run(1.0).ball.velocity[-2:, 0], axis=0)[0]
    yield BENDS(f"at {FAST:g} rad/s", FAST**2 * reach() * TICK, length(*bend))
    held = match.frame.ball.velocity.copy()
    scene.tell(0, dribbler=0.0)
    velocity = np.concatenate([held[None], match.run(3 * TICK).ball.velocity])[:, 0]
    for tick, change in enumerate(np.diff(velocity, axis=0), start=1):
        yield RELEASE(f"tick {tick}", BALL.sliding_deceleration * TICK, length(*change))
    yield LEAVES("turning on", 0.0, match.run(1.0).robots.infrared[-1, 0, 0])


def _taking() -> Checks:
    scene = Scene(SimConfig("ssl_b", 1, 1))
    scene.robots.position[:, 1] = (2 * reach(), 0.0)
    scene.face(1, 180.0)
    scene.ball.position[:] = (reach(), 0.0)
    scene.tell(1, v_x=-0.3, dribbler=1.0)
    yield STEAL("nose to nose", 1.0, scene.play(1.5).robots.infrared[-1, 0, 1])
    scene = Scene(SimConfig("ssl_b", 1, 1))
    scene.robots.position[:, 1] = (reach(), 0.16)
    scene.face(1, -90.0)
    scene.ball.position[:] = (reach(), 0.0)
    scene.tell(0, dribbler=1.0)
    scene.tell(1, v_x=1.0, dribbler=1.0)
    yield KNOCK("at 1 m/s", 0.0, scene.play(1.5).robots.infrared[-1, 0, 0])

"""Sliding and rolling of the ball on an empty floor, compared with the closed form."""

from math import sqrt

import numpy as np

from rsoccer._core import BallModel, Field
from rsoccer.arrays import Array
from rsoccer.vectors import norm
from tools.physics import closed_form
from tools.physics.check import Checks, Criterion, absolute, percent
from tools.physics.cited import BALLS, Ball
from tools.physics.closed_form import StraightKick
from tools.physics.rolling import Rolling
from tools.physics.scene import STEP, TICK, Scene, Trajectory, make_config

TOPIC = "ball_rolling"
ENDLESS = Field("ssl_b", length=200.0, width=200.0)
KICKS = (6.5, 4.0, 2.0)  # m/s
DIRECTIONS = (0.0, 30.0, 45.0, 90.0, 200.0)  # degrees
TICKS = (0.001, 0.0025, 0.005)  # s

LAW = "closed form"
GRAZED = "closed form, Coulomb friction"
SLIDE_DISTANCE = Criterion(TOPIC, "end of sliding, distance", "m", percent(3), LAW)
SLIDE_TIME = Criterion(TOPIC, "end of sliding, time", "s", percent(3), LAW)
SPEED_AT_3 = Criterion(TOPIC, "speed after 3 m", "m/s", percent(3), LAW)
SPEED_AT_6 = Criterion(TOPIC, "speed after 6 m", "m/s", percent(3), LAW)
STOP = Criterion(TOPIC, "stopping distance", "m", percent(3), LAW)
DISTANCE_BY_DIRECTION = Criterion(TOPIC, "distance in 2 s, five directions", "m", percent(1), LAW)
SPEED_BY_DIRECTION = Criterion(TOPIC, "speed after 2 s, five directions", "m/s", percent(1), LAW)
DISTANCE_BY_TICK = Criterion(
    TOPIC, "distance in 2 s, ticks of 1, 2.5 and 5 ms", "m", percent(1), LAW
)
SPEED_BY_TICK = Criterion(
    TOPIC, "speed after 2 s, ticks of 1, 2.5 and 5 ms", "m/s", percent(1), LAW
)
GRAZE_DISTANCE = Criterion(
    TOPIC, "displacement in 1 s with one grazing wall bounce, same ticks", "m", percent(1), GRAZED
)
GRAZE_SPEED = Criterion(
    TOPIC, "speed after 1 s with one grazing wall bounce, same ticks", "m/s", percent(1), GRAZED
)
ROLLS = Criterion(
    TOPIC, "kick with rolling spin (no sliding): speed after 0.5 s", "m/s", percent(1)
)
BACK_SPIN = Criterion(
    TOPIC, "kick with back-spin (full sliding deceleration): speed after 0.1 s", "m/s", percent(1)
)
ROLLS_BACK = Criterion(
    TOPIC, "kick with back-spin: velocity at the start of rolling", "m/s", absolute(0.02)
)


def checks() -> Checks:
    """Yield all checks of sliding and rolling."""
    for name, ball in BALLS.items():
        yield from _kicks(name, ball)
        yield from _directions(name, ball)
        yield from _ticks(name, ball)
        yield from _spins(name, ball)
    yield from _grazes()


def simulate_kicks(
    name: str,
    kicks: tuple[float, ...],
    seconds: float,
    tick: float = TICK,
    time_step: float = STEP,
) -> Trajectory:
    """Simulate straight kicks (m/s) along x without spin, one world per kick."""
    config = make_config(ENDLESS, 0, 0, ball=name, tick=tick, time_step=time_step)
    scene = Scene(config, len(kicks))
    scene.ball.velocity[:, 0] = kicks
    return scene.play(seconds)


def _kicks(name: str, ball: Ball) -> Checks:
    forms = [StraightKick(ball, kick) for kick in KICKS]
    slides = simulate_kicks(name, KICKS, 1.0, time_step=TICK)
    trajectory = simulate_kicks(name, KICKS, max(form.stop_time for form in forms) + 1)
    for world, form in enumerate(forms):
        case = f"`{name}`, {form.kick:g} m/s"
        slide_time, slide_distance = _end_of_sliding(slides, world)
        yield SLIDE_TIME(case, form.slide_time, slide_time)
        yield SLIDE_DISTANCE(case, form.slide_distance, slide_distance)
        distance, speed = (
            trajectory.ball.position[:, world, 0],
            trajectory.ball.velocity[:, world, 0],
        )
        yield from _speeds_after_distances(case, form, distance, speed)
        yield STOP(case, form.stop_distance, distance[-1] if speed[-1] == 0.0 else np.nan)


def _end_of_sliding(trajectory: Trajectory, world: int) -> tuple[float, float]:
    """Return time (s) and distance (m) at which sliding ends.

    Straight lines are fitted to the first and the last speeds; sliding ends at their intersection.
    """
    speed = trajectory.ball.velocity[:, world, 0]
    slide = np.polyfit(trajectory.times[:5], speed[:5], 1)
    roll = np.polyfit(trajectory.times[-20:], speed[-20:], 1)
    time = float((roll[1] - slide[1]) / (slide[0] - roll[0]))
    return time, float(np.interp(time, trajectory.times, trajectory.ball.position[:, world, 0]))


def _speeds_after_distances(case: str, form: StraightKick, distance: Array, speed: Array) -> Checks:
    for at, criterion in ((3.0, SPEED_AT_3), (6.0, SPEED_AT_6)):
        expected = form.speed_at(at)
        if expected is not None:
            yield criterion(
                case, expected, np.interp(at, distance, speed) if distance[-1] > at else np.nan
            )


def _directions(name: str, ball: Ball) -> Checks:
    radians = np.radians(DIRECTIONS)
    scene = Scene(make_config(ENDLESS, 0, 0, ball=name), len(DIRECTIONS))
    scene.ball.velocity[:] = 4.0 * np.stack([np.cos(radians), np.sin(radians)], axis=-1)
    distance, speed = StraightKick(ball, 4.0).after(2.0)
    last = scene.play(2.0).ball
    for world, degrees in enumerate(DIRECTIONS):
        case = f"`{name}`, {degrees:g} degrees"
        yield DISTANCE_BY_DIRECTION(case, distance, norm(*last.position[-1, world]))
        yield SPEED_BY_DIRECTION(case, speed, norm(*last.velocity[-1, world]))


def _ticks(name: str, ball: Ball) -> Checks:
    distance, speed = StraightKick(ball, 4.0).after(2.0)
    for tick in TICKS:
        case = f"`{name}`, {1000 * tick:g} ms"
        last = simulate_kicks(name, (4.0,), 2.0, tick).ball
        yield DISTANCE_BY_TICK(case, distance, last.position[-1, 0, 0])
        yield SPEED_BY_TICK(case, speed, last.velocity[-1, 0, 0])


def _spins(name: str, ball: Ball) -> Checks:
    case = f"`{name}`"
    scene = Scene(make_config(ENDLESS, 0, 0, ball=name), 2)
    scene.ball.velocity[:, 0] = 1.0
    scene.ball.spin[:, 1] = np.array([1.0, -4.0]) / BallModel(name).radius
    trajectory = scene.play(2.0)
    rolling, back = trajectory.ball.velocity[..., 0].T

    def at(seconds: float) -> int:
        return round(seconds / STEP) - 1

    law = Rolling(ball.rolling_deceleration, ball.rolling_drag)
    yield ROLLS(case, law.after(1.0, 0.5)[1], rolling[at(0.5)])
    # Of the initial slip of 5 m/s, sliding removes 1 - slide_to_roll_ratio from the ball's speed.
    share = ball.slide_to_roll_ratio
    rolls_at = 5.0 * (1 - share) / ball.sliding_deceleration
    yield BACK_SPIN(case, 1.0 - 0.1 * ball.sliding_deceleration, back[at(0.1)])
    step = at(np.ceil(rolls_at / STEP) * STEP)
    speed = 4.0 * (1 - share) - share  # backwards
    _, slowed = law.after(speed, trajectory.times[step] - rolls_at)
    yield ROLLS_BACK(case, -slowed, back[step])


def _grazes() -> Checks:
    """Kick along a wall of a division B field; the ball grazes the wall after about 0.4 s."""
    start, kick = np.array([-2.0, 2.8, 0.0]), np.array([4.0, 1.2, 0.0])
    end, velocity = _grazed(BALLS["ssl_tigers"], start, kick, 3.3, 1.0)
    for tick in TICKS:
        scene = Scene(make_config("ssl_b", 0, 0, tick=tick))
        scene.ball.position[:], scene.ball.velocity[:] = start[:2], kick[:2]
        ball = scene.play(1.0).ball
        case = f"{1000 * tick:g} ms"
        away = ball.position[-1, 0] - start[:2]
        yield GRAZE_DISTANCE(case, sqrt(((end - start) ** 2).sum()), norm(*away))
        yield GRAZE_SPEED(case, float(np.linalg.norm(velocity)), norm(*ball.velocity[-1, 0]))


def _grazed(ball: Ball, start: Array, kick: Array, wall: float, time: float) -> tuple[Array, Array]:
    """Return position and velocity after `time` s with one bounce off a wall at y = `wall`."""
    still = np.zeros(3)
    early, late = 0.0, time
    for _ in range(60):  # bisection for the time of contact: center one radius from the wall
        middle = (early + late) / 2
        moved, _, _ = closed_form.floor(ball, kick, still, middle)
        early, late = (
            (middle, late) if start[1] + moved[1] < wall - ball.radius else (early, middle)
        )
    moved, velocity, spin = closed_form.floor(ball, kick, still, early)
    surface = closed_form.Surface(ball.wall_restitution, ball.wall_friction)
    velocity, spin = closed_form.bounce(ball, surface, velocity, spin, np.array([0.0, -1.0, 0.0]))
    velocity[2] = 0.0  # the floor keeps it down
    further, velocity, _ = closed_form.floor(ball, velocity, spin, time - early)
    return start + moved + further, velocity

"""A kicked ball on an empty floor: it slides, it rolls, it stops."""

from math import sqrt

import numpy as np

from rsoccer import SimConfig
from rsoccer._core import BallModel, Field
from rsoccer.frame import Array, length
from tools.physics import closed_form
from tools.physics.check import Checks, Line, percent, within
from tools.physics.cited import BALLS, Ball
from tools.physics.closed_form import RollOut
from tools.physics.scene import STEP, TICK, Scene, Track

TOPIC = "floor"
ENDLESS = Field("ssl_b", length=200.0, width=200.0)
KICKS = (6.5, 4.0, 2.0)  # m/s
DIRECTIONS = (0.0, 30.0, 45.0, 90.0, 200.0)  # degrees
TICKS = (0.001, 0.0025, 0.005)  # s

LAW = "closed form"
GRAZED = "the same and Coulomb's law"
SLIDE_WAY = Line(TOPIC, "where the slide ends", "m", percent(3), LAW)
SLIDE_TIME = Line(TOPIC, "when the slide ends", "s", percent(3), LAW)
SPEED_AT_3 = Line(TOPIC, "speed at 3 m", "m/s", percent(3), LAW)
SPEED_AT_6 = Line(TOPIC, "speed at 6 m", "m/s", percent(3), LAW)
STOP = Line(TOPIC, "where it stops", "m", percent(3), LAW)
WAY_ALONG = Line(TOPIC, "way in 2 s, in five directions", "m", percent(1), LAW)
SPEED_ALONG = Line(TOPIC, "speed after 2 s, in five directions", "m/s", percent(1), LAW)
WAY_BY_TICK = Line(TOPIC, "way in 2 s, at ticks of 1, 2.5 and 5 ms", "m", percent(1), LAW)
SPEED_BY_TICK = Line(TOPIC, "speed after 2 s, at those ticks", "m/s", percent(1), LAW)
GRAZE_WAY = Line(
    TOPIC, "way in 1 s with a graze of a wall, at those ticks", "m", percent(1), GRAZED
)
GRAZE_SPEED = Line(TOPIC, "speed after that graze, at those ticks", "m/s", percent(1), GRAZED)
ROLLS = Line(
    TOPIC, "a ball that rolls already does not slide: speed after 0.5 s", "m/s", percent(1)
)
BACK_SPIN = Line(TOPIC, "back-spin brakes by the full slide: speed after 0.1 s", "m/s", percent(1))
ROLLS_BACK = Line(TOPIC, "and brings it back: speed when it has come to roll", "m/s", within(0.02))


def checks() -> Checks:
    """Every line of the acceptance about the floor."""
    for name, ball in BALLS.items():
        yield from _kicks(name, ball)
        yield from _directions(name, ball)
        yield from _ticks(name, ball)
        yield from _spins(name, ball)
    yield from _grazes()


def roll_out(
    name: str,
    kicks: tuple[float, ...],
    seconds: float,
    tick: float = TICK,
    time_step: float = STEP,
) -> Track:
    """Straight kicks along x without spin, a world each."""
    config = SimConfig(ENDLESS, 0, 0, ball=name, tick=tick, time_step=time_step)
    scene = Scene(config, len(kicks))
    scene.ball.velocity[:, 0] = kicks
    return scene.play(seconds)


def _kicks(name: str, ball: Ball) -> Checks:
    forms = [RollOut(ball, kick) for kick in KICKS]
    slides = roll_out(name, KICKS, 1.0, time_step=TICK)
    track = roll_out(name, KICKS, max(form.stop_time for form in forms) + 1)
    for world, form in enumerate(forms):
        case = f"`{name}`, {form.kick:g} m/s"
        slide_time, slide_way = _bend(slides, world)
        yield SLIDE_TIME(case, form.slide_time, slide_time)
        yield SLIDE_WAY(case, form.slide_way, slide_way)
        way, speed = track.ball.position[:, world, 0], track.ball.velocity[:, world, 0]
        yield from _speeds_on_the_way(case, form, way, speed)
        yield STOP(case, form.stop, way[-1] if speed[-1] == 0.0 else np.nan)


def _bend(track: Track, world: int) -> tuple[float, float]:
    """Time and way where the speed's two straight lines meet: first it slides, last it rolls."""
    speed = track.ball.velocity[:, world, 0]
    slide = np.polyfit(track.times[:5], speed[:5], 1)
    roll = np.polyfit(track.times[-20:], speed[-20:], 1)
    time = float((roll[1] - slide[1]) / (slide[0] - roll[0]))
    return time, float(np.interp(time, track.times, track.ball.position[:, world, 0]))


def _speeds_on_the_way(case: str, form: RollOut, way: Array, speed: Array) -> Checks:
    for at, line in ((3.0, SPEED_AT_3), (6.0, SPEED_AT_6)):
        expected = form.speed_at(at)
        if expected is not None:
            yield line(case, expected, np.interp(at, way, speed) if way[-1] > at else np.nan)


def _directions(name: str, ball: Ball) -> Checks:
    radians = np.radians(DIRECTIONS)
    scene = Scene(SimConfig(ENDLESS, 0, 0, ball=name), len(DIRECTIONS))
    scene.ball.velocity[:] = 4.0 * np.stack([np.cos(radians), np.sin(radians)], axis=-1)
    way, speed = RollOut(ball, 4.0).after(2.0)
    last = scene.play(2.0).ball
    for world, degrees in enumerate(DIRECTIONS):
        case = f"`{name}`, {degrees:g} degrees"
        yield WAY_ALONG(case, way, length(*last.position[-1, world]))
        yield SPEED_ALONG(case, speed, length(*last.velocity[-1, world]))


def _ticks(name: str, ball: Ball) -> Checks:
    way, speed = RollOut(ball, 4.0).after(2.0)
    for tick in TICKS:
        case = f"`{name}`, {1000 * tick:g} ms"
        last = roll_out(name, (4.0,), 2.0, tick).ball
        yield WAY_BY_TICK(case, way, last.position[-1, 0, 0])
        yield SPEED_BY_TICK(case, speed, last.velocity[-1, 0, 0])


def _spins(name: str, ball: Ball) -> Checks:
    case = f"`{name}`"
    scene = Scene(SimConfig(ENDLESS, 0, 0, ball=name), 2)
    scene.ball.velocity[:, 0] = 1.0
    scene.ball.spin[:, 1] = np.array([1.0, -4.0]) / BallModel(name).radius
    track = scene.play(2.0)
    rolling, back = track.ball.velocity[..., 0].T

    def at(seconds: float) -> int:
        return round(seconds / STEP) - 1

    yield ROLLS(case, 1.0 - 0.5 * ball.rolling_deceleration, rolling[at(0.5)])
    # Of the slip of 5 m/s, sliding takes all but the rolling share from the ball.
    share = ball.rolling_share
    rolls_at = 5.0 * (1 - share) / ball.sliding_deceleration
    yield BACK_SPIN(case, 1.0 - 0.1 * ball.sliding_deceleration, back[at(0.1)])
    step = at(np.ceil(rolls_at / STEP) * STEP)
    slowed = ball.rolling_deceleration * (track.times[step] - rolls_at)
    yield ROLLS_BACK(case, share - 4.0 * (1 - share) + slowed, back[step])


def _grazes() -> Checks:
    """Along a wall of division B, which it grazes after about 0.4 s."""
    start, kick = np.array([-2.0, 2.8, 0.0]), np.array([4.0, 1.2, 0.0])
    end, velocity = _grazed(BALLS["ssl_tigers"], start, kick, 3.3, 1.0)
    for tick in TICKS:
        scene = Scene(SimConfig("ssl_b", 0, 0, tick=tick))
        scene.ball.position[:], scene.ball.velocity[:] = start[:2], kick[:2]
        ball = scene.play(1.0).ball
        case = f"{1000 * tick:g} ms"
        away = ball.position[-1, 0] - start[:2]
        yield GRAZE_WAY(case, sqrt(((end - start) ** 2).sum()), length(*away))
        yield GRAZE_SPEED(case, float(np.linalg.norm(velocity)), length(*ball.velocity[-1, 0]))


def _grazed(ball: Ball, start: Array, kick: Array, wall: float, time: float) -> tuple[Array, Array]:
    """Place and velocity after a time, with one impact on a wall at y = `wall`."""
    still = np.zeros(3)
    early, late = 0.0, time
    for _ in range(60):  # bisection: when it is a radius from the wall
        middle = (early + late) / 2
        way, _, _ = closed_form.floor(ball, kick, still, middle)
        early, late = (middle, late) if start[1] + way[1] < wall - ball.radius else (early, middle)
    way, velocity, spin = closed_form.floor(ball, kick, still, early)
    surface = closed_form.Surface(ball.wall_restitution, ball.wall_friction)
    velocity, spin = closed_form.bounce(ball, surface, velocity, spin, np.array([0.0, -1.0, 0.0]))
    velocity[2] = 0.0  # the floor keeps it down
    further, velocity, _ = closed_form.floor(ball, velocity, spin, time - early)
    return start + way + further, velocity

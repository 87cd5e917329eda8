"""SSL robots against the limits of their models: times to speed, directions, wheels."""

from math import hypot, sqrt

import numpy as np

from rsoccer import SimConfig
from rsoccer._core import RobotModel
from rsoccer.frame import Array, length
from tools.physics.check import Checks, Line, percent, within
from tools.physics.cited import GENERIC, JERK, SSL_ROBOTS
from tools.physics.scene import TICK, Scene, Track, first

TOPIC = "omni"
DIRECTIONS = np.array([0.0, 30.0, 45.0, 90.0, 135.0, 180.0, 200.0, 270.0])  # degrees
BODIES = ((1.0, 0.0, 0.0), (0.0, 0.8, 0.0), (0.7, -0.5, 2.0))  # m/s, m/s, rad/s

SPECS = "closed form, `robot-specs.yaml`"
SPEED_UP = Line(TOPIC, "0 to 3 m/s at 4.7 m/s², eight directions", "s", within(0.01), SPECS)
BRAKE = Line(TOPIC, "3 m/s to 0 at 5.9 m/s², eight directions", "s", within(0.01), SPECS)
TURN = Line(TOPIC, "0 to 20 rad/s at 50.8 rad/s²", "s", within(0.01), SPECS)
STOP_TURN = Line(TOPIC, "20 rad/s to 0 at 51.6 rad/s²", "s", within(0.01), SPECS)
TOP_SPEED = Line(TOPIC, "top speed of each preset", "m/s", percent(0.1), "`robot-specs.yaml`")
TOP_TURN = Line(TOPIC, "top turn rate of each preset", "rad/s", percent(0.1), "`robot-specs.yaml`")
BY_WHEELS = Line(TOPIC, "speed by four wheel speeds", "m/s", percent(0.1), "wheel kinematics")
WHEELS_TURN = Line(
    TOPIC, "turn rate by four wheel speeds", "rad/s", within(0.001), "wheel kinematics"
)
AGREE = Line(TOPIC, "place after 1 s: wheel less body commands", "m", within(0.001), "same motion")
SATURATED = Line(
    TOPIC, "direction of a command beyond the top speed", "degrees", within(0.1), "command"
)
JERKED_UP = Line(TOPIC, "speed-up with a jerk of at most 20 m/s³", "s", within(0.01), "S-curve")
JERKED_DOWN = Line(TOPIC, "brake with that jerk", "s", within(0.01), "S-curve")
MOST_JERK = Line(TOPIC, "largest jerk on that way", "m/s³", percent(1), "limit")


def checks() -> Checks:
    """Every line of the acceptance about omnidirectional robots."""
    yield from _straight_on()
    yield from _turning()
    yield from _top_speeds()
    yield from _wheels()
    yield from _beyond()
    yield from _jerked()


def alone(
    robot: str | RobotModel = "ssl_generic", worlds: int = 1, time_step: float = TICK
) -> Scene:
    """A robot at rest in the middle of a field, the ball far off."""
    scene = Scene(SimConfig("ssl_a", 1, 0, robot=robot, time_step=time_step), worlds)
    scene.ball.position[:] = (0.0, 4.0)
    return scene


def speeds(track: Track) -> Array:
    """Speed of robot 0, (steps, worlds)."""
    velocity = track.robots.velocity[:, :, 0]
    return length(velocity[..., 0], velocity[..., 1])


def _straight_on() -> Checks:
    radians = np.radians(DIRECTIONS)
    forward, left = 3.0 * np.cos(radians), 3.0 * np.sin(radians)
    going = alone(worlds=len(DIRECTIONS))
    going.tell(0, v_x=forward, v_y=left)
    track = going.play(1.0)
    there = track.times[first(speeds(track) >= 2.999)]
    stopping = alone(worlds=len(DIRECTIONS))
    stopping.robots.velocity[:, 0] = np.stack([forward, left], axis=-1)
    track = stopping.play(1.0)
    still = track.times[first(speeds(track) < 0.001)]
    for world, degrees in enumerate(DIRECTIONS):
        yield SPEED_UP(f"{degrees:g} degrees", 3.0 / GENERIC.speed_up, there[world])
        yield BRAKE(f"{degrees:g} degrees", 3.0 / GENERIC.brake, still[world])


def _turning() -> Checks:
    scene = alone(worlds=2)
    scene.tell(0, v_theta=np.array([20.0, -20.0]))
    track = scene.play(1.0)
    there = track.times[first(abs(track.robots.spin[:, :, 0]) >= 19.99)]
    scene = alone(worlds=2)
    scene.robots.spin[:, 0] = [20.0, -20.0]
    track = scene.play(1.0)
    still = track.times[first(abs(track.robots.spin[:, :, 0]) < 0.01)]
    for world, way in enumerate(("to the left", "to the right")):
        yield TURN(way, 20.0 / GENERIC.turn_speed_up, there[world])
        yield STOP_TURN(way, 20.0 / GENERIC.turn_brake, still[world])


def _top_speeds() -> Checks:
    """Asked for more than there is; one that is told wheel speeds cannot be asked like that."""
    for name, robot in SSL_ROBOTS.items():
        if RobotModel(name).drive != "omni":
            continue
        scene = alone(name, worlds=2)
        scene.tell(0, v_y=np.array([-9.0, 0.0]), v_theta=np.array([0.0, 99.0]))
        last = scene.play(1.2).robots
        yield TOP_SPEED(f"`{name}`", robot.max_speed, -last.velocity[-1, 0, 0, 1])
        yield TOP_TURN(f"`{name}`", robot.max_turn_rate, last.spin[-1, 1, 0])


def wheel_speeds(v_x: float, v_y: float, v_theta: float) -> dict[str, float]:
    """Command of four wheels at 60, 135, 225 and 300 degrees, 90 mm out, 24.75 mm in radius."""
    angles = np.radians([60.0, 135.0, 225.0, 300.0])
    rims = -v_x * np.sin(angles) + v_y * np.cos(angles) + 0.09 * v_theta
    return {f"wheel_{index}": rim / 0.02475 for index, rim in enumerate(rims)}


def _wheels() -> Checks:
    for v_x, v_y, v_theta in BODIES:
        by_wheels, by_body = alone("ssl_generic_wheels"), alone()
        by_wheels.tell(0, **wheel_speeds(v_x, v_y, v_theta))
        by_body.tell(0, v_x=v_x, v_y=v_y, v_theta=v_theta)
        a, b = (scene.play(1.0).robots for scene in (by_wheels, by_body))
        case = f"{v_x:g} m/s, {v_y:g} m/s, {v_theta:g} rad/s"
        yield BY_WHEELS(case, hypot(v_x, v_y), length(*a.velocity[-1, 0, 0]))
        yield WHEELS_TURN(case, v_theta, a.spin[-1, 0, 0])
        yield AGREE(case, 0.0, length(*(a.position[-1, 0, 0] - b.position[-1, 0, 0])))


def _beyond() -> Checks:
    scene = alone(worlds=2)
    scene.tell(0, v_x=np.array([3.7, -5.0]), v_y=np.array([1.0, 9.0]))
    for world, place in enumerate(scene.play(1.0).robots.position[-1, :, 0]):
        told = scene.commands[world, 0]
        expected = np.degrees(np.arctan2(told[1], told[0]))
        case = f"({told[0]:g}, {told[1]:g}) m/s"
        yield SATURATED(case, expected, np.degrees(np.arctan2(place[1], place[0])))


def s_curve(change: float, most: float, jerk: float) -> float:
    """Time (s) to change the speed by so much: acceleration rises, holds at the most, and falls."""
    if change > most**2 / jerk:
        return change / most + most / jerk
    return 2 * sqrt(change / jerk)


def _jerked() -> Checks:
    robot = RobotModel("ssl_generic", jerk=JERK)
    for speed in (0.5, 1.0, 3.0):
        for line, start, told, most in (
            (JERKED_UP, 0.0, speed, GENERIC.speed_up),
            (JERKED_DOWN, speed, 0.0, GENERIC.brake),
        ):
            scene = alone(robot)
            scene.robots.velocity[:, 0, 0] = start
            scene.tell(0, v_x=told)
            track = scene.play(1.5)
            way = track.robots.velocity[:, 0, 0, 0].astype(np.float64)
            there = track.times[first(abs(way - told) < 1e-4)]
            case = f"{start:g} to {told:g} m/s"
            yield line(case, s_curve(speed, most, JERK), there)
            jerks = np.diff(np.diff(way, prepend=start), prepend=0.0) / TICK**2
            yield MOST_JERK(case, JERK, abs(jerks).max())

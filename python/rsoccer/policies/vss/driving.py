"""How a script drives a robot on two wheels: what its policies share."""

from typing import Final, NamedTuple

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.frame import Array, Floats, Mask, RobotColumns, length
from rsoccer.policies.vectors import TINY, inverse
from rsoccer.rng import WorldRng
from rsoccer.task import Task

Place = tuple[Floats, Floats]  # x and y, (n, robots) each; metres, or a direction

DAMPING: Final = np.float32(0.3)  # less turning, per share of the fastest turn, not to overshoot
CLEAR: Final = 0.005  # metres to a wall, beyond what it needs to turn on the spot
TURN: Final = np.float32(1.1)  # turning power, per sine of the angle that it is off
BRAKE: Final = np.float32(0.15)  # metres before a stop from which it slows down, by their root
CREEP: Final = np.float32(0.03)  # metres from which it slows down and turns evenly less, to rest
SLOW: Final = np.float32(0.1)  # share of top speed below which it may be stuck
PUSH: Final = np.float32(0.3)  # power from which a robot that stays slow is stuck
PATIENCE: Final = 16  # slow steps before it backs off
BACKING: Final = 12  # steps that it backs off for
DETOUR: Final = np.float32(0.25)  # metres to where it drives on a way past something


class Orders(NamedTuple):
    """What robots are to do, (n, robots) each."""

    x: Floats  # metres, where to drive
    y: Floats
    run: Floats  # 1 to arrive at full power, 0 to stop there
    spin: Floats  # turning power in place of driving; 0 to drive


class Driver:
    """Drives robots to where they are ordered, forwards or backwards, and backs off when stuck."""

    def __init__(self, robot: RobotModel) -> None:
        """Learn how fast the robot is."""
        self._damping = damping(robot)
        self._top = np.float32(robot.top_speed)

    def drive(
        self, ego: RobotColumns, orders: Orders, pace: np.float32, slow: Array, rng: WorldRng
    ) -> Floats:
        """Powers of the two wheels (n, robots, 2), at most `pace`; counts steps in `slow`."""
        forward, turn = self._steer(ego, orders)
        least = SLOW * pace * self._top
        backs = backing(ego.velocity, least, np.abs(forward) > PUSH, slow)
        forward = np.where(backs, -forward, forward)
        turn = np.where(backs, rng.uniform(-1.0, 1.0, slow.shape[1:]), turn)
        return wheels(forward, turn) * pace

    def _steer(self, ego: RobotColumns, orders: Orders) -> tuple[Floats, Floats]:
        """Forward and turning power, (n, robots) each."""
        x, y = orders.x - ego.position[..., 0], orders.y - ego.position[..., 1]
        cos, sin = ego.heading[..., 0], ego.heading[..., 1]
        distance = length(x, y)
        near = np.minimum(distance / CREEP, np.float32(1.0))
        power = np.minimum(np.sqrt(distance / BRAKE), near)
        power = np.where(orders.run > 0.0, np.float32(1.0), power)
        per = inverse(distance, TINY)
        ahead, left = (x * cos + y * sin) * per, (y * cos - x * sin) * per
        # It turns before it drives: less forward, the more it is off. Backwards is as good.
        forward, turn = power * ahead * np.abs(ahead), left * np.sign(ahead) * near * TURN
        spins = orders.spin != 0.0
        forward = np.where(spins, np.float32(0.0), forward)
        return forward, np.where(spins, orders.spin, turn - ego.spin * self._damping)


def expect_two_wheels(task: Task, policy: str) -> None:
    """Refuse a task whose robots have other drives."""
    if tuple(task.config.command_columns) != ("left", "right") or task.action_size != 2:
        raise ValueError(f"{policy} drives two wheels, which the robots of {task.name} have not")


def room_to_turn(robot: RobotModel) -> float:
    """Metres to a wall at which it can turn on the spot."""
    return robot.bounding_radius + CLEAR


def damping(robot: RobotModel) -> np.float32:
    """Less turning power, per rad/s that it turns."""
    return DAMPING * np.float32(0.5 * robot.track / robot.top_speed)


def backing(velocity: Floats, least: np.float32, tries: Mask, slow: Array) -> Mask:
    """Which robots back off, (n, robots): who `tries` and stays below `least` m/s for long.

    `slow` counts the steps that each has been slow for; below 0 while it backs off.
    """
    speed = np.abs(velocity[..., 0]) + np.abs(velocity[..., 1])
    stuck = (speed < least) & tries
    slow[:] = np.where(slow < 0, slow + 1, np.where(stuck, slow + 1, 0))
    slow[slow > PATIENCE] = -BACKING
    return np.less(slow, 0)


def past(ego: Floats, target: Place, thing: Place, radius: np.float32, when: Mask) -> Place:
    """Where to drive on the way to a target, `radius` metres past a thing, where `when` says so."""
    to_x, to_y = thing[0] - ego[..., 0], thing[1] - ego[..., 1]
    way_x, way_y = target[0] - ego[..., 0], target[1] - ego[..., 1]
    toward = to_x * way_x + to_y * way_y
    share = toward * inverse(way_x * way_x + way_y * way_y, TINY)
    share = np.minimum(np.maximum(share, 0.0), np.float32(1.0))
    blocked = length(to_x - share * way_x, to_y - share * way_y) < radius
    blocked &= (toward > 0.0) & when
    distance = np.maximum(length(to_x, to_y), TINY)
    u_x, u_y = to_x / distance, to_y / distance
    # Along the tangent to the circle round it; from inside straight across the way to it.
    sin = np.minimum(radius / distance, np.float32(1.0))
    ahead = np.sqrt(np.float32(1.0) - sin * sin)
    right = np.copysign(sin, way_x * to_y - way_y * to_x)  # of it, if that is shorter
    x = ego[..., 0] + DETOUR * (u_x * ahead + u_y * right)
    y = ego[..., 1] + DETOUR * (u_y * ahead - u_x * right)
    return np.where(blocked, x, target[0]), np.where(blocked, y, target[1])


def wheels(forward: Floats, turn: Floats) -> Floats:
    """Left and right power; both are scaled alike where one is too much, to keep the curve."""
    most = np.maximum(np.abs(forward) + np.abs(turn), np.float32(1.0))
    return np.stack([(forward - turn) / most, (forward + turn) / most], axis=-1)

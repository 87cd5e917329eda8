"""Textbook mechanics of two tyres that slide: Coulomb's friction, integrated in small steps."""

from dataclasses import dataclass, replace
from math import hypot

from tools.physics.cited import VssRobot

STEP = 2e-5  # s
CREEP = 1e-3  # m/s: below this slip friction falls to nothing in proportion, so that tyres can roll


@dataclass(frozen=True)
class Motion:
    """Of a robot on two wheels in its own frame: forward, to its left (m/s), turning (rad/s)."""

    forward: float = 0.0
    left: float = 0.0
    spin: float = 0.0


def slid(robot: VssRobot, rim: float, motion: Motion, seconds: float) -> Motion:
    """How it moves after a time in which both rims turn at a speed, m/s."""
    for _ in range(round(seconds / STEP)):
        motion = _stepped(robot, rim, motion)
    return motion


def straight_after(robot: VssRobot, rim: float, spin: float, slow: float) -> float:
    """When a robot that turns on the spot, told straight on, turns slower than `slow` rad/s: s."""
    motion, steps = Motion(spin=spin), 0
    while motion.spin > slow:
        motion, steps = _stepped(robot, rim, motion), steps + 1
    return steps * STEP


def _stepped(robot: VssRobot, rim: float, motion: Motion) -> Motion:
    """One step. Friction acts on each tyre against its slip, along and across by its own grip.

    Half the weight is on each tyre, and the body is a plate.
    """
    forward = left = turning = 0.0
    for lever in (-robot.track / 2, robot.track / 2):
        along = motion.forward + motion.spin * lever - rim
        slip = max(hypot(along, motion.left), CREEP)
        push = -robot.forward_grip / 2 * along / slip
        forward += push
        left -= robot.side_grip / 2 * motion.left / slip
        turning += push * lever / (robot.side**2 / 6)
    return replace(
        motion,
        forward=motion.forward + (forward + motion.spin * motion.left) * STEP,
        left=motion.left + (left - motion.spin * motion.forward) * STEP,
        spin=motion.spin + turning * STEP,
    )

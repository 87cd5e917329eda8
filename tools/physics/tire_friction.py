"""Reference solution for two sliding tires: Coulomb friction integrated in small steps."""

from dataclasses import dataclass, replace
from math import hypot

from tools.physics.cited import VssRobot

STEP = 2e-5  # s
CREEP = 1e-3  # m/s: below this slip friction is proportional to the slip, so that tires can roll


@dataclass(frozen=True)
class Motion:
    """Velocity of a differential-drive robot in its own frame."""

    forward: float = 0.0  # m/s
    left: float = 0.0  # m/s
    angular_velocity: float = 0.0  # rad/s


def motion_after(robot: VssRobot, rim: float, motion: Motion, seconds: float) -> Motion:
    """Return the motion after some seconds with both rims at the speed `rim`, m/s."""
    for _ in range(round(seconds / STEP)):
        motion = _step(robot, rim, motion)
    return motion


def straightening_time(robot: VssRobot, rim: float, angular_velocity: float, slow: float) -> float:
    """Return the time (s) until a robot spinning on the spot turns slower than `slow` (rad/s).

    Both rims turn forward at the speed `rim`, m/s.
    """
    motion, steps = Motion(angular_velocity=angular_velocity), 0
    while motion.angular_velocity > slow:
        motion, steps = _step(robot, rim, motion), steps + 1
    return steps * STEP


def _step(robot: VssRobot, rim: float, motion: Motion) -> Motion:
    """Integrate one step: friction opposes the slip of each tire, bounded by a grip ellipse.

    Each tire carries half the weight; the body is a uniform square plate.
    """
    forward = left = turning = 0.0
    for lever in (-robot.track_width / 2, robot.track_width / 2):
        along = motion.forward + motion.angular_velocity * lever - rim
        slip = max(hypot(along, motion.left), CREEP)
        push = -robot.longitudinal_grip / 2 * along / slip
        forward += push
        left -= robot.lateral_grip / 2 * motion.left / slip
        turning += push * lever / (robot.side_length**2 / 6)
    return replace(
        motion,
        forward=motion.forward + (forward + motion.angular_velocity * motion.left) * STEP,
        left=motion.left + (left - motion.angular_velocity * motion.forward) * STEP,
        angular_velocity=motion.angular_velocity + turning * STEP,
    )

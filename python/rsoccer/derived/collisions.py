"""Contacts of robots with each other between two frames, and their closing speeds."""

from typing import Final, NamedTuple

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.arrays import Floats, Mask
from rsoccer.derived.motion import Seconds, column, poses_after
from rsoccer.derived.outlines import CONTACT_GAP, SHARES, Indices, Separation, outlines_of
from rsoccer.frame import Frame
from rsoccer.vectors import norm

ACCELERATION: Final = np.float32(10.0)
"""Acceleration that no wheels give a robot, m/s²: tyres with a friction of 1 give 9.81."""
ANGULAR_ACCELERATION: Final = np.float32(400.0)
"""Angular acceleration that no wheels give a robot, rad/s²: the same tyres turn a VSSS robot, a
square of 8 cm with its wheels 7 cm apart, with 320."""


class Collisions(NamedTuple):
    """Contacts of robots with each other."""

    opponent: Mask
    """(n, robots) whether a robot touched an opponent."""
    speed: Floats
    """(n, robots) closing speed of a robot's hardest contact with another robot, m/s."""


def collisions(
    last: Frame,
    frame: Frame,
    config: SimConfig,
    seconds: Seconds,
    gap: float = CONTACT_GAP,
) -> Collisions:
    """Find the robots that touched each other between two frames, and their closing speeds.

    Robots have met if they touch in the present frame, or did on the way by which they came; or if
    they would have met with their last velocities, and one of them left its path by more than its
    own wheels can move it. Closing speeds are those of the last velocities, so they lack what
    robots accelerated since.

    Args:
        last: poses and velocities of the earlier frame.
        frame: poses and velocities of the present frame.
        config: robots.
        seconds: time between the two.
        gap: gap up to which two robots touch, m.

    Returns:
        The contacts of each robot.
    """
    outlines, time = outlines_of(config), column(seconds)
    first, second = np.triu_indices(config.n_robots, 1)
    now = outlines.separation(poses_after(frame, time * 0.0), first, second)
    met = now.gap <= gap
    speed = _closing(last, now, gap, first, second)
    pushed = _deviates(last, frame, time)
    pushed = pushed[:, first] | pushed[:, second]
    for share in SHARES:
        back = outlines.separation(poses_after(frame, -share * time), first, second)
        ahead = outlines.separation(poses_after(last, share * time), first, second)
        met |= (back.gap <= 0.0) | (pushed & (ahead.gap <= gap))
        speed = np.maximum(speed, _closing(last, ahead, gap, first, second))
    return _by_robot(met, speed * met, config, first, second)


def _deviates(last: Frame, frame: Frame, time: Floats) -> Mask:
    """Whether robots (n, robots) left their paths by more than their own wheels can move them."""
    expected = poses_after(last, time)
    off = frame.robots.position - expected.position
    turned = frame.robots.heading - expected.heading
    half = np.float32(0.5) * time * time
    moved = norm(off[..., 0], off[..., 1]) > half * ACCELERATION
    return moved | (norm(turned[..., 0], turned[..., 1]) > half * ANGULAR_ACCELERATION)


def _closing(
    frame: Frame, apart: Separation, gap: float, first: Indices, second: Indices
) -> Floats:
    """Speeds (n, pairs) at which surfaces that touch approach each other, m/s; 0 for others."""
    velocities = []
    for robots in (first, second):
        arm = apart.point - frame.robots.position[:, robots]
        turn = frame.robots.angular_velocity[:, robots, None]
        across = np.stack([-arm[..., 1], arm[..., 0]], axis=-1)
        velocities.append(frame.robots.velocity[:, robots] + turn * across)
    closing = ((velocities[0] - velocities[1]) * apart.normal).sum(axis=-1)
    return np.where(apart.gap <= gap, np.maximum(closing, 0.0), np.float32(0.0))


def _by_robot(
    met: Mask, speed: Floats, config: SimConfig, first: Indices, second: Indices
) -> Collisions:
    """Contacts (n, robots), from those of pairs (n, pairs)."""
    shape = (len(met), config.n_robots)
    found = Collisions(np.zeros(shape, np.bool_), np.zeros(shape, np.float32))
    opponents = met & ((first < config.n_blue) != (second < config.n_blue))
    for pair, ends in enumerate(zip(first.tolist(), second.tolist(), strict=True)):
        for robot in ends:
            found.opponent[:, robot] |= opponents[:, pair]
            np.maximum(found.speed[:, robot], speed[:, pair], out=found.speed[:, robot])
    return found

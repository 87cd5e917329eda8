"""Contacts of robots with each other between two frames, and their closing speeds."""

from typing import Final, NamedTuple

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.arrays import Floats, Mask
from rsoccer.derived.motion import Seconds, column, poses_after
from rsoccer.derived.outlines import CONTACT_GAP, SHARES, Indices, Outlines, Separation, outlines_of
from rsoccer.frame import Frame
from rsoccer.vectors import norm

ACCELERATION: Final = np.float32(10.0)
"""Acceleration that no wheels give a robot, m/s²: tires with a friction of 1 give 9.81."""
ANGULAR_ACCELERATION: Final = np.float32(400.0)
"""Angular acceleration that no wheels give a robot, rad/s²: the same tires turn a VSSS robot, a
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
    mean_motion: Frame | None = None,
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
        mean_motion: the earlier frame with mean velocities of some time before it, from
            `TrackRecord`, where those of `last` are noisy: robots close at the lower speed by both.

    Returns:
        The contacts of each robot.
    """
    outlines, time = outlines_of(config), column(seconds)
    first, second = _near_pairs(last, frame, outlines, time, gap)
    came = outlines.separation(poses_after(frame, -SHARES * time), first, second)
    ahead = outlines.separation(poses_after(last, SHARES * time), first, second)
    now = Separation(*(each[0] for each in came))
    pushed = _deviates(last, frame, time)
    met = (now.gap <= gap) | (came.gap <= 0.0).any(axis=0)
    met |= (pushed[:, first] | pushed[:, second]) & (ahead.gap <= gap).any(axis=0)
    speed = _hardest(last, now, ahead, gap, first, second)
    if mean_motion is not None:
        speed = np.minimum(speed, _hardest(mean_motion, now, ahead, gap, first, second))
    return _by_robot(met, speed * met, config, first, second)


def _near_pairs(
    last: Frame, frame: Frame, outlines: Outlines, time: Floats, gap: float
) -> tuple[Indices, Indices]:
    """Pairs of robots that can have met in any world, by the circles around them."""
    first, second = np.triu_indices(len(outlines.size), 1)
    near = np.zeros(len(first), np.bool_)
    for known in (last, frame):
        position, velocity = known.robots.position, known.robots.velocity
        reach = outlines.bounding + norm(velocity[..., 0], velocity[..., 1]) * time
        offset = position[:, first] - position[:, second]
        apart = norm(offset[..., 0], offset[..., 1]) - reach[:, first] - reach[:, second]
        near |= (apart <= gap).any(axis=0)
    return first[near], second[near]


def _deviates(last: Frame, frame: Frame, time: Floats) -> Mask:
    """Whether robots (n, robots) left their paths by more than their own wheels can move them."""
    expected = poses_after(last, time)
    off = frame.robots.position - expected.position
    turned = frame.robots.heading - expected.heading
    half = np.float32(0.5) * time * time
    moved = norm(off[..., 0], off[..., 1]) > half * ACCELERATION
    return moved | (norm(turned[..., 0], turned[..., 1]) > half * ANGULAR_ACCELERATION)


def _hardest(
    frame: Frame, now: Separation, ahead: Separation, gap: float, first: Indices, second: Indices
) -> Floats:
    """Highest closing speeds (n, pairs) of surfaces that touch now or on the way there, m/s."""
    on_way: Floats = _closing(frame, ahead, gap, first, second).max(axis=0)
    hardest: Floats = np.maximum(_closing(frame, now, gap, first, second), on_way)
    return hardest


def _closing(
    frame: Frame, apart: Separation, gap: float, first: Indices, second: Indices
) -> Floats:
    """Speeds (..., n, pairs) at which surfaces that touch approach, m/s; 0 for others."""
    velocities = []
    for robots in (first, second):
        arm = apart.point - frame.robots.position[:, robots]
        angular_velocity = frame.robots.angular_velocity[:, robots, None]
        across = np.stack([-arm[..., 1], arm[..., 0]], axis=-1)
        velocities.append(frame.robots.velocity[:, robots] + angular_velocity * across)
    closing = ((velocities[0] - velocities[1]) * apart.normal).sum(axis=-1)
    return np.where(apart.gap <= gap, np.maximum(closing, 0.0), np.float32(0.0))


def _by_robot(
    met: Mask, speed: Floats, config: SimConfig, first: Indices, second: Indices
) -> Collisions:
    """Contacts (n, robots), from those of pairs (n, pairs)."""
    shape = (len(met), config.n_robots, config.n_robots)
    opponents, speeds = np.zeros(shape, np.bool_), np.zeros(shape, np.float32)
    for ends in ((first, second), (second, first)):
        opponents[:, *ends] = met & ((first < config.n_blue) != (second < config.n_blue))
        speeds[:, *ends] = speed
    return Collisions(opponents.max(axis=2, initial=False), speeds.max(axis=2, initial=0.0))

"""Break beams, touches of the ball between two frames, and possession."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import SimConfig
from rsoccer.arrays import Floats, Mask
from rsoccer.derived.motion import Seconds, ball_gaps_after, column
from rsoccer.derived.outlines import CONTACT_GAP, SHARES, outlines_of
from rsoccer.frame import Frame
from rsoccer.game import NOBODY
from rsoccer.vectors import norm, rotate_into_body

DEVIATION: Final = np.float32(0.004)
"""Distance from its straight path from which a ball has been touched on its way, m."""


def beam_broken(frame: Frame, config: SimConfig) -> Mask:
    """Return whether the ball cuts the break beam of each robot.

    Args:
        frame: poses of n worlds.
        config: robots and ball; robots without a mouth have no beam.

    Returns:
        (n, robots).
    """
    outlines, robots, ball = outlines_of(config), frame.robots, frame.ball
    offset = ball.position[:, None] - robots.position
    x, y = rotate_into_body(offset[..., 0], offset[..., 1], robots.heading)
    radius = outlines.ball_radius
    above = outlines.beam_height - (ball.height[:, None] + radius)
    section = radius * radius - above * above  # its half length squared, where the beam is
    before = x - (outlines.front + outlines.beam_distance)
    broken: Mask = (np.abs(y) <= outlines.half_mouth) & (before * before < section)
    return broken


def ball_touches(
    last: Frame,
    frame: Frame,
    config: SimConfig,
    seconds: Seconds,
    gap: float = CONTACT_GAP,
) -> Mask:
    """Return which robots touched the ball between two frames.

    A robot has touched the ball if it does in the present frame, or has it in its beam; or if the
    ball left its straight path, and would have met the robot on it.

    Args:
        last: poses and velocities of the earlier frame.
        frame: poses and velocities of the present frame.
        config: robots and ball.
        seconds: time between the two.
        gap: gap up to which ball and robot touch, m.

    Returns:
        (n, robots).
    """
    outlines, time = outlines_of(config), column(seconds)
    came = ball_gaps_after(frame, outlines, -SHARES * time) <= gap
    ahead = ball_gaps_after(last, outlines, SHARES * time) <= gap
    off = frame.ball.position - (last.ball.position + last.ball.velocity * time)
    deviates = (norm(off[:, 0], off[:, 1]) > DEVIATION)[:, None]
    on_the_way = deviates & (came.any(axis=0) | ahead.any(axis=0))
    touched: Mask = came[0] | on_the_way | beam_broken(frame, config)
    return touched


def last_touch(previous: Floats, touched: Mask, frame: Frame, config: SimConfig) -> Floats:
    """Return the robots that touched the ball last.

    Args:
        previous: (n,) indices of the robots that touched the ball last before, or `NOBODY`.
        touched: (n, robots) robots that touched it since, see `ball_touches`.
        frame: present poses of n worlds: of several robots the nearest was the last.
        config: robots and ball.

    Returns:
        (n,) indices of robots in the order of a state row, or `NOBODY`.
    """
    if not touched.shape[1]:
        return previous
    gaps = np.where(touched, ball_gaps_after(frame, outlines_of(config), column(0.0)), np.inf)
    return np.where(touched.any(axis=1), np.argmin(gaps, axis=1), previous).astype(np.float32)


class SinceTouch(NamedTuple):
    """The ball since a robot touched it last; 0 where none has."""

    seconds: Floats
    """(n,) time since then, s."""
    speed: Floats
    """(n,) speed right after the touch, m/s."""
    height: Floats
    """(n,) maximum height since then, m."""


def since_touch(last: Frame, frame: Frame, touched: Mask, seconds: Seconds) -> SinceTouch:
    """Return how long ago the last touch was, how fast the ball was then, and how high since.

    Moments between the frames are not known: a touch is taken to be that of the present frame.

    Args:
        last: the earlier frame, with these columns.
        frame: poses and velocities of the present frame, and `last_touch`.
        touched: (n, robots) robots that touched the ball since, see `ball_touches`.
        seconds: time between the two.
    """
    before, ball = last.ball, frame.ball
    anew, nobody = touched.any(axis=1), ball.last_touch == NOBODY
    speed = norm(norm(ball.velocity[:, 0], ball.velocity[:, 1]), ball.vertical_velocity)
    found = (
        np.where(anew, 0.0, before.seconds_since_touch + seconds),
        np.where(anew, speed, before.speed_after_touch),
        np.where(anew, ball.height, np.maximum(before.height_since_touch, ball.height)),
    )
    return SinceTouch(*(np.where(nobody, 0.0, part).astype(np.float32) for part in found))


def ball_holder(frame: Frame, config: SimConfig, gap: float = CONTACT_GAP) -> NDArray[np.intp]:
    """Return the robots that have the ball: in their beam, or at their body.

    Args:
        frame: poses of n worlds.
        config: robots and ball.
        gap: gap up to which ball and robot touch, m.

    Returns:
        (n,) indices of robots in the order of a state row, the nearest of several; or `NOBODY`.
    """
    gaps = ball_gaps_after(frame, outlines_of(config), column(0.0))
    has_ball = beam_broken(frame, config) | (gaps <= gap)
    if not has_ball.shape[1]:
        return np.full(len(frame), NOBODY, np.intp)
    nearest = np.argmin(np.where(has_ball, gaps, np.inf), axis=1)
    return np.where(has_ball.any(axis=1), nearest, NOBODY)

"""Break beams, touches of the ball between two frames, and possession."""

from typing import Final

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
    broken = np.zeros(frame.robots.position.shape[:2], np.bool_)
    radius = config.ball.radius
    for robot, model in enumerate(config.robots):
        if not model.has_mouth:
            continue
        offset = frame.ball.position - frame.robots.position[:, robot]
        x, y = rotate_into_body(offset[:, 0], offset[:, 1], frame.robots.heading[:, robot])
        front = outlines_of(config).front[robot]
        above = np.float32(model.beam_height) - (frame.ball.height + np.float32(radius))
        section = np.float32(radius * radius) - above * above
        beam = x - (front + np.float32(model.beam_distance))
        inside = np.abs(y) <= np.float32(model.mouth_width / 2)
        broken[:, robot] = inside & (section > 0.0) & (beam * beam < section)
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
    met = ball_gaps_after(frame, outlines, time * 0.0) <= gap
    off = frame.ball.position - (last.ball.position + last.ball.velocity * time)
    deviates = (norm(off[:, 0], off[:, 1]) > DEVIATION)[:, None]
    for share in SHARES:
        near = ball_gaps_after(last, outlines, share * time) <= gap
        near |= ball_gaps_after(frame, outlines, -share * time) <= gap
        met |= near & deviates
    return met | beam_broken(frame, config)


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

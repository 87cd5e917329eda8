"""Motion between two frames: velocities and spins from poses, and poses moved on."""

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.derived.outlines import Outlines, Poses
from rsoccer.frame import Frame
from rsoccer.vectors import rotate_into_body

Seconds = float | Floats
"""Time between two frames, s: one for all worlds, or (n,)."""


def differentiate(last: Frame, frame: Frame, seconds: Seconds) -> None:
    """Write all velocities of a frame as differences of positions and headings.

    These are the mean velocities since the last frame. The ball is assumed to roll: its spin
    follows from its velocity, and that about the vertical is 0.

    Args:
        last: poses of the earlier frame.
        frame: poses of the present frame; its velocities and spins are written.
        seconds: time between the two, above 0.
    """
    rate = np.float32(1.0) / np.asarray(seconds, np.float32).reshape(-1, 1)
    ball, robots = frame.ball, frame.robots
    ball.velocity[:] = (ball.position - last.ball.position) * rate
    ball.vertical_velocity[:] = (ball.height - last.ball.height) * rate[:, 0]
    robots.velocity[:] = (robots.position - last.robots.position) * rate[..., None]
    turned = rotate_into_body(robots.heading[..., 0], robots.heading[..., 1], last.robots.heading)
    robots.angular_velocity[:] = np.arctan2(turned[1], turned[0]) * rate


def roll(frame: Frame, radius: float) -> None:
    """Write the spins of balls that roll with their velocities.

    Args:
        frame: state of n worlds; its spins are written.
        radius: radius of the ball, m.
    """
    velocity, spin = frame.ball.velocity, frame.ball.spin
    spin[:, 0], spin[:, 1] = -velocity[:, 1] / radius, velocity[:, 0] / radius
    spin[:, 2] = 0.0


def column(seconds: Seconds) -> Floats:
    """Return times as (n, 1) or (1, 1), s.

    Args:
        seconds: one time for all worlds, or (n,).
    """
    return np.asarray(seconds, np.float32).reshape(-1, 1)


def poses_after(frame: Frame, time: Floats) -> Poses:
    """Return the poses of robots that move on with their velocities.

    Args:
        frame: state of n worlds.
        time: (..., n, 1) or (..., 1, 1) times, s; negative for the past.

    Returns:
        Poses (..., n, robots, 2).
    """
    robots = frame.robots
    angle = robots.angular_velocity * time
    cos, sin = np.cos(angle), np.sin(angle)
    x, y = robots.heading[..., 0], robots.heading[..., 1]
    heading = np.stack([x * cos - y * sin, x * sin + y * cos], axis=-1)
    return Poses(robots.position + robots.velocity * time[..., None], heading)


def ball_gaps_after(frame: Frame, outlines: Outlines, time: Floats) -> Floats:
    """Return the gaps of ball and robots that move on with their velocities.

    Args:
        frame: state of n worlds.
        outlines: outlines of the robots.
        time: (..., n, 1) or (..., 1, 1) times, s; negative for the past.

    Returns:
        (..., n, robots) m; infinite for a ball above a robot.
    """
    ball = frame.ball
    gaps = outlines.ball_gaps(poses_after(frame, time), ball.position + ball.velocity * time)
    above = ball.height + ball.vertical_velocity * time[..., 0]
    return np.where(above[..., None] > outlines.height, np.float32(np.inf), gaps)

"""Events of a recorded match: goals, outs, free balls, kicks, touches and ends of episodes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from rsoccer._core import CROSSINGS
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT, Frame

if TYPE_CHECKING:
    from rsoccer._core import SimConfig

KINDS: Final = ("goal", "out", "free_ball", "kick", "touch", "end")
"""Kinds of events."""
KICK_GAIN: Final = 0.4
"""Least gain of the ball's speed in a step that counts as a kick, m/s."""


class Event(NamedTuple):
    """One event of a match."""

    frame: int
    """Index of the frame at whose end it had happened."""
    kind: str
    """One of `KINDS`."""
    robot: str
    """Robot that touched the ball last, or that kicks or touches it; empty if none."""
    detail: str
    """Team that scored, line that was crossed (one of `CROSSINGS`), or kind of end: "terminated"
    or "truncated"; else empty."""


def step_events(
    config: SimConfig, robots: tuple[str, ...], index: int, rows: Floats, commands: Floats
) -> list[Event]:
    """Return the events of one control step, without the end of an episode.

    Args:
        config: the configuration.
        robots: names of the robots, in the order of a row.
        index: index of the frame after the step.
        rows: (2, row) states before and after the step.
        commands: (robots, command) commands in the step.

    Returns:
        Kicks and touches, then a crossing.
    """
    frame = Frame(np.ascontiguousarray(rows, np.float32), config.n_blue, config.n_yellow)
    kicked = _kicking(config, frame, commands)
    before, after = frame.robots.touched_ball > 0
    events = [
        Event(index, "kick" if kicked[robot] else "touch", robots[robot], "")
        for robot in np.flatnonzero(kicked | (after & ~before))
    ]
    crossed = int(frame.ball.crossed[1])
    if crossed:
        last = int(frame.ball.last_touch[1])
        robot_name = robots[last] if 0 <= last < len(robots) else ""
        if crossed in (GOAL_RIGHT, GOAL_LEFT):
            team = "blue" if crossed == GOAL_RIGHT else "yellow"
            events.append(Event(index, "goal", robot_name, team))
        else:
            events.append(Event(index, "out", robot_name, CROSSINGS[crossed]))
    return events


def _kicking(config: SimConfig, frame: Frame, commands: Floats) -> Mask:
    """Robots (robots,) that kicked: one touched the ball on such a command, and it gained speed."""
    columns = config.command_columns
    none = np.zeros(config.n_robots, np.bool_)
    if "kick_v_x" not in columns or not config.n_robots:
        return none
    first = columns.index("kick_v_x")
    wanted = (commands[:, first : first + 2] > 0).any(axis=1) & (frame.robots.touched_ball[1] > 0)
    speeds = np.hypot(np.hypot(*frame.ball.velocity.T), frame.ball.vertical_velocity)
    return wanted if speeds[1] - speeds[0] > KICK_GAIN else none

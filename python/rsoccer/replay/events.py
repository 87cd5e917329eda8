"""Events of a recorded match: those of the game, kicks, touches and ends of episodes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

from rsoccer import game
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.game import EventKind
from rsoccer.render.words import EVENT_NAMES, announced, event_name, side_of

if TYPE_CHECKING:
    from rsoccer._core import SimConfig

KINDS: Final = EVENT_NAMES
"""Kinds of events: "goal", "out", "free_ball", "pass", "kick", "touch" and "end"; with a referee
also cards, and the other kinds of `EventKind` in lower case."""
KICK_GAIN: Final = 0.4
"""Least gain of the ball's speed in a step that counts as a kick, m/s."""


class Event(NamedTuple):
    """One event of a match."""

    frame: int
    """Index of the frame at whose end it had happened."""
    kind: str
    """One of `KINDS`."""
    robot: str
    """Robot that touched the ball last, that kicks or touches it or receives a pass; empty if
    none."""
    detail: str
    """Team that scored, passed or is at fault, line that was crossed (one of `CROSSINGS`), or kind
    of end: "terminated" or "truncated"; else empty."""


def game_events(robots: Sequence[str], index: int, events: Sequence[game.Event]) -> list[Event]:
    """Return the events of the game in one control step as they are recorded.

    Args:
        robots: names of the robots, in the order of a row.
        index: index of the frame after the step.
        events: events of the step, as `Events.of_world` returns them.
    """
    return [
        Event(index, event_name(event.kind), _name(robots, event.robot), _detail(event))
        for event in announced(events)
    ]


def ball_events(
    config: SimConfig, robots: Sequence[str], index: int, rows: Floats, commands: Floats
) -> list[Event]:
    """Return the kicks and touches of one control step.

    Args:
        config: the configuration.
        robots: names of the robots, in the order of a row.
        index: index of the frame after the step.
        rows: (2, row) states before and after the step.
        commands: (robots, command) commands in the step.
    """
    frame = Frame(np.ascontiguousarray(rows, np.float32), config.n_blue, config.n_yellow)
    kicked = _kicking(config, frame, commands)
    before, after = frame.robots.touched_ball > 0
    return [
        Event(index, "kick" if kicked[robot] else "touch", robots[robot], "")
        for robot in np.flatnonzero(kicked | (after & ~before)).tolist()
    ]


def _name(robots: Sequence[str], robot: int) -> str:
    """Name of a robot; empty for nobody."""
    return "" if robot == game.NOBODY else robots[robot]


def _detail(event: game.Event) -> str:
    """Team or line of an event."""
    x, y = event.position
    if event.kind is EventKind.BALL_LEFT_FIELD_GOAL_LINE:
        return "goal_line_right" if x > 0 else "goal_line_left"
    if event.kind is EventKind.BALL_LEFT_FIELD_TOUCH_LINE:
        return "touch_line_left" if y > 0 else "touch_line_right"
    return side_of(event.team)


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

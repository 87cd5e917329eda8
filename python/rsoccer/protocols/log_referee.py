"""The referee in the course of a log: rows and events of a replay."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from rsoccer._core import Field
from rsoccer.arrays import Doubles
from rsoccer.frame import robot_names
from rsoccer.game import BLUE, NOBODY, YELLOW, Event, EventKind
from rsoccer.protocols.ball_in_play import BallInPlay
from rsoccer.protocols.layout import TEAM_NAMES, TEAMS, WireLayout
from rsoccer.protocols.referee import RefereeStatus, read_packet, read_stamp
from rsoccer.protocols.schemas import referee_pb2
from rsoccer.render.referee_state import COLUMNS
from rsoccer.replay import events
from rsoccer.rules.referee_config import RefereeConfig

BALL_DISTANCE: Final = 0.5
"""Distance that robots keep from the ball in a stop and before a kick of the opponents, m (SSL
rules 4300196, "Stop")."""


class LogReferee:
    """The newest state of the referee, and what has happened since the last frame.

    Attributes:
        layout: the match, with the side of the last packet.
    """

    def __init__(self, layout: WireLayout) -> None:
        """Begin before the first packet.

        Args:
            layout: the match.
        """
        self.layout = layout
        self._status: RefereeStatus | None = None
        self._state = BallInPlay(_rules(layout))
        self._reported: set[str] = set()
        self._new: list[Event] = []
        self._counter: int | None = None

    def add(self, message: referee_pb2.Packet) -> None:
        """Bring the state up to date.

        Args:
            message: packet of the game controller.
        """
        if message.HasField("blue_team_on_positive_half"):
            side = message.blue_team_on_positive_half
            self.layout = replace(self.layout, blue_on_positive_half=side)
        status, _ = read_packet(self.layout, message)
        before, self._status = self._status, status
        last, self._counter = self._counter, read_stamp(message).command_counter
        self._state.give(status.command, again=last is not None and last != self._counter)
        old = status if before is None else before
        for team in TEAMS:
            if status.teams[team].score > old.teams[team].score:
                self._new.append(Event(EventKind.GOAL, team, NOBODY, (0.0, 0.0)))
        for reported in status.events:
            if (
                reported.identity not in self._reported
                and reported.event.kind is not EventKind.GOAL
            ):
                self._new.append(reported.event)  # goals follow from the score
            self._reported.add(reported.identity)

    def frame(
        self, index: int, ball: tuple[float, float]
    ) -> tuple[Doubles | None, list[events.Event]]:
        """Return the row of a frame, and the events since the frame before it.

        Args:
            index: index of the frame.
            ball: place of the ball, x and y, m.

        Returns:
            (columns + robots,), or None before the first packet; and the events.
        """
        config = self.layout.config
        names = robot_names(config.n_blue, config.n_yellow)
        new = events.game_events(names, index, self._new)
        self._new = []
        self._state.judge(ball, config.time_step)
        row = None if self._status is None else self._row(self._status)
        self._state.steps += 1
        return row, new

    def _row(self, status: RefereeStatus) -> Doubles:
        state, following = self._state, status.next_command
        x, y = status.designated_position or (0.0, 0.0)
        values: dict[str, float] = {
            "command": status.command,
            "next_command": NOBODY if following is None else following,
            "kick": NOBODY if state.kick is None else state.kick,
            "command_steps": state.steps,
            "stage": status.stage,
            "in_play": float(state.in_play),
            "designated_position_x": x,
            "designated_position_y": y,
            "seconds_left": max(0.0, status.seconds_left or 0.0),
            "ball_distance": BALL_DISTANCE,
        }
        for team, side in enumerate(TEAM_NAMES):
            values[f"score_{side}"] = status.teams[team].score
            values[f"yellow_cards_{side}"] = status.teams[team].yellow_cards
            values[f"red_cards_{side}"] = status.teams[team].red_cards
        touch = np.zeros(self.layout.config.n_robots)
        for team in (BLUE, YELLOW):
            touch[list(self.layout.slots(team))] = state.may_touch(team)
        return np.concatenate([[values.get(name, 0.0) for name in COLUMNS], touch])


def _rules(layout: WireLayout) -> RefereeConfig:
    """Rules of the division whose field is the nearest."""
    length = layout.config.field.length
    names = {"ssl_a": "ssl_2026_a", "ssl_b": "ssl_2026_b"}
    return RefereeConfig(names[min(names, key=lambda name: abs(Field(name).length - length))])


def no_referee(layout: WireLayout) -> Doubles:
    """Return the row before the first packet: a match that is halted.

    Args:
        layout: the match.
    """
    row = np.zeros(len(COLUMNS) + layout.config.n_robots)
    row[[COLUMNS.index(name) for name in ("next_command", "kick")]] = NOBODY
    return row

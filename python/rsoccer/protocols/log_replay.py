"""From a log of the SSL to a replay."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Final

import numpy as np

from rsoccer import checks
from rsoccer._core import Field, SimConfig, build_info
from rsoccer.arrays import Doubles, Floats
from rsoccer.frame import Frame, robot_names
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.geometry import to_field
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.log_referee import LogReferee, no_referee
from rsoccer.protocols.log_states import LogStates, add_velocities
from rsoccer.protocols.log_survey import Survey, messages, survey_log
from rsoccer.protocols.schemas import referee_pb2
from rsoccer.replay.events import Event
from rsoccer.replay.recorded import Episode
from rsoccer.replay.replay import Replay

TASK: Final = "SSLMatch-v0"
"""Name of the task of replays from logs."""
MAX_SECONDS: Final = 6 * 3600.0
"""Longest log that is converted, s: a time stamp far off must not fill the memory."""
_LOGGER: Final = logging.getLogger(__name__)
_TOLERANCE: Final = 1e-6
"""Tolerance of times, s: logs have them in ns, sums of steps have rounding errors."""


def log_to_replay(
    path: Path | str,
    *,
    time_step: float = 0.025,
    field: Field | str | None = None,
    blue_on_positive_half: bool = False,
) -> Replay:
    """Return the replay of a log.

    States are those of the tracker that sent most, or else what cameras saw last, at the times of
    the replay's frames. Robots are in the order of their uniform numbers.

    Args:
        path: the log.
        time_step: time between frames, s; a multiple of the physics tick, 0.005 s.
        field: the field, or the name of its preset; None for that of the log's geometry, or
            "ssl_a" where it has none.
        blue_on_positive_half: whether blue's goal is at +x in a log without packets of a referee.
            Where it has some, these tell the side.

    Returns:
        The replay: blue attacks +x all the time, whatever side it played on. Commands, touches and
        spins are not in logs, so they are zeros. Packets that cannot be read are left out, and a
        log that is cut off ends where it is, with a warning.

    Raises:
        FileNotFoundError: no such file.
        TypeError: `blue_on_positive_half` is no bool.
        MessageError: the file is no log, is damaged, lasts longer than `MAX_SECONDS`, or has
            neither tracked frames nor detections.
        ValueError: `time_step` or the field are not those of a configuration.
    """
    checks.positive_number("time_step", time_step)
    checks.boolean("blue_on_positive_half", blue_on_positive_half)
    survey = survey_log(path)
    if survey.side is None:
        survey.side = blue_on_positive_half
    if survey.is_cut_off:
        _LOGGER.warning("log: %s is cut off; the replay ends where it does", path)
    first = survey.first or 0.0
    if survey.last - first > MAX_SECONDS:
        duration = survey.last - first
        raise MessageError(
            Code.BAD_LOG, f"log: expected at most {MAX_SECONDS:g} s of play, got {duration:g} s"
        )
    layout = _layout(survey, time_step, field)
    officials = LogReferee(layout)
    states = LogStates(layout, survey.tracker)
    frames = _Frames(officials, states, first, time_step)
    for seconds, message in messages(path):
        # A referee's packet may have any time; states have those that the check has seen.
        frames.advance(min(seconds, survey.last) - _TOLERANCE)
        if isinstance(message, referee_pb2.Packet):
            officials.add(message)
        else:
            states.add(officials.layout, message, seconds)
    frames.advance(survey.last + _TOLERANCE)
    return _replay(layout, survey, frames)


def _layout(survey: Survey, time_step: float, field: Field | str | None) -> WireLayout:
    """The match of a log."""
    if field is None:
        field = "ssl_a" if survey.geometry is None else to_field(survey.geometry)
    most = SimConfig(field, 0, 0).field.max_robots
    blue, yellow = survey.ids(0, most), survey.ids(1, most)
    config = SimConfig(field, len(blue), len(yellow), time_step=time_step)
    return WireLayout(config, blue, yellow, bool(survey.side))


class _Frames:
    """Frames of the replay, which are added as the time of the log goes on."""

    def __init__(
        self, officials: LogReferee, states: LogStates, first: float, time_step: float
    ) -> None:
        self.rows: list[Floats] = []
        self.referee: list[Doubles | None] = []
        self.events: list[Event] = []
        self._officials, self._states = officials, states
        self._first, self._time_step = first, time_step

    def advance(self, seconds: float) -> None:
        """Add the frames before a time."""
        while (due := self._first + len(self.rows) * self._time_step) < seconds:
            state = self._states.row(due)
            x, y = state[:2].tolist()
            row, events = self._officials.frame(len(self.rows), (x, y))
            self.rows.append(state)
            self.referee.append(row)
            self.events += events


def _replay(layout: WireLayout, survey: Survey, frames: _Frames) -> Replay:
    config, info = layout.config, build_info()
    rows = np.stack(frames.rows)
    if survey.tracker is None:
        add_velocities(Frame(rows, config.n_blue, config.n_yellow), config.time_step)
    referee = None
    if any(row is not None for row in frames.referee):
        none = no_referee(layout)
        referee = np.stack([none if row is None else row for row in frames.referee])
    blue, yellow = survey.names
    return Replay(
        task=TASK,
        options=None,
        controllers=dict.fromkeys(robot_names(config.n_blue, config.n_yellow)),
        names=(blue or "BLUE", yellow or "YELLOW"),
        sensing=None,
        randomization={},
        forecasting=(),
        history=1,
        config=config,
        rows=rows,
        commands=np.zeros((len(rows), config.n_robots, len(config.command_columns)), np.float32),
        observers=(),
        terms={},
        markers=((),) * len(rows),
        referee=referee,
        sensed=None,
        episodes=(Episode(0, len(rows), ""),),
        events=tuple(frames.events),
        snapshots={},
        package=str(info["version"]),
        physics=int(info["physics"]),
    )

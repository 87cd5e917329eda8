"""Content of a replay: the frames of one world, and what follows from them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import Sensing, SimConfig
from rsoccer.arrays import Array, Doubles, Floats, Mask
from rsoccer.frame import Frame, robot_names
from rsoccer.markers import Marker
from rsoccer.randomization import Ranges
from rsoccer.render.announcer import Announcer
from rsoccer.render.referee_state import RefereeState
from rsoccer.render.words import Words
from rsoccer.replay.events import Event
from rsoccer.replay.sensed_poses import SensedPoses
from rsoccer.view import SIDES


@dataclass(frozen=True)
class Episode:
    """One episode of a replay: frames `start` to `stop - 1`, the first being the initial state."""

    start: int
    """index of the first frame"""
    stop: int
    """index after the last frame"""
    end: str
    """"terminated", "truncated", or "" if the recording stopped earlier"""
    metrics: dict[str, float] = field(default_factory=dict)
    """metrics of the task at the end, by name; empty without an end"""


@dataclass(frozen=True, eq=False)
class Recorded:
    """One world of a match, frame by frame; f frames over one or more episodes.

    A frame is an initial state, or the state after a control step.
    """

    task: str
    """name of the task"""
    options: Mapping[str, Any] | None
    """options of the task that are not its defaults; None if they cannot be written"""
    controllers: Mapping[str, str | None]
    """name or file of each robot's policy by robot; "LEARN" for a learner; None if unknown"""
    names: tuple[str, str]
    """names of blue and of yellow on the score board"""
    sensing: Sensing | str | None
    """senses of the robots: a `Sensing`, or the text "module:name" of a sensor model; None without
    senses, and for a model that is an object"""
    randomization: Ranges
    """distributions of numbers that each episode drew, by name; empty for none"""
    forecasting: tuple[str, ...]
    """teams that forecast although `sensing` does not"""
    history: int
    """observations in each observation of the learners, as for `Matches`"""
    config: SimConfig
    """configuration of the simulator"""
    rows: Floats
    """(f, row) state rows"""
    commands: Floats
    """(f, robots, command) commands that led to each frame, SI units; 0 in initial states"""
    observers: tuple[str, ...]
    """robots that have reward terms: those that learn or whose policy observes the match"""
    terms: Mapping[str, Floats]
    """(f, observers) weighted reward terms by name; 0 in initial states"""
    markers: tuple[tuple[Marker, ...], ...]
    """(f,) markers that the task shows on the floor"""
    referee: Doubles | None
    """(f, column) state of the referee, columns of `rsoccer.render.referee_state`; None without
    one"""
    sensed: SensedPoses | None
    """(f, ...) poses of ball and robots as the robots knew them; None without senses"""
    episodes: tuple[Episode, ...]
    """episodes in the order of play; their frames are all frames"""
    events: tuple[Event, ...]
    """events in the order of their frames"""
    snapshots: Mapping[int, Mapping[str, Array]]
    """complete states of the matches by frame, from `Matches.state_dict`"""
    package: str
    """version of the package that recorded the match"""
    physics: int
    """version of its physics"""

    def __len__(self) -> int:
        return len(self.rows)

    @property
    def robots(self) -> tuple[str, ...]:
        """Names of all robots in the order of a row."""
        return robot_names(self.config.n_blue, self.config.n_yellow)

    @property
    def frame(self) -> Frame:
        """(f, ...) all states by column name."""
        return Frame(self.rows, self.config.n_blue, self.config.n_yellow)

    @property
    def seconds(self) -> float:
        """Duration of play, s."""
        return float(self.clock[-1])

    @cached_property
    def starts(self) -> Mask:
        """(f,) whether the frame is an initial state."""
        starts = np.zeros(len(self), np.bool_)
        starts[[episode.start for episode in self.episodes]] = True
        return starts

    @cached_property
    def clock(self) -> Doubles:
        """(f,) seconds of play; the clock runs on over all episodes."""
        clock: Doubles = np.cumsum(~self.starts) * np.float64(self.config.time_step)
        return clock

    @cached_property
    def score(self) -> NDArray[np.int64]:
        """(f, 2) goals of blue and of yellow so far."""
        goals = np.zeros((len(self), len(SIDES)), np.int64)
        for event in self.events:
            if event.kind == "goal":
                goals[event.frame, SIDES.index(event.detail)] += 1
        return np.cumsum(goals, axis=0)

    @property
    def referee_states(self) -> tuple[RefereeState, ...] | None:
        """(f,) state of the referee by name; None without one."""
        if self.referee is None:
            return None
        time_step = self.config.time_step
        return tuple(RefereeState.of_row(row, time_step) for row in self.referee)

    @property
    def announcements(self) -> tuple[Words, ...]:
        """(f,) what has just happened, in words."""
        events: dict[int, list[Event]] = {}
        for event in self.events:
            events.setdefault(event.frame, []).append(event)
        announcer, announced = Announcer(self.config.field), []
        for frame, clock in enumerate(self.clock.tolist()):
            if self.starts[frame]:
                announcer.clear()
            happened = ((e.kind, e.robot, e.detail) for e in events.get(frame, ()))
            announced.append(announcer.update(happened, clock))
        return tuple(announced)

    @property
    def rewards(self) -> Floats:
        """(f, observers) sums of the reward terms."""
        zeros = np.zeros((len(self), len(self.observers)), np.float32)
        return sum(self.terms.values(), start=zeros)

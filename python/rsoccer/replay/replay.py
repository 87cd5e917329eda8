"""A recorded match: what happened in one world, frame by frame, and states to resume it from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import SimConfig
from rsoccer.arrays import Array, Doubles, Floats, Mask
from rsoccer.files import write_atomically
from rsoccer.frame import Frame, robot_names
from rsoccer.markers import Marker
from rsoccer.replay.container import ReplayError
from rsoccer.replay.events import Event
from rsoccer.view import SIDES

if TYPE_CHECKING:
    from rsoccer.controllers import Controllers
    from rsoccer.matches import Matches
    from rsoccer.sources import SensingSource, SimulatorSource
    from rsoccer.task import Task

SUFFIX = ".rsr"
"""Suffix of replay files."""


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
class Replay:
    """One world of a match, recorded frame by frame; f frames over one or more episodes.

    A frame is an initial state, or the state after a control step. `Recorder` and `record_replay`
    make replays. `save` writes one to a small file and `Replay.load` reads it again, with numbers
    rounded to the steps of `rsoccer.replay.quantized`, except for the rows of frames with a
    snapshot. A notebook shows a replay as its page.

    Example:
        >>> from rsoccer.replay import Replay, record_replay
        >>> replay = record_replay("VSSSelfPlay-v0", {"all": "chase"}, seconds=2.0)
        >>> len(replay), replay.rows.shape == (81, replay.config.row_size)
        (81, True)
        >>> path = replay.save("match.rsr")
        >>> Replay.load(path).task
        'VSSSelfPlay-v0'
    """

    task: str
    """name of the task"""
    options: Mapping[str, Any] | None
    """options of the task that are not its defaults; None if they cannot be written"""
    controllers: Mapping[str, str | None]
    """name or file of each robot's policy by robot; "LEARN" for a learner; None if unknown"""
    names: tuple[str, str]
    """names of blue and of yellow on the score board"""
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

    def __repr__(self) -> str:
        blue, yellow = self.score[-1]
        return (
            f"<Replay of {self.task}: {' '.join(self.names)} {blue}-{yellow}, "
            f"{self.seconds:g} s, {len(self.episodes)} episodes, {len(self.snapshots)} snapshots>"
        )

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
    def rewards(self) -> Floats:
        """(f, observers) sums of the reward terms."""
        zeros = np.zeros((len(self), len(self.observers)), np.float32)
        return sum(self.terms.values(), start=zeros)

    def save(self, path: Path | str) -> Path:
        """Write the replay to a file, in one step.

        Args:
            path: the file, ending in .rsr; its folder must exist.

        Returns:
            The path.

        Raises:
            ReplayError: another suffix, numbers that are not finite, or a snapshot with objects.
        """
        path = Path(path)
        if path.suffix != SUFFIX:
            raise ReplayError(f"path: expected a name ending in {SUFFIX}, got {str(path)!r}")
        write_atomically(path, self.to_bytes())
        return path

    @staticmethod
    def load(path: Path | str) -> Replay:
        """Read a file that `save` wrote.

        Args:
            path: the file.

        Returns:
            The replay.

        Raises:
            FileNotFoundError: no such file.
            ReplayError: the file is no replay, of another version, cut off or damaged.
        """
        if not Path(path).exists():
            raise FileNotFoundError(f"replay: the file {path} does not exist")
        if not Path(path).is_file():
            raise ReplayError(f"replay: expected a file, got {path}")
        try:
            return Replay.from_bytes(Path(path).read_bytes())
        except ReplayError as error:
            raise ReplayError(f"{path} is not a usable replay: {error}") from None

    def to_bytes(self, *, snapshots: bool = True) -> bytes:
        """Return the content of the replay's file.

        Args:
            snapshots: whether to include the snapshots.

        Returns:
            The bytes; equal replays give equal bytes.

        Raises:
            ReplayError: numbers that are not finite, or a snapshot with objects.
        """
        from rsoccer.replay.file_format import to_bytes

        return to_bytes(self, snapshots)

    @staticmethod
    def from_bytes(content: bytes) -> Replay:
        """Return the replay with this content.

        Args:
            content: bytes from `to_bytes`.

        Returns:
            The replay.

        Raises:
            ReplayError: no replay, another version, an incomplete file or wrong bytes.
        """
        from rsoccer.replay.file_format import from_bytes

        return from_bytes(content)

    def resume(
        self,
        frame: int,
        *,
        task: Task | None = None,
        controllers: Controllers | None = None,
        simulator: SimulatorSource | None = None,
        sensing: SensingSource | None = None,
    ) -> Matches:
        """Continue the match from a frame with a snapshot, exactly as it went on.

        Args:
            frame: a key of `snapshots`.
            task: the task; by default made from its name and options.
            controllers: controllers of the robots; by default those of the recording.
            simulator: moves the robots, as for `Matches`; the one that the match was recorded with.
            sensing: what robots know of the true state, as for `Matches`; as it was recorded with.

        Returns:
            Matches of one world at that frame. `autoreset` is "disabled".

        Raises:
            ReplayError: no snapshot at that frame, another version of the physics, or a task,
                controllers, a simulator or senses that do not fit or have to be given.
        """
        from rsoccer.replay.resume import resume

        return resume(self, frame, task, controllers, simulator=simulator, sensing=sensing)

    def to_html(self) -> str:
        """Return a page that plays the replay in a browser, complete in itself."""
        from rsoccer.replay.page import to_html

        return to_html(self)

    def save_html(self, path: Path | str) -> Path:
        """Write the page of `to_html` to a file, in one step.

        Args:
            path: the file, ending in .html; its folder must exist.

        Returns:
            The path.

        Raises:
            ReplayError: another suffix, or numbers that are not finite.
        """
        path = Path(path)
        if path.suffix != ".html":
            raise ReplayError(f"path: expected a name ending in .html, got {str(path)!r}")
        write_atomically(path, self.to_html().encode())
        return path

    def _repr_html_(self) -> str:
        """The page in a frame, for notebooks."""
        from rsoccer.replay.page import to_frame

        return to_frame(self)

"""A recorded match as a file, as a page, or as matches that continue from one of its states."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

from rsoccer.controllers import Controllers
from rsoccer.files import as_path, write_atomically
from rsoccer.matches import Matches
from rsoccer.randomization import Ranges
from rsoccer.replay import file_format, page
from rsoccer.replay.branch import branch
from rsoccer.replay.container import ReplayError
from rsoccer.replay.recorded import Recorded
from rsoccer.replay.resume import resume
from rsoccer.sources import SensingSource, SimulatorSource
from rsoccer.task import Task

SUFFIX = ".rsr"
"""Suffix of replay files."""


class Replay(Recorded):
    """One world of a match, recorded frame by frame; f frames over one or more episodes.

    A frame is an initial state, or the state after a control step; `Recorded` has the fields.
    `Recorder` and `record_replay` make replays. `save` writes one to a small file and `Replay.load`
    reads it again, with numbers rounded to the steps of `rsoccer.replay.quantized`, except for the
    rows of frames with a snapshot. A notebook shows a replay as its page.

    Example:
        >>> from rsoccer.replay import Replay, record_replay
        >>> replay = record_replay("VSSSelfPlay-v0", {"all": "chase"}, seconds=2.0)
        >>> len(replay), replay.rows.shape == (81, replay.config.row_size)
        (81, True)
        >>> path = replay.save("match.rsr")
        >>> Replay.load(path).task
        'VSSSelfPlay-v0'
    """

    def __repr__(self) -> str:
        blue, yellow = self.score[-1]
        return (
            f"<Replay of {self.task}: {' '.join(self.names)} {blue}-{yellow}, "
            f"{self.seconds:g} s, {len(self.episodes)} episodes, {len(self.snapshots)} snapshots>"
        )

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
            TypeError: no path.
            ReplayError: the file is no replay, of another version, cut off or damaged.
        """
        file = as_path("path", path)
        if not file.exists():
            raise FileNotFoundError(f"replay: the file {path} does not exist")
        if not file.is_file():
            raise ReplayError(f"replay: expected a file, got {path}")
        try:
            return Replay.from_bytes(file.read_bytes())
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
        return file_format.to_bytes(self, snapshots)

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
        found = file_format.from_bytes(content)
        return Replay(**{each.name: getattr(found, each.name) for each in fields(found)})

    def resume(
        self,
        frame: int,
        *,
        task: Task | None = None,
        controllers: Controllers | None = None,
        simulator: SimulatorSource | None = None,
        sensing: SensingSource | None = None,
        randomization: Ranges | None = None,
    ) -> Matches:
        """Continue the match from a frame with a snapshot, exactly as it went on.

        Args:
            frame: a key of `snapshots`.
            task: the task; by default made from its name and options.
            controllers: controllers of the robots; by default those of the recording.
            simulator: moves the robots, as for `Matches`; the one that the match was recorded with.
            sensing: what robots know of the true state, as for `Matches`; by default that of the
                recording. A sensor model of one's own has to be given.
            randomization: numbers that each episode draws; by default those of the recording.

        Returns:
            Matches of one world at that frame. `autoreset` is "disabled".

        Raises:
            ReplayError: no snapshot at that frame, another version of the physics, or a task,
                controllers, a simulator or senses that do not fit or have to be given.
        """
        return resume(
            self,
            frame,
            task,
            controllers,
            simulator=simulator,
            sensing=sensing,
            randomization=randomization,
        )

    def branch(
        self,
        frame: int,
        controllers: Controllers,
        *,
        seed: int = 0,
        task: Task | None = None,
        recorded: Controllers | None = None,
        sensing: SensingSource | None = None,
    ) -> Matches:
        """Go on from any frame with other controllers, as matches for a step loop of one's own.

        Up to the frame the recorded controllers play again, from the last snapshot before it, so
        that clock, score, referee, senses and each bit of the physics are those of the recording.
        The new policies begin anew. Where the episode has no snapshot before the frame, a new
        episode begins with the bodies of the frame, which are rounded.

        Args:
            frame: index of a frame at which the match has not ended.
            controllers: controllers from there on, as for `Matches`; `LEARN` for robots that your
                own loop moves.
            seed: seed of the new policies, and of all else without a snapshot.
            task: the task; by default made from its name and options.
            recorded: controllers of the recording, where a policy has no name.
            sensing: what robots know, where the recording had a sensor model of one's own.

        Returns:
            Matches of one world at that frame. `autoreset` is "disabled".

        Raises:
            ReplayError: no such frame, one at which the match has ended, a recording that cannot
                be played again up to it, another version of the physics, or an argument that does
                not fit or has to be given.
        """
        return branch(
            self,
            frame,
            controllers,
            seed=seed,
            task=task,
            recorded=recorded,
            sensing=sensing,
        )

    def to_html(self) -> str:
        """Return a page that plays the replay in a browser, complete in itself."""
        return page.to_html(self)

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
        return page.to_frame(self)

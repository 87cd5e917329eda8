"""`rsoccer convert`: replays as logs of the Small Size League, and logs as replays."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Final

from tyro.conf import Positional, arg

from rsoccer.commands.imports import Imports
from rsoccer.commands.output import check_output, write
from rsoccer.replay.replay import SUFFIX, Replay

_LOG_SUFFIXES: Final = (".log", ".gz")


@dataclass(frozen=True)
class Convert(Imports):
    """Convert a replay (.rsr) to a log of the Small Size League (.log, .log.gz), or back."""

    source: Annotated[Path, Positional, arg(metavar="FILE")]
    """replay or log to read"""
    target: Annotated[Path, Positional, arg(metavar="FILE")]
    """log or replay to write"""
    start: float = 0.0
    """time of the first frame of the log, seconds since 1970"""
    blue_on_positive_half: bool = False
    """put blue's goal at +x in the log; or it is there in a log without a referee to read"""
    index: bool = False
    """end a log that is not compressed in an index, with which players jump"""
    time_step: float = 0.025
    """seconds between the frames of the replay"""
    field: Annotated[str | None, arg(metavar="NAME", help_behavior_hint="(default: the log's)")] = (
        None
    )
    """preset of the replay's field"""

    def run(self) -> None:
        """Convert the file.

        Raises:
            FileNotFoundError: no such file.
            ValueError: two replays, two logs, an option of the other direction, or a damaged file.
        """
        if (self.source.suffix == SUFFIX) is (self.target.suffix == SUFFIX):
            raise ValueError(f"target: expected one of the two files to be a replay ({SUFFIX})")
        if self.source.suffix == SUFFIX:
            self._write_log()
        else:
            self._write_replay()

    def _write_log(self) -> None:
        from rsoccer.protocols.replay_log import replay_to_log

        self._refuse("time_step", "field")
        check_output("target", self.target, *_LOG_SUFFIXES)
        path = replay_to_log(
            Replay.load(self.source),
            self.target,
            start=self.start,
            blue_on_positive_half=self.blue_on_positive_half,
            index=self.index,
        )
        write(f"log: {path} ({path.stat().st_size / 1024:.1f} KiB)")

    def _write_replay(self) -> None:
        from rsoccer.protocols.log_replay import log_to_replay

        self._refuse("start", "index")
        check_output("target", self.target, SUFFIX)
        replay = log_to_replay(
            self.source,
            time_step=self.time_step,
            field=self.field,
            blue_on_positive_half=self.blue_on_positive_half,
        )
        write(f"replay: {replay.save(self.target)} ({replay.seconds:g} s)")

    def _refuse(self, *names: str) -> None:
        """Refuse options of the other direction."""
        for name in names:
            value = getattr(self, name)
            if value != getattr(Convert, name):
                raise ValueError(f"{name}: expected none in this direction, got {value}")

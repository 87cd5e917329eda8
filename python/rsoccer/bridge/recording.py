"""Records of a served match: a replay, or a log of the SSL."""

from __future__ import annotations

import logging
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

import numpy as np

from rsoccer import sensing_text
from rsoccer._core import build_info
from rsoccer.arrays import Doubles, Floats
from rsoccer.bridge.match_tasks import TICK, with_ticks
from rsoccer.bridge.server import Server
from rsoccer.bridge.session import Datagram
from rsoccer.files import check_writable
from rsoccer.frame import Frame, robot_names
from rsoccer.protocols.logs import COMPRESSED_SUFFIX, NANOSECONDS, LogKind, LogWriter
from rsoccer.render.referee_state import COLUMNS, referee_row
from rsoccer.replay import Replay
from rsoccer.replay.events import Event, ball_events, game_events
from rsoccer.replay.recorded import Episode
from rsoccer.replay.replay import SUFFIX
from rsoccer.replay.sensed_poses import SensedPoses

MAX_SECONDS: Final = 3600.0
"""Longest replay that is recorded, simulated s. It is in the memory until the end: some 2 kB a
frame of six against six. A log is written as the match goes on, and has no limit."""
PERIOD: Final = 0.025
"""Time between two frames of a replay, s: the control step of the tasks."""
MAX_COMMAND: Final = 1e6
"""Greatest number of a command in a replay, m/s or rad/s. Robots take what they can of any command,
but the file has no room for the largest ones."""
_LOGGER: Final = logging.getLogger(__name__)
_EVERY: Final = round(PERIOD / TICK)
_LEFT_OUT: Final = "replay: ticks left out"
_STEPS: Final = [place for place, name in enumerate(COLUMNS) if "_steps" in name]
"""Columns of the referee that count control steps."""
_KINDS: Final = {
    "vision": LogKind.VISION,
    "tracker": LogKind.TRACKER,
    "referee": LogKind.REFEREE,
}


@contextmanager
def record(server: Server, path: Path | str) -> Iterator[None]:
    """Return a context manager that records what its block plays.

    Args:
        server: the server.
        path: the file: a replay (.rsr) of at most `MAX_SECONDS`, written at the end, or a log of
            the SSL (.log, .log.gz), written at once. Clients cannot exchange robots meanwhile in
            a match whose replay is recorded.

    Raises:
        OSError: the file cannot be written. A replay is then in a temporary file, which the message
            names.
        ValueError: as for `check_record`.
    """
    path = Path(path)
    check_record(server, path)
    if path.suffix == SUFFIX:
        recorder = ReplayRecorder(server)
        server.listeners.append(recorder)
        server.session.recorders += 1
        try:
            yield
        finally:
            server.session.recorders -= 1
            server.listeners.remove(recorder)
            _save(recorder.replay(), path)
        return
    with LogWriter(path) as log:

        def write(server: Server, sent: list[Datagram]) -> None:
            session = server.session
            time = round((session.epoch + session.arena.seconds) * NANOSECONDS)
            for datagram in sent:
                log.write(time, _KINDS[datagram.port], datagram.data)

        server.listeners.append(write)
        try:
            yield
        finally:
            server.listeners.remove(write)


def check_record(server: Server, path: Path | str) -> None:
    """Check that a match can be recorded to a file, which stays as it is.

    Args:
        server: the server.
        path: the file.

    Raises:
        ValueError: another suffix, a log of a match of another league, or a place where no file can
            be written.
    """
    path = Path(path)
    if not path.name.endswith((SUFFIX, ".log", f".log{COMPRESSED_SUFFIX}")):
        raise ValueError(f"record: expected a name ending in .rsr, .log or .log.gz, got {path}")
    if path.suffix != SUFFIX and server.session.settings.league != "ssl":
        raise ValueError(f"record: expected a replay (.rsr) of a match of VSSS, got {path}")
    check_writable("record", path)


def _save(replay: Replay, path: Path) -> None:
    """Save a replay, in a temporary file if its own cannot be written any more."""
    try:
        replay.save(path)
    except OSError as error:
        handle, spare = tempfile.mkstemp(SUFFIX, f"{path.stem}-")
        os.close(handle)
        replay.save(spare)
        reason = error.strerror or error
        raise OSError(f"record: cannot write {path}: {reason}; the replay is {spare}") from error


class ReplayRecorder:
    """Keeps a frame of each `PERIOD`, up to `MAX_SECONDS`; a listener of a server."""

    def __init__(self, server: Server) -> None:
        """Keep the state as it is.

        Args:
            server: the server.
        """
        self._server = server
        self._config = with_ticks(server.session.arena.config, PERIOD)
        self._robots = robot_names(self._config.n_blue, self._config.n_yellow)
        self._rows: list[Floats] = []
        self._commands: list[Floats] = []
        self._referee: list[Doubles] = []
        self._sensed: list[Floats] = []
        self._events: list[Event] = []
        robots = self._config.n_robots
        self._touched: Floats = np.zeros(robots, np.float32)
        self._ticks = 0
        self._keep()

    def __call__(self, server: Server, sent: list[Datagram]) -> None:
        """Take note of a tick.

        Args:
            server: the server.
            sent: what it sends, and what a referee on the network has sent.
        """
        arena = server.session.arena
        index = len(self._rows)
        if index * PERIOD > MAX_SECONDS:
            self._leave_out(server)
            return
        self._ticks += 1
        np.maximum(self._touched, arena.frame.robots.touched_ball[0], out=self._touched)
        self._events += game_events(self._robots, index, arena.play.events.of_world(0))
        if self._ticks % _EVERY == 0:
            self._keep()
            rows = np.stack(self._rows[-2:])
            self._events += ball_events(self._config, self._robots, index, rows, self._commands[-1])

    def _leave_out(self, server: Server) -> None:
        """Count a tick that the replay lacks, and say so at the first one."""
        counts = server.session.counts
        if not counts[_LEFT_OUT]:
            _LOGGER.warning(
                "record: the replay is full after %g s; a log has no limit", MAX_SECONDS
            )
        counts[_LEFT_OUT] += 1

    def _keep(self) -> None:
        """Add the current state."""
        session = self._server.session
        arena = session.arena
        row: Floats = arena.frame.rows[0].copy()
        frame = Frame(row[None], self._config.n_blue, self._config.n_yellow)
        frame.robots.touched_ball[0] = self._touched
        self._touched[:] = 0.0
        self._rows.append(row)
        self._commands.append(np.clip(session.commands, -MAX_COMMAND, MAX_COMMAND))
        self._sensed.append(arena.sense().rows[0].copy())
        referee = referee_row(arena.task, arena.play)
        assert referee is not None, "match tasks have a referee"
        referee[_STEPS] = np.floor(referee[_STEPS] / _EVERY)
        self._referee.append(referee)

    def replay(self) -> Replay:
        """Return what has been recorded so far."""
        session, info = self._server.session, build_info()
        config = self._config
        rows = np.stack(self._rows)
        sensed = Frame(np.stack(self._sensed), config.n_blue, config.n_yellow)
        settings = session.settings
        has_referee = settings.referee != "off"
        frames = len(rows)
        return Replay(
            task=session.arena.task.name,
            options=None,
            controllers=dict.fromkeys(self._robots),
            names=(settings.blue or "BLUE", settings.yellow or "YELLOW"),
            sensing=sensing_text.recordable(session.arena.sensing),
            randomization={},
            forecasting=(),
            history=1,
            config=config,
            rows=rows,
            commands=np.stack(self._commands),
            observers=(),
            terms={},
            markers=((),) * frames,
            referee=np.stack(self._referee) if has_referee else None,
            sensed=SensedPoses.of_frame(sensed),
            episodes=(Episode(0, frames, ""),),
            events=tuple(event for event in self._events if event.frame < frames),
            snapshots={},
            package=str(info["version"]),
            physics=int(info["physics"]),
        )

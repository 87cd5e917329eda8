"""From a replay to a log that the league's tools play."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Final

from rsoccer import checks
from rsoccer.game import NOBODY, Event, EventKind
from rsoccer.protocols import referee, tracker, vision
from rsoccer.protocols.cameras import Camera
from rsoccer.protocols.errors import MessageError
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.logs import NANOSECONDS, LogEntry, LogKind, LogWriter
from rsoccer.protocols.referee_state import status_of_recorded
from rsoccer.render.words import event_name
from rsoccer.replay.recorded import Recorded
from rsoccer.view import SIDES

GEOMETRY_SECONDS: Final = 1.0
"""Time between packets with the geometry, s."""
UUID: Final = "rSoccer-replay"
"""Identity of the sender of tracked frames and of the referee's packets."""
_KINDS: Final[dict[str, EventKind]] = {
    event_name(kind): kind for kind in EventKind if kind not in (EventKind.NONE, EventKind.PASS)
}
"""Kinds of events by their names in replays."""


def replay_to_log(
    replay: Recorded,
    path: Path | str,
    *,
    start: float = 0.0,
    blue_on_positive_half: bool = False,
    index: bool = False,
) -> Path:
    """Write a replay as a log: in each frame what one camera, a tracker and the referee tell.

    Args:
        replay: the replay. What no packet has, such as commands, rewards and the ball's spin, is
            not in the log.
        path: the log; it is compressed if its name ends in .gz.
        start: time of the first frame, Unix time, s; 0 or above.
        blue_on_positive_half: whether blue's goal is at +x on the wire.
        index: whether the log ends in an index, which a compressed one has not.

    Returns:
        The path. Frames follow each other by the control step, also where an episode begins. The
        referee is in logs of matches of the SSL that have one.

    Raises:
        OSError: the file cannot be written.
        ValueError: `start` is negative or not finite, or an index of a compressed file.
    """
    checks.number_in_range("start", start, 0.0, 2.0**33)
    layout = WireLayout(replay.config, blue_on_positive_half=blue_on_positive_half)
    with LogWriter(path, index=index) as log:
        for entry in log_entries(replay, layout, start):
            log.write(*entry)
    return Path(path)


def log_entries(replay: Recorded, layout: WireLayout, start: float = 0.0) -> Iterator[LogEntry]:
    """Yield the messages of a replay.

    Args:
        replay: the replay.
        layout: the match.
        start: time of the first frame, Unix time, s.
    """
    frame, step = replay.frame, replay.config.time_step
    states, reported, stamper = replay.referee_states, _events(replay), referee.Stamper()
    every, camera = max(1, round(GEOMETRY_SECONDS / step)), Camera()
    events = referee.EventLog()
    for i in range(len(replay)):
        seconds = start + i * step
        time = round(seconds * NANOSECONDS)
        seen = vision.to_packet(
            layout,
            frame,
            i,
            frame_number=i,
            t_capture=seconds,
            t_sent=seconds,
            camera=camera,
            geometry=[camera] if i % every == 0 else None,
        )
        yield LogEntry(time, LogKind.VISION, seen.SerializeToString())
        tracked = tracker.to_packet(layout, frame, i, frame_number=i, timestamp=seconds, uuid=UUID)
        yield LogEntry(time, LogKind.TRACKER, tracked.SerializeToString())
        if states is None:
            continue
        state = states[i]
        since_stop = events.add(state.command, reported.get(i, ()), seconds, in_play=state.in_play)
        status = status_of_recorded(state, names=replay.names, events=since_stop)
        again = i > 0 and state.command_seconds < states[i - 1].command_seconds
        stamp = stamper.stamp(status.command, seconds, again=again)
        try:
            packet = referee.to_packet(layout, status, stamp, source_identifier=UUID)
        except MessageError:
            continue  # a command of VSSS, which the game controller does not have
        yield LogEntry(time, LogKind.REFEREE, packet.SerializeToString())


def _events(replay: Recorded) -> dict[int, list[Event]]:
    """Events of the referee by frame; their place is that of the ball."""
    found: dict[int, list[Event]] = {}
    balls, robots = replay.frame.ball.position, replay.robots
    for event in replay.events:
        kind = _KINDS.get(event.kind)
        if event.kind == "out":
            line = "GOAL_LINE" if event.detail.startswith("goal_line") else "TOUCH_LINE"
            kind = EventKind[f"BALL_LEFT_FIELD_{line}"]
        if kind is None:
            continue
        robot = robots.index(event.robot) if event.robot else NOBODY
        team = SIDES.index(event.detail) if event.detail in SIDES else _team(replay, robot)
        x, y = balls[event.frame].tolist()
        found.setdefault(event.frame, []).append(Event(kind, team, robot, (x, y)))
    return found


def _team(replay: Recorded, robot: int) -> int:
    """Team of a robot."""
    return NOBODY if robot == NOBODY else int(robot >= replay.config.n_blue)

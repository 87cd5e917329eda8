"""A page on this machine that shows a served match in a browser."""

from __future__ import annotations

import base64
import http
import json
import logging
import socket
import threading
from dataclasses import replace
from functools import cache
from importlib import resources
from typing import Any, Final, Self

import numpy as np
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response
from websockets.sync.server import Server as WebServer
from websockets.sync.server import ServerConnection, serve

from rsoccer.bridge.match_tasks import TICK
from rsoccer.bridge.recording import PERIOD, ReplayRecorder
from rsoccer.bridge.server import Server
from rsoccer.bridge.session import Datagram
from rsoccer.bridge.sockets import LOOPBACK
from rsoccer.protocols.layout import TEAM_NAMES
from rsoccer.render.referee_state import RefereeState, referee_row
from rsoccer.render.words import command_words, has_clock, stage_text
from rsoccer.replay import file_format, page, quantized
from rsoccer.replay.recorded import Episode
from rsoccer.replay.sensed_poses import SensedPoses

HISTORY: Final = 60
"""Frames that the page keeps for trails."""
MAX_VIEWERS: Final = 8
"""Browsers that watch at once."""
FRAMES: Final = "/frames"
"""Path of the websocket."""
_LOGGER: Final = logging.getLogger(__name__)
"""Silent by default: a browser that goes away is no error."""
_LOGGER.addHandler(logging.NullHandler())
_LOGGER.propagate = False
_EVERY: Final = round(PERIOD / TICK)
_SCRIPTS: Final = ("reader.js", "ghosts.js", "field.js")
_DIGITS: Final = 4
_WAIT: Final = 0.5
"""Time after which a thread looks whether the page is closed, s."""
_CLOSE: Final = 1.0
"""Longest wait for a browser that is to close its connection, s."""


class LivePage:
    """The page; a `with` statement closes it. It is a listener of the server.

    Frames are made while somebody watches, one each `PERIOD` of simulated time; a browser that is
    slow misses some. The page cannot change anything.

    Attributes:
        url: address for the browser.
    """

    def __init__(self, server: Server, port: int) -> None:
        """Open the page.

        Args:
            server: the server.
            port: port on this machine; 0 for any that is free.

        Raises:
            OSError: the port is taken.
        """
        self._server = server
        self._content, self._config = _page(server).encode(), server.session.arena.config
        self._changed = threading.Condition()
        self._frame, self._number, self._closed, self._viewers = "", 0, False, 0
        try:
            made = socket.create_server((LOOPBACK, port))
        except OSError as error:
            raise OSError(f"page: {LOOPBACK}:{port}: {error.strerror or error}") from error
        self.port: int = made.getsockname()[1]
        self._web: WebServer = serve(
            self._watch,
            sock=made,
            process_request=self._answer,
            compression=None,
            logger=_LOGGER,
            close_timeout=_CLOSE,
        )
        self.url = f"http://{LOOPBACK}:{self.port}/"
        self._thread = threading.Thread(target=self._web.serve_forever, daemon=True)
        self._thread.start()
        server.listeners.append(self)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the page; a second call does nothing."""
        if self._closed:
            return
        self._server.listeners.remove(self)
        with self._changed:
            self._closed = True
            self._changed.notify_all()
        self._web.shutdown()
        self._thread.join()

    def __call__(self, server: Server, sent: list[Datagram]) -> None:
        """Show the state after a tick.

        Args:
            server: the server.
            sent: what it sends.
        """
        if server.session.arena.config is not self._config:
            # Robots were exchanged: who loads the page from now on sees the new ones.
            self._content, self._config = _page(server).encode(), server.session.arena.config
        if not self._viewers or server.session.arena.ticks % _EVERY:
            return
        frame = json.dumps(frame_of(server), separators=(",", ":"))
        with self._changed:
            self._frame, self._number = frame, self._number + 1
            self._changed.notify_all()

    def _answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """Send the page, or let a websocket begin."""
        hosts = {f"{name}:{self.port}" for name in (LOOPBACK, "localhost")}
        # Pages of others, which a browser may show, get nothing.
        if request.headers.get("Host") not in hosts:
            return connection.respond(http.HTTPStatus.FORBIDDEN, "This page is local.\n")
        if request.path == FRAMES:
            origin = request.headers.get("Origin")
            if origin is not None and origin not in {f"http://{host}" for host in hosts}:
                return connection.respond(http.HTTPStatus.FORBIDDEN, "This page is local.\n")
            return None
        if request.path != "/":
            return connection.respond(http.HTTPStatus.NOT_FOUND, "There is only one page.\n")
        response = connection.respond(http.HTTPStatus.OK, "")
        del response.headers["Content-Type"], response.headers["Content-Length"]
        response.headers["Content-Type"] = "text/html; charset=utf-8"
        response.headers["Content-Length"] = str(len(self._content))
        response.body = self._content
        return response

    def _watch(self, connection: ServerConnection) -> None:
        """Send frames to a browser, in a thread of its own."""
        with self._changed:
            is_full = self._viewers >= MAX_VIEWERS
            self._viewers += not is_full
            seen = self._number
        if is_full:
            # The match, which needs the lock, does not wait for the browser's answer.
            connection.close(1013, "too many watch")
            return
        try:
            while True:
                with self._changed:
                    if self._number == seen and not self._closed:
                        self._changed.wait(_WAIT)
                    if self._closed:
                        break
                    frame, fresh, seen = self._frame, self._number != seen, self._number
                if fresh:
                    connection.send(frame)
                elif connection.close_code is not None:
                    break
        except ConnectionClosed:
            pass
        finally:
            with self._changed:
                self._viewers -= 1


def frame_of(server: Server) -> dict[str, Any]:
    """Return what the page shows of the current state.

    Args:
        server: the server.

    Returns:
        Values for JSON.
    """
    session, arena = server.session, server.session.arena
    row = quantized.stored_rows(arena.frame.rows)[0]
    sensed = SensedPoses.of_frame(arena.sense()).columns()[0]
    blue, yellow = arena.play.game.score[0].tolist()
    frame: dict[str, Any] = {
        "seconds": arena.seconds,
        "row": np.round(row, _DIGITS).tolist(),
        "sensed": np.round(sensed, _DIGITS).tolist(),
        "score": [int(blue), int(yellow)],
        "clock": _clock(arena.seconds),
        "stage": "",
        "command": "",
        "drivers": ", ".join(
            f"{name}: {_driver(server, team)}" for team, name in enumerate(TEAM_NAMES)
        ),
    }
    numbers = referee_row(arena.task, arena.play)
    if server.awaits_referee:
        frame["command"] = "No referee is heard"
    elif numbers is not None and session.settings.referee != "off":
        state = RefereeState.of_row(numbers, TICK)
        frame["stage"], frame["command"] = stage_text(state), command_words(state).text
        if has_clock(state):
            frame["clock"] = _clock(max(0.0, state.seconds_left))
    return frame


def _driver(server: Server, team: int) -> str:
    """Driver of a team, in words."""
    session = server.session
    address = session.teams[team].address
    if address is not None:
        return f"{address[0]}:{address[1]}"
    policy = (session.settings.blue, session.settings.yellow)[team]
    return policy or "nobody"


def _clock(seconds: float) -> str:
    tenths = int(10.0 * seconds + 1e-6)  # whole ones, so that no minute has 60.0 seconds
    return f"{tenths // 600}:{tenths % 600 / 10:04.1f}"


def _page(server: Server) -> str:
    """The page, with a replay whose frames are all the current state."""
    begun = ReplayRecorder(server).replay()
    assert begun.sensed is not None, "served matches have senses"
    poses = (begun.sensed.ball, begun.sensed.robots, begun.sensed.headings)
    still = replace(
        begun,
        rows=np.repeat(begun.rows[:1], HISTORY, axis=0),
        commands=np.repeat(begun.commands[:1], HISTORY, axis=0),
        referee=None,
        sensed=SensedPoses(*(np.repeat(each[:1], HISTORY, axis=0) for each in poses)),
        markers=((),) * HISTORY,
        episodes=(Episode(0, HISTORY, ""),),
        events=(),
    )
    content = base64.b64encode(file_format.to_bytes(still, snapshots=False)).decode()
    parts = {"scene": page.to_json(page.scene(still.config)), "replay": content}
    return page.document(
        f"{still.task}: {' - '.join(still.names)}",
        page.web_part("style.css") + _web("live.css"),
        page.fill(_web("live.html"), parts),
        [*map(page.web_part, _SCRIPTS), _web("live.js")],
    )


@cache
def _web(name: str) -> str:
    """Text of a part of the page."""
    return (resources.files("rsoccer.bridge") / "web" / name).read_text(encoding="utf-8")

"""Replays: recorded matches in small files, which play in a window, a video or a browser.

    >>> from rsoccer.replay import Replay, record_replay
    >>> replay = record_replay("VSSSelfPlay-v0", {"blue": "chase", "yellow": "ou"}, seconds=5.0)
    >>> path = replay.save_html("match.html")

`Recorder` records beside a step loop of your own. `Replay.resume` continues a match from a
snapshot.
"""

from rsoccer.replay.container import ReplayError
from rsoccer.replay.recorded import Episode
from rsoccer.replay.recorder import Recorder, record_replay
from rsoccer.replay.replay import Replay
from rsoccer.replay.what_if import what_if

__all__ = ["Episode", "Recorder", "Replay", "ReplayError", "record_replay", "what_if"]

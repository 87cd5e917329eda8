"""Whole matches under a referee, as the site plays them and the README shows them."""

from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

import rsoccer
from rsoccer.lineup import lineup
from rsoccer.replay import Recorder, Replay

SECONDS: Final = 300.0
"""Longest duration of a recording, s."""


@dataclass(frozen=True)
class WholeMatch:
    """Match of two policies from a fixed seed."""

    blue: str
    """Policy of blue."""
    yellow: str
    """Policy of yellow."""
    options: dict[str, Any] = field(default_factory=lambda: {"half_seconds": 45.0})
    """Options of the task."""
    seed: int = 0
    """Seed of the match."""


WHOLE_MATCHES: Final = {
    "SSLMatch-v0": WholeMatch("best", "scripted"),
    "VSSMatch-v0": WholeMatch("best", "scripted"),
}
"""Matches by task: six SSL robots a side, and three of VSSS; blue has learned."""


def record(name: str, seconds: float = SECONDS) -> Replay:
    """Record a match up to its end.

    Args:
        name: Name of its task.
        seconds: Longest duration, s.
    """
    played = WHOLE_MATCHES[name]
    task = rsoccer.make_task(name, **played.options)
    controllers = lineup(task, played.blue, played.yellow)
    matches = rsoccer.Matches(task, seed=played.seed, controllers=controllers, autoreset="disabled")
    names = (played.blue.upper(), played.yellow.upper())
    recorder = Recorder(matches, names=names, controllers=controllers)
    matches.reset()
    recorder.begin()
    actions = np.zeros((1, 0, matches.action_size), np.float32)  # no robot learns
    while not matches.done[0] and recorder.seconds < seconds:
        recorder.add(matches.step(actions))
    return recorder.replay()

"""List of a study's runs, with the time that the open ones will take."""

from __future__ import annotations

from collections.abc import Sequence

from benches.learning import status as states
from benches.learning.status import DONE, STALE, UNAVAILABLE, Status, expected_seconds

HEADLINE_DIGITS = 3


def listing(entries: Sequence[Status], known: Sequence[Status], jobs: int) -> str:
    """Return a line for each run, and the sum of the time that is left.

    Args:
        entries: States of the selected runs.
        known: States of all runs, from which the time is estimated.
        jobs: Processes at once.
    """
    width = max((len(entry.run.key) for entry in entries), default=0)
    lines = [f"{entry.run.key:{width}}  {_state(entry, known)}" for entry in entries]
    left = sum(
        expected_seconds(entry.run, known)
        for entry in entries
        if entry.state not in (DONE, STALE, UNAVAILABLE)
    )
    counts = {
        state: sum(entry.state == state for entry in entries)
        for state in (
            *(states.DONE, states.STALE, states.RUNNING, states.UNFINISHED),
            *(states.OPEN, states.WAITING, states.UNAVAILABLE),
        )
    }
    summary = ", ".join(f"{count} {state}" for state, count in counts.items() if count)
    hours = f"{left / 3600.0:.1f} core-hours left, {left / 3600.0 / jobs:.1f} h with {jobs} jobs"
    return "\n".join([*lines, f"{summary or 'no runs'}; {hours}"])


def _state(entry: Status, known: Sequence[Status]) -> str:
    """State of a run, with its score or its expected time."""
    if entry.state == DONE and entry.result is not None:
        first = entry.result["evaluations"][0]
        text = f"{first['metric']} {first['score']:.{HEADLINE_DIGITS}f}"
        against = "" if first["opponent"] == "-" else f" against {first['opponent']}"
        return f"done  {text}{against}, {entry.result['seconds']['wall'] / 60.0:.1f} min"
    if entry.state in (STALE, UNAVAILABLE):
        return f"{entry.state}  {entry.reason}"
    minutes = expected_seconds(entry.run, known) / 60.0
    reason = f", {entry.reason}" if entry.reason else ""
    return f"{entry.state}  about {minutes:.0f} min{reason}"

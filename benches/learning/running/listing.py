"""List of a study's runs, with the time that the open ones will take."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from typing import Final

from benches.learning.run_files import Folders
from benches.learning.running import status as states
from benches.learning.running.estimate import expected_seconds
from benches.learning.running.status import DONE, INVALID, STALE, UNAVAILABLE, Status
from benches.learning.running.workplace import keeps_policy

HEADLINE_DIGITS: Final = 3


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
        if entry.state not in (DONE, STALE, UNAVAILABLE, INVALID)
    )
    counts = {
        state: sum(entry.state == state for entry in entries)
        for state in (
            *(states.DONE, states.STALE, states.RUNNING, states.UNFINISHED),
            *(states.OPEN, states.WAITING, states.UNAVAILABLE, states.INVALID),
        )
    }
    summary = ", ".join(f"{count} {state}" for state, count in counts.items() if count)
    hours = f"{left / 3600.0:.1f} core-hours left, {left / 3600.0 / jobs:.1f} h with {jobs} jobs"
    note = " without the unavailable ones" if counts[states.UNAVAILABLE] else ""
    return "\n".join([*lines, f"{summary or 'no runs'}; {hours}{note}"])


def _state(entry: Status, known: Sequence[Status]) -> str:
    """State of a run, with its score or its expected time."""
    if entry.state == DONE and entry.result is not None:
        first = entry.result["evaluations"][0]
        text = f"{first['metric']} {first['score']:.{HEADLINE_DIGITS}f}"
        against = "" if first["opponent"] == "-" else f" against {first['opponent']}"
        return f"done  {text}{against}, {entry.result['seconds']['wall'] / 60.0:.1f} min"
    if entry.state in (STALE, UNAVAILABLE, INVALID):
        return f"{entry.state}  {entry.reason}"
    minutes = expected_seconds(entry.run, known) / 60.0
    reason = f", {entry.reason}" if entry.reason else ""
    return f"{entry.state}  about {minutes:.0f} min{reason}"


def best(entries: Sequence[Status], folders: Folders) -> str:
    """Return a line for each experiment: its best finished run, and the path of the policy.

    The best run has the highest mean score over its evaluations, in the policies' own mode.

    Args:
        entries: States of the selected runs.
        folders: Folders with the policies.
    """
    finished = [entry for entry in entries if entry.state == DONE]
    finished.sort(key=lambda entry: entry.run.experiment.key)
    lines = []
    for _, seeds in groupby(finished, key=lambda entry: entry.run.experiment.key):
        score, entry = max(((_mean_score(e), e) for e in seeds), key=lambda pair: pair[0])
        kept = "policy not here; --again learns it"
        if keeps_policy(folders, entry.run.key):
            kept = str(folders.policy(entry.run.key))
        lines.append(f"{entry.run.key}  {score:.{HEADLINE_DIGITS}f}  {kept}")
    return "\n".join(lines)


def _mean_score(entry: Status) -> float:
    """Mean score over the opponents."""
    rows = entry.result["evaluations"] if entry.result else []
    scores = [float(row["score"]) for row in rows if row["mode"] == rows[0]["mode"]]
    return sum(scores) / len(scores)

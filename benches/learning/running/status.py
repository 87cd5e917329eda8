"""State of each run of a study: finished, stale, or still to be done."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from benches.learning import conditions, run_files
from benches.learning.experiments import Run, Study
from benches.learning.run_files import Folders
from benches.learning.running import algorithms, workplace

DONE: Final = "done"
STALE: Final = "stale"
RUNNING: Final = "running"
UNFINISHED: Final = "unfinished"
OPEN: Final = "open"
WAITING: Final = "waiting"
UNAVAILABLE: Final = "unavailable"
"""A library of the run is missing."""
INVALID: Final = "invalid"
"""The task or its settings do not exist, or have wrong values."""


@dataclass(frozen=True)
class Status:
    """State of one run."""

    run: Run
    state: str
    """One of the constants of this module."""
    reason: str = ""
    """Cause of the state, such as the settings that have changed."""
    result: Mapping[str, Any] | None = field(default=None, compare=False)
    """Result of a run that is done or stale."""


def statuses(study: Study, folders: Folders) -> list[Status]:
    """Return the state of every run of a study, in its order."""
    found: dict[str, Status] = {}
    for run in study.runs():
        found[run.key] = status(run, study, folders)
    return [_after_needs(entry, found) for entry in found.values()]


def status(run: Run, study: Study, folders: Folders) -> Status:
    """Return the state of a run, whatever the runs that it needs."""
    try:
        settings = conditions.settings(run)
    except (TypeError, ValueError) as error:
        return Status(run, INVALID, str(error), run_files.load(folders, run.key))
    missing = conditions.missing_library(run)
    if missing and run_files.load(folders, run.key) is None:
        return Status(run, UNAVAILABLE, f"{missing} is not installed")
    if workplace.is_running(folders, run.key):
        return Status(run, RUNNING, _progress(run, folders))
    result = run_files.load(folders, run.key)
    if result is not None:
        changed = conditions.differences(run, study, folders, settings, result)
        return Status(run, STALE if changed else DONE, "; ".join(changed), result)
    progress = _progress(run, folders)
    return Status(run, UNFINISHED if progress else OPEN, progress)


def _after_needs(entry: Status, found: Mapping[str, Status]) -> Status:
    """The status, or that of a run that waits for others."""
    invalid = [need.key for need in entry.run.needs if found[need.key].state == INVALID]
    if invalid and entry.result is None:
        return Status(entry.run, INVALID, f"needs {', '.join(invalid)}")
    missing = [need.key for need in entry.run.needs if found[need.key].state != DONE]
    if entry.state in (OPEN, UNFINISHED) and missing:
        return Status(entry.run, WAITING, f"needs {', '.join(missing)}")
    return entry


def _progress(run: Run, folders: Folders) -> str:
    """Progress of an unfinished run; empty for a new one."""
    samples = algorithms.samples_so_far(run, folders.workplace(run.key))
    return "" if samples is None else f"{samples:,} samples so far"

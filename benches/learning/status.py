"""State of each run of a study: finished, stale, or still to be done."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any, Final

from benches.learning import algorithms, run_files
from benches.learning.experiments import Run, Study
from benches.learning.run_files import Folders
from rsoccer._core import build_info

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

MAX_CHANGE: Final = 120
"""Most characters of a change that are listed with both values."""


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
        settings = algorithms.settings(run)
    except (TypeError, ValueError) as error:
        return Status(run, INVALID, str(error), run_files.load(folders, run.key))
    missing = algorithms.missing_library(run)
    if missing and run_files.load(folders, run.key) is None:
        return Status(run, UNAVAILABLE, f"{missing} is not installed")
    if run_files.is_running(folders, run.key):
        return Status(run, RUNNING, _progress(run, folders))
    result = run_files.load(folders, run.key)
    if result is not None:
        changed = differences(run, study, folders, settings, result)
        return Status(run, STALE if changed else DONE, "; ".join(changed), result)
    progress = _progress(run, folders)
    return Status(run, UNFINISHED if progress else OPEN, progress)


def differences(
    run: Run,
    study: Study,
    folders: Folders,
    settings: Mapping[str, Any],
    result: Mapping[str, Any],
) -> list[str]:
    """Return what differs from the settings of a result and of the runs that it needed, in lines.

    A setting that is newer than the result counts as its default.

    Args:
        run: The run.
        study: Its study.
        folders: Folders with the results of the runs that it needs.
        settings: Present settings of the run.
        result: The result in its file.
    """
    protocol = {f"protocol.{name}": value for name, value in asdict(study.protocol).items()}
    kept_protocol = {f"protocol.{name}": value for name, value in result["protocol"].items()}
    now = {**settings, **protocol, "physics": build_info()["physics"]}
    ignored = algorithms.without_effect(run)
    settings_then = {n: v for n, v in result["settings"].items() if n not in ignored}
    kept = {**settings_then, **kept_protocol, "physics": result["physics"]}
    missing = {n: v for n, v in algorithms.defaults(run).items() if n in now and n not in kept}
    before = {**missing, **kept}
    changes = [
        _change(name, before.get(name), now.get(name))
        for name in {**now, **before}
        if now.get(name) != before.get(name)
    ]
    needed = run_files.needs(folders, run)
    return changes + [
        f"{key} has changed" for key, digest in needed.items() if result["needs"][key] != digest
    ]


def _change(name: str, before: object, now: object) -> str:
    text = f"{name} was {before!r}, now {now!r}"
    return text if len(text) <= MAX_CHANGE else f"{name} has changed"


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

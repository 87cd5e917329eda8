"""One run in this process: learning, evaluation and the file of its result."""

from __future__ import annotations

import json
import os
import platform
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from importlib import metadata
from itertools import zip_longest
from pathlib import Path
from typing import Any, Final

from benches.learning import conditions
from benches.learning.experiments import Run, Study
from benches.learning.run_files import Folders, load, save
from benches.learning.running import algorithms
from benches.learning.running.clock import spent
from benches.learning.running.evaluation import evaluate_run
from benches.learning.running.workplace import LEARNED_FILE, lock
from benches.result_files import this_machine
from rsoccer.evaluate.schedule import processors

PACKAGES: Final = ("numpy", "torch", "gymnasium", "stable-baselines3")


def execute(run: Run, study: Study, folders: Folders) -> Path | None:
    """Learn and evaluate one run, and write its result.

    Args:
        run: The run; an unfinished one continues.
        study: The study with its protocol.
        folders: Folders for files.

    Returns:
        Path of the result; None if another process works on this run.
    """
    folder = folders.workplace(run.key)
    with lock(folders, run.key) as held:
        if not held:
            return None
        machine = {**asdict(this_machine()), "cores": os.cpu_count(), "cores_used": processors()}
        identity = conditions.conditions(run, folders)
        learned = algorithms.learn(run, folder, folders, identity)
        (folder / LEARNED_FILE).touch()
        start = time.monotonic()
        evaluations = evaluate_run(run, learned, study.protocol, folders)
        result = {
            "run": run.key,
            "task": run.experiment.task,
            "algorithm": run.experiment.algorithm,
            "text": run.experiment.text,
            **identity,
            "protocol": asdict(study.protocol),
            "machine": machine,
            "libraries": libraries(),
            "samples": learned.samples,
            "seconds": {name: round(value, 1) for name, value in spent(folder).items()},
            "evaluation_seconds": round(time.monotonic() - start, 1),
            **learned.extra,
            "curve": learned.curve,
            "evaluations": evaluations,
        }
        if (before := load(folders, run.key)) is not None:
            changes = conditions.differences(run, study, folders, identity["settings"], before)
            sys.stdout.write(f"{run.key}: {comparison(changes, before, result)}\n")
        return save(folders, run.key, result)


def comparison(changes: Sequence[str], before: Mapping[str, Any], now: Mapping[str, Any]) -> str:
    """Return in words whether a run has repeated an earlier result.

    Args:
        changes: What differs from the conditions of the earlier result.
        before: The earlier result.
        now: The new one.
    """
    if changes:
        return f"replaces a result of other conditions: {'; '.join(changes)}"
    rows = zip_longest(before["evaluations"], now["evaluations"])
    for earlier, later in ((json.dumps(row) for row in pair) for pair in rows):
        if earlier != later:
            return f"other evaluations than in the earlier result: {earlier}, now {later}"
    return "the same evaluations as in the earlier result"


def libraries() -> dict[str, str]:
    """Return the versions of Python and of the libraries that are installed."""
    versions = {"python": platform.python_version()}
    for name in PACKAGES:
        try:
            versions[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    return versions


def pin(core: int | None) -> None:
    """Restrict this process to a processor, where the system can do that."""
    if core is not None and hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, {core})

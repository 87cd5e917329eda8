"""Command line of the study: `python -m benches.learning`.

Without options it works on all open runs, one process a core. It may be stopped at any time by
Ctrl-C; the next call continues.
"""

from __future__ import annotations

import argparse
import fnmatch
import importlib
import sys
import time
from collections.abc import Iterable, Sequence
from pathlib import Path

from benches.learning import conditions
from benches.learning.experiments import CLONES, Run, Study
from benches.learning.reporting.report import report
from benches.learning.run_files import Folders
from benches.learning.running import worker, workplace
from benches.learning.running.listing import best, listing
from benches.learning.running.pool import BUSY, Pool
from benches.learning.running.status import (
    DONE,
    INVALID,
    OPEN,
    STALE,
    UNAVAILABLE,
    UNFINISHED,
    WAITING,
    Status,
    statuses,
)
from rsoccer.evaluate.schedule import processors

TABLE = "benches.learning.table"


def main(arguments: Sequence[str] | None = None) -> int:
    """Work on the runs of a study, or list them; return the exit status.

    Args:
        arguments: Command line without the program name; default: that of the process.
    """
    options = parse_arguments(arguments)
    try:
        study = load_study(options.table)
    except ValueError as error:
        sys.stderr.write(f"{error}\n")
        return 2
    folders = Folders(options.results.resolve(), options.work.resolve())
    if options.worker:
        worker.pin(options.core)
        written = worker.execute(study.run(options.worker), study, folders)
        return BUSY if written is None else 0
    if options.report:
        sys.stdout.write("".join(f"{path}\n" for path in report()))
        return 0
    try:
        known = statuses(study, folders)
    except ValueError as error:
        sys.stderr.write(f"{error}\n")
        return 2
    chosen = [entry for entry in known if selected(entry.run, options)]
    if not chosen:
        sys.stderr.write("--group, --only and --seeds: expected a run of the study, got none\n")
        return 2
    if options.list:
        sys.stdout.write(listing(chosen, known, options.jobs) + "\n")
        return 0
    if options.best:
        sys.stdout.write(best(chosen, folders) + "\n")
        return 0
    return work(chosen, known, options)


def load_study(table: str) -> Study:
    """Return the study of a module.

    Raises:
        ValueError: There is no such module, or it has no `STUDY`.
    """
    try:
        study = getattr(importlib.import_module(table), "STUDY", None)
    except ModuleNotFoundError as error:
        raise ValueError(
            f"--table: expected a module with a STUDY, got {table}: {error}"
        ) from error
    if not isinstance(study, Study):
        raise ValueError(f"--table: expected a module with a STUDY, got {table}, which has none")
    return study


def work(chosen: Sequence[Status], known: Sequence[Status], options: argparse.Namespace) -> int:
    """Work on the open runs among the chosen ones; return the exit status.

    Args:
        chosen: States of the selected runs.
        known: States of all runs.
        options: Options of the command line.
    """
    folders = Folders(options.results.resolve(), options.work.resolve())
    for entry in chosen:
        if entry.state == STALE and not options.rerun_stale:
            sys.stdout.write(f"stale, kept as it is: {entry.run.key}: {entry.reason}\n")
            sys.stdout.write("--rerun-stale repeats it\n")
        if entry.state in (UNAVAILABLE, INVALID):
            sys.stderr.write(f"{entry.state}: {entry.run.key}: {entry.reason}\n")
    done = {entry.run.key for entry in known if entry.state == DONE}
    again = repeated(chosen, folders) if options.again else set()
    wanted = (OPEN, UNFINISHED, WAITING, *([STALE] if options.rerun_stale else []))
    runs = with_libraries(
        entry.run for entry in chosen if entry.state in wanted or entry.run.key in again
    )
    if not runs:
        sys.stdout.write("nothing to do; --list shows the state of the runs\n")

    def command(run: Run, core: int | None) -> list[str]:
        places = ["--results", str(options.results), "--work", str(options.work)]
        place = [] if core is None else ["--core", str(core)]
        module = [sys.executable, "-m", "benches.learning", "--table", options.table]
        return [*module, *places, *place, "--worker", run.key]

    minutes = options.budget_minutes
    deadline = float("inf") if minutes is None else time.monotonic() + 60.0 * minutes
    pool = Pool(options.jobs, command, deadline)
    pool.work(runs, done - again)
    if pool.failed:
        sys.stdout.write(f"failed: {', '.join(pool.failed)}\n")
    invalid = any(entry.state == INVALID for entry in chosen)
    return 1 if pool.failed or invalid else 0


def repeated(chosen: Sequence[Status], folders: Folders) -> set[str]:
    """Return the keys of the finished runs whose policy is not here."""
    # Clones learn nothing, so they lack no policy.
    runs = [entry.run for entry in chosen if entry.state == DONE]
    keys = (run.key for run in runs if run.experiment.algorithm != CLONES)
    return {key for key in keys if not workplace.keeps_policy(folders, key)}


def with_libraries(runs: Iterable[Run]) -> list[Run]:
    """Return the runs whose libraries are installed, and name the others."""
    found = []
    for run in runs:
        if library := conditions.missing_library(run):
            sys.stderr.write(f"{UNAVAILABLE}: {run.key}: {library} is not installed\n")
        else:
            found.append(run)
    return found


def selected(run: Run, options: argparse.Namespace) -> bool:
    """Return whether the options select a run."""
    groups, patterns, seeds = options.group, options.only, options.seeds
    if groups and run.experiment.group not in groups:
        return False
    if seeds is not None and run.seed >= seeds:
        return False
    return not patterns or any(fnmatch.fnmatch(run.key, f"*{pattern}*") for pattern in patterns)


def parse_arguments(arguments: Sequence[str] | None) -> argparse.Namespace:
    """Return the options of a command line."""
    default = Folders()
    parser = argparse.ArgumentParser(prog="python -m benches.learning", description=__doc__)
    add = parser.add_argument
    add("--list", action="store_true", help="print the runs that are done and open, run nothing")
    add("--best", action="store_true", help="print the best seed of each experiment, its policy")
    add("--report", action="store_true", help="write the pages of the study and their pictures")
    add("--group", action="append", help="only this group; may be repeated")
    add("--only", action="append", help="only runs whose name contains this; may be repeated")
    add("--seeds", type=int, help="only the first seeds")
    add("--jobs", type=int, default=processors(), help="processes at once (default: one a core)")
    add("--budget-minutes", type=float, help="start no run after this time")
    add("--rerun-stale", action="store_true", help="run again what has other settings now")
    add("--again", action="store_true", help="repeat finished runs whose policy is not here")
    add("--table", default=TABLE, help="module with the STUDY (default: %(default)s)")
    add("--results", type=Path, default=default.results, help="folder of the results")
    add("--work", type=Path, default=default.work, help="folder of checkpoints and policies")
    add("--worker", help=argparse.SUPPRESS)
    add("--core", type=int, help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    for name, least in (("jobs", 1), ("seeds", 1), ("budget_minutes", 0.0)):
        value = getattr(options, name)
        if value is not None and not value >= least:
            parser.error(f"--{name.replace('_', '-')} must be at least {least}, got {value}")
    own = (options.table, options.results, options.work) == (TABLE, default.results, default.work)
    if options.report and not own:
        parser.error("--report writes the pages of this study: no --table, --results or --work")
    return options


if __name__ == "__main__":
    sys.exit(main())

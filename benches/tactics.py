"""Learned tactics in matches: `python -m benches.tactics 0=out/evolve-0 1=out/evolve-1`.

A name and the folder of a run of `rsoccer evolve` stand for the policy of the run; `best` and
`best:robust`, without a folder, are those of the package. Each plays whole matches of two minutes
against the scripted side with the numbers that were set by hand. With `--passing`, `keep` and
`best` play keepaway and 2 v 1. The result file gets every row at once. Trials that it has of the
same tactics are left out.
"""

import argparse
import hashlib
import json
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

import rsoccer
from benches.markdown import table
from benches.result_files import RESULTS
from rsoccer import files
from rsoccer.evaluate import Evaluation
from rsoccer.evaluate.episodes import EpisodeRunner
from rsoccer.evaluate.results import bootstrap_interval, bootstrap_rate
from rsoccer.evaluate.schedule import processors
from rsoccer.lineup import lineup
from rsoccer.policies import make_policy
from rsoccer.policies.evolved import Evolved
from rsoccer.policies.ssl.team import ScriptedSsl
from rsoccer.task import LEARN
from rsoccer.train.run.folder import POLICY_FILE

FILE: Final = RESULTS / "tactics.json"
"""Results by trial and policy."""
MATCHES: Final = 100
"""Matches of each trial, half of them for each team."""
HALF_SECONDS: Final = 60.0
"""Playing time of a half, s."""
DIVISION_A: Final = {"division": "A", "n_blue": 11, "n_yellow": 11}
"""Options of matches of eleven."""


@dataclass(frozen=True)
class Trial:
    """Matches against a script."""

    title: str
    """size of the teams, and senses"""
    opponent: str
    """policy of the other team"""
    options: tuple[tuple[str, Any], ...] = ()
    """options of the task"""
    sensing: str | None = None
    """senses of the robots; None if they know the true state"""

    @property
    def key(self) -> str:
        """Name of the trial in the file."""
        return f"{self.title}, {self.opponent}"


TRIALS: Final = (
    Trial("6 v 6", "scripted:0.5"),
    Trial("6 v 6", "scripted"),
    Trial("11 v 11", "scripted:0.5", tuple(DIVISION_A.items())),
    Trial("11 v 11", "scripted", tuple(DIVISION_A.items())),
    Trial("6 v 6, `rc2021`", "scripted:0.5", sensing="rc2021"),
    Trial("6 v 6, frames 90 ms late", "scripted:0.5", sensing="delay=0.09"),
)
"""Trials, in the order of the table."""

PASSING: Final[dict[str, tuple[str, dict[str, int]]]] = {
    "3 v 2": ("SSLKeepaway-v0", {}),
    "4 v 3": ("SSLKeepaway-v0", {"n_keepers": 4, "n_takers": 3}),
    "2 v 1": ("SSLPassEnduranceMulti-v1", {"n_opponents": 1}),
}
"""Tasks with passes, and their options."""
PASSERS: Final = ("keep", "best")
"""Policies that play them."""
EPISODES: Final = 300
"""Episodes of each."""
SEED: Final = 5
"""Seed of their starts."""

Rows = dict[str, dict[str, Any]]
"""Evaluations by the key of the trial and the name of the policy."""


def measure(policy: str, trial: Trial, threads: int | None) -> Evaluation:
    """Return the evaluation of a policy in a trial.

    Args:
        policy: the policy, or the path of its file.
        trial: the trial.
        threads: threads of the simulator; None for all.
    """
    task = rsoccer.make_task("SSLMatch-v0", half_seconds=HALF_SECONDS, **dict(trial.options))
    return rsoccer.evaluate(
        policy, trial.opponent, MATCHES, task=task, sensing=trial.sensing, threads=threads
    )


def measure_passing(policy: str, title: str, threads: int | None) -> dict[str, Any]:
    """Return the means of a policy in a task with passes, with intervals.

    A pass that does not arrive ends an episode of 2 v 1, unless its time is over before. So the
    share that arrives is that of the passes in passes and such ends.

    Args:
        policy: the policy.
        title: one of `PASSING`.
        threads: threads of the simulator; None for all.
    """
    name, options = PASSING[title]
    task = rsoccer.make_task(name, **options)
    made = make_policy(policy, task)
    line_up = lineup(task, LEARN, None, None)
    count = processors() if threads is None else threads
    found = EpisodeRunner(task, line_up, made, EPISODES, count).run(EPISODES, SEED)
    limit = task.max_steps * task.config.time_step
    failed = (found.seconds < limit - task.config.time_step).astype(np.float64)
    measures = {"possession": found.metrics["possession"], "passes": found.metrics["passes"]}
    rng = np.random.default_rng(0)
    row: dict[str, Any] = {
        name: asdict(bootstrap_interval([values], rng)) for name, values in measures.items()
    }
    if title == "2 v 1":
        passes = found.metrics["passes"]
        pairs = np.stack([passes, passes + failed], axis=1)
        row["arrived"] = asdict(bootstrap_rate([pairs], rng))
    return row


def passing_report() -> str:
    """Return the table of keepaway and 2 v 1."""
    rows = []
    for title in PASSING:
        for policy, row in load().get(title, {}).items():
            cells = (_mean(row.get(name), digits) for name, digits in _PASSING_COLUMNS.items())
            rows.append((title, f"`{policy}`", *cells))
    header = ("situation", "policy", "possession (s)", "passes", "passes that arrive")
    return table(header, rows)


_PASSING_COLUMNS: Final = {"possession": 1, "passes": 1, "arrived": 3}
"""Measures, and digits of their cells."""


def _mean(row: dict[str, float] | None, digits: int) -> str:
    """A mean with its interval."""
    if row is None:
        return "-"
    mean, low, high = (f"{row[name]:.{digits}f}" for name in ("mean", "low", "high"))
    return f"{mean} ({low} to {high})"


def load() -> Rows:
    """Return the results of the file."""
    found: Rows = json.loads(FILE.read_text()) if FILE.exists() else {}
    return found


def report() -> str:
    """Return the table of the results."""
    found, rows = load(), []
    for trial in TRIALS:
        for name, row in found.get(trial.key, {}).items():
            rows.append((trial.title, f"`{trial.opponent}`", f"`{name}`", *_cells(row)))
    header = ("matches", "against", "tactics", "won", "drawn", "lost", "goals", "goal difference")
    return table((*header, "passes a minute", "fouls a minute"), rows)


def _cells(row: dict[str, Any]) -> tuple[str, ...]:
    """Cells of an evaluation."""
    metrics = row["metrics"]
    minutes = 2 * HALF_SECONDS / 60.0  # of playing time
    counts = (row["wins"], row["draws"], row["losses"])
    return (
        *(str(count) for count in counts),
        f"{metrics['own_goals']:.2f} : {metrics['opponent_goals']:.2f}",
        f"{row['score']:.2f} ({row['low']:.2f} to {row['high']:.2f})",
        f"{metrics['own_passes'] / minutes:.1f}",
        f"{metrics['own_fouls'] / minutes:.2f}",
    )


def _digest(policy: str) -> str:
    """Digest of the tactics of a policy."""
    task = rsoccer.make_task("SSLMatch-v0")
    made = make_policy(policy, task)
    tactics = made.tactics if isinstance(made, Evolved) else ScriptedSsl(task).tactics
    return hashlib.sha256(tactics.tobytes()).hexdigest()[:16]


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure what the file lacks, and print the table.

    Args:
        arguments: words of the command line; None for those of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", nargs="*", metavar="NAME=FOLDER", help="runs of rsoccer evolve")
    parser.add_argument("--trials", nargs="+", help="keys of trials; all by default")
    parser.add_argument("--passing", action="store_true", help="play keepaway and 2 v 1, too")
    parser.add_argument("--threads", type=int, help="threads of the simulator")
    given = parser.parse_args(arguments)
    known = {trial.key: trial for trial in TRIALS}
    if unknown := sorted(set(given.trials or ()) - set(known)):
        parser.error(f"--trials: unknown {unknown}; expected some of {list(known)}")
    trials = [known[key] for key in given.trials or known]
    for run in given.runs:
        name, _, folder = run.partition("=")
        policy = str(Path(folder) / POLICY_FILE) if folder else name
        digest = _digest(policy)
        for trial in trials:
            if load().get(trial.key, {}).get(name, {}).get("digest") == digest:
                continue
            sys.stderr.write(f"{trial.key}: {name}\n")
            row = asdict(measure(policy, trial, given.threads))
            found = load()
            found.setdefault(trial.key, {})[name] = {**row, "policy": name, "digest": digest}
            files.write_atomically(FILE, (json.dumps(found, indent=1) + "\n").encode())
    for title in PASSING if given.passing else ():
        for policy in PASSERS:
            found = load()
            row = measure_passing(policy, title, given.threads)
            found.setdefault(title, {})[policy] = row
            files.write_atomically(FILE, (json.dumps(found, indent=1) + "\n").encode())
    sys.stdout.write(f"{report()}\n{passing_report()}\n")


if __name__ == "__main__":
    main()

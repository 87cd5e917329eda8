"""Scores of policies with delays, without and with a forecast: `python -m benches.forecast`.

Each task is evaluated with late commands, late cameras and a whole preset, with and without
`forecast`, and without any of it. Results are kept in a file, so that a run that was stopped goes
on where it was. Scores depend on neither time nor machine.
"""

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import rsoccer
from benches.markdown import table
from rsoccer import Sensing, files

STORED: Final = Path(__file__).parent / "results" / "forecast.json"
"""Results that the documentation shows."""

TASKS: Final = (
    "SSLGoToBall-v0",
    "VSS-v0",
    "SSLContestedPossession-v0",
    "SSLStaticDefenders-v0",
    "SSLDribbling-v0",
    "SSLPassEnduranceMulti-v1",
    "SSLPassEndurance-v1",
)
DELAYS: Final[Mapping[str, dict[str, Any]]] = {
    "commands 25 ms late": {"command_delay": 0.025},
    "commands 50 ms late": {"command_delay": 0.05},
    "commands 100 ms late": {"command_delay": 0.1},
    "cameras 90 ms late": {"delay": 0.09},
    "rc2021": {"name": "rc2021"},
}
"""Numbers of `Sensing` by condition."""
EXACT: Final = "exact"
FORECAST: Final = ", forecast"
FORECAST_ALL: Final = ", forecast of all"


def conditions() -> dict[str, Sensing | None]:
    """Return what lies between the truth and the robots, by condition."""
    known: dict[str, Sensing | None] = {EXACT: None}
    for name, numbers in DELAYS.items():
        known[name] = Sensing(**numbers)
        known[name + FORECAST] = Sensing(**numbers, forecast=1.0)
        known[name + FORECAST_ALL] = Sensing(**numbers, forecast=1.0, forecast_others=1.0)
    return known


def score(task: str, sensing: Sensing | None, policy: str, matches: int) -> dict[str, float | None]:
    """Return the score of a policy and its 95% interval.

    Args:
        task: name of the task.
        sensing: what robots know.
        policy: name of the policy.
        matches: number of matches.
    """
    found = rsoccer.evaluate(policy, None, matches, 0, task=task, sensing=sensing, threads=1)
    return {"score": found.score, "low": found.low, "high": found.high}


def report(results: Mapping[str, Mapping[str, Mapping[str, float | None]]]) -> str:
    """Return results as a Markdown table, with a row for each condition.

    Args:
        results: score and interval by task and condition.
    """
    rows = [
        (name, *(_cell(row[name]) if name in row else "-" for row in results.values()))
        for name in conditions()
        if any(name in row for row in results.values())
    ]
    return table(("condition", *(f"`{task}`" for task in results)), rows)


def _cell(result: Mapping[str, float | None]) -> str:
    """A score with its interval."""
    if result["low"] is None or result["high"] is None:
        return f"{result['score']:.3g}"
    return f"{result['score']:.3g} ({result['low']:.3g} to {result['high']:.3g})"


def main(arguments: Sequence[str] | None = None) -> None:
    """Evaluate, and print the table.

    Args:
        arguments: words of the command line; None for those of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--policy", default="best", help="policy of the learners")
    parser.add_argument("--matches", type=int, default=200, help="matches of each score")
    parser.add_argument("--tasks", nargs="+", default=TASKS, help="names of tasks")
    parser.add_argument("--conditions", nargs="+", help="names of conditions, all by default")
    parser.add_argument("--results", type=Path, help="file in which results are kept")
    given = parser.parse_args(arguments)
    known = conditions()
    chosen = given.conditions or list(known)
    unknown = sorted(set(chosen) - set(known))
    if unknown:
        parser.error(f"--conditions: unknown {unknown}; expected some of {list(known)}")
    results: dict[str, dict[str, dict[str, float | None]]] = {}
    if given.results and given.results.exists():
        results = json.loads(given.results.read_text())
    for name in chosen:
        for task in given.tasks:
            row = results.setdefault(task, {})
            if name not in row:
                row[name] = score(task, known[name], given.policy, given.matches)
                sys.stderr.write(f"{task}, {name}: {_cell(row[name])}\n")
                if given.results:
                    content = json.dumps(results, indent=1) + "\n"
                    files.write_atomically(given.results, content.encode())
    sys.stdout.write(report(results) + "\n")


if __name__ == "__main__":
    main()

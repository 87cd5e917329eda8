"""Measures how well the shipped policies solve the tasks: `python -m tools.site.solved`.

The results are in docs/solved.json; the pages of the tasks show them. `make docs` runs this.
`--only TASK ...` measures some tasks, and keeps the results of the others.
"""

import argparse
import json
from collections.abc import Sequence
from typing import Any, Final

import rsoccer
from benches.solvers import SOLVERS
from rsoccer._core import build_info
from tools.paths import DOCS

FILE: Final = DOCS / "solved.json"
MATCHES: Final = 200
OPTIONS: Final[dict[str, dict[str, Any]]] = {
    name: {"half_seconds": 30.0, "halves": 1} for name in ("SSLMatch-v0", "VSSMatch-v0")
}
"""Options by task: whole matches would take an hour."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Play every task, or some, and write the results.

    Args:
        arguments: Command line without the program name; default: that of the process.
    """
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--only", nargs="+", choices=sorted(SOLVERS), help="tasks to measure")
    only = parser.parse_args(arguments).only
    known = load()["tasks"] if only else {}
    results = {
        name: measured(name, policy) if only is None or name in only else known[name]
        for name, policy in sorted(SOLVERS.items())
    }
    kept = {"physics": build_info()["physics"], "matches": MATCHES, "tasks": results}
    FILE.write_text(json.dumps(kept, indent=2) + "\n")


def measured(task: str, policy: str) -> dict[str, Any]:
    """Return the evaluation of a policy at a task, as numbers and texts for JSON."""
    options = OPTIONS.get(task, {})
    found = rsoccer.evaluate(
        policy, matches=MATCHES, task=rsoccer.make_task(task, **options), seed=0
    )
    assert found.low is not None and found.high is not None, "enough matches for an interval"
    return {
        "policy": policy,
        "options": options,
        "opponent": found.opponent,
        "metric": found.metric,
        "score": round(found.score, 3),
        "low": round(found.low, 3),
        "high": round(found.high, 3),
        "seconds": round(found.seconds.mean, 1),
    }


def load() -> dict[str, Any]:
    """Return the results that were written last."""
    kept: dict[str, Any] = json.loads(FILE.read_text())
    return kept


if __name__ == "__main__":
    main()

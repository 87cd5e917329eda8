"""Starts that every policy loses at once: a bound on the score against an opponent.

    python -m benches.learning --again --group ppo --only VSSSelfPlay
    python -m benches.learning.running.lost_starts

The first command learns the policies that are not in `out/learning`.

A start is a random state, and in some the opponent has the ball in front of the empty goal. The
study's policies of the task and the scripts play the same starts. What all of them lose within
2 s is hardly a matter of skill, and a policy that wins all other matches scores 1 - 2 * share.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from benches.learning.experiments import Run
from benches.learning.run_files import LOST_STARTS, Folders, digest, load
from benches.learning.running.workplace import keeps_policy
from benches.learning.table import STUDY
from rsoccer.evaluate import first_seed
from rsoccer.evaluate.episodes import EpisodeRunner
from rsoccer.files import write_atomically
from rsoccer.lineup import lineup
from rsoccer.policies import make_policy
from rsoccer.registry import make_task
from rsoccer.task import LEARN
from rsoccer.view import SIDES

TASK: Final = "VSSSelfPlay-v0"
EXPERIMENTS: Final = ("ppo/VSSSelfPlay-v0",)
"""Experiments whose policies have learned to play the task's teams."""
SCRIPTS: Final = ("chase", "scripted")
OPPONENTS: Final = ("chase", "scripted")
SECONDS: Final = 2.0
"""Time within which a start counts as lost at once."""


def measure(policies: Sequence[str], starts: int, seed: int) -> list[dict[str, Any]]:
    """Return, for each opponent, the shares of starts that policies lose at once.

    Args:
        policies: names or files.
        starts: starts per side, those of the study's protocol.
        seed: seed of the protocol.
    """
    rows = []
    for opponent in OPPONENTS:
        lost = np.array([_lost(policy, opponent, starts, seed) for policy in policies])
        share = float(lost.all(axis=0).mean())
        rows.append(
            {
                "opponent": opponent,
                "policies": len(policies),
                "starts": lost.shape[1],
                "lost_by_all": round(share, 4),
                "least_lost_by_one": round(float(lost.mean(axis=1).min()), 4),
                "highest_score": round(1.0 - 2.0 * share, 4),
            }
        )
    return rows


def _lost(policy: str, opponent: str, starts: int, seed: int) -> NDArray[np.bool_]:
    """(2 * starts,) whether a policy loses a start within `SECONDS`, from both sides."""
    task = make_task(TASK)
    own, other = make_policy(policy, task), make_policy(opponent, task)
    lost = []
    for index, side in enumerate(SIDES):
        runner = EpisodeRunner(task, lineup(task, LEARN, other, side), own, 250, 1)
        episodes = runner.run(starts, first_seed(seed, index))
        against = episodes.scores * (1 - 2 * index) < 0.0
        lost.append(against & (episodes.seconds < SECONDS))
    return np.concatenate(lost)


def runs_of(folders: Folders) -> dict[str, str]:
    """Return the finished runs whose policies are in the work folder: digests by key.

    Raises:
        FileNotFoundError: There are no such runs.
    """
    found = {}
    for experiment in STUDY.experiments:
        if experiment.key in EXPERIMENTS:
            for run in (Run(experiment, seed) for seed in range(experiment.seeds)):
                result = load(folders, run.key)
                if result is not None and keeps_policy(folders, run.key):
                    found[run.key] = digest(result)
    if not found:
        raise FileNotFoundError(
            f"expected policies of {', '.join(EXPERIMENTS)} in {folders.work}, got none; "
            "`python -m benches.learning --again --group ppo --only VSSSelfPlay` learns them"
        )
    return found


def policies_of(folders: Folders, runs: Iterable[str]) -> list[str]:
    """Return the policies of runs, with and without noise, and the scripts."""
    files = (folders.policy(key) for key in runs)
    return [*(f"{path}:{mode}" for path in files for mode in ("sample", "mean")), *SCRIPTS]


def main() -> int:
    """Measure, write the result and print it."""
    folders = Folders()
    runs = runs_of(folders)
    rows = measure(policies_of(folders, runs), STUDY.protocol.starts, STUDY.protocol.seed)
    text = json.dumps({"runs": runs, "seconds": SECONDS, "rows": rows}, indent=1) + "\n"
    write_atomically(folders.results / LOST_STARTS, text.encode())
    sys.stdout.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())

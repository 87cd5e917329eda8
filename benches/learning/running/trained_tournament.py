"""Tournament of the package's trained policies for teams of VSSS, and of the scripts.

python -m benches.learning.running.trained_tournament
"""

from __future__ import annotations

import dataclasses
import json
import sys
from pathlib import Path
from typing import Any, Final

from benches.learning.conditions import weights_digest
from benches.learning.run_files import TOURNAMENT, TOURNAMENT_PICTURE, Folders
from rsoccer.evaluate.tournament import tournament
from rsoccer.files import write_atomically
from rsoccer.policies import trained
from rsoccer.policies.network import Network

TASK: Final = "VSSSelfPlay-v0"
SCRIPTS: Final = ("scripted", "chase", "ou", "zero")
MATCHES: Final = 200
"""Matches of each pair."""
SEED: Final = 31


def measure(matches: int, picture: Path) -> dict[str, Any]:
    """Play the tournament, draw its picture, and return its standings and cycles.

    Args:
        matches: matches of each pair, even.
        picture: the PNG file to write.
    """
    result = tournament([*_files().values(), *SCRIPTS], matches, SEED, task=TASK)
    result.save_picture(picture)
    # A policy is named by its label: its path is one of this machine.
    standings = [
        {**dataclasses.asdict(standing), "policy": standing.label} for standing in result.standings
    ]
    return {
        "task": TASK,
        "matches": matches,
        "files": file_digests(),
        "standings": standings,
        "cycles": result.cycles,
    }


def file_digests() -> dict[str, str]:
    """Return what the trained policies play with, by task: weights, and steps of a decision."""
    networks = {name: Network.load(path) for name, path in _files().items()}
    return {name: f"{weights_digest(n)}, {n.action_repeat}" for name, n in networks.items()}


def _files() -> dict[str, Path]:
    return {name: path for name, path in trained.list_trained().items() if name.startswith("VSS")}


def main() -> int:
    """Play, write the result and print it."""
    text = json.dumps(measure(MATCHES, TOURNAMENT_PICTURE), indent=1) + "\n"
    write_atomically(Folders().results / TOURNAMENT, text.encode())
    sys.stdout.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())

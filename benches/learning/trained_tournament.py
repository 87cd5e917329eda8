"""Tournament of the package's trained policies for teams of VSSS, and of the scripts.

python -m benches.learning.trained_tournament
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
import sys
from pathlib import Path
from typing import Any, Final

from benches.learning.run_files import Folders
from benches.result_files import ROOT
from rsoccer.evaluate.cycles import in_words
from rsoccer.evaluate.tournament import tournament
from rsoccer.files import write_atomically
from rsoccer.policies import trained
from tools.markdown import table

TASK: Final = "VSSSelfPlay-v0"
SCRIPTS: Final = ("scripted", "chase", "ou", "zero")
MATCHES: Final = 200
"""Matches of each pair."""
SEED: Final = 31
FILE: Final = "tournament.json"
PICTURE: Final = ROOT / "docs" / "learning_tournament.png"


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
        "matches": matches,
        "files": file_digests(),
        "standings": standings,
        "cycles": result.cycles,
    }


def file_digests() -> dict[str, str]:
    """Return the SHA-256 digests of the trained policies' files, by task."""
    return {name: hashlib.sha256(path.read_bytes()).hexdigest() for name, path in _files().items()}


def _files() -> dict[str, Path]:
    return {name: path for name, path in trained.list_trained().items() if name.startswith("VSS")}


def section(folders: Folders) -> str:
    """Return the table of the ratings, with the cycles; empty without a result."""
    path = folders.results / FILE
    if not path.is_file():
        return ""
    result = json.loads(path.read_text())
    rows = [
        (
            f"`{row['label']}`",
            f"{row['rating']:.0f}",
            "-" if row["low"] is None else f"{row['low']:.0f} to {row['high']:.0f}",
            f"{row['wins']}, {row['draws']}, {row['losses']}",
            f"{row['score']:.2f}",
        )
        for row in result["standings"]
    ]
    header = ("policy", "rating", "95% interval", "won, drawn, lost", "goal score")
    return (
        f"{table(header, rows)}\n\n{TASK}, {result['matches']} matches of each pair, half from "
        f"each side; Bradley-Terry ratings on the scale of Elo, where `ou` has 1000. Cycles of "
        f"wins: {in_words(result['cycles'])}. "
        "(`python -m benches.learning.trained_tournament`)\n\n"
        f"![Goal scores of each pair, and ratings]({PICTURE.name})"
    )


def main() -> int:
    """Play, write the result and print it."""
    folders = Folders()
    result = measure(MATCHES, PICTURE)
    write_atomically(folders.results / FILE, (json.dumps(result, indent=1) + "\n").encode())
    sys.stdout.write(section(folders) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())

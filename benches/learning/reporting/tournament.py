"""The tournament of the trained policies as a table."""

from __future__ import annotations

import json

from benches.learning.run_files import TOURNAMENT, TOURNAMENT_PICTURE, Folders
from benches.markdown import table
from rsoccer.evaluate.cycles import in_words


def section(folders: Folders) -> str:
    """Return the table of the ratings, with the cycles; empty without a result."""
    path = folders.results / TOURNAMENT
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
        f"{table(header, rows)}\n\n{result['task']}, {result['matches']} matches of each pair, "
        "half from each side; Bradley-Terry ratings on the scale of Elo, where `ou` has 1000. "
        f"Cycles of wins: {in_words(result['cycles'])}. "
        "(`python -m benches.learning.running.trained_tournament`)\n\n"
        f"![Goal scores of each pair, and ratings]({TOURNAMENT_PICTURE.name})"
    )

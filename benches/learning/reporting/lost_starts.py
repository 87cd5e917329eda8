"""Starts that every policy loses at once, in words."""

from __future__ import annotations

import json

from benches.learning.run_files import LOST_STARTS, Folders


def sentences(folders: Folders) -> str:
    """Return the result in words; empty without one."""
    path = folders.results / LOST_STARTS
    if not path.is_file():
        return ""
    result = json.loads(path.read_text())
    first, *_ = result["rows"]
    lines = [
        f"Some of the {first['starts']} starts are lost within {result['seconds']:g} s by all of "
        f"{first['policies']} policies: learned ones with and without noise, and scripts. They "
        "bound the score of any policy:",
        *(
            f"- Against `{row['opponent']}` all lose {row['lost_by_all']:.1%} of them, and the "
            f"best policy loses {row['least_lost_by_one']:.1%}. A score above "
            f"{row['highest_score']:.2f} needs wins from starts that all lose."
            for row in result["rows"]
        ),
    ]
    command = "`python -m benches.learning.running.lost_starts` measures them."
    return "\n\n".join([lines[0], "\n".join(lines[1:]), command])

"""Matches on the site: for each task a page that plays one of the policy that plays it best.

Tasks of whole matches under a referee have one up to its end.
"""

from pathlib import Path
from typing import Final

import rsoccer
from benches.solvers import SOLVERS
from rsoccer.lineup import lineup, opponents_of
from rsoccer.replay import Replay, record_replay
from tools import whole_matches
from tools.task_pictures import SEEDS
from tools.whole_matches import WHOLE_MATCHES

FOLDER: Final = "matches"
"""Folder of the pages on the site."""
SECONDS: Final = 12.0
"""Duration of play; pages stay small."""
WHOLE_SECONDS: Final = whole_matches.SECONDS
"""Longest duration of a whole match."""
HEIGHT: Final = 620
"""Height of a match within the page of a task, pixels."""


def write(folder: Path) -> None:
    """Write a page for each registered task.

    Args:
        folder: Folder of the pages; created if it does not exist.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for name in rsoccer.list_tasks():
        record(name).save_html(folder / f"{name}.html")


def record(name: str) -> Replay:
    """Return a match of the policy that plays a task best, or a whole match, from a fixed seed."""
    if name in WHOLE_MATCHES:
        return whole_matches.record(name, WHOLE_SECONDS)
    task, solver = rsoccer.make_task(name), SOLVERS[name]
    names = (solver.upper(), " ".join(opponents_of(task)).upper())
    return record_replay(task, lineup(task, solver), SEEDS.get(name, 0), SECONDS, names=names)


def shown(name: str) -> str:
    """Return the part of a task's page that shows its match."""
    page = f"../{FOLDER}/{name}.html"
    whole = WHOLE_MATCHES.get(name)
    teams = f"`{SOLVERS[name]}`" if whole is None else f"`{whole.blue}` and `{whole.yellow}`"
    return (
        f"Played by {teams}. A pointer over a robot shows its numbers and its reward; "
        f'<a href="{page}">on a page of its own</a> keys work too. `rsoccer watch --html` writes '
        "such a page: see [Replays](../replays.md).\n\n"
        f'<iframe src="{page}" title="A match of {name}" loading="lazy" width="100%" '
        f'height="{HEIGHT}" style="border: 0"></iframe>'
    )

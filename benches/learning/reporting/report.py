"""The report of the study: generated parts of its pages, and pictures."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Final

from benches.learning.reporting import (
    lost_starts,
    paper_claims,
    robustness,
    settings_table,
    tables,
)
from benches.learning.reporting import tournament as tournament_table
from benches.learning.reporting.collection import Collected, collect
from benches.learning.reporting.pictures import draw_ablation, draw_curves
from benches.learning.run_files import Folders
from benches.learning.table import STUDY, TASKS
from benches.markdown import filled
from benches.result_files import ROOT

DOCS: Final = ROOT / "docs"
PAGES: Final = (DOCS / "learning.md", DOCS / "learning-protocol.md", DOCS / "robustness.md")
CURVES: Final = "learning_curves.png"
ABLATION: Final = "learning_ablation.png"


def report() -> Iterator[Path]:
    """Draw the pictures, and write the generated parts of the pages.

    Yields:
        Path of each file.
    """
    yield from draw(_collected(), DOCS)
    for page in PAGES:
        page.write_text(filled(page.read_text(), PARTS, page.name))
        yield page


def draw(collected: list[Collected], folder: Path) -> list[Path]:
    """Draw the pictures for which there are results, and return their paths."""
    paths = (
        draw_curves(collected, folder / CURVES),
        draw_ablation(collected, folder / ABLATION),
    )
    return [path for path in paths if path is not None]


def results() -> str:
    """Return the results of PPO, the learning curves, and starts that no policy survives."""
    text = tables.results(_collected()) or "No run has finished yet."
    picture = _picture(CURVES, "Learning curves of all tasks")
    parts = (text, picture, tables.details(_collected()), lost_starts.sentences(Folders()))
    return "\n\n".join(part for part in parts if part)


def baselines() -> str:
    """Return DDPG and SAC beside PPO, and the paper's order of them; empty without results."""
    return _section("PPO, DDPG and SAC", _baselines_and_order)


def ablation() -> str:
    """Return the table and the picture of the ablation; empty without results."""
    text = _section("PPO in the setting of the paper", tables.ablation)
    return f"{text}\n\n{_picture(ABLATION, 'Bars of the ablation')}".strip() if text else ""


def settings() -> str:
    """Return the table of the settings of PPO."""
    return settings_table.settings(TASKS)


def cooperation() -> str:
    """Return the table of teams, clones and critics; empty without results."""
    return _section("Cooperation", tables.cooperation)


def tournament() -> str:
    """Return the tournament of the trained policies; empty without a result."""
    text = tournament_table.section(Folders())
    return f"## Tournament\n\n{text}" if text else ""


def compute() -> str:
    """Return the table of the time that the study took; empty without results."""
    return _section("Compute", tables.compute)


def shipped() -> str:
    """Return the comparison of the policies `best` and `best:robust`; empty without results."""
    return robustness.shipped(_collected())


def conditions() -> str:
    """Return the scores of all policies under each condition; empty without results."""
    parts = (robustness.missing(_collected()), robustness.conditions(_collected()))
    return "\n\n".join(part for part in parts if part)


def _baselines_and_order(collected: list[Collected]) -> str:
    """Both tables; empty without results."""
    text, order = tables.baselines(collected), paper_claims.order(collected)
    return f"{text}\n\n### The order of the algorithms\n\n{order}" if order else text


def _section(title: str, write: Callable[[list[Collected]], str]) -> str:
    """A table under a title; empty without results."""
    text = write(_collected())
    return f"## {title}\n\n{text}" if text else ""


def _picture(name: str, text: str) -> str:
    return f"![{text}]({name})" if (DOCS / name).exists() else ""


def _collected() -> list[Collected]:
    return collect(STUDY, Folders())


PARTS: Final[dict[str, Callable[[], str]]] = {
    "learning_ablation": ablation,
    "learning_baselines": baselines,
    "learning_compute": compute,
    "learning_cooperation": cooperation,
    "learning_results": results,
    "learning_settings": settings,
    "learning_tournament": tournament,
    "robustness_conditions": conditions,
    "robustness_shipped": shipped,
}
"""Functions that write the generated parts of the pages, by name."""

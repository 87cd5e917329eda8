from pathlib import Path
from typing import Any

import pytest

from benches.learning import robust
from benches.learning.experiments import Experiment, Study
from benches.learning.reporting import robustness
from benches.learning.reporting.collection import Collected, collect
from benches.learning.run_files import Folders
from rsoccer.benchmark.conditions import CONDITIONS
from tests.benches.learning.made_up import store

TASK = "SSLGoToBall-v0"


@pytest.fixture(scope="module")
def collected(tmp_path_factory: pytest.TempPathFactory) -> list[Collected]:
    """Results of both policies of the package and of one variant, of which a seed lacks."""
    shared: dict[str, Any] = {"seeds": 1, "conditions": tuple(CONDITIONS), "opponents": (None,)}
    shipped = [
        Experiment(
            *(robust.SHIPPED_GROUP, f"{TASK}-{name}", TASK, "clones"),
            settings={"policy": "best"},
            text=robust.VARIANTS[name],
            **shared,
        )
        for name in ("best", "best-robust")
    ]
    learned = [e for e in robust.experiments(seeds=2) if e.name == f"{TASK}-senses"]
    study = Study((*shipped, *learned))
    folder = tmp_path_factory.mktemp("made-up")
    folders = Folders(folder / "results", folder / "work")
    store(study, folders, missing=("seed-1",))
    return collect(study, folders)


def test_both_policies_of_the_package_stand_in_a_row(collected: list[Collected]) -> None:
    header, _, row = robustness.shipped(collected).splitlines()
    assert header.count("`best:robust`") == 1 + len(robustness.HEADLINE)
    assert row.startswith(f"| `{TASK}` | reached | ")
    assert row.count("%") == len(robustness.HEADLINE)


def test_each_condition_has_a_row(collected: list[Collected]) -> None:
    text = robustness.conditions(collected)
    assert text.startswith(f"### {TASK}")
    assert "Scores: reached." in text
    rows = [line for line in text.splitlines() if line.startswith("| ")][1:]
    rows = [row for row in rows if "---" not in row]
    assert len(rows) == len(CONDITIONS)
    assert "| (b) senses; 3 M, one seed |" in text
    first = robustness.estimate(collected[0], "truth")
    later = robustness.estimate(collected[0], "friendly")
    assert later.value == pytest.approx(0.9 * first.value, abs=1e-3)
    assert first.high - first.low == pytest.approx(0.04)


def test_open_runs_are_named(collected: list[Collected], tmp_path: Path) -> None:
    assert robustness.missing(collected).startswith("Of the 2 runs of the variants")
    empty = collect(Study(()), Folders(tmp_path, tmp_path))
    assert (robustness.missing(empty), robustness.shipped(empty)) == ("", "")
    assert robustness.conditions(empty) == ""

from pathlib import Path

import pytest

from benches.learning.experiments import Experiment, Study
from benches.learning.reporting.collection import collect
from benches.learning.reporting.curves import mean_between
from benches.learning.reporting.paper_claims import CLAIMS, order
from benches.learning.run_files import Folders, load, save
from benches.learning.table import STUDY
from tests.benches.learning.made_up import store

TASK = "SSLGoToBall-v0"
NAMES = ("ddpg", "sac")


@pytest.fixture
def folders(tmp_path: Path) -> Folders:
    return Folders(tmp_path / "results", tmp_path / "work")


def study(seeds: int) -> Study:
    named = {name: f"{TASK}-{name}" for name in NAMES}
    return Study(
        tuple(
            Experiment("baselines", name, TASK, algorithm, seeds=seeds)
            for algorithm, name in named.items()
        )
    )


def store_scores(folders: Folders, made: Study, ddpg: float, sac: float) -> None:
    """Give all runs of an algorithm a score, and a curve that stays at it."""
    store(made, folders)
    for run in made.runs():
        result = load(folders, run.key)
        assert result is not None
        score = ddpg if run.experiment.algorithm == "ddpg" else sac
        for row in result["evaluations"]:
            row["score"] = score
        result["curve"].update(samples=[100, 200 + run.seed], seconds=[1, 2], values=[score] * 2)
        save(folders, run.key, result)


@pytest.mark.parametrize(
    ("ddpg", "sac", "early", "late"),
    [(0.9, 0.4, "agrees", "the reverse"), (0.4, 0.9, "the reverse", "agrees")],
)
def test_claims_are_compared_with_the_seeds(
    folders: Folders, ddpg: float, sac: float, early: str, late: str
) -> None:
    made = study(seeds=3)
    store_scores(folders, made, ddpg, sac)
    rows = order(collect(made, folders)).splitlines()[2:]
    assert len(rows) == 2
    assert "DDPG is ahead of SAC at equal samples" in rows[0]
    assert rows[0].endswith(f" {early} |")
    assert rows[1].endswith(f" {late} |")


def test_equal_scores_and_few_seeds_decide_nothing(folders: Folders) -> None:
    for seeds, verdict in ((3, "open"), (2, "too few seeds"), (1, "too few seeds")):
        made = study(seeds)
        store_scores(folders, made, 0.5, 0.5)
        assert order(collect(made, folders)).count(f"| {verdict} |") == 2


def test_there_is_no_table_without_results_of_both(folders: Folders) -> None:
    made = study(seeds=1)
    store(made, folders, missing=("ddpg",))
    assert order(collect(made, folders)) == ""


def test_each_claim_is_about_experiments_of_the_study() -> None:
    keys = {experiment.key for experiment in STUDY.experiments}
    for claim in CLAIMS:
        assert claim.tasks
        for task in claim.tasks:
            for name in (claim.better, claim.worse):
                key = f"ppo/{task}" if name == "ppo" else f"baselines/{task}-{name}"
                assert key in keys


def test_the_mean_of_a_curve_is_over_samples() -> None:
    curve = {"samples": [100, 200, 400], "seconds": [1, 2, 4], "values": [0.0, 1.0, 1.0]}
    assert mean_between(curve, 100, 200) == pytest.approx(0.5)
    assert mean_between(curve, 100, 400) == pytest.approx(5 / 6, abs=0.01)
    assert mean_between(curve, 200, 400) == 1.0
    assert mean_between(curve, 100, 50) == 0.0

import json
from pathlib import Path

import pytest

from benches.learning.experiments import Run
from benches.learning.run_files import LOST_STARTS, Folders, digest, load
from benches.learning.running import lost_starts
from benches.learning.table import STUDY
from tests.benches.learning.finished import finish


def test_a_start_counts_if_all_policies_lose_it_at_once() -> None:
    one = lost_starts.measure(["zero"], starts=40, seed=3)
    both = lost_starts.measure(["zero", "chase"], starts=40, seed=3)
    assert [row["opponent"] for row in one] == list(lost_starts.OPPONENTS)
    for alone, joint in zip(one, both, strict=True):
        assert alone["starts"] == joint["starts"] == 80
        assert alone["lost_by_all"] == alone["least_lost_by_one"] > 0.1, "zero stands still"
        assert 0.0 < joint["lost_by_all"] < joint["least_lost_by_one"] < alone["lost_by_all"]
        assert joint["highest_score"] == pytest.approx(1.0 - 2.0 * joint["lost_by_all"])


def test_policies_are_those_of_finished_runs_of_whole_teams(tmp_path: Path) -> None:
    folders = Folders(tmp_path / "results", tmp_path / "work")
    with pytest.raises(FileNotFoundError, match="expected policies of ppo/VSSSelfPlay-v0"):
        lost_starts.runs_of(folders)
    experiment = next(e for e in STUDY.experiments if e.key == lost_starts.EXPERIMENTS[0])
    run = Run(experiment, 1)
    policy = finish(folders, run.key)
    policy.parent.rename(tmp_path / "elsewhere")
    with pytest.raises(FileNotFoundError):  # as in a fresh clone: results without policies
        lost_starts.runs_of(folders)
    finish(folders, run.key)
    result = load(folders, run.key)
    assert result is not None
    runs = lost_starts.runs_of(folders)
    assert runs == {run.key: digest(result)}
    found = lost_starts.policies_of(folders, runs)
    assert found == [f"{policy}:sample", f"{policy}:mean", *lost_starts.SCRIPTS]


def test_the_published_result_is_of_runs_of_today() -> None:
    """After a change of settings or physics: `python -m benches.learning.running.lost_starts`."""
    folders = Folders()
    published = json.loads((folders.results / LOST_STARTS).read_text())["runs"]
    assert {key.split("/seed")[0] for key in published} == set(lost_starts.EXPERIMENTS)
    for key, kept in published.items():
        result = load(folders, key)
        assert result is not None
        assert digest(result) == kept

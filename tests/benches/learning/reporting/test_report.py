from dataclasses import replace
from pathlib import Path

import pytest

from benches.learning.experiments import Experiment, Study
from benches.learning.reporting import report, tables
from benches.learning.reporting.cells import STALE_MARK
from benches.learning.reporting.collection import collect, find
from benches.learning.reporting.curves import band, value_at
from benches.learning.run_files import Folders, load, save
from benches.learning.running.status import statuses
from benches.learning.table import STUDY
from tests.benches.learning.made_up import store

TABLES = (tables.results, tables.baselines, tables.ablation, tables.cooperation, tables.compute)
SIGNATURE = b"\x89PNG\r\n"


@pytest.fixture(scope="module")
def folders(tmp_path_factory: pytest.TempPathFactory) -> Folders:
    """Folders with made-up results, of which one task and one variant of the ablation lack."""
    folder = tmp_path_factory.mktemp("made-up")
    folders = Folders(folder / "results", folder / "work")
    store(STUDY, folders, missing=("StaticDefenders", "ours-headings", "VSS-v0/seed-4"))
    return folders


def test_tables_have_a_row_for_each_experiment_with_results(folders: Folders) -> None:
    collected = collect(STUDY, folders)
    text = tables.results(collected)
    assert text.count("| `VSS-v0` |") == 4  # opponents
    assert "StaticDefenders-v0` |" not in text
    assert text.count("| `SSLContestedPossession-v0` | the official scenarios |") == 1
    assert "Missing runs: VSS-v0 (1), SSLStaticDefenders-v0 (5)." in text
    assert "| `SSLGoToBall-v0` | SAC |" in tables.baselines(collected)
    assert tables.baselines(collected).count("the paper's setting |") == 2
    assert tables.ablation(collected).count("missing") == 1
    # Matches against clones, without and with free balls.
    assert tables.cooperation(collected).count("| policy of VSS-v0 |") == 2
    assert "| .300 met |" in tables.cooperation(collected)
    assert tables.compute(collected).count("\n") == 8  # seven groups


def test_an_empty_study_has_empty_tables(tmp_path: Path) -> None:
    collected = collect(STUDY, Folders(tmp_path, tmp_path))
    assert [write(collected) for write in TABLES] == [""] * 5
    assert report.draw(collected, tmp_path) == []


def test_pictures_are_drawn(folders: Folders, tmp_path: Path) -> None:
    paths = report.draw(collect(STUDY, folders), tmp_path)
    assert [path.name for path in paths] == [report.CURVES, report.ABLATION]
    assert all(path.read_bytes().startswith(SIGNATURE) for path in paths)


def study_of(gamma: float | None = None, **settings: float) -> Study:
    settings |= {} if gamma is None else {"ppo.gamma": gamma}
    experiment = Experiment("ppo", "VSS-v0", "VSS-v0", settings=settings, seeds=2)
    return Study((experiment,))


def test_stale_results_are_marked_until_there_is_a_current_one(tmp_path: Path) -> None:
    folders = Folders(tmp_path / "results", tmp_path / "work")
    store(study_of(0.9), folders)
    old = load(folders, "ppo/VSS-v0/seed-1")
    assert old is not None
    assert not collect(study_of(0.9), folders)[0].stale
    stale = collect(study_of(0.8), folders)
    assert stale[0].stale
    assert len(stale[0].results) == 2
    assert r"| `VSS-v0`\* |" in tables.results(stale)
    store(study_of(0.8), folders)
    save(folders, "ppo/VSS-v0/seed-1", old)
    mixed = collect(study_of(0.8), folders)[0]
    assert not mixed.stale
    assert [result["run"] for result in mixed.results] == ["ppo/VSS-v0/seed-0"]
    assert mixed.missing == 1


def test_results_with_another_observation_are_stale(tmp_path: Path) -> None:
    folders = Folders(tmp_path / "results", tmp_path / "work")
    store(study_of(), folders)
    old = load(folders, "ppo/VSS-v0/seed-0")
    assert old is not None
    assert old["settings"]["observation"].startswith("ball 4, ego 7, ")
    old["settings"]["observation"] = "ball 4, ego 7"
    for seed in range(2):
        save(folders, f"ppo/VSS-v0/seed-{seed}", old)
    assert collect(study_of(), folders)[0].stale
    assert [entry.reason for entry in statuses(study_of(), folders)] == [
        "observation has changed"
    ] * 2


def test_results_are_stale_if_a_run_that_they_needed_has_changed(tmp_path: Path) -> None:
    def made(gamma: float) -> Study:
        learned = Experiment("ppo", "VSS-v0", "VSS-v0", settings={"ppo.gamma": gamma}, seeds=1)
        policy = {"policy": "@ppo/VSS-v0"}
        clones = Experiment("a", "x", "VSSMulti-v0", "clones", policy, 1, needs=(learned,))
        return Study((learned, clones))

    folders = Folders(tmp_path / "results", tmp_path / "work")

    def reasons(study: Study) -> list[str]:
        return [entry.reason for entry in statuses(study, folders)]

    store(made(0.9), folders)
    assert reasons(made(0.9)) == ["", ""]
    store(made(0.8), folders, missing=("a/x",))
    assert reasons(made(0.8)) == ["", "ppo/VSS-v0/seed-0 has changed"]
    assert collect(made(0.8), folders)[1].stale


def test_the_result_of_a_setting_that_is_gone_is_stale(tmp_path: Path) -> None:
    folders = Folders(tmp_path / "results", tmp_path / "work")
    store(study_of(), folders)
    assert collect(study_of(no_such_setting=1.0), folders)[0].stale


def test_equal_samples_are_read_from_the_curve(folders: Folders) -> None:
    curve = {"metric": "reached", "samples": [100, 200], "seconds": [1, 2], "values": [0.0, 1.0]}
    assert value_at(curve, 150) == 0.5
    assert value_at(curve, 50) is None
    assert value_at(curve, 500) == 1.0
    part = find(collect(STUDY, folders), "SSLGoToBall-v0")
    assert part is not None
    drawn = band([result["curve"] for result in part.results])
    assert drawn is not None
    samples, means, low, high = drawn
    assert samples[-1] == pytest.approx(3_000_000)
    assert (low <= means).all()
    assert (means <= high).all()


def test_curves_without_points_have_no_band() -> None:
    empty = {"metric": "", "samples": [], "seconds": [], "values": []}
    assert band([empty]) is None


def test_stale_variants_of_the_ablation_are_marked(tmp_path: Path) -> None:
    folders = Folders(tmp_path / "results", tmp_path / "work")
    variant = Experiment("ablation", "paper", "VSS-v0", settings={"ppo.gamma": 0.9}, seeds=1)
    store(Study((variant,)), folders)
    changed = Study((replace(variant, settings={"ppo.gamma": 0.8}),))
    assert STALE_MARK not in tables.ablation(collect(Study((variant,)), folders))
    assert tables.ablation(collect(changed, folders)).count(STALE_MARK) == 2  # its cell, the note

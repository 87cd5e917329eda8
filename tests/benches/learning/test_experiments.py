import numpy as np
import pytest

from benches.learning import ablation, algorithms
from benches.learning.experiments import Experiment, Study
from benches.learning.learned import POINTS, curve
from benches.learning.listing import listing
from benches.learning.run_files import Folders
from benches.learning.status import statuses
from benches.learning.table import STUDY
from rsoccer.train import Args


def test_the_study_has_all_groups_and_unique_runs() -> None:
    keys = [run.key for run in STUDY.runs()]
    assert len(keys) == len(set(keys)) == sum(e.seeds for e in STUDY.experiments)
    assert {e.group for e in STUDY.experiments} == {"ppo", "baselines", "ablation", "cooperation"}


def test_runs_of_a_group_go_by_seed() -> None:
    study = Study(tuple(Experiment("a", n, "VSS-v0", seeds=s) for n, s in (("x", 2), ("y", 1))))
    assert [run.key for run in study.runs()] == ["a/x/seed-0", "a/y/seed-0", "a/x/seed-1"]
    assert study.run("a/x/seed-1").seed == 1
    with pytest.raises(ValueError, match="no run 'a/x/seed-2'"):
        study.run("a/x/seed-2")


def test_wrong_experiments_are_refused() -> None:
    with pytest.raises(ValueError, match="algorithm must be one of"):
        Experiment("a", "x", "VSS-v0", "td3")
    with pytest.raises(ValueError, match="names of files"):
        Experiment("a", "x/y", "VSS-v0")
    one = Experiment("a", "x", "VSS-v0")
    with pytest.raises(ValueError, match="got twice"):
        Study((one, one))
    with pytest.raises(ValueError, match=r"unknown|got \['a/z'\]"):
        Study((Experiment("a", "x", "VSS-v0", needs=("a/z",)),))


def test_the_ablation_goes_from_all_changes_to_none() -> None:
    experiments = {e.name: e for e in ablation.experiments("VSS-v0", 1000, 3)}
    assert experiments["ours"].settings == {"samples": 1000}
    paper = dict(experiments["paper"].settings)
    assert paper["gamma"] == 0.95
    assert {"opponents:2,3", "shot"} <= set(paper["masked_observations"])
    assert "gamma" not in experiments["paper+discount"].settings
    assert experiments["ours-discount"].settings == {"samples": 1000, "gamma": 0.95}
    with_headings = experiments["paper+headings"].settings["masked_observations"]
    assert set(paper["masked_observations"]) - set(with_headings) == {"opponents:2,3"}
    for experiment in experiments.values():
        Args(task=experiment.task, **experiment.settings).make_task()


def test_settings_without_effect_on_a_task_do_not_count() -> None:
    study = Study(tuple(Experiment("a", n, n) for n in ("VSS-v0", "VSSSelfPlay-v0")))
    single, both = (algorithms.settings(study.run(f"a/{e.name}/seed-0")) for e in study.experiments)
    assert {"pool_size", "solo_fraction"} <= set(both)
    assert not {"pool_size", "solo_fraction", "seed", "out"} & set(single)


def test_a_curve_keeps_the_mean_of_all_episodes() -> None:
    rng = np.random.default_rng(0)
    samples, values = np.arange(1, 1001) * 100, rng.normal(size=1000)
    values[::3] = np.nan
    weights = rng.integers(1, 9, 1000).astype(float)
    kept = curve("goal_score", samples, samples / 7.0, values, weights)
    assert len(kept["samples"]) == POINTS
    assert kept["samples"][-1] == 100_000
    known = np.isfinite(values)
    parts = (np.arange(1000) // 20)[known]
    sums = np.bincount(parts, (values * weights)[known]) / np.bincount(parts, weights[known])
    np.testing.assert_allclose(kept["values"], sums, atol=1e-4)


def test_a_curve_without_episodes_is_empty() -> None:
    nothing = curve("passes", np.ones(3), np.ones(3), np.full(3, np.nan), np.zeros(3))
    assert nothing == {"metric": "passes", "samples": [], "seconds": [], "values": []}


def test_the_list_estimates_the_time_of_all_runs(tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.mktemp("empty")
    known = statuses(STUDY, Folders(folder, folder))
    lines = listing(known, known, 2).splitlines()
    assert len(lines) == len(known) + 1
    assert "core-hours left" in lines[-1]

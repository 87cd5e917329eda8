from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benches.learning import ablation, algorithms
from benches.learning.experiments import Experiment, Run, Study
from benches.learning.learned import POINTS, curve
from benches.learning.listing import listing
from benches.learning.ppo_run import NOT_COMPARED, SELF_PLAY_ONLY, defaults, strength
from benches.learning.run_files import Folders, with_policies
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
    with pytest.raises(ValueError, match=r"needs from the study's experiments, got \['a/z'\]"):
        Study((replace(one, needs=(replace(one, name="z"),)),))


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
    assert {*NOT_COMPARED, *SELF_PLAY_ONLY} <= set(defaults())


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


def test_the_curve_of_self_play_is_that_of_the_ladder_or_of_matches_against_ou() -> None:
    progress = {"episodes": np.array([4.0, 2.0]), "episode/goal_score": np.array([0.0, 0.1])}
    assert strength(progress, "goal_score")[0].tolist() == [0.0, 0.1]
    progress["episode_ou/goal_score"] = np.array([np.nan, 0.5])
    assert strength(progress, "goal_score")[0][1] == 0.5
    progress["ladder_ou_goal_score"] = np.array([np.nan, 0.7])
    values, weights = strength(progress, "goal_score")
    assert values[1] == 0.7
    assert weights.tolist() == [1.0, 1.0]


def test_settings_name_the_policies_of_other_experiments(tmp_path: Path) -> None:
    folders = Folders(tmp_path, tmp_path)
    run = Run(Experiment("a", "x", "VSSMulti-v0", settings={"solo_partners": "@b/y"}), 3)
    with pytest.raises(ValueError, match="a/x/seed-3 needs the policy"):
        with_policies(run.experiment.settings, folders, run)
    path = folders.policy("b/y/seed-3")
    path.parent.mkdir(parents=True)
    path.touch()
    assert with_policies(run.experiment.settings, folders, run) == {"solo_partners": str(path)}
    mix = {"opponents": {"@b/y": 0.5, "ou": 0.5}, "sizes": (8, 8)}
    expected = {"opponents": {str(path): 0.5, "ou": 0.5}, "sizes": (8, 8)}
    assert with_policies(mix, folders, run) == expected
    assert algorithms.settings(run)["solo_partners"] == "@b/y"


def test_the_list_estimates_the_time_of_all_runs(tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.mktemp("empty")
    known = statuses(STUDY, Folders(folder, folder))
    lines = listing(known, known, 2).splitlines()
    assert len(lines) == len(known) + 1
    assert "core-hours left" in lines[-1]

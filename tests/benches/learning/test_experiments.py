from dataclasses import replace

import pytest

from benches.learning import ablation, conditions
from benches.learning.experiments import AS_TRAINED, Experiment, Study
from benches.learning.ppo_settings import NOT_COMPARED, SELF_PLAY_ONLY, defaults
from benches.learning.table import STUDY
from rsoccer.train import Args


def test_the_study_has_all_groups_and_runs() -> None:
    assert len(STUDY.runs()) == sum(e.seeds for e in STUDY.experiments)
    groups = {
        "ppo",
        "baselines",
        "calibration",
        "ablation",
        "cooperation",
        "robust",
        "robust-shipped",
    }
    assert {e.group for e in STUDY.experiments} == groups


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
    ours = {"samples": 1000, **AS_TRAINED}
    assert experiments["ours"].settings == ours
    paper = dict(experiments["paper"].settings)
    assert paper["ppo.gamma"] == 0.95
    assert {"opponents:2,3", "shot"} <= set(paper["network.masked_observations"])
    assert "ppo.gamma" not in experiments["paper+discount"].settings
    assert experiments["ours-discount"].settings == {**ours, "ppo.gamma": 0.95}
    with_headings = experiments["paper+headings"].settings["network.masked_observations"]
    assert set(paper["network.masked_observations"]) - set(with_headings) == {"opponents:2,3"}
    for experiment in experiments.values():
        Args.from_json({"task": experiment.task, **experiment.settings}).make_task()


def test_settings_without_effect_on_a_task_do_not_count() -> None:
    study = Study(tuple(Experiment("a", n, n) for n in ("VSS-v0", "VSSSelfPlay-v0")))
    single, both = (conditions.settings(study.run(f"a/{e.name}/seed-0")) for e in study.experiments)
    without_effect = {"opponents.past_fraction", "opponents.solo_fraction"}
    assert without_effect <= set(both)
    assert not (without_effect | {"seed", "out"}) & set(single)
    assert {*NOT_COMPARED, *SELF_PLAY_ONLY} <= set(defaults())

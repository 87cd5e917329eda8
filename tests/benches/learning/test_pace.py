"""Samples of DDPG and SAC in the time of PPO."""

import pytest

from benches.learning import pace
from benches.learning.experiments import SB3
from benches.learning.run_files import Folders
from benches.learning.table import IN_TIME_OF_PPO
from benches.result_files import load


def test_the_study_has_the_measured_samples() -> None:
    machine, figures = load(Folders().results / pace.FOLDER / pace.SOURCE)
    ratios = {(f.scenario, f.variant.split(" / ")[0]): f for f in figures if f.unit == "x"}
    planned = {(task, name): n for task, row in IN_TIME_OF_PPO.items() for name, n in row.items()}
    assert planned
    assert planned.keys() == ratios.keys()
    assert not machine.commit.endswith("-dirty")
    for key, samples in planned.items():
        assert samples == pytest.approx(pace.samples_in_time_of_ppo(ratios[key]), rel=0.06)


def test_each_task_of_the_baselines_is_compared_with_ppo() -> None:
    found = pace.benchmarks()
    assert [benchmark.scenario for benchmark in found] == list(IN_TIME_OF_PPO)
    for benchmark in found:
        assert [variant.name for variant in benchmark.variants] == ["ppo", *SB3]
        assert [variant.worlds > 0 for variant in benchmark.variants] == [True] * 3
        assert benchmark.pairs == ((1, 0), (2, 0))


def test_it_measures_and_prints(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("stable_baselines3")
    assert pace.main(["--only", "GoToBall", "--rounds", "1", "--seconds", "0"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[1] for line in lines] == ["ppo", *SB3, *SB3]
    assert all(line.endswith("samples") for line in lines[3:])

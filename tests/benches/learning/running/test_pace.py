"""Samples of DDPG and SAC in the time of PPO."""

import pytest

from benches.learning.experiments import SB3
from benches.learning.run_files import Folders
from benches.learning.running import pace
from benches.learning.table import IN_TIME_OF_PPO, PPO
from benches.result_files import load

ROBOTS = {"VSSMulti-v0": 3, "SSLPassEnduranceMulti-v1": 2}
"""Robots that learn in a match, where they are several."""


def test_the_study_has_the_measured_samples() -> None:
    """After `python -m benches.learning.running.pace`: `IN_TIME_OF_PPO` has its samples, rounded.

    Runs of DDPG and SAC whose samples change are then stale.
    """
    machine, figures = load(Folders().results / pace.GROUP / pace.SOURCE)
    ratios = {(f.scenario, f.variant.split(" / ")[0]): f for f in figures if f.unit == "x"}
    planned = {(task, name): n for task, row in IN_TIME_OF_PPO.items() for name, n in row.items()}
    assert planned
    assert planned.keys() == ratios.keys()
    assert not machine.commit.endswith("-dirty")
    for key, samples in planned.items():
        assert samples == pytest.approx(pace.samples_in_time_of_ppo(ratios[key]), rel=0.06)


def test_each_task_of_the_paper_is_compared_with_ppo() -> None:
    found = pace.benchmarks()
    studied = [task for task in PPO if "SelfPlay" not in task]
    assert [benchmark.scenario for benchmark in found] == list(IN_TIME_OF_PPO) == studied
    for benchmark in found:
        assert [variant.name for variant in benchmark.variants] == ["ppo", *SB3]
        robots = ROBOTS.get(benchmark.scenario, 1)
        assert [variant.worlds for variant in benchmark.variants[1:]] == [60 // robots] * 2
        assert benchmark.pairs == ((1, 0), (2, 0))


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["--only", "Chess"], "no benchmark has 'Chess'"),
        (["--rounds", "0"], "expected rounds of at least 1"),
        (["--seconds", "-1"], "seconds of at least 0"),
    ],
)
def test_wrong_options_are_refused(
    arguments: list[str], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    if arguments[0] == "--only":
        pytest.importorskip("stable_baselines3")
    with pytest.raises(SystemExit, match="2"):
        pace.main(arguments)
    assert expected in capsys.readouterr().err


def test_without_the_library_it_says_what_is_missing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(pace, "find_spec", lambda _: None)
    with pytest.raises(SystemExit, match="2"):
        pace.main([])
    assert "Stable-Baselines3 is missing" in capsys.readouterr().err


def test_it_measures_and_prints(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("stable_baselines3")
    assert pace.main(["--only", "GoToBall", "--rounds", "1", "--seconds", "0"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[1] for line in lines] == ["ppo", *SB3, *SB3]
    assert all(line.endswith("samples") for line in lines[3:])

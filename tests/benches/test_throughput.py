import dataclasses
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

from benches import process_cost, suite, throughput
from benches.result_files import ROOT, load, this_machine
from benches.scenarios import CROWD, ENGINES, RANDOM
from benches.suite import Sizes

QUICK = ["--rounds", "2", "--seconds", "0.001"]
SMALL = Sizes(
    core=2,
    batched=(3, 4),
    threads=4,
    scaling=(1, 3),
    libraries=(2,),
    training=4,
    memory=64,
    capacity=8,
)


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Use few, small scenarios and no third-party simulators."""
    # Short, but long enough for a crowd to gather.
    short = dataclasses.replace(CROWD[0], episode=120)
    monkeypatch.setattr(suite, "SCENARIOS", (RANDOM[0], RANDOM[2], short, RANDOM[3], RANDOM[4]))
    monkeypatch.setattr(suite, "import_optional", lambda name: None)
    monkeypatch.setattr(throughput, "import_optional", lambda name: None)
    monkeypatch.setattr(throughput, "core_figures", list)


def test_everything_is_measured_and_stored(tmp_path: Path) -> None:
    machine, figures = load(throughput.main([*QUICK, "--out", str(tmp_path)], SMALL))
    assert machine.profile == "release"
    assert len(list(tmp_path.glob("*.png"))) == 1
    assert {figure.group for figure in figures} == {
        *(
            "core",
            "threads",
            "scaling",
            "batched",
            "single",
            "libraries",
            "training",
            "memory",
            "capacity",
            "startup",
        ),
    }
    batched = [f for f in figures if (f.group, f.quantity) == ("batched", "speed")]
    assert {(f.variant, f.engine, f.worlds, f.threads) for f in batched} == {
        ("Matches", engine, worlds, threads)
        for engine in ENGINES
        for worlds in (3, 4)
        for threads in (1, 2)
    }
    for group in ("core", "batched", "single", "training"):
        ratios = {f.engine for f in figures if (f.group, f.quantity) == (group, "ratio")}
        assert "compact / rapier" in ratios
    for group in ("scaling", "memory"):
        assert {f.engine for f in figures if f.group == group} == set(ENGINES)
    assert {f.variant for f in figures if f.group == "single" and f.quantity == "speed"} == {
        *("ParallelEnv", "AECEnv", "no-op ParallelEnv", "Env", "no-op Env", "VectorEnv"),
        "Matches",
    }
    ratios = {f.variant for f in figures if (f.group, f.quantity) == ("libraries", "ratio")}
    assert "Gymnasium robots_vector_env / Matches" in ratios
    assert ("SB3 SoccerVecEnv / Matches" in ratios) == bool(find_spec("stable_baselines3"))
    assert "examples/13_ppo.py / trainer" in {f.variant for f in figures}
    for figure in figures:
        assert figure.rounds == (1 if figure.group == "memory" else 2)
        assert figure.minimum <= figure.median <= figure.maximum
        # Few samples of random play may have no contact; memory may already have been allocated.
        assert figure.median > 0 or figure.quantity in ("robots in contact", "memory")


def test_a_part_can_be_selected(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(throughput, "PARTIAL", tmp_path)
    path = throughput.main([*QUICK, "--only", "gotoball"], SMALL)
    assert path.parent == tmp_path, "a partial run does not replace the table"
    assert {figure.scenario for figure in load(path)[1]} == {"SSLGoToBall-v0"}


def test_a_run_without_benchmarks_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(SystemExit, match=r"(?s)no benchmark has.*core: VSSS 3 v 3 random"):
        throughput.main([*QUICK, "--only", "chess", "--out", str(tmp_path)], SMALL)
    with pytest.raises(SystemExit):
        throughput.main(["--rounds", "0"], SMALL)
    monkeypatch.setattr(process_cost, "free_memory", lambda: 0)
    with pytest.raises(SystemExit, match="no benchmark was measured"):
        throughput.main([*QUICK, "--only", "capacity", "--out", str(tmp_path)], SMALL)
    assert not list(tmp_path.iterdir())


def test_a_debug_build_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    debug = dataclasses.replace(this_machine(), profile="debug")
    monkeypatch.setattr(throughput, "this_machine", lambda: debug)
    with pytest.raises(SystemExit, match="debug build"):
        throughput.main([*QUICK, "--out", str(tmp_path)], SMALL)
    assert not list(tmp_path.iterdir())


def test_it_runs_from_the_command_line() -> None:
    command = [sys.executable, "-m", "benches.throughput", "--help"]
    shown = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert "--rounds" in shown

import dataclasses
import subprocess
import sys
from pathlib import Path

import pytest

from benches import contests, fresh, throughput
from benches.contests import Sizes
from benches.games import CROWD, RANDOM
from benches.table import ROOT, load, this_machine

QUICK = ["--rounds", "2", "--seconds", "0.001"]
SMALL = Sizes(2, many=(3, 4), shared=4, growing=(1, 3), trained=4, weighed=64, hosted=8)


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without peers, and with few games."""
    # Short, but long enough for a crowd to gather.
    short = dataclasses.replace(CROWD[0], episode=120)
    monkeypatch.setattr(contests, "GAMES", (RANDOM[0], RANDOM[2], short, RANDOM[3], RANDOM[4]))
    monkeypatch.setattr(contests, "peer", lambda name: None)
    monkeypatch.setattr(throughput, "peer", lambda name: None)
    monkeypatch.setattr(throughput, "physics_alone", list)


def test_everything_is_measured_and_stored(tmp_path: Path) -> None:
    machine, figures = load(throughput.main([*QUICK, "--out", str(tmp_path)], SMALL))
    assert machine.profile == "release"
    assert len(list(tmp_path.glob("*.png"))) == 1
    assert {figure.group for figure in figures} == {
        *("core", "threads", "growth", "many", "one", "training", "memory", "hosting", "start"),
    }
    assert {(f.who, f.worlds, f.threads) for f in figures if f.group == "many"} == {
        *(("Matches", 3, 1), ("Matches", 3, 2), ("Matches", 4, 1), ("Matches", 4, 2)),
    }
    assert {f.who for f in figures if f.group == "one" and f.quantity == "speed"} == {
        *("ParallelEnv", "AECEnv", "empty ParallelEnv", "Env", "empty Env", "VectorEnv"),
    }
    for figure in figures:
        assert figure.rounds == 2
        assert figure.least <= figure.median <= figure.most
        # A few looks at random play may see nobody touch; little memory may have been there.
        assert figure.median > 0 or figure.quantity in ("robots touching", "memory")


def test_some_can_be_picked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(throughput, "PART", tmp_path)
    path = throughput.main([*QUICK, "--only", "gotoball"], SMALL)
    assert path.parent == tmp_path, "a part does not replace the whole table"
    assert {figure.game for figure in load(path)[1]} == {"SSLGoToBall-v0"}


def test_nothing_to_measure_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(SystemExit, match=r"(?s)nothing to measure.*core: VSSS 3 v 3 random"):
        throughput.main([*QUICK, "--only", "chess", "--out", str(tmp_path)], SMALL)
    with pytest.raises(SystemExit):
        throughput.main(["--rounds", "0"], SMALL)
    monkeypatch.setattr(fresh, "free_memory", lambda: 0)
    with pytest.raises(SystemExit, match="nothing was measured"):
        throughput.main([*QUICK, "--only", "hosting", "--out", str(tmp_path)], SMALL)
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

import dataclasses
import subprocess
import sys
from pathlib import Path

import pytest

from benches import throughput
from benches.table import ROOT, load, this_machine

QUICK = ["--rounds", "2", "--seconds", "0.01"]


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(throughput, "WORLDS", (1, 3))
    monkeypatch.setattr(throughput, "physics_alone", list)


def test_every_case_is_measured_and_stored(tmp_path: Path) -> None:
    machine, figures = load(throughput.main([*QUICK, "--out", str(tmp_path)]))
    assert machine.profile == "release"
    assert {figure.name for figure in figures} == {
        *("physics", "matches", "physics_share"),
        *("parallel_env", "empty_parallel_env"),
    }
    assert {(f.worlds, f.threads) for f in figures if f.name == "matches"} == {
        *((1, 1), (3, 1), (3, 2)),
    }
    for figure in figures:
        assert 0 < figure.slowest <= figure.median <= figure.fastest
        assert figure.rounds == 2
    shares = [figure.median for figure in figures if figure.unit == "share"]
    assert len(shares) == 2
    assert all(0 < share < 1 for share in shares)


def test_a_debug_build_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    debug = dataclasses.replace(this_machine(), profile="debug")
    monkeypatch.setattr(throughput, "this_machine", lambda: debug)
    with pytest.raises(SystemExit, match="debug build"):
        throughput.main([*QUICK, "--out", str(tmp_path)])
    assert not list(tmp_path.iterdir())


def test_it_runs_from_the_command_line() -> None:
    command = [sys.executable, "-m", "benches.throughput", "--help"]
    shown = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert "--rounds" in shown

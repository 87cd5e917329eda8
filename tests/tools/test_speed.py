from pathlib import Path

import pytest

from benches.table import Figure, store
from tests.benches.figures import MACHINE, OURS, PEERS, SHARED
from tools import speed


def written(figures: list[Figure]) -> str:
    return speed.machine_speed("some-cpu", MACHINE, figures)


def test_a_table_without_peers_is_shown() -> None:
    text = written(OURS)
    assert text.startswith("Some CPU @ 2.5GHz, 2 cores, 2026-01-31, release build of commit abc")
    assert "| steps a second on one thread | one match | 64 at once |" in text
    assert "| VSSS 3 v 3 random | 25,000 | 50,000 |" in text
    assert "| `Matches` | `VSSSelfPlay-v0` | 1,024 | 2 | 40,000 | 4 us a world-step |" in text
    assert "59 KiB for SSL 11 v 11" in text
    assert "100,000 worlds (VSSS 3 v 3 random) in one process, on 2 threads: built in 1.2 s" in text
    assert "2.6 GiB of memory in all once some touch, 45,700 steps a second." in text
    assert "first env and reset 0.13 s" in text
    assert "robosim" not in text
    assert "vmas" not in text


def test_a_table_with_peers_shows_ratios() -> None:
    text = written(OURS + PEERS + SHARED)
    row = "| VSSS 3 v 3 random | 500 | 25,000 | 50x (45x to 55x) | 50,000 | 100x (90x to 110x) |"
    assert row in text
    assert "compat.robosim` runs 20x or more as fast" in text
    assert "| vmas 1.5.2 | football | 1,024 | 2 | 20,000 |  |" in text
    assert "of vmas 1.5.2's football" in text
    assert "controlled: 2x (1.8x to 2.2x) at 1,024." in text
    assert "1.9x (1.71x to 2.09x) as fast as one" in text
    assert "1.98x (1.78x to 2.18x) for hashing" in text
    assert "0.97x at 16,384" in text


def test_every_machine_has_its_part(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(speed, "RESULTS", tmp_path)
    assert speed.speed() == ""
    store(OURS, MACHINE, tmp_path)
    assert "64 at once" in speed.speed()

from pathlib import Path

import pytest

from benches import fresh
from benches.games import RANDOM
from benches.measuring import LeftOut

GIB = 2**30


def test_worlds_that_memory_does_not_hold_are_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fresh, "free_memory", lambda: GIB)
    with pytest.raises(LeftOut, match=r"100,000 worlds need 3\.8 GiB of memory, 1\.0 GiB are free"):
        fresh.hosting(RANDOM[0], 100_000, 2)
    assert fresh.hosting(RANDOM[0], 20_000, 2)(0.0) == {}


@pytest.mark.parametrize(("limit", "free"), [("max", 8), (str(4 * GIB), 4), (str(2**63), 8)])
@pytest.mark.parametrize("file", fresh.LIMITS)
def test_a_container_may_have_less_memory(file: str, limit: str, free: int, tmp_path: Path) -> None:
    meminfo = tmp_path / "proc/meminfo"
    meminfo.parent.mkdir()
    meminfo.write_text(f"MemTotal:  99 kB\nMemAvailable:  {8 * GIB // 1024} kB\n")
    assert fresh.free_memory(tmp_path) == 8 * GIB
    (tmp_path / file).parent.mkdir(parents=True)
    (tmp_path / file).write_text(f"{limit}\n")
    assert fresh.free_memory(tmp_path) == free * GIB


def test_this_machine_has_memory(tmp_path: Path) -> None:
    assert fresh.free_memory() > 0
    assert fresh.free_memory(tmp_path) > fresh.ROOM, "where the system does not say"

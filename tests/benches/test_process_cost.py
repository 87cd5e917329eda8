from pathlib import Path

import pytest

from benches import process_cost
from benches.measuring import UnavailableError
from benches.scenarios import RANDOM

GIB = 2**30


def test_too_many_worlds_for_the_memory_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process_cost, "free_memory", lambda: GIB)
    with pytest.raises(
        UnavailableError, match=r"100,000 worlds need 3\.8 GiB of memory, 1\.0 GiB are free"
    ):
        process_cost.capacity(RANDOM[0], 100_000, 2)
    assert process_cost.capacity(RANDOM[0], 20_000, 2)(0.0) == {}


@pytest.mark.parametrize(("limit", "free"), [("max", 8), (str(4 * GIB), 4), (str(2**63), 8)])
@pytest.mark.parametrize("file", process_cost.LIMITS)
def test_a_memory_limit_of_a_container_is_respected(
    file: str, limit: str, free: int, tmp_path: Path
) -> None:
    meminfo = tmp_path / "proc/meminfo"
    meminfo.parent.mkdir()
    meminfo.write_text(f"MemTotal:  99 kB\nMemAvailable:  {8 * GIB // 1024} kB\n")
    assert process_cost.free_memory(tmp_path) == 8 * GIB
    (tmp_path / file).parent.mkdir(parents=True)
    (tmp_path / file).write_text(f"{limit}\n")
    assert process_cost.free_memory(tmp_path) == free * GIB


def test_free_memory_of_this_machine_is_positive(tmp_path: Path) -> None:
    assert process_cost.free_memory() > 0
    assert process_cost.free_memory(tmp_path) > process_cost.BYTES_PER_WORLD, "no /proc/meminfo"

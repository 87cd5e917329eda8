import json
from collections.abc import Mapping
from pathlib import Path

import pytest

from benches.table import Figure, Machine, load, physics_alone, store

MACHINE = Machine("Some CPU @ 2.5GHz", 2, "2026-01-31", "abc1234-dirty", "0.1.0", "release")
FIGURES = [
    Figure("matches", 1024, 2, "world-steps/s", 25170.0, 24110.0, 26000.0, 7),
    Figure("physics_share", 1024, 1, "share", 0.6125, 0.6, 0.63, 7),
]


def test_what_is_stored_is_loaded(tmp_path: Path) -> None:
    path = store(FIGURES, MACHINE, tmp_path / "new")
    assert path.name == "some-cpu-2-5ghz-2-cores.csv"
    assert load(path) == (MACHINE, FIGURES)


def test_an_older_table_of_the_machine_is_replaced(tmp_path: Path) -> None:
    store(FIGURES, MACHINE, tmp_path)
    path = store(FIGURES[:1], MACHINE, tmp_path)
    assert list(tmp_path.iterdir()) == [path]
    assert load(path)[1] == FIGURES[:1]


def test_an_empty_table_is_refused(tmp_path: Path) -> None:
    (tmp_path / "empty.csv").write_text("")
    with pytest.raises(ValueError, match=r"empty\.csv holds no figures"):
        load(tmp_path / "empty.csv")


def leave(folder: Path, case: Mapping[str, object], nanoseconds: float) -> None:
    """What criterion leaves of one case."""
    folder.mkdir(parents=True)
    interval = {"lower_bound": 0.8 * nanoseconds, "upper_bound": 1.6 * nanoseconds}
    median = {"point_estimate": nanoseconds, "confidence_interval": interval}
    (folder / "benchmark.json").write_text(json.dumps(case))
    (folder / "estimates.json").write_text(json.dumps({"median": median}))


def test_figures_of_the_core_are_read_from_criterion(tmp_path: Path) -> None:
    case = {
        "group_id": "vss_3v3_step",
        "function_id": "random",
        "value_str": "256x2",
        "throughput": {"Elements": 256},
    }
    leave(tmp_path / "vss_3v3_step" / "random" / "256x2" / "new", case, 1e7)
    leave(tmp_path / "place" / "new", {"function_id": None, "throughput": None}, 5e3)
    [figure] = physics_alone(tmp_path)
    found = (figure.name, figure.worlds, figure.threads)
    assert found == ("core_vss_3v3_random", 256, 2)
    assert figure.median == pytest.approx(25_600)
    assert (figure.slowest, figure.fastest) == pytest.approx((16_000, 32_000))
    assert list(physics_alone(tmp_path / "nothing")) == []

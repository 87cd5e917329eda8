import json
import os
from collections.abc import Mapping
from pathlib import Path

import pytest

from benches.criterion import core_figures

CASE = {
    "group_id": "vss_3v3_compact",
    "function_id": "random",
    "value_str": "256x2",
    "throughput": {"Elements": 256},
}


def write_case(folder: Path, case: Mapping[str, object], nanoseconds: float) -> None:
    """Write the files of one criterion benchmark."""
    folder.mkdir(parents=True)
    interval = {"lower_bound": 0.8 * nanoseconds, "upper_bound": 1.6 * nanoseconds}
    median = {"point_estimate": nanoseconds, "confidence_interval": interval}
    (folder / "benchmark.json").write_text(json.dumps(case))
    (folder / "estimates.json").write_text(json.dumps({"median": median}))


def test_figures_of_the_core_are_read(tmp_path: Path) -> None:
    write_case(tmp_path / "vss_3v3_compact" / "random" / "256x2" / "new", CASE, 1e7)
    write_case(tmp_path / "place" / "new", {"function_id": None, "throughput": None}, 5e3)
    [figure] = core_figures(tmp_path, since=0.0)
    assert (figure.scenario, figure.engine) == ("VSSS 3 v 3 random", "compact")
    assert (figure.worlds, figure.threads) == (256, 2)
    assert figure.median == pytest.approx(25_600)
    assert (figure.minimum, figure.maximum) == pytest.approx((16_000, 32_000))
    assert list(core_figures(tmp_path / "nothing")) == []


def test_figures_of_an_older_build_are_skipped(tmp_path: Path) -> None:
    folder = tmp_path / "vss_3v3_compact" / "random" / "256x2" / "new"
    write_case(folder, CASE, 1e7)
    os.utime(folder / "benchmark.json", (1e9, 1e9))
    assert len(list(core_figures(tmp_path, since=1e9))) == 1
    assert not list(core_figures(tmp_path, since=1e9 + 1))
    assert not list(core_figures(tmp_path)), "the installed build is newer"

"""The benchmark of identified numbers."""

import pytest

from benches import identify
from rsoccer.identify import Estimate


def test_errors_are_parts_of_the_truth_and_intervals_are_counted() -> None:
    count = identify.Count()
    count.add(Estimate("max_speed", "m/s", 2.9, 3.1, 3.2), 3.0)
    count.add(Estimate("max_speed", "m/s", 3.05, 3.1, 3.15), 3.0)
    count.add(Estimate.missing("max_speed", "m/s", "speed"), 3.0)
    assert count.errors == pytest.approx([1 / 30, 1 / 30])
    assert count.halves == pytest.approx([0.05, 1 / 60])
    assert (count.held, count.missing) == (1, 1)
    row = ["max_speed", "2 of 3", "3.3%", "3.3%", "3.3%", "1 of 2"]
    assert identify.rows({"max_speed": count}) == [row]


def test_robots_of_vsss_are_identified(capsys: pytest.CaptureFixture[str]) -> None:
    identify.main(["--leagues", "vss", "--logs", "2"])
    printed = capsys.readouterr().out.splitlines()
    assert printed[0] == "vss"
    rows = {
        cells[0]: cells[1:]
        for cells in ([c.strip() for c in r.split("|")[1:-1]] for r in printed)
        if len(cells) == 6
    }
    assert rows["latency"][0] == "2 of 2"
    assert float(rows["latency"][2]) < 0.003, "three times the deviation of many logs"
    assert float(rows["wheel_radius"][2].rstrip("%")) < 2.0
    assert float(rows["longitudinal_grip"][2].rstrip("%")) < 10.0
    assert float(rows["rolling_deceleration"][2].rstrip("%")) < 5.0

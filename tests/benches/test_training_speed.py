"""Speed of the trainer: a short measurement of two checkouts in turn."""

import pytest

from benches import training_speed
from benches.training_speed import ROOT


def test_this_checkout_is_as_fast_as_itself(capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--task", "VSS-v0", "--threads", "1", "--rounds", "3", "--worlds", "16"]
    training_speed.main([*options, "--base", str(ROOT)])
    header, _, row = capsys.readouterr().out.splitlines()
    cells = [cell.strip() for cell in row.strip("|").split("|")]
    assert len(cells) == len(header.strip("|").split("|"))
    assert cells[:2] == ["`VSS-v0`", "1"]
    simulation, playing, learning = (float(cell.replace(",", "")) for cell in cells[2:5])
    assert simulation > playing > learning > 0.0
    assert 0.3 < float(cells[-1].split("x")[0]) < 3.0, "processor time relative to itself"

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


def test_whole_updates_are_measured_with_and_without_overlap(
    capsys: pytest.CaptureFixture[str],
) -> None:
    options = ["--task", "VSS-v0", "--threads", "1", "--rounds", "2", "--worlds", "16"]
    training_speed.main([*options, "--whole", "--overlap"])
    header, _, *rows = capsys.readouterr().out.splitlines()
    found = [[cell.strip() for cell in row.strip("|").split("|")] for row in rows]
    assert [cells[:4] for cells in found] == [
        ["`VSS-v0`", "1", "cpu", "no"],
        ["`VSS-v0`", "1", "cpu", "yes"],
    ]
    for cells in found:
        assert len(cells) == len(header.strip("|").split("|"))
        rollout, learning, update = (float(cell.removesuffix(" s")) for cell in cells[4:7])
        assert 0.0 < rollout < update and 0.0 < learning < update
        assert float(cells[7].replace(",", "")) > 0.0


@pytest.mark.parametrize("wrong", [["--overlap"], ["--device", "cpu"], ["--whole", "--store"]])
def test_options_that_do_not_fit_are_refused(wrong: list[str]) -> None:
    with pytest.raises(SystemExit):
        training_speed.main(wrong)

from pathlib import Path

import pytest

from benches.plot import core_ratios, draw, front_doors
from benches.table import Figure
from tests.benches.figures import MACHINE, OURS, PEERS, SHARED

SIGNATURE = b"\x89PNG\r\n"


@pytest.mark.parametrize("figures", [OURS, OURS + PEERS + SHARED], ids=["alone", "beside peers"])
def test_a_picture_is_drawn(figures: list[Figure], tmp_path: Path) -> None:
    path = draw(figures, MACHINE, tmp_path / "speed.png")
    assert path is not None
    assert path.read_bytes().startswith(SIGNATURE)


def test_only_figures_that_compare_are_drawn() -> None:
    assert {f.who for f in core_ratios(OURS + PEERS)} == {"Simulator / robosim 1.2"}
    assert not core_ratios(OURS)
    assert [f.who for f in front_doors(OURS + PEERS)] == [
        *("Matches", "empty ParallelEnv", "vmas 1.5.2"),
    ]


def test_nothing_to_draw_leaves_no_file(tmp_path: Path) -> None:
    assert draw(SHARED, MACHINE, tmp_path / "speed.png") is None
    assert not list(tmp_path.iterdir())

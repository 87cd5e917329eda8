from pathlib import Path

import pytest

from benches.plot import core_ratios, draw, environment_rates
from benches.result_files import Figure
from tests.benches.figures import (
    MACHINE,
    OTHER,
    OTHER_ENGINE,
    PSIM,
    RSOCCER,
    SCALING,
    THIRD_PARTY,
)

SIGNATURE = b"\x89PNG\r\n"


@pytest.mark.parametrize(
    "figures",
    [RSOCCER, RSOCCER + THIRD_PARTY + SCALING + OTHER + PSIM],
    ids=["alone", "with third-party simulators"],
)
def test_a_picture_is_drawn(figures: list[Figure], tmp_path: Path) -> None:
    path = draw(figures, MACHINE, tmp_path / "speed.png")
    assert path is not None
    assert path.read_bytes().startswith(SIGNATURE)


def test_only_comparable_figures_are_drawn() -> None:
    assert {f.variant for f in core_ratios(RSOCCER + THIRD_PARTY)} == {"Simulator / robosim 1.2"}
    assert not core_ratios(RSOCCER)
    both = RSOCCER + THIRD_PARTY + OTHER
    assert [figure.median for figure in core_ratios(both)] == [50.0, 100.0]
    assert [figure.median for figure in core_ratios(both, OTHER_ENGINE)] == [30.0]
    assert [figure.variant for figure in environment_rates(both, OTHER_ENGINE)] == ["Matches"]
    assert [f.variant for f in environment_rates(RSOCCER + THIRD_PARTY)] == [
        *("Matches", "no-op ParallelEnv", "vmas 1.5.2"),
    ]


def test_no_figures_leave_no_file(tmp_path: Path) -> None:
    assert draw(SCALING, MACHINE, tmp_path / "speed.png") is None
    assert not list(tmp_path.iterdir())

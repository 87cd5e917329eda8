"""The benchmark of the cost of senses."""

import dataclasses

import pytest

from benches import senses
from rsoccer import Sensing


def test_a_cost_is_of_the_time_without_senses() -> None:
    cost = senses.measure(senses.CASES[0], worlds=2, seeds=2, rounds=2, steps=3)
    assert cost.microseconds > 0.0
    assert cost.preset > -1.0 and cost.everything > -1.0
    shown = senses.report([dataclasses.replace(cost, microseconds=9.0, preset=0.2, everything=0.3)])
    assert "| VSSS 3 v 3 | 9.0 us | `vsss` | 20% | 30% |" in shown


def test_everything_is_every_number() -> None:
    for case in senses.CASES:
        sensing = Sensing(case.preset, **senses.EVERYTHING)
        used = [name for name in senses.EVERYTHING if getattr(sensing, name) > 0.0]
        assert used == list(senses.EVERYTHING)


def test_all_cases_are_printed(capsys: pytest.CaptureFixture[str]) -> None:
    senses.main(["--worlds", "1", "--seeds", "1", "--rounds", "1", "--steps", "1"])
    printed = capsys.readouterr().out
    assert all(case.title in printed for case in senses.CASES)

"""Entries of the leaderboard whose matches are played again."""

from dataclasses import replace
from functools import cache
from typing import Any

import pytest

from rsoccer.benchmark import Entry, Row, replayed, run_benchmark

TASK = "SSLGoToBall-v0"


@cache
def measured(policy: str) -> Entry:
    """Few matches take a second, so all tests share them."""
    return run_benchmark(policy, [TASK], matches=20, threads=1, robust=False)


def row_of(entry: Entry) -> Row:
    (row,) = entry.tasks[TASK]
    return row


def claimed(entry: Entry, **numbers: Any) -> Entry:  # noqa: ANN401  (any field)
    return replace(entry, tasks={TASK: (replace(row_of(entry), **numbers),)})


def elsewhere(entry: Entry) -> Entry:
    return replace(entry, machine={**entry.machine, "processor": "another"})


@pytest.mark.parametrize("policy", ["fetch", "zero", "best"])
def test_equal_matches_have_no_difference(policy: str) -> None:
    assert replayed(measured(policy), TASK, threads=2) == []
    assert replayed(elsewhere(measured(policy)), TASK, threads=1) == []


@pytest.mark.parametrize("low", [0.0, 1.0])
def test_a_claimed_success_is_revealed_whatever_the_interval_of_the_file(low: float) -> None:
    zero = measured("zero")
    assert row_of(zero).wins == 0
    entry = claimed(zero, wins=20, draws=0, score=1.0, low=low, high=1.0)
    (found,) = replayed(entry, TASK, threads=1)
    assert found == f"{TASK}, opponent -, condition truth: expected wins 0 as played again, got 20"
    (found,) = replayed(elsewhere(entry), TASK, threads=1)
    assert "expected a score of -0.161 to 0.161 as played again, got 1.000" in found


def test_a_script_has_the_same_numbers_on_a_machine_of_the_same_kind() -> None:
    fetch = measured("fetch")
    assert row_of(fetch).score == 1.0
    entry = claimed(fetch, wins=19, draws=1, score=0.95, low=0.85, high=1.0)
    (found,) = replayed(entry, TASK, threads=1)
    assert "expected wins 20 as played again, got 19" in found
    assert replayed(elsewhere(entry), TASK, threads=1) == []
    cores = {**fetch.machine, "cores": 999}
    assert replayed(replace(entry, machine=cores), TASK, threads=1) == [found]


def test_what_cannot_be_played_again_is_refused() -> None:
    entry = measured("fetch")
    with pytest.raises(ValueError, match=r"replay: expected one of \['SSLGoToBall-v0'\]"):
        replayed(entry, "VSS-v0")
    with pytest.raises(ValueError, match=r"replay: expected physics"):
        replayed(replace(entry, versions={"package": "0", "physics": 1}), TASK)
    with pytest.raises(ValueError, match=r"is not the file that was measured"):
        replayed(replace(entry, digest="0" * 64), TASK)
    for away in ("away.safetensors", "a_name_of_another_package"):
        with pytest.raises(FileNotFoundError, match=f"the file that was measured, {away}, here"):
            replayed(replace(entry, policy=away, digest="0" * 64), TASK)

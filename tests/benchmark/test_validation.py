"""Entries of the leaderboard: what makes one invalid."""

import json
import re
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from rsoccer.benchmark import (
    Entry,
    EntryError,
    is_current,
    problems,
    read_entry,
    run_benchmark,
)

TASK = "SSLGoToBall-v0"


@cache
def entry() -> Entry:
    """Scores of a whole task; few lines take seconds, so all tests share them."""
    return run_benchmark("fetch", [TASK], matches=200, threads=1, robust=False)


def values() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(entry().to_json())
    return found


def test_a_measured_entry_is_valid_and_read_as_it_was_written(tmp_path: Path) -> None:
    path = entry().save(tmp_path / "entry.json")
    assert problems(values()) == []
    assert read_entry(path) == entry()
    assert is_current(entry())
    assert not is_current(replace(entry(), versions={"package": "0", "physics": 1}))


def changed(change: Callable[[dict[str, Any]], object]) -> list[str]:
    found = values()
    change(found)
    return problems(found)


def row(**numbers: object) -> Callable[[dict[str, Any]], object]:
    return lambda found: found["tasks"][TASK][0].update(numbers)


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        (lambda v: v.update(format=2), "format: expected 1, got 2"),
        (lambda v: v.pop("machine"), "machine: missing"),
        (lambda v: v.update(extra=1), "extra: unknown"),
        (lambda v: v.update(robust="yes"), "robust: expected bool, got 'yes'"),
        (lambda v: v.update(name=" "), "name: expected a text"),
        (lambda v: v.update(seed=7), "seed: expected 31, got 7"),
        (lambda v: v.update(matches=100), "matches: expected at least 200, got 100"),
        (lambda v: v["versions"].update(physics=999), "versions.physics: expected 1 to"),
        (lambda v: v["versions"].pop("package"), "versions.package: expected a text, got None"),
        (lambda v: v["versions"].update(package=1), "versions.package: expected a text, got 1"),
        (lambda v: v.update(digest="0" * 63), "digest: expected 64 hexadecimal digits"),
        (lambda v: v.update(digest="G" * 64), "digest: expected 64 hexadecimal digits"),
        (lambda v: v.update(date="25.11.2026"), "date: expected year-month-day"),
        (lambda v: v.update(date="2026-02-30"), "date: expected year-month-day"),
        (lambda v: v.update(date="2999-11-26"), "not in the future, got '2999-11-26'"),
        (lambda v: v.update(link="javascript:alert(1)"), "link: expected an address"),
        (lambda v: v.update(link="https://a.org/) | x"), "link: expected an address"),
        (lambda v: v["refused"].update({"VSS-v0": 1}), "refused.VSS-v0: expected a text, got 1"),
        (lambda v: v["machine"].update(cores="2"), "machine.cores: expected int, got '2'"),
        (lambda v: v["machine"].pop("cores"), "machine.cores: missing"),
        (lambda v: v["tasks"].update({"Chess-v0": []}), "tasks: expected some of .*Chess-v0"),
        (lambda v: v["tasks"].clear(), "tasks: expected rows of at least one task"),
        (lambda v: v["refused"].update({TASK: "no"}), "expected rows or a reason, got both"),
        (lambda v: v["tasks"][TASK].clear(), r"expected each opponent .* missing \[\('-', 'truth'"),
        (
            lambda v: v["tasks"][TASK].append(v["tasks"][TASK][0]),
            "opponent and condition once",
        ),
        (lambda v: v.update(robust=True), r"missing .*'rc2021'"),
        (lambda v: v["tasks"].update({TASK: {}}), "expected a list of rows, got dict"),
        (row(score="1"), "row 0: score: expected float, got '1'"),
        (row(metric="goal_score"), "metric: expected 'reached', got 'goal_score'"),
        (row(matches=400), "matches: expected 200, got 400"),
        (row(wins=1), "wins, draws, losses: expected 200 in all"),
        (row(low=2.0), "score: expected low <= score <= high"),
        (row(score=float("nan")), "score: expected finite numbers"),
        (row(seconds=0.0), "seconds: expected a positive time"),
        (row(seconds=31.0), "seconds: expected a positive time up to 30, got 31.0"),
        (row(wall_clock=-1.0), "wall_clock: expected a time of 0 or more"),
        (row(wins=0, losses=200), "losses: expected 0 as reached is not negative, got 200"),
        (row(wins=1, draws=199, score=50.0, low=0.0, high=50.0), "expected .* 0.005, got 50.0"),
        (row(low=0.0), r"low: expected about 1.000, as of \(200, 0, 0\), got 0.0"),
        (row(wins=100, draws=100, score=0.5, low=0.5, high=0.5), "low: expected about 0.43"),
        (row(wins=100, draws=100, score=0.5, low=0.43, high=1.0), "high: expected about 0.57"),
    ],
)
def test_a_changed_entry_is_invalid(
    change: Callable[[dict[str, Any]], object], problem: str
) -> None:
    (found, *_) = changed(change)
    assert re.search(problem, found)


def test_an_address_and_a_digest_are_valid() -> None:
    both = {"link": "https://example.org/code?v=1#top", "digest": "0a" * 32}
    assert changed(lambda found: found.update(both)) == []


def test_a_goal_score_follows_from_the_counts() -> None:
    found = values()
    rows = [{**found["tasks"][TASK][0], "opponent": name} for name in ("ou", "zero", "strike")]
    for each in rows:
        each.update(metric="goal_score", wins=150, draws=0, losses=50, score=0.5, low=0.4, high=0.6)
    found["tasks"] = {"SSLSelfPlay-v0": rows}
    assert problems(found) == []
    rows[1]["score"] = 0.6
    (problem,) = problems(found)
    assert "expected (wins - losses) / matches" in problem


def test_an_interval_follows_from_the_counts_of_a_goal_score() -> None:
    found = values()
    rows = [{**found["tasks"][TASK][0], "opponent": name} for name in ("ou", "zero", "strike")]
    for each in rows:
        each.update(metric="goal_score", wins=100, draws=0, losses=100, score=0.0)
        each.update(low=-0.14, high=0.14)
    # No resample differs if one side wins all and the other loses all.
    rows[1].update(low=0.0, high=0.0)
    found["tasks"] = {"SSLSelfPlay-v0": rows}
    assert problems(found) == []
    rows[2].update(low=-1.0, high=1.0)
    low, high = problems(found)
    assert "row 2: low: expected about -0.14" in low
    assert "row 2: high: expected about 0.000 to 0.14" in high


@pytest.mark.parametrize(
    ("task", "metric", "numbers", "problem"),
    [
        ("SSLDribbling-v0", "gates", {"score": 3.5, "low": 3.4, "high": 3.6}, ""),
        ("SSLDribbling-v0", "gates", {"score": 3.505}, "score: expected 0.5 to 3.5 of 100 matches"),
        ("SSLDribbling-v0", "gates", {"score": 0.495}, "score: expected 0.5 to 3.5 of 100 matches"),
        ("SSLDribbling-v0", "gates", {"score": 1.001}, "score: expected a whole number over 200"),
        ("SSLDribbling-v0", "gates", {"high": 7.5}, "low, high: expected 0 to 7, got 0.0, 7.5"),
        ("SSLPassEnduranceMulti-v1", "passes", {"score": 9.5, "high": 12.0}, ""),
        ("SSLPassEnduranceMulti-v1", "passes", {"low": -1.0}, "low, high: expected 0 to 1200"),
    ],
)
def test_a_metric_that_counts_has_bounds(
    task: str, metric: str, numbers: dict[str, float], problem: str
) -> None:
    found = values()
    row = {**found["tasks"][TASK][0], "metric": metric, "wins": 100, "draws": 100}
    found["tasks"] = {task: [{**row, "score": 1.0, "low": 0.0, "high": 7.0, **numbers}]}
    assert problem in "; ".join(problems(found))
    assert bool(problem) == bool(problems(found))


def test_a_partial_entry_may_lack_rows_but_have_no_others() -> None:
    found = values()
    found["robust"] = True
    assert problems(found, partial=True) == []
    found["tasks"][TASK].append(dict(found["tasks"][TASK][0]))
    assert problems(found, partial=True)


def test_files_that_hold_no_entry_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "entry.json"
    path.write_text("{")
    with pytest.raises(EntryError, match="expected JSON"):
        read_entry(path)
    path.write_text("[]")
    with pytest.raises(EntryError, match="expected an object, got list"):
        read_entry(path)

"""Comparison of the contact engines: statistics of play, intervals, the result file."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benches import engine_agreement
from benches.engine_agreement import Comparison, load, play_agrees, score_agrees
from benches.play_statistics import (
    BALL_SPEED,
    GOALS,
    MEETING,
    POSSESSION,
    TOUCHING,
    Statistics,
    in_batches,
    play_ou,
    play_scenario,
)
from benches.scenarios import CROWD, ENGINES, Scenario
from benches.solvers import EPISODIC
from tools.engine_agreement import play_table, policy_table

SHORT = Scenario("VSSS 3 v 3", "vss_3v3", 3, "crowd", episode=40)


def comparison(reference: float, compared: float, half: float) -> Comparison:
    difference = reference - compared
    return Comparison(
        "scene", "speed", "m/s", 9, reference, compared, difference - half, difference + half
    )


def test_engines_agree_within_the_interval_or_the_bound() -> None:
    assert play_agrees(comparison(1.0, 0.9, 0.11)), "the interval contains 0"
    assert play_agrees(comparison(1.0, 0.96, 0.01)), "a difference of 4%"
    assert not play_agrees(comparison(1.0, 0.9, 0.05))
    off = replace(comparison(1.0, 0.9, 0.05), limit=0.92)
    assert play_agrees(off), "near the limit of short ticks"
    assert not play_agrees(replace(off, limit=1.0))
    assert score_agrees(comparison(0.5, 0.46, 0.01))
    assert not score_agrees(comparison(0.5, 0.4, 0.05))
    assert score_agrees(comparison(7.0, 6.7, 0.1)), "5% of a score above 1"


@pytest.mark.parametrize("engine", ENGINES)
def test_statistics_of_a_crowd_do_not_depend_on_the_batch(engine: str) -> None:
    def play(worlds: int, seed: int) -> Statistics:
        return play_scenario(SHORT, engine, 0.005, worlds, seed)

    together, apart = play(4, 3), in_batches(play, 4, 3, 3)
    for quantity, values in together.items():
        assert values.shape == (4,)
        assert np.array_equal(values, apart[quantity]), quantity
    assert together[MEETING].mean() > 0.0 < together[BALL_SPEED].mean()


def test_statistics_are_counted_per_step_and_per_minute() -> None:
    found = play_scenario(CROWD[0], "compact", 0.005, 8, 0)
    assert 0.0 < found[TOUCHING].mean() < 6.0
    assert 0.0 < found[POSSESSION].mean() < 600.0
    assert set(play_ou("compact", 1.0, 2, 0)) == {*found, GOALS}


def test_the_result_file_is_complete_and_reads_back() -> None:
    results, play, policies = load()
    assert {row.scene for row in play} == {*engine_agreement.CROWDS, engine_agreement.OU}
    assert len(policies) == len(EPISODIC) + 2
    assert results["profile"] == "release"
    for row in (*play, *policies):
        assert row.low <= row.difference + 1e-3 * abs(row.reference) + 1e-9
    assert play_table().count("\n") == len(play) + 1
    assert str(results["date"]) in policy_table()


def test_engines_agree() -> None:
    _, play, policies = load()
    missed = [row for row in play if not play_agrees(row)]
    missed += [row for row in policies if not score_agrees(row)]
    # A twentieth of all intervals misses 0 by chance: about 2, and in 5% of measurements above 5.
    assert len(play) + len(policies) > 40
    assert len(missed) <= 4, missed
    for row in missed:
        assert min(abs(row.low), abs(row.high)) < 0.1 * abs(row.reference), "by a little"


def test_a_file_reads_back(tmp_path: Path) -> None:
    row = comparison(1.0, 0.9, 0.1)
    path = tmp_path / "results.json"
    path.write_text(json.dumps({"date": "", "play": [vars(row)], "policies": []}))
    assert load(path) == ({"date": ""}, [row], [])

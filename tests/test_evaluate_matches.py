"""Evaluations, tournaments and ladders of matches with many goals."""

import json
from dataclasses import dataclass

import numpy as np
import pytest

from rsoccer.arrays import Floats
from rsoccer.evaluate import evaluate, tournament
from rsoccer.evaluate.results import MIN_PER_SIDE, bootstrap_rate
from rsoccer.play import Play
from rsoccer.tasks import SslMatch, VssMatch
from rsoccer.tasks.match import Match
from tests.helpers import bounds

SHORT = VssMatch(half_seconds=15.0, halves=1, referee={"goal_stop_seconds": 0.5})


@dataclass(frozen=True)
class Invented(VssMatch):
    """A match of two steps: blue scores three goals with a ball in play for 60 s, yellow one."""

    max_steps: int = 2

    def metrics(self, play: Play) -> dict[str, Floats]:
        n = len(play.frame)
        values = {"goal_score": 2.0, "blue_goals": 3.0, "yellow_goals": 1.0, "in_play": 60.0}
        return {name: np.full(n, value, np.float32) for name, value in values.items()}


def test_a_match_is_won_by_the_sign_of_its_goal_difference() -> None:
    found = evaluate("scripted", "zero", matches=20, seed=1, task=SHORT)
    assert (found.wins, found.draws, found.losses) == (20, 0, 0)
    assert found.score > 1.5, "a match counts with all of its goals"
    assert found.metrics["own_goals"] == pytest.approx(
        found.score + found.metrics["opponent_goals"]
    )
    low, high = bounds(found.goal_rates["own"])
    assert low < found.goal_rates["own"].mean < high
    expected = 600.0 * found.metrics["own_goals"] / found.metrics["in_play"]
    assert found.goal_rates["own"].mean == pytest.approx(expected, rel=1e-4)
    assert found.seconds_to_decision is not None
    assert found.seconds_to_decision < found.seconds.mean


def test_goals_count_for_the_policy_on_either_side() -> None:
    found = evaluate("zero", "zero", matches=4, task=Invented())
    assert (found.wins, found.losses, found.score) == (2, 2, 0.0)
    assert found.sides["blue"].score == 2.0 == -found.sides["yellow"].score
    rates = {team: rate.mean for team, rate in found.goal_rates.items()}
    assert rates == {"own": pytest.approx(20.0), "opponent": pytest.approx(20.0)}
    assert found.goal_rates["own"].low is None, "too few matches for an interval"


def test_matches_whose_ball_was_never_in_play_have_no_rate() -> None:
    assert evaluate("zero", "zero", matches=4, task=VssMatch(max_steps=3)).goal_rates == {}


def test_a_rate_is_a_ratio_of_sums() -> None:
    rng = np.random.default_rng(0)
    seconds = rng.uniform(1.0, 5.0, (2, 200))
    counts = rng.poisson(2.0 * seconds).astype(np.float64)
    strata = [np.stack([c, s], axis=1) for c, s in zip(counts, seconds, strict=True)]
    rate = bootstrap_rate(strata, rng)
    low, high = bounds(rate)
    assert rate.mean == pytest.approx(counts.sum() / seconds.sum())
    assert low < 2.0 < high
    error = np.sqrt(2.0 / seconds.sum())  # of a Poisson process
    assert high - low == pytest.approx(2 * 1.96 * error, rel=0.15)
    few = [part[: MIN_PER_SIDE - 1] for part in strata]
    assert bootstrap_rate(few, rng).low is None


def test_the_table_has_a_line_for_both_teams() -> None:
    found = evaluate("zero", "zero", matches=4, task=Invented())
    header, row, empty, teams, rates = str(found).splitlines()
    assert (header.split()[-2:], row.split()[-1], empty) == (["in", "play"], "60.00", "")
    assert teams.split("  ")[2].strip() == "goals in 10 min"
    assert rates.split()[2:6] == ["20.00", "-", "20.00", "-"]
    assert rates.endswith("2.00 : 2.00")
    assert json.loads(json.dumps(found.as_dict()))["goal_rates"]["own"]["low"] is None


def test_a_tournament_counts_matches_and_not_goals() -> None:
    found = tournament(["scripted", "ou", "zero"], matches=4, seed=2, task=SHORT)
    best = found.standings[0]
    assert best.policy == "scripted"
    assert (best.wins, best.losses, best.score) == (8, 0, 1.0)
    assert all(abs(score) <= 1.0 for row in found.scores for score in row)


@pytest.mark.parametrize("task", [SHORT, SslMatch(half_seconds=2.0, halves=1)], ids=["vsss", "ssl"])
def test_results_of_matches_depend_on_the_seed_only(task: Match) -> None:
    expected = evaluate("ou", "zero", matches=4, seed=3, task=task)
    assert evaluate("ou", "zero", matches=4, seed=3, task=task, worlds=1, threads=1) == expected

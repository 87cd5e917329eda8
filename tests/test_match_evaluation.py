"""Evaluations during a training of any library."""

from pathlib import Path

import pytest

import rsoccer
from rsoccer.match_evaluation import MatchEvaluation
from rsoccer.policies import Policy, make_policy


def test_scores_are_those_of_evaluate_at_intervals(tmp_path: Path) -> None:
    policy = make_policy("best", "VSS-v0")
    measured = MatchEvaluation(
        ("ou", "scripted:0.5"), every=100, matches=2, seed=3, folder=tmp_path, seconds=0.2
    )
    calls: list[int] = []

    def current() -> Policy:
        calls.append(1)
        return policy

    scores = [measured(current, samples) for samples in (10, 50, 109, 110, 150)]
    assert [bool(each) for each in scores] == [True, False, False, True, False]
    assert len(calls) == 2
    assert scores[0] == scores[3], "the matches are the same each time"
    expected = {
        f"evaluation/goal_score_{name}": rsoccer.evaluate(policy, name, 2, 3, task="VSS-v0").score
        for name in ("ou", "scripted:0.5")
    }
    assert scores[0] == expected
    assert [samples for samples, _ in measured.results] == [10, 110]
    assert [page.name for page in measured.pages] == ["match_10.html", "match_110.html"]
    assert "110 SAMPLES" in measured.pages[1].read_text()


def test_a_count_that_begins_again_is_a_new_training() -> None:
    measured = MatchEvaluation(every=100, matches=1)
    policy = make_policy("best", "SSLGoToBall-v0")
    counts = (0, 60, 120, 180, 8, 60, 108, 150)
    due = [bool(measured(policy, samples)) for samples in counts]
    assert due == [True, False, True, False, True, False, True, False]
    assert [measured.is_due(samples) for samples in (160, 208)] == [False, True]


def test_a_policy_for_a_task_that_is_given_needs_no_name_of_its_own() -> None:
    assert MatchEvaluation(task="SSLGoToBall-v0").naming == {"task_name": "SSLGoToBall-v0"}
    assert MatchEvaluation().naming == {}


def test_tasks_of_one_team_have_no_opponents() -> None:
    measured = MatchEvaluation(matches=1)
    scores = measured(make_policy("best", "SSLGoToBall-v0"), 0)
    assert list(scores) == ["evaluation/reached_default"]


def test_episodes_draw_numbers_as_those_of_evaluate(tmp_path: Path) -> None:
    ranges = {"robot.mass": (0.5, 2.0)}
    measured = MatchEvaluation(
        ("chase",), matches=2, folder=tmp_path, seconds=0.2, randomization=ranges
    )
    measured(make_policy("best", "VSS-v0"), 0)
    expected = rsoccer.evaluate("best", "chase", 2, task="VSS-v0", randomization=ranges)
    assert measured.results[0][1][0].returns == expected.returns
    assert expected.returns != rsoccer.evaluate("best", "chase", 2, task="VSS-v0").returns


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"opponents": "ou"}, "opponents: expected several policies, got 'ou'"),
        ({"opponents": [3]}, "opponents: expected a policy"),
        ({"every": 0}, "every: expected"),
        ({"matches": 0}, "matches: expected"),
        ({"seconds": 0.0}, "seconds"),
        ({"task": "Nothing-v0"}, "unknown task"),
        ({"folder": "/nowhere"}, "folder: expected one that exists, got /nowhere"),
        ({"folder": 3}, "folder: expected a path, got 3"),
        ({"opponents": 3}, "opponents: expected several policies, got 3"),
        ({"opponents": ["nope"]}, "unknown policy 'nope'"),
        (
            {"opponents": ["best"], "task": "SSLGoToBall-v0"},
            "opponent: SSLGoToBall-v0 has one team",
        ),
        ({"matches": 3, "task": "VSSSelfPlay-v0"}, "matches: expected an even number"),
        ({"threads": 0}, "threads: expected at least 1, got 0"),
        ({"threads": True}, "threads: expected a whole number, got True"),
        ({"threads": "x"}, "threads: expected a whole number, got 'x'"),
        ({"sensing": 3}, "sensing: expected a rsoccer.Sensing"),
        ({"sensing": "nope"}, "sensing.*nope"),
        ({"randomization": 3}, "randomization: expected distributions by name, got 3"),
        ({"randomization": {"x": 1}}, "randomization: expected one of .*, got 'x'"),
        ({"randomization": {"robot.mass": 10**400}}, "expected two finite numbers"),
        ({"randomization": {"ball.mass": 1e9}, "task": "VSS-v0"}, "expected values from"),
    ],
)
def test_bad_arguments_are_refused(arguments: dict[str, object], message: str) -> None:
    with pytest.raises((TypeError, ValueError), match=message):
        MatchEvaluation(**arguments)  # type: ignore[arg-type]

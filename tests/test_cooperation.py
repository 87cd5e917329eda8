"""`rsoccer.cooperation`: line-ups, their starts, cross-play, tables, and the command."""

import json
from pathlib import Path

import pytest

import rsoccer
from rsoccer import cli
from rsoccer.evaluate.team_play import MEASURES
from rsoccer.policies import make_policy
from rsoccer.tasks import SslKeepaway, SslPassEndurance, SslSelfPlay, VssSelfPlay

TASK = VssSelfPlay(max_steps=120)


def test_a_team_without_replacement_scores_as_in_evaluations() -> None:
    found = rsoccer.cooperation("chase", "zero", 20, 4, task=TASK, replacements=["zero"])
    expected = rsoccer.evaluate("chase", "zero", 20, 4, task=TASK)
    whole, replaced = found.line_ups
    assert (whole.score.mean, found.metric) == (expected.score, expected.metric)
    assert (whole.replacement, whole.difference, replaced.replacement) == ("-", None, "zero")
    assert whole.score.low is not None, "10 matches a side have an interval"
    assert replaced.difference is not None
    gap = replaced.score.mean - whole.score.mean
    assert replaced.difference.mean == pytest.approx(gap)
    assert list(whole.measures) == list(MEASURES)
    assert replaced.measures["spread"].mean > 0.0


def test_a_robot_replaced_by_the_same_policy_changes_nothing() -> None:
    """Starts are the same, and every robot is replaced in turn. `strike` draws no numbers."""
    task = SslSelfPlay(n_blue=2, n_yellow=2, max_steps=60)
    found = rsoccer.cooperation("strike", "zero", 4, 1, task=task, replacements=["strike", "ou"])
    whole, same, other = found.line_ups
    assert same.score == whole.score
    assert same.measures == whole.measures
    assert same.difference is not None
    assert same.difference.mean == 0.0
    assert other.measures["spread"] != whole.measures["spread"]


def test_results_do_not_depend_on_the_batch() -> None:
    few, many = (
        rsoccer.cooperation("chase", "ou", 8, 2, task=TASK, worlds=worlds, threads=threads)
        for worlds, threads in ((2, 1), (8, 2))
    )
    assert few == many
    assert [each.replacement for each in few.line_ups] == ["-", "zero", "scripted"]


def test_cross_play_mixes_two_policies_in_a_team() -> None:
    found = rsoccer.cooperation(
        "chase", "ou", 8, 5, task=TASK, replacements=["zero"], partners=["zero"]
    )
    cross = found.cross_play
    assert cross is not None
    assert cross.policies == ("chase", "zero")
    assert cross.scores[0][0] == found.line_ups[0].score
    assert cross.scores[0][1] == cross.scores[1][0]
    expected = cross.scores[0][1].mean - (cross.scores[0][0].mean + cross.scores[1][1].mean) / 2
    assert cross.gap.mean == pytest.approx(expected)
    assert "(2) zero" in str(found)
    assert "mixed teams less others" in str(found)


def test_cross_play_takes_policies_of_one_class() -> None:
    task = TASK
    policies = [make_policy(f"scripted:{skill}", task) for skill in (0.3, 0.9)]
    found = rsoccer.cooperation(
        policies[0], "zero", 4, task=task, replacements=["zero"], partners=[policies[1]]
    )
    assert found.cross_play is not None
    first, second = found.cross_play.policies
    assert first != second
    with pytest.raises(ValueError, match="partners: expected other policies, each once"):
        rsoccer.cooperation(policies[0], "zero", 4, task=task, partners=[policies[0]])


def test_one_sided_tasks_are_measured_from_their_side() -> None:
    task = SslKeepaway(max_steps=60)
    found = rsoccer.cooperation("keep", matches=3, task=task, replacements=["zero"])
    assert (found.opponent, found.matches, found.metric) == ("take", 3, "possession")
    assert found.line_ups[0].score.mean > 0.5
    takers = SslKeepaway(learners="takers", max_steps=60)
    found = rsoccer.cooperation("take", matches=2, task=takers, replacements=["zero"])
    assert (found.opponent, found.metric) == ("keep", "lost")


def test_the_teammate_of_a_single_learner_is_replaced() -> None:
    task = SslPassEndurance()
    found = rsoccer.cooperation("passer", matches=10, task=task, replacements=["zero"])
    whole, without = found.line_ups
    assert whole.score.mean >= 0.8
    assert without.score.mean < 0.5, "nobody turns to the ball"
    with pytest.raises(ValueError, match="partners: expected a task with two learners a team"):
        rsoccer.cooperation("passer", matches=1, task=task, partners=["zero"])


def test_wrong_arguments_are_named() -> None:
    with pytest.raises(ValueError, match="task: expected one with at least two robots a team"):
        rsoccer.cooperation("fetch", matches=1, task="SSLGoToBall-v0", replacements=["zero"])
    with pytest.raises(TypeError, match="replacements: expected a list of policies, got 'zero'"):
        rsoccer.cooperation("chase", task=TASK, replacements="zero")
    with pytest.raises(ValueError, match="partners: expected other policies, each once"):
        rsoccer.cooperation("chase", task=TASK, partners=["chase"])
    with pytest.raises(ValueError, match="matches: expected an even number"):
        rsoccer.cooperation("chase", matches=3, task=TASK)


def test_the_command_prints_and_writes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "found.json"
    options = ["--matches", "4", "--replacements", "zero", "--json", str(path)]
    task = ["--task", "VSSSelfPlay-v0", "--task-options", "max_steps=60"]
    assert cli.main(["cooperation", "chase", "--opponents", "ou", *task, *options]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("VSSSelfPlay-v0: chase against ou, 4 matches each\n")
    assert "replaced by" in printed
    found = json.loads(path.read_text())
    assert [each["replacement"] for each in found["line_ups"]] == ["-", "zero"]
    assert cli.main(["cooperation"]) == 2
    assert "policy: expected a policy or a task, got none" in capsys.readouterr().err

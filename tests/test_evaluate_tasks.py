"""Tasks in which one side plays: how often a policy succeeds, against whom the task has."""

import json
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

import rsoccer
from rsoccer import LEARN, Matches
from rsoccer.evaluate import evaluate, table
from rsoccer.frame import Floats, Mask
from rsoccer.lineup import lineup
from rsoccer.task import Play
from rsoccer.tasks import SslGoToBall, VssSelfPlay
from tests.policies.networks import network_for

module = sys.modules["rsoccer.evaluate.episodes"]

SOLVED = [
    ("SSLGoToBall-v0", "fetch", "reached", 0.9, 1.0, 15),
    ("SSLStaticDefenders-v0", "strike", "goal_score", 0.6, 1.0, 15),
    ("SSLContestedPossession-v0", "strike", "goal_score", 0.4, 1.0, 11),
    ("SSLDribbling-v0", "weave", "gates", 4.0, 7.0, 1),  # it always starts alike
    ("SSLPassEndurance-v0", "passer", "received", 0.8, 1.0, 15),
    ("SSLPassEnduranceMulti-v0", "passer", "passes", 1.0, 30.0, 11),
]


@pytest.mark.parametrize(("task", "solver", "metric", "least", "most", "count"), SOLVED)
def test_nobody_could_tell_how_often_a_policy_succeeds(
    task: str, solver: str, metric: str, least: float, most: float, count: int
) -> None:
    result = evaluate(solver, matches=count, seed=1, task=task)
    assert (result.matches, result.task, result.metric) == (count, task, metric)
    assert least <= result.low <= result.score <= result.high <= most
    assert result.low < result.high or result.score == most or count == 1
    assert result.returns.low <= result.returns.mean <= result.returns.high
    assert 0.0 < result.seconds.low <= result.seconds.mean <= result.seconds.high
    assert result.sides == {}
    idle = evaluate("zero", matches=count, seed=1, task=task)
    assert idle.high < 0.2 * least
    assert idle.returns.high < result.returns.low
    assert idle.decided_after is None


class Spy(Matches):
    """Notes who plays, and from where."""

    seen: ClassVar[list[tuple[dict[str, object], list[bytes]]]] = []

    def __init__(self, *args: Any, controllers: Mapping[str, Any], **kwargs: Any) -> None:  # noqa: ANN401
        super().__init__(*args, controllers=controllers, **kwargs)
        self.told = dict(controllers)

    def reset(self, *args: Any, **kwargs: Any) -> Floats:  # noqa: ANN401
        observations = super().reset(*args, **kwargs)
        self.seen.append((self.told, [row.tobytes() for row in self.frame.rows]))
        return observations


@pytest.fixture
def spy(monkeypatch: pytest.MonkeyPatch) -> type[Spy]:
    monkeypatch.setattr(Spy, "seen", [])
    monkeypatch.setattr(module, "Matches", Spy)
    return Spy


def test_defenders_were_driven_away_by_ou(spy: type[Spy]) -> None:
    task = rsoccer.make_task("SSLStaticDefenders-v0", max_steps=2)
    assert evaluate("strike", matches=4, task=task).opponent == "hold"
    ((told, _),) = spy.seen
    opponents = [f"yellow_{i}" for i in range(6)]
    assert told == {"blue_0": LEARN, **dict.fromkeys(opponents, "hold")}
    assert evaluate("strike", "zero", matches=4, task=task).opponent == "zero"
    told = spy.seen[1][0]
    assert {type(told[opponent]).__name__ for opponent in opponents} == {"Zero"}


def test_teammates_who_do_not_learn_were_driven_by_the_policy(spy: type[Spy]) -> None:
    task = rsoccer.make_task("VSS-v0", max_steps=2, teammates="chase", opponent="uniform")
    assert evaluate("scripted", matches=2, task=task).opponent == "uniform"
    blue, yellow = (told for told, _ in spy.seen)
    ours, theirs = [LEARN, "chase", "chase"], ["uniform"] * 3
    assert [blue[robot] for robot in task.robots] == [*ours, *theirs]
    assert [yellow[robot] for robot in task.robots] == [*theirs, *ours]


def test_every_policy_plays_the_same_starts(spy: type[Spy]) -> None:
    task = rsoccer.make_task("SSLGoToBall-v0", max_steps=3)
    for policy, worlds in (("zero", 10), ("fetch", 10), ("fetch", 4)):
        evaluate(policy, matches=10, seed=3, task=task, worlds=worlds)
    rows = [row for _, starts in spy.seen for row in starts]
    assert rows[:10] == rows[10:20] == rows[20:]
    assert len(set(rows)) == 10


@dataclass(frozen=True)
class Paid(SslGoToBall):
    """World i of a batch ends after i + 1 steps, paid 0.5 a step; every other one succeeds."""

    name = "Paid-v0"

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        n = len(play.steps)
        return {"alive": np.full((n, 1), 0.5, np.float32)}, play.steps > np.arange(n)

    def metrics(self, play: Play) -> dict[str, Floats]:
        n = len(play.steps)
        ended = play.steps == np.arange(n) + 1
        return {"reached": np.where(ended, np.arange(n) % 2, 9).astype(np.float32)}


def test_each_match_counts_once_as_it_ended() -> None:
    result = evaluate("zero", matches=6, task=Paid())
    assert (result.score, result.wins, result.draws, result.losses) == (0.5, 3, 3, 0)
    assert result.returns.mean == pytest.approx(0.5 * np.mean([1, 2, 3, 4, 5, 6]))
    assert result.seconds.mean == pytest.approx(0.025 * np.mean([1, 2, 3, 4, 5, 6]))
    assert result.decided_after == pytest.approx(0.025 * np.mean([2, 4, 6]))
    assert evaluate("zero", matches=5, task=Paid()).matches == 5


def test_half_a_course_is_no_full_success() -> None:
    result = evaluate("weave", matches=2, task=rsoccer.make_task("SSLDribbling-v0", max_steps=400))
    assert 0.0 < result.score < 7.0
    assert result.decided_after is None


def test_without_a_success_the_return_counts() -> None:
    @dataclass(frozen=True)
    class Unnamed(Paid):
        success = None  # type: ignore[assignment]

    result = evaluate("zero", matches=4, task=Unnamed())
    assert result.metric == "return"
    assert result.score == result.returns.mean == 0.5 * 2.5
    assert str(result).split()[:5] == ["policy", "opponent", "matches", "return", "95%"]


def test_two_sides_need_a_success() -> None:
    @dataclass(frozen=True)
    class Unnamed(VssSelfPlay):
        success = None  # type: ignore[assignment]

    with pytest.raises(ValueError, match=r"two sides.*success"):
        evaluate("zero", task=Unnamed())


def test_a_seed_fixes_what_a_network_draws(tmp_path: Path) -> None:
    task = rsoccer.make_task("SSLGoToBall-v0", max_steps=200)
    network_for(task).save(tmp_path / "policy.safetensors")
    drawn, again, mean = (
        evaluate(f"{tmp_path}/policy.safetensors{how}", matches=10, task=task, threads=threads)
        for how, threads in (("", 2), (":sample", 1), (":mean", 2))
    )
    assert drawn.returns == again.returns != mean.returns


# -- Which task -------------------------------------------------------------------------------


def test_the_task_that_a_policy_was_trained_on_was_not_played(tmp_path: Path) -> None:
    task = rsoccer.make_task("SSLGoToBall-v0")
    network_for(task).save(tmp_path / "policy.safetensors")
    for policy in (tmp_path / "policy.safetensors", network_for(task)):
        assert evaluate(policy, matches=2).task == "SSLGoToBall-v0"
    assert evaluate("chase", matches=2).task == "VSSSelfPlay-v0"


@pytest.mark.parametrize("name", rsoccer.list_tasks())
def test_each_task_names_its_success(name: str, tmp_path: Path) -> None:
    task = rsoccer.make_task(name, max_steps=2)
    network_for(task).save(tmp_path / "policy.safetensors")
    result = evaluate(tmp_path / "policy.safetensors", matches=2, task=task)
    assert result.metric == task.success
    assert set(result.sides) == ({"blue", "yellow"} if task.two_sided else set())
    assert task.two_sided == (name.startswith("VSS") or name == "SSLSelfPlay-v0")


def test_a_line_up_puts_teams_of_other_sizes_in_their_places() -> None:
    task = VssSelfPlay(n_blue=1, n_yellow=3)
    assert lineup(task, "chase") == {"blue_0": "chase", **_yellow("ou", 3)}
    assert lineup(task, "chase", "zero", "yellow") == {"blue_0": "zero", **_yellow("chase", 3)}


def _yellow(driver: str, count: int) -> dict[str, str]:
    return {f"yellow_{i}": driver for i in range(count)}


# -- Words and tables -------------------------------------------------------------------------


def test_tables_of_other_successes_stand_apart() -> None:
    told = [
        evaluate("zero", matches=3, task=rsoccer.make_task(name, max_steps=2))
        for name in ("SSLGoToBall-v0", "SSLDribbling-v0")
    ]
    first, second = table(told).split("\n\n")
    assert first.split()[3] == "reached"
    assert second.split()[3] == "gates"
    assert first.splitlines()[1].split()[:4] == ["zero", "-", "3", "0.000"]
    for part in (first, second):
        header, row = part.splitlines()
        assert len(header) - len("done after") == len(row) - len("-") - 9


def test_results_go_into_json() -> None:
    result = evaluate("fetch", matches=3, task="SSLGoToBall-v0")
    read = json.loads(json.dumps(result.as_dict()))
    assert (read["metric"], read["score"], read["matches"]) == ("reached", result.score, 3)
    assert read["returns"] == {
        "mean": result.returns.mean,
        "low": result.returns.low,
        "high": result.returns.high,
    }

"""Evaluations of one-sided tasks: success, starts, opponents and tables."""

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
from rsoccer.arrays import Floats, Mask
from rsoccer.evaluate import evaluate, table
from rsoccer.lineup import lineup
from rsoccer.task import Play
from rsoccer.tasks import SslGoToBall, VssSelfPlay
from tests.helpers import bounds
from tests.policies.networks import network_for

module = sys.modules["rsoccer.evaluate.episodes"]

SOLVED = [
    ("SSLGoToBall-v0", "fetch", "reached", 0.9, 1.0, 15),
    ("SSLStaticDefenders-v0", "strike", "goal_score", 0.6, 1.0, 15),
    ("SSLContestedPossession-v0", "strike", "goal_score", 0.4, 1.0, 11),
    ("SSLDribbling-v0", "weave", "gates", 4.0, 7.0, 10),  # every start is the same
    ("SSLPassEndurance-v1", "passer", "received", 0.8, 1.0, 15),
    ("SSLPassEnduranceMulti-v1", "passer", "passes", 1.0, 30.0, 11),
]


@pytest.mark.parametrize(("task", "solver", "metric", "lowest", "highest", "count"), SOLVED)
def test_a_script_solves_its_task_and_zero_does_not(
    task: str, solver: str, metric: str, lowest: float, highest: float, count: int
) -> None:
    result = evaluate(solver, matches=count, seed=1, task=task)
    assert (result.matches, result.task, result.metric) == (count, task, metric)
    low, high = bounds(result)
    assert lowest <= low <= result.score <= high <= highest
    assert low < high or result.score == highest
    low_return, high_return = bounds(result.returns)
    assert low_return <= result.returns.mean <= high_return
    low_seconds, high_seconds = bounds(result.seconds)
    assert 0.0 < low_seconds <= result.seconds.mean <= high_seconds
    assert result.sides == {}
    idle = evaluate("zero", matches=count, seed=1, task=task)
    assert bounds(idle)[1] < 0.2 * lowest
    assert bounds(idle.returns)[1] < low_return
    assert idle.seconds_to_decision is None


class Spy(Matches):
    """Records controllers and initial states."""

    records: ClassVar[list[tuple[dict[str, object], list[bytes]]]] = []

    def __init__(self, *args: Any, controllers: Mapping[str, Any], **kwargs: Any) -> None:  # noqa: ANN401
        super().__init__(*args, controllers=controllers, **kwargs)
        self.assigned = dict(controllers)

    def reset(self, *args: Any, **kwargs: Any) -> Floats:  # noqa: ANN401
        observations = super().reset(*args, **kwargs)
        self.records.append((self.assigned, [row.tobytes() for row in self.frame.rows]))
        return observations


@pytest.fixture
def spy(monkeypatch: pytest.MonkeyPatch) -> type[Spy]:
    monkeypatch.setattr(Spy, "records", [])
    monkeypatch.setattr(module, "Matches", Spy)
    return Spy


def test_opponents_keep_their_default_policies(spy: type[Spy]) -> None:
    task = rsoccer.make_task("SSLStaticDefenders-v0", max_steps=2)
    assert evaluate("strike", matches=4, task=task).opponent == "hold"
    ((controllers, _),) = spy.records
    opponents = [f"yellow_{i}" for i in range(6)]
    assert controllers == {"blue_0": LEARN, **dict.fromkeys(opponents, "hold")}
    assert evaluate("strike", "zero", matches=4, task=task).opponent == "zero"
    controllers = spy.records[1][0]
    assert {type(controllers[opponent]).__name__ for opponent in opponents} == {"Zero"}


def test_teammates_that_do_not_learn_keep_their_default_policies(spy: type[Spy]) -> None:
    task = rsoccer.make_task("VSS-v0", max_steps=2, teammates="chase", opponent="uniform")
    assert evaluate("scripted", matches=2, task=task).opponent == "uniform"
    blue, yellow = (controllers for controllers, _ in spy.records)
    home, away = [LEARN, "chase", "chase"], ["uniform"] * 3
    assert [blue[robot] for robot in task.robots] == [*home, *away]
    assert [yellow[robot] for robot in task.robots] == [*away, *home]


def test_starts_depend_on_the_seed_only(spy: type[Spy]) -> None:
    task = rsoccer.make_task("SSLGoToBall-v0", max_steps=3)
    for policy, worlds in (("zero", 10), ("fetch", 10), ("fetch", 4)):
        evaluate(policy, matches=10, seed=3, task=task, worlds=worlds)
    rows = [row for _, starts in spy.records for row in starts]
    assert rows[:10] == rows[10:20] == rows[20:]
    assert len(set(rows)) == 10


@dataclass(frozen=True)
class Alive(SslGoToBall):
    """World i of a batch ends after i + 1 steps of reward 0.5; every second world succeeds."""

    name = "Alive-v0"

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        n = len(play.steps)
        return {"alive": np.full((n, 1), 0.5, np.float32)}, play.steps > np.arange(n)

    def metrics(self, play: Play) -> dict[str, Floats]:
        n = len(play.steps)
        ended = play.steps == np.arange(n) + 1
        return {"reached": np.where(ended, np.arange(n) % 2, 9).astype(np.float32)}


def test_each_match_counts_once_as_it_ended() -> None:
    result = evaluate("zero", matches=6, task=Alive())
    assert (result.score, result.wins, result.draws, result.losses) == (0.5, 3, 3, 0)
    assert result.returns.mean == pytest.approx(0.5 * np.mean([1, 2, 3, 4, 5, 6]))
    assert result.seconds.mean == pytest.approx(0.025 * np.mean([1, 2, 3, 4, 5, 6]))
    assert result.seconds_to_decision == pytest.approx(0.025 * np.mean([2, 4, 6]))
    assert evaluate("zero", matches=5, task=Alive()).matches == 5


def test_part_of_a_course_is_no_full_success() -> None:
    result = evaluate("weave", matches=2, task=rsoccer.make_task("SSLDribbling-v0", max_steps=400))
    assert 0.0 < result.score < 7.0
    assert result.seconds_to_decision is None


def test_without_a_success_the_return_counts() -> None:
    @dataclass(frozen=True)
    class Unnamed(Alive):
        success = None  # type: ignore[assignment]

    result = evaluate("zero", matches=4, task=Unnamed())
    assert result.metric == "return"
    assert result.score == result.returns.mean == 0.5 * 2.5
    assert str(result).split()[:5] == ["policy", "opponent", "matches", "return", "95%"]


def test_a_two_sided_task_without_a_success_is_refused() -> None:
    @dataclass(frozen=True)
    class Unnamed(VssSelfPlay):
        success = None  # type: ignore[assignment]

    with pytest.raises(ValueError, match=r"two sides.*success"):
        evaluate("zero", task=Unnamed())


def test_the_actions_of_a_network_depend_on_the_seed_only(tmp_path: Path) -> None:
    task = rsoccer.make_task("SSLGoToBall-v0", max_steps=200)
    network_for(task).save(tmp_path / "policy.safetensors")
    drawn, again, mean = (
        evaluate(f"{tmp_path}/policy.safetensors{mode}", matches=10, task=task, threads=threads)
        for mode, threads in (("", 2), (":sample", 1), (":mean", 2))
    )
    assert drawn.returns == again.returns != mean.returns


# -- Default task -----------------------------------------------------------------------------


def test_the_default_task_is_the_one_a_policy_was_trained_on(tmp_path: Path) -> None:
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
    both_sides = ("SSLSelfPlay-v0", "SSLMatch-v0")
    assert task.two_sided == (name.startswith("VSS") or name in both_sides)


def test_a_lineup_resizes_teams_that_change_sides() -> None:
    task = VssSelfPlay(n_blue=1, n_yellow=3)
    assert lineup(task, "chase") == {"blue_0": "chase", **_yellow("ou", 3)}
    assert lineup(task, "chase", "zero", "yellow") == {"blue_0": "zero", **_yellow("chase", 3)}


def _yellow(policy: str, count: int) -> dict[str, str]:
    return {f"yellow_{i}": policy for i in range(count)}


# -- Tables and JSON --------------------------------------------------------------------------


def test_evaluations_of_other_metrics_get_a_table_of_their_own() -> None:
    evaluations = [
        evaluate("zero", matches=3, task=rsoccer.make_task(name, max_steps=2))
        for name in ("SSLGoToBall-v0", "SSLDribbling-v0")
    ]
    first, second = table(evaluations).split("\n\n")
    assert first.split()[3] == "reached"
    assert second.split()[3] == "gates"
    assert first.splitlines()[1].split()[:4] == ["zero", "-", "3", "0.000"]
    for part in (first, second):
        header, row = part.splitlines()
        assert len(header) - len("done after") == len(row) - len("-") - 9


def test_results_go_into_json() -> None:
    result = evaluate("fetch", matches=3, task="SSLGoToBall-v0")
    loaded = json.loads(json.dumps(result.as_dict()))
    assert (loaded["metric"], loaded["score"], loaded["matches"]) == ("reached", result.score, 3)
    assert loaded["returns"] == {
        "mean": result.returns.mean,
        "low": result.returns.low,
        "high": result.returns.high,
    }

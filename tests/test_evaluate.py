import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches
from rsoccer.evaluate import Evaluation, evaluate, table
from rsoccer.frame import Floats
from rsoccer.policies.base import Memory, Policy, Seen
from rsoccer.policies.chase import Chase
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import FORMAT
from rsoccer.rng import WorldRng
from rsoccer.task import Play
from rsoccer.tasks import VssSelfPlay
from tests.one_match import VSS_TASKS

module = sys.modules["rsoccer.evaluate"]


def a_network(seed: int = 0) -> Network:
    """A policy of the right sizes that has learned nothing."""
    task = rsoccer.make_task("VSSSelfPlay-v0")
    rng = np.random.default_rng(seed)
    sizes = {"observation_size": task.observation_size, "action_size": task.action_size}
    arrays = {
        "layers.0.weight": rng.normal(size=(task.action_size, task.observation_size)),
        "layers.0.bias": np.zeros(task.action_size),
        "mean": np.zeros(task.observation_size),
        "std": np.ones(task.observation_size),
    }
    metadata = {"format": FORMAT, "task": task.name, "activation": "tanh"}
    return Network(
        {name: array.astype(np.float32) for name, array in arrays.items()},
        metadata | {name: str(size) for name, size in sizes.items()},
    )


BETTER = [(name, "chase", 60) for name in VSS_TASKS] + [("SSLSelfPlay-v0", "strike", 10)]


@pytest.mark.parametrize(("task", "better", "count"), BETTER)
def test_a_better_policy_wins_from_either_side(task: str, better: str, count: int) -> None:
    result = evaluate(better, "zero", matches=count, seed=1, task=task)
    assert result.matches == count
    assert result.blue.matches == result.yellow.matches == count // 2
    assert result.blue.wins >= 0.36 * count
    assert result.yellow.wins >= 0.36 * count
    assert result.low > 0.5
    assert result.goal_time is not None
    assert 1.0 < result.goal_time < 20.0
    assert (result.policy, result.opponent, result.task) == (better, "zero", task)
    mirrored = evaluate("zero", better, matches=count, seed=1, task=task)
    assert mirrored.high < -0.5


def test_counts_add_up() -> None:
    result = evaluate("chase", "chase", matches=20, seed=2)
    for part in (result, result.blue, result.yellow):
        assert part.wins + part.draws + part.losses == part.matches
        assert part.goal_score == (part.wins - part.losses) / part.matches
        assert part.low <= part.goal_score <= part.high
    assert result.wins == result.blue.wins + result.yellow.wins
    assert result.losses == result.blue.losses + result.yellow.losses
    assert result.wins * result.losses > 0, "one side wins all: signs are not compared"


def test_a_seed_fixes_the_result_whatever_else() -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0", max_steps=300)
    expected = evaluate("chase", "ou", matches=10, seed=3, task=task)
    assert 0 < expected.wins < 10
    assert evaluate("chase", "ou", matches=10, seed=3, task=task) == expected
    assert evaluate("chase", "ou", matches=10, seed=3, task=task, threads=1) == expected
    assert evaluate("chase", "ou", matches=10, seed=3, task=task, worlds=3) == expected
    assert evaluate("chase", "ou", matches=10, seed=4, task=task) != expected


def test_each_match_has_a_start_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    starts: list[bytes] = []

    class Spy(Matches):
        def reset(self, *args: Any, **kwargs: Any) -> Floats:  # noqa: ANN401
            observations = super().reset(*args, **kwargs)
            starts.extend(row.tobytes() for row in self.frame.rows)
            return observations

    monkeypatch.setattr(module, "Matches", Spy)
    task = rsoccer.make_task("VSSSelfPlay-v0", max_steps=1)
    for seed in (0, 1):
        evaluate("zero", "zero", matches=20, seed=seed, task=task, worlds=3)
    assert len(starts) == len(set(starts)) == 40


def test_matches_without_a_goal_are_draws() -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0", max_steps=5)
    result = evaluate("zero", "zero", matches=4, task=task)
    assert (result.wins, result.draws, result.losses) == (0, 4, 0)
    assert (result.goal_score, result.low, result.high) == (0.0, 0.0, 0.0)
    assert result.goal_time is None
    assert str(result).splitlines()[1].endswith(" -")


@dataclass(frozen=True)
class Decided(VssSelfPlay):
    """World i of a batch ends with score i % 3 - 1 (for blue) after i + 1 steps."""

    name = "Decided-v0"

    def calculate_reward_and_done(self, play: Play) -> Any:  # noqa: ANN401
        terms, _ = super().calculate_reward_and_done(play)
        return terms, play.steps > np.arange(len(play.steps))

    def metrics(self, play: Play) -> dict[str, Floats]:
        score = np.arange(len(play.steps)) % 3 - 1
        return {"goal_score": np.where(play.steps == np.arange(len(play.steps)) + 1, score, 9)}


def test_each_match_counts_once_as_it_ended() -> None:
    result = evaluate("zero", "zero", matches=12, task=Decided())
    assert (result.blue.wins, result.blue.draws, result.blue.losses) == (2, 2, 2)
    assert (result.yellow.wins, result.yellow.draws, result.yellow.losses) == (2, 2, 2)
    assert result.goal_time == pytest.approx(0.025 * np.mean([1, 3, 4, 6]))
    five = evaluate("zero", "zero", matches=10, task=Decided())
    assert (five.blue.wins, five.blue.draws, five.blue.losses) == (1, 2, 2)
    assert (five.yellow.wins, five.yellow.draws, five.yellow.losses) == (2, 2, 1)
    assert five.goal_score == 0.0
    assert (five.blue.goal_score, five.yellow.goal_score) == (-0.2, 0.2)


def test_odd_numbers_of_matches_are_rounded_up() -> None:
    assert evaluate("zero", "zero", matches=3, task=Decided()).matches == 4


# -- Who plays --------------------------------------------------------------------------------


class Spin(Policy):
    """Turns on the spot."""

    observes: Literal["nothing", "view", "observation"] = "nothing"

    def act(self, seen: Seen, rng: WorldRng, memory: Memory) -> Floats:
        return np.tile(np.array([1.0, -1.0], np.float32), (*seen.shape[:2], 1))


def test_policies_may_be_names_files_or_objects(tmp_path: Path) -> None:
    network = a_network()
    path = tmp_path / "policy.safetensors"
    network.save(path)
    task = rsoccer.make_task("VSSSelfPlay-v0", max_steps=300)
    by_object, by_path, by_text = (
        evaluate(policy, Spin(), matches=6, seed=1, task=task)
        for policy in (network, path, str(path))
    )
    assert by_object.opponent == "Spin"
    assert by_object.policy == "Network"
    assert by_path.policy == by_text.policy == str(path)
    without_names = [{**one.as_dict(), "policy": ""} for one in (by_object, by_path, by_text)]
    assert without_names[0] == without_names[1] == without_names[2]


def test_one_policy_can_play_itself() -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0")
    chase = Chase(task)
    assert evaluate(chase, chase, matches=4, seed=0, task=task).matches == 4


# -- Words and tables -------------------------------------------------------------------------


def test_tables_line_up() -> None:
    results = [
        evaluate("zero", opponent, matches=4, task=Decided()) for opponent in ("ou", "uniform")
    ]
    header, *rows = table(results).splitlines()
    assert [row.split()[1] for row in rows] == ["ou", "uniform"]
    for title in ("matches", "goal score", "as blue"):
        end = header.index(title) + len(title)
        assert all(row[end - 1] != " " and row[end : end + 1] in ("", " ") for row in rows)
    assert str(results[0]).splitlines()[0].split() == header.split()


def test_results_go_into_json() -> None:
    result = evaluate("zero", "zero", matches=4, task=Decided())
    read = json.loads(json.dumps(result.as_dict()))
    assert read["matches"] == 4
    assert read["blue"]["wins"] == result.blue.wins
    assert read["seed"] == 0
    assert set(read) >= {"wins", "draws", "losses", "goal_score", "low", "high", "goal_time"}


def test_the_package_offers_the_function() -> None:
    assert rsoccer.evaluate is evaluate
    assert isinstance(rsoccer.evaluate("zero", "zero", 2, task=Decided()), Evaluation)


# -- Wrong input ------------------------------------------------------------------------------


@dataclass(frozen=True)
class Unscored(VssSelfPlay):
    name = "Unscored-v0"

    def metrics(self, play: Play) -> dict[str, Floats]:
        return {}


@dataclass(frozen=True)
class OneSided(VssSelfPlay):
    name = "OneSided-v0"
    sides = ("blue",)


WRONG: list[tuple[dict[str, Any], type[Exception], str]] = [
    ({"policy": "nobody"}, ValueError, "unknown policy 'nobody'.*chase"),
    ({"opponent": "nobody"}, ValueError, "unknown policy 'nobody'.*chase"),
    ({"policy": "gone.safetensors"}, FileNotFoundError, r"gone\.safetensors"),
    ({"matches": 1}, ValueError, "matches: expected at least 2, got 1"),
    ({"matches": 2.5}, TypeError, "matches: expected a whole number, got 2.5"),
    ({"seed": -1}, ValueError, "seed: expected at least 0"),
    ({"worlds": 0}, ValueError, "worlds: expected at least 1"),
    ({"threads": 0}, ValueError, "threads: expected at least 1"),
    ({"task": "VSS-v9"}, ValueError, "unknown task 'VSS-v9'"),
    ({"task": VssSelfPlay(n_yellow=0)}, ValueError, "no yellow side"),
    ({"task": OneSided()}, ValueError, "no yellow side"),
    ({"task": Unscored()}, ValueError, "'Unscored-v0' has no metric 'goal_score'"),
]


@pytest.mark.parametrize(("changes", "error", "message"), WRONG)
def test_wrong_input_is_named(
    changes: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        evaluate(**{"policy": "zero", "matches": 2, **changes})


def test_a_network_for_other_sizes_is_refused() -> None:
    with pytest.raises(ValueError, match=r"observation_size \d+, but task 'VSSSelfPlay-v0' has"):
        evaluate(a_network(), "zero", 2, task=VssSelfPlay(n_blue=2, n_yellow=2))

"""Evaluations of two-sided tasks: sides, seeds, counts, and invalid input."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches
from rsoccer.arrays import Floats, Mask
from rsoccer.evaluate import Results, evaluate
from rsoccer.frame import Frame
from rsoccer.game import EventKind
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import FORMAT
from rsoccer.policies.vss.chase import Chase
from rsoccer.rng import WorldRng
from rsoccer.rules import Crossings, Restart, Rule
from rsoccer.task import Play
from rsoccer.tasks import SslSelfPlay, VssSelfPlay
from tests.helpers import bounds

module = sys.modules["rsoccer.evaluate.episodes"]


def untrained_network(seed: int = 0) -> Network:
    """Return an untrained policy of the right sizes."""
    task = rsoccer.make_task("VSSSelfPlay-v0")
    rng = np.random.default_rng(seed)
    sizes = {"observation_size": task.layout.size, "action_size": task.action_size}
    arrays = {
        "layers.0.weight": rng.normal(size=(task.action_size, task.layout.size)),
        "layers.0.bias": np.zeros(task.action_size),
        "mean": np.zeros(task.layout.size),
        "std": np.ones(task.layout.size),
    }
    metadata = {"format": FORMAT, "task": task.name, "activation": "tanh"}
    return Network(
        {name: array.astype(np.float32) for name, array in arrays.items()},
        metadata | {name: str(size) for name, size in sizes.items()},
    )


WINNERS = [
    ("VSSSelfPlay-v0", "chase", 60, 0.72),
    ("VSS-v0", "chase", 60, 0.3),  # its teammates follow `ou`
    ("SSLSelfPlay-v0", "strike", 20, 0.72),
]


@pytest.mark.parametrize(("task", "winner", "count", "share"), WINNERS)
def test_a_better_policy_wins_on_either_side(
    task: str, winner: str, count: int, share: float
) -> None:
    result = evaluate(winner, "zero", matches=count, seed=1, task=task)
    assert result.matches == count
    assert result.sides["blue"].matches == result.sides["yellow"].matches == count // 2
    assert result.sides["blue"].wins >= share * count / 2
    assert result.sides["yellow"].wins >= share * count / 2
    assert bounds(result)[0] > share - 0.25
    assert result.seconds_to_decision is not None
    assert 1.0 < result.seconds_to_decision < 20.0
    assert (result.policy, result.opponent, result.task) == (winner, "zero", task)
    mirrored = evaluate("zero", winner, matches=count, seed=1, task=task)
    assert bounds(mirrored)[1] < 0.25 - share or task == "VSS-v0", (
        "zero's teammates, which follow ou, may score"
    )


def test_counts_add_up() -> None:
    result = evaluate("chase", "chase", matches=20, seed=2)
    for part in (result, result.sides["blue"], result.sides["yellow"]):
        assert part.wins + part.draws + part.losses == part.matches
        assert part.score == (part.wins - part.losses) / part.matches
        low, high = bounds(part)
        assert low <= part.score <= high
    assert result.wins == result.sides["blue"].wins + result.sides["yellow"].wins
    assert result.losses == result.sides["blue"].losses + result.sides["yellow"].losses
    assert result.wins * result.losses > 0, "one policy won all, so signs are not compared"


def test_the_result_depends_on_the_seed_only() -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0", max_steps=150)
    expected = evaluate("chase", "ou", matches=10, seed=3, task=task)
    assert 0 < expected.wins < 10
    assert evaluate("chase", "ou", matches=10, seed=3, task=task) == expected
    assert evaluate("chase", "ou", matches=10, seed=3, task=task, threads=1) == expected
    assert evaluate("chase", "ou", matches=10, seed=3, task=task, worlds=3) == expected
    assert evaluate("chase", "ou", matches=10, seed=4, task=task) != expected


def test_each_match_has_its_own_initial_state(monkeypatch: pytest.MonkeyPatch) -> None:
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
    result = evaluate("zero", "zero", matches=20, task=task)
    assert (result.wins, result.draws, result.losses) == (0, 20, 0)
    assert (result.score, result.low, result.high) == (0.0, 0.0, 0.0)
    assert result.seconds_to_decision is None
    assert str(result).splitlines()[1].split()[-2:] == ["-", "0.00"], "goal after, free balls"


def counts(results: Results) -> tuple[int, int, int]:
    return results.wins, results.draws, results.losses


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


def test_each_match_counts_once_at_its_end() -> None:
    result = evaluate("zero", "zero", matches=12, task=Decided())
    assert counts(result.sides["blue"]) == (2, 2, 2)
    assert counts(result.sides["yellow"]) == (2, 2, 2)
    assert result.seconds_to_decision == pytest.approx(0.025 * np.mean([1, 3, 4, 6]))
    assert result.decided == 8
    five = evaluate("zero", "zero", matches=10, task=Decided())
    assert counts(five.sides["blue"]) == (1, 2, 2)
    assert counts(five.sides["yellow"]) == (2, 2, 1)
    assert five.score == 0.0
    assert (five.sides["blue"].score, five.sides["yellow"].score) == (-0.2, 0.2)


def test_an_odd_number_of_matches_is_refused_in_two_sided_tasks() -> None:
    with pytest.raises(ValueError, match=r"matches: expected an even number, .*both sides, got 3"):
        evaluate("zero", "zero", matches=3, task=Decided())
    for count in (1, 3):
        assert evaluate("fetch", matches=count, task="SSLGoToBall-v0").matches == count


# -- Policies ---------------------------------------------------------------------------------


class Spin(Policy):
    """A policy that turns on the spot."""

    observes: Literal["nothing", "view", "observation"] = "nothing"

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        return np.tile(np.array([1.0, -1.0], np.float32), (*inputs.action_shape[:2], 1))


def test_policies_may_be_names_files_or_objects(tmp_path: Path) -> None:
    network = untrained_network()
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
    unnamed = [{**one.as_dict(), "policy": ""} for one in (by_object, by_path, by_text)]
    assert unnamed[0] == unnamed[1] == unnamed[2]


def test_one_object_can_play_against_itself() -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0")
    chase = Chase(task)
    assert evaluate(chase, chase, matches=4, seed=0, task=task).matches == 4


# -- Invalid input ----------------------------------------------------------------------------


@dataclass(frozen=True)
class Unscored(VssSelfPlay):
    name = "Unscored-v0"

    def metrics(self, play: Play) -> dict[str, Floats]:
        return {}


@dataclass(frozen=True)
class ScoredBy(VssSelfPlay):
    """A match with a score and rewards that are given."""

    max_steps: int = 2
    metric: float = 0.0
    reward: float = 0.0

    def calculate_reward_and_done(self, play: Play) -> Any:  # noqa: ANN401
        _, done = super().calculate_reward_and_done(play)
        return {"own": np.full((len(done), 1), self.reward, np.float32)}, done

    def metrics(self, play: Play) -> dict[str, Floats]:
        return {"goal_score": np.full(len(play.steps), self.metric, np.float32)}


@dataclass(frozen=True)
class ScoredByItsReturn(ScoredBy):
    """A match of one side without a metric of success."""

    n_yellow: int = 0
    success = None  # type: ignore[assignment]


INVALID: list[tuple[dict[str, Any], type[Exception], str]] = [
    ({"policy": "nobody"}, ValueError, "unknown policy 'nobody'.*chase"),
    ({"opponent": "nobody"}, ValueError, "unknown policy 'nobody'.*chase"),
    ({"policy": "gone.safetensors"}, FileNotFoundError, r"gone\.safetensors"),
    ({"matches": 1}, ValueError, "matches: expected at least 2, got 1"),
    ({"matches": 2.5}, TypeError, "matches: expected a whole number, got 2.5"),
    ({"seed": -1}, ValueError, "seed: expected at least 0"),
    ({"worlds": 0}, ValueError, "worlds: expected at least 1"),
    ({"threads": 0}, ValueError, "threads: expected at least 1"),
    ({"policy": 3}, TypeError, "policy: expected a policy, its name or its file, got 3"),
    ({"opponent": 3}, TypeError, "opponent: expected a policy, its name or its file, got 3"),
    ({"policy": b"chase"}, TypeError, "policy: expected a policy, .*, got b'chase'"),
    ({"task": 5}, TypeError, "task: expected a task or its name, got 5"),
    ({"task": "VSS-v9"}, ValueError, "unknown task 'VSS-v9'"),
    ({"task": VssSelfPlay(n_yellow=0), "opponent": "ou"}, ValueError, "opponent: VSS.*one team"),
    ({"task": "SSLPassEndurance-v1", "opponent": "ou"}, ValueError, "opponent: SSL.*one team"),
    ({"task": ScoredBy(metric=np.nan)}, ValueError, "finite numbers of 'goal_score', .*, got nan"),
    ({"task": ScoredBy(metric=np.inf)}, ValueError, "finite numbers of 'goal_score', .*, got inf"),
    ({"task": ScoredByItsReturn(reward=np.nan)}, ValueError, "finite numbers of 'return', .* nan"),
    ({"task": Unscored()}, ValueError, "'Unscored-v0' has no metric 'goal_score'"),
]


@pytest.mark.parametrize(("changes", "error", "message"), INVALID)
def test_wrong_input_is_named(
    changes: dict[str, Any], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        evaluate(**{"policy": "zero", "matches": 2, **changes})


def test_a_network_for_other_sizes_is_refused() -> None:
    with pytest.raises(ValueError, match=r"observation_size \d+, but task 'VSSSelfPlay-v0' has"):
        evaluate(untrained_network(), "zero", 2, task=VssSelfPlay(n_blue=2, n_yellow=2))


class Push(Policy):
    """Drives ahead."""

    observes: Observes = "nothing"

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        return np.ones(inputs.action_shape, np.float32)


@dataclass(frozen=True)
class BeforeTheGoal(VssSelfPlay):
    """The ball lies between one robot and a goal; the robot is the policy's in half of the cases.

    Robot 0 of the team faces blue's goal in even worlds, and the other one in odd worlds.
    """

    name = "BeforeTheGoal-v0"
    team: str = "blue"

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        frame = Frame.empty(len(rng), self.n_blue, self.n_yellow)
        side = np.where(np.arange(len(rng)) % 2 == 0, -1.0, 1.0)
        frame.ball.position[:, 0] = 0.7 * side
        frame.robots.position[..., 0] = 0.0
        frame.robots.position[..., 1] = 0.6 * np.linspace(-1.0, 1.0, self.n_blue + self.n_yellow)
        robots = frame.blue if self.team == "blue" else frame.yellow
        robots.position[:, 0] = np.stack([0.62 * side, np.zeros(len(rng))], axis=-1)
        robots.heading[:, 0] = np.stack([side, np.zeros(len(rng))], axis=-1)
        return frame


def test_own_goals_are_goals_after_a_last_touch_of_the_own_team() -> None:
    task = BeforeTheGoal(n_blue=1, n_yellow=1, max_steps=40)
    result = evaluate(Push(), "zero", matches=16, task=task)
    assert counts(result.sides["blue"]) == (4, 0, 4)
    assert counts(result.sides["yellow"]) == (0, 8, 0)  # the robot before the goal stands still
    assert (result.decided, result.own_goals) == (8, 4)
    pushed = evaluate("zero", Push(), matches=16, task=task)
    assert counts(pushed.sides["yellow"]) == (4, 0, 4)
    assert (pushed.decided, pushed.own_goals) == (8, 0), "these are own goals of the opponent"


def test_own_goals_of_the_first_yellow_robot_are_yellows() -> None:
    task = BeforeTheGoal(n_blue=1, n_yellow=1, max_steps=40, team="yellow")
    result = evaluate(Push(), "zero", matches=16, task=task)
    assert counts(result.sides["blue"]) == (0, 8, 0)
    assert counts(result.sides["yellow"]) == (4, 0, 4)
    assert (result.decided, result.own_goals) == (8, 4)
    pushed = evaluate("zero", Push(), matches=16, task=task)
    assert (pushed.decided, pushed.own_goals) == (8, 0), "these are own goals of the opponent"


class KickOff(Rule):
    """After a goal all bodies go back to where they stood at the start."""

    def __init__(self, rows: Floats) -> None:
        self.rows = rows

    def judge(self, play: Play) -> Restart | None:
        worlds = np.flatnonzero(play.events.happened(EventKind.GOAL))
        return Restart(worlds, rows=self.rows[worlds]) if len(worlds) else None


@dataclass(frozen=True)
class ToTheTimeLimit(BeforeTheGoal):
    """Play goes on after goals."""

    @cached_property
    def rules(self) -> Sequence[Rule]:
        start = self.get_initial_positions_frame(WorldRng.seeded(0, 8))
        return (Crossings(), KickOff(start.rows))

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        return terms, np.zeros_like(done)


def test_goals_that_end_no_match_count_too() -> None:
    task = ToTheTimeLimit(n_blue=1, n_yellow=1, max_steps=100)
    result = evaluate(Push(), "zero", matches=16, task=task)
    ending = BeforeTheGoal(n_blue=1, n_yellow=1, max_steps=100)
    first = evaluate(Push(), "zero", matches=16, task=ending)
    assert result.decided == first.decided == 8
    assert result.seconds_to_decision == first.seconds_to_decision
    assert result.seconds.mean == pytest.approx(2.5)
    assert result.own_goals > first.own_goals == 4


def test_other_metrics_are_means_from_the_view_of_the_policy() -> None:
    result = evaluate("chase", "ou", matches=40, seed=1)
    assert set(result.metrics) == {"free_balls"}
    assert 0.0 < result.metrics["free_balls"] < 1.0
    passing = evaluate("strike", "zero", matches=4, task=PassingTask())
    assert passing.metrics == {"own_passes": 3.0, "opponent_passes": 1.0, "throw_ins": 4.0}
    assert passing.as_dict()["metrics"] == passing.metrics
    assert passing.goal_rates == {}
    lines = str(passing).splitlines()
    assert lines[0].endswith("throw ins") and lines[1].endswith("4.00")
    assert lines[3].split() == ["policy", "opponent", "passes"]
    assert lines[4].split() == ["strike", "zero", "3.00", ":", "1.00"]


class PassingTask(SslSelfPlay):
    """A task whose winner, by assumption, makes three passes, and the other team one."""

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Derive passes from the score, and add a metric of the match that is not a team's."""
        score = super().metrics(play)["goal_score"]
        return {
            "goal_score": score,
            "blue_passes": 2.0 + score,
            "yellow_passes": 2.0 - score,
            "throw_ins": np.full_like(score, 4.0),
        }


def test_matches_have_the_simulator_and_the_senses_that_are_named() -> None:
    usual = evaluate("chase", "zero", matches=20, task="VSSSelfPlay-v0")
    blind = evaluate("chase", "zero", matches=20, sensing="tests.simulators:Blind")
    still = evaluate("chase", "zero", matches=20, simulator="tests.simulators:Still")
    assert usual.score > blind.score
    assert still.score == 0.0

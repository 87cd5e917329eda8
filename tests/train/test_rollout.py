"""Holding an action: what happens to a match that ends within the repeat."""

from typing import Any, cast

import numpy as np

from rsoccer.frame import Floats
from rsoccer.matches import Matches, Outcome
from rsoccer.train.trainer import decide

NEVER = 99


class Scripted:
    """Three worlds, two agents. Rewards and observations are 10 x step + world; ends as told."""

    def __init__(self, goal_at: list[int], clock_at: list[int]) -> None:
        self.goal_at, self.clock_at = np.array(goal_at), np.array(clock_at)
        self.steps = 0
        self.given: list[Floats] = []

    def step(self, actions: Floats) -> Outcome:
        self.steps += 1
        self.given.append(actions)
        each: Floats = np.arange(3).astype(np.float32) + np.float32(10 * self.steps)
        rewards = np.repeat(each[:, None], 2, axis=1)
        observations = np.repeat(rewards[:, :, None], 4, axis=2)
        return Outcome(
            observations=observations,
            final_observations=observations.copy(),
            rewards=rewards,
            terms={"half": rewards * np.float32(0.5)},
            terminated=self.goal_at == self.steps,
            truncated=self.clock_at == self.steps,
            metrics={"goal_score": each.copy()},
        )


def played(goal_at: list[int], clock_at: list[int], repeat: int) -> tuple[Scripted, Any]:
    matches = Scripted(goal_at, clock_at)
    decision = decide(cast("Matches", matches), np.ones((3, 2, 2), np.float32), repeat)
    return matches, decision


def test_the_same_action_is_held_and_rewards_add_up() -> None:
    matches, decision = played([NEVER] * 3, [NEVER] * 3, repeat=3)
    assert matches.steps == 3
    assert all((given == 1.0).all() for given in matches.given)
    assert decision.rewards[:, 0].tolist() == [60.0, 63.0, 66.0]
    assert decision.observations[:, 1, 3].tolist() == [30.0, 31.0, 32.0]
    assert decision.terms == {"half": 31.5}
    assert not decision.ended.any()


def test_nothing_of_what_follows_an_end_leaks_in() -> None:
    # World 0 scores in the first step, world 1 runs out of time in the second.
    _, decision = played([1, NEVER, NEVER], [NEVER, 2, NEVER], repeat=4)
    assert decision.rewards[:, 0].tolist() == [10.0, 11.0 + 21.0, 12.0 + 22.0 + 32.0 + 42.0]
    assert decision.observations[:, 0, 0].tolist() == [10.0, 21.0, 42.0]
    assert decision.metrics["goal_score"].tolist() == [10.0, 21.0, 42.0]
    assert decision.terminated.tolist() == [True, False, False]
    assert decision.ended.tolist() == [True, True, False]


def test_a_second_end_within_the_repeat_changes_nothing() -> None:
    # The clock would strike after the goal; the match is over by then.
    _, decision = played([1, NEVER, NEVER], [3, NEVER, NEVER], repeat=3)
    assert decision.terminated.tolist() == [True, False, False]
    assert decision.rewards[0, 0] == 10.0


def test_without_repeat_a_decision_is_a_step() -> None:
    matches, decision = played([NEVER, 1, NEVER], [NEVER] * 3, repeat=1)
    assert matches.steps == 1
    assert decision.rewards[:, 0].tolist() == [10.0, 11.0, 12.0]
    assert decision.terminated.tolist() == [False, True, False]

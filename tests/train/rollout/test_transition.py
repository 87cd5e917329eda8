"""Action repeat: rewards, observations and ends of a match that ends within the repeat."""

from typing import cast

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.matches import Matches, Outcome
from rsoccer.train.rollout.transition import Transition, repeat_action

NEVER = 99


class FakeMatches:
    """Three worlds, two agents; rewards and observations are 10 x step + world."""

    def __init__(self, terminated_at: list[int], truncated_at: list[int]) -> None:
        self.terminated_at, self.truncated_at = np.array(terminated_at), np.array(truncated_at)
        self.steps = 0
        self.actions: list[Floats] = []

    def step(self, actions: Floats) -> Outcome:
        self.steps += 1
        self.actions.append(actions)
        values: Floats = np.arange(3).astype(np.float32) + np.float32(10 * self.steps)
        rewards = np.repeat(values[:, None], 2, axis=1)
        observations = np.repeat(rewards[:, :, None], 4, axis=2)
        return Outcome(
            observations=observations,
            final_observations=observations.copy(),
            rewards=rewards,
            terms={"half": rewards * np.float32(0.5)},
            terminated=self.terminated_at == self.steps,
            truncated=self.truncated_at == self.steps,
            metrics={"goal_score": values.copy()},
        )


def repeated(
    terminated_at: list[int], truncated_at: list[int], action_repeat: int
) -> tuple[FakeMatches, Transition]:
    matches = FakeMatches(terminated_at, truncated_at)
    actions = np.ones((3, 2, 2), np.float32)
    transition = repeat_action(cast("Matches", matches), actions, action_repeat)
    return matches, transition


def test_the_same_action_is_held_and_rewards_add_up() -> None:
    matches, transition = repeated([NEVER] * 3, [NEVER] * 3, action_repeat=3)
    assert matches.steps == 3
    assert all((actions == 1.0).all() for actions in matches.actions)
    assert transition.rewards[:, 0].tolist() == [60.0, 63.0, 66.0]
    assert transition.observations[:, 1, 3].tolist() == [30.0, 31.0, 32.0]
    assert transition.terms == {"half": 31.5}
    assert not transition.ended.any()


def test_steps_after_an_end_do_not_count() -> None:
    # World 0 terminates in the first step, world 1 is truncated in the second.
    _, transition = repeated([1, NEVER, NEVER], [NEVER, 2, NEVER], action_repeat=4)
    assert transition.rewards[:, 0].tolist() == [10.0, 11.0 + 21.0, 12.0 + 22.0 + 32.0 + 42.0]
    assert transition.observations[:, 0, 0].tolist() == [10.0, 21.0, 42.0]
    assert transition.metrics["goal_score"].tolist() == [10.0, 21.0, 42.0]
    assert transition.terminated.tolist() == [True, False, False]
    assert transition.ended.tolist() == [True, True, False]


def test_a_second_end_within_the_repeat_changes_nothing() -> None:
    # The time limit comes after the goal that ended the match.
    _, transition = repeated([1, NEVER, NEVER], [3, NEVER, NEVER], action_repeat=3)
    assert transition.terminated.tolist() == [True, False, False]
    assert transition.rewards[0, 0] == 10.0


def test_an_action_repeat_of_1_is_one_step() -> None:
    matches, transition = repeated([NEVER, 1, NEVER], [NEVER] * 3, action_repeat=1)
    assert matches.steps == 1
    assert transition.rewards[:, 0].tolist() == [10.0, 11.0, 12.0]
    assert transition.terminated.tolist() == [False, True, False]

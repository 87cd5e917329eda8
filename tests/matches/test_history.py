"""Stacked observations of learners, against stacks made by hand from the plain observations."""

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.arrays import Floats, Mask
from rsoccer.controllers import Controllers
from rsoccer.task import LEARN
from tests.helpers import same
from tests.stacks import HandStack

TASK, WORLDS, STEPS, LIMIT = "VSSMulti-v0", 5, 40, 9
SOME: Controllers = {"blue": "chase", "blue_1": LEARN, "yellow_2": LEARN}
"""Learners of both teams among robots that observe."""


def matches(
    history: int,
    *,
    worlds: int = WORLDS,
    seed: int = 7,
    threads: int = 1,
    autoreset: str = "same_step",
    controllers: Controllers | None = None,
) -> Matches:
    """Short matches."""
    return Matches(
        TASK,
        worlds,
        seed,
        threads,
        controllers=controllers,
        autoreset=autoreset,
        history=history,
        max_steps=LIMIT,
    )


def random_actions(matches: Matches, rng: np.random.Generator) -> Floats:
    """Actions (n, agents, action), some of which are clipped."""
    shape = (matches.worlds, len(matches.agents), matches.action_size)
    return rng.uniform(-1.5, 1.5, shape).astype(np.float32)


class Pair:
    """Stacked matches beside plain ones, and stacks made by hand of the plain observations."""

    def __init__(self, history: int, autoreset: str, controllers: Controllers | None) -> None:
        self.ours = matches(history, autoreset=autoreset, controllers=controllers)
        self.plain = matches(1, autoreset=autoreset, controllers=controllers)
        self.hands = [HandStack(history, self.ours.action_size) for _ in range(WORLDS)]
        self.rng = np.random.default_rng(0)

    def check(self, observations: Floats) -> None:
        """Compare observations of all worlds."""
        assert same(observations, np.stack([hand.value for hand in self.hands]))

    def begin(self, worlds: Mask, plain: Floats) -> None:
        """Begin episodes by hand."""
        for world in np.flatnonzero(worlds):
            self.hands[world].begin(plain[world])

    def reset(self, worlds: Mask) -> None:
        """Reset some worlds."""
        observations = self.ours.reset(mask=worlds)
        self.begin(worlds, self.plain.reset(mask=worlds))
        self.check(observations)

    def step(self) -> int:
        """Step all worlds, and return how many episodes ended."""
        waits, actions = self.plain.done, random_actions(self.ours, self.rng)
        outcome, expected = self.ours.step(actions), self.plain.step(actions)
        for world in np.flatnonzero(~waits):
            self.hands[world].step(actions[world], expected.final_observations[world])
        if self.ours.autoreset == "next_step":
            self.begin(waits, expected.observations)
        self.check(outcome.final_observations)
        if self.ours.autoreset == "same_step":
            self.begin(expected.ended, expected.observations)
        self.check(outcome.observations)
        assert same(outcome.rewards, expected.rewards)
        return int(expected.ended.sum())


@pytest.mark.parametrize("controllers", [None, SOME], ids=["all", "some"])
@pytest.mark.parametrize("autoreset", ["same_step", "next_step", "disabled"])
@pytest.mark.parametrize("history", [1, 2, 4])
def test_observations_are_the_stacks_of_plain_ones(
    history: int, autoreset: str, controllers: Controllers | None
) -> None:
    pair, ends = Pair(history, autoreset, controllers), 0
    pair.reset(np.ones(WORLDS, np.bool_))
    for step in range(STEPS):
        if step == 4:  # from here on worlds end in different steps
            pair.reset(np.array([False, True, False, True, False]))
        ends += pair.step()
        if autoreset == "disabled" and step % 6 == 0:
            pair.reset(pair.plain.done)
    assert ends > 10


def test_observations_are_in_their_space() -> None:
    ours = matches(3)
    ours.reset()
    space = ours.observation_space
    outcome = ours.step(random_actions(ours, np.random.default_rng(0)))
    assert space.shape == (ours.observation_size,)
    assert all(space.contains(row) for row in outcome.observations.reshape(-1, space.shape[0]))
    assert same(ours.observation_low, space.low) and same(ours.observation_high, space.high)


def test_a_batch_equals_single_matches_on_any_number_of_threads() -> None:
    rng = np.random.default_rng(1)
    batch = matches(3, threads=2)
    alone = [matches(3, worlds=1, seed=7 + world) for world in range(WORLDS)]
    assert same(batch.reset(), np.concatenate([each.reset() for each in alone]))
    for _ in range(STEPS):
        actions = random_actions(batch, rng)
        outcome = batch.step(actions)
        singles = [each.step(actions[i : i + 1]) for i, each in enumerate(alone)]
        for name in ("observations", "final_observations"):
            expected = np.concatenate([getattr(single, name) for single in singles])
            assert same(getattr(outcome, name), expected)


@pytest.mark.parametrize("autoreset", ["same_step", "next_step", "disabled"])
def test_a_saved_state_continues_with_the_past(autoreset: str) -> None:
    rng = np.random.default_rng(2)
    ours, resumed = (matches(3, autoreset=autoreset, seed=seed) for seed in (7, 99))
    ours.reset()
    resumed.reset()
    for _ in range(LIMIT + 3):
        ours.step(random_actions(ours, rng))
    resumed.load_state_dict(ours.state_dict())
    for _ in range(4):
        actions = random_actions(ours, rng)
        assert same(ours.step(actions).observations, resumed.step(actions).observations)


def test_a_state_of_another_history_is_refused() -> None:
    short, long = matches(1), matches(3)
    for each in (short, long):
        each.reset()
    assert not {"past_observations", "past_actions"} & set(short.state_dict())
    with pytest.raises(ValueError, match=r"unknown .*'past_actions', 'past_observations'"):
        short.load_state_dict(long.state_dict())
    with pytest.raises(ValueError, match=r"expected float32 .* for 'past_"):
        long.load_state_dict(state_of(2))


def state_of(history: int) -> dict[str, np.ndarray]:
    """State of matches after a reset."""
    each = matches(history)
    each.reset()
    return each.state_dict()


def test_returned_observations_belong_to_the_caller() -> None:
    rng = np.random.default_rng(3)
    ours, twin = matches(3), matches(3)
    observations = ours.reset()
    twin.reset()
    for _ in range(LIMIT + 2):
        observations[:] = np.nan
        actions = random_actions(ours, rng)
        observations, expected = ours.step(actions).observations, twin.step(actions).observations
        assert same(observations, expected)


def test_indices_of_actions_are_remembered_as_vectors() -> None:
    ours = Matches("VSS-v0", 2, history=2, discrete=True)
    ours.reset()
    table = ours.task.action_table
    assert table is not None
    outcome = ours.step(np.array([[3], [1]]))
    assert same(outcome.observations[:, 0, -ours.action_size :], table[[3, 1]])


def test_matches_without_learners_have_no_past() -> None:
    ours = matches(3, controllers={"all": "ou"})
    assert ours.reset().shape == (WORLDS, 0, ours.observation_size)
    empty = np.zeros((WORLDS, 0, ours.action_size), np.float32)
    assert ours.step(empty).observations.shape == (WORLDS, 0, ours.observation_size)

"""Sensor models: who gets the sensed state and who the true one; copying, saving, resuming."""

import pickle
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.new_play import new_play
from rsoccer.play import Play
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.senses import ModelSenses
from rsoccer.task import Task
from rsoccer.tasks import SslSelfPlay, VssSelfPlay
from tests.helpers import Crowd, pushing, same
from tests.sensors import LateAndNoisy

SSL = SslSelfPlay(n_blue=2, n_yellow=2)


def sensed_matches(task: Task, worlds: int = 4, seed: int = 0, **settings: Any) -> Matches:  # noqa: ANN401
    model = LateAndNoisy(task.config.row_size)
    return Matches(task, worlds, seed, sensing=model, **settings)


@pytest.mark.parametrize("task", [VssSelfPlay(), SSL], ids=["vss", "ssl"])
def test_the_same_actions_move_robots_alike_but_are_observed_otherwise(task: Task) -> None:
    """SSL commands turn with the heading, which this model senses a step late."""
    blind, exact = sensed_matches(task), Matches(task, 4)
    shown = blind.reset(), exact.reset()
    assert not same(*shown)
    outcomes = (
        blind.step(np.zeros_like(shown[0][..., : blind.action_size])),
        exact.step(np.zeros_like(shown[0][..., : blind.action_size])),
    )
    assert same(blind.frame.rows, exact.frame.rows), "the truth is the same"
    assert same(outcomes[0].rewards, outcomes[1].rewards)
    assert not same(outcomes[0].observations, outcomes[1].observations)
    ours, theirs = blind.play, exact.play
    assert theirs.sensed is theirs.frame
    assert theirs.sensed_view is theirs.view
    assert ours.senses is not None
    assert ours.sensed is ours.senses.frame.read_only
    assert same(ours.view.ball.data, theirs.view.ball.data)
    assert not same(ours.sensed_view.ball.data, ours.view.ball.data)


def test_observations_are_those_of_the_sensed_state() -> None:
    matches = sensed_matches(SSL)
    matches.reset()
    rng = np.random.default_rng(0)
    for _ in range(20):
        outcome = matches.step(pushing(rng, matches))
    play = matches.play
    fresh = play.viewpoint.new_view(4)
    play.viewpoint.fill(play.sensed, fresh)
    assert same(fresh.robots.data, play.sensed_view.robots.data)
    exact = new_play(SSL, 4, play.viewpoint, WorldRng.seeded(0, 4))
    exact.start(play.sensed.rows)
    exact.actions[:] = play.actions
    assert same(outcome.observations, SSL.layout.observe(exact))


def test_commands_turn_with_the_sensed_heading() -> None:
    matches = sensed_matches(SSL)
    matches.reset()
    actions = np.zeros((4, 4, 5), np.float32)
    actions[..., 0], actions[..., 2] = 0.5, 1.0  # ahead while turning
    for _ in range(10):
        matches.step(actions)
    play = matches.play
    expected = SSL._steering.commands(actions, play.sensed.rows, play.threads)
    other = SSL._steering.commands(actions, play.frame.rows, play.threads)
    assert not same(expected, other)
    assert same(SSL.get_commands(play, actions), expected)


class Watching(Policy):
    """Stands still and keeps the last positions of the ball that it saw."""

    observes = "view"

    def __init__(self) -> None:
        super().__init__()
        self.seen: Floats | None = None

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        assert inputs.view is not None
        self.seen = inputs.view.ball.position.copy()
        return np.zeros(inputs.action_shape, np.float32)


def test_policies_see_the_sensed_state() -> None:
    policy = Watching()
    matches = sensed_matches(VssSelfPlay(), controllers={"yellow": policy})
    matches.reset()
    expected = matches.play.sensed_view.ball.position[:, 3:].copy()
    true = matches.play.view.ball.position[:, 3:].copy()
    matches.step(np.zeros((4, 3, 2), np.float32))
    assert policy.seen is not None
    assert same(policy.seen, expected)
    assert not same(policy.seen, true)


@dataclass(frozen=True)
class Recorded(Crowd):
    """A crowd whose rewards and metrics are the true positions."""

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        return terms | {"x": play.frame.ball.position[:, :1].copy()}, done


def test_rewards_ends_and_rules_judge_the_true_state() -> None:
    blind, exact = sensed_matches(Recorded(), 64), Matches(Recorded(), 64)
    blind.reset()
    exact.reset()
    rng, ended = np.random.default_rng(0), 0
    for _ in range(100):
        actions = pushing(rng, exact)
        ours, theirs = blind.step(actions), exact.step(actions)
        assert same(blind.play.events.kind, exact.play.events.kind)
        for name in theirs.terms:
            assert same(ours.terms[name], theirs.terms[name])
        assert same(ours.terminated, theirs.terminated)
        ended += int(ours.terminated.sum())
    assert ended > 0, "goals were scored"


def states(matches: Matches) -> dict[str, Array]:
    return matches.state_dict()


@pytest.mark.parametrize("autoreset", ["same_step", "next_step"])
def test_matches_continue_exactly_from_a_saved_state(autoreset: str) -> None:
    ours = sensed_matches(Crowd(max_steps=15), seed=3, autoreset=autoreset)
    theirs = sensed_matches(Crowd(max_steps=15), seed=9, autoreset=autoreset)
    ours.reset()
    theirs.reset()
    rng = np.random.default_rng(0)
    for _ in range(20):
        ours.step(pushing(rng, ours))
    saved = ours.state_dict()
    assert {"senses.frame", "senses.state.calls", "rng.senses"} <= set(saved)
    theirs.load_state_dict(saved)
    copied = pickle.loads(pickle.dumps(ours))
    for _ in range(40):
        actions = pushing(rng, ours)
        first = ours.step(actions)
        for other in (theirs, copied):
            assert same(first.observations, other.step(actions).observations)


def test_a_world_of_a_batch_equals_the_world_alone() -> None:
    batch = sensed_matches(Crowd(max_steps=15), 5, seed=3, threads=2)
    alone = sensed_matches(Crowd(max_steps=15), 1, seed=5)
    assert same(batch.reset()[2:3], alone.reset())
    rng = np.random.default_rng(0)
    for _ in range(40):
        actions = pushing(rng, batch)
        assert same(batch.step(actions).observations[2:3], alone.step(actions[2:3]).observations)


def test_waiting_worlds_sense_nothing() -> None:
    matches = sensed_matches(Crowd(max_steps=5), 3, autoreset="disabled")
    matches.reset()
    rng = np.random.default_rng(0)
    for _ in range(9):
        outcome = matches.step(pushing(rng, matches))
    senses = matches.play.senses
    assert isinstance(senses, ModelSenses)
    assert matches.done.all()
    assert (senses.state["calls"] <= 5).all()
    assert same(outcome.observations, matches.step(pushing(rng, matches)).observations)


def test_a_reset_begins_anew() -> None:
    matches = sensed_matches(Crowd(), 3)
    first = matches.reset(seed=4)
    matches.step(np.ones((3, 6, 2), np.float32))
    assert same(first, matches.reset(seed=4))
    senses = matches.play.senses
    assert isinstance(senses, ModelSenses)
    assert not senses.state["calls"].any()


def test_a_column_has_a_row_for_each_world() -> None:
    class Wrong(LateAndNoisy):
        def columns(self, n: int) -> dict[str, Array]:
            return {"before": np.zeros(1, np.float32)}

    with pytest.raises(ValueError, match=r"Wrong.columns: expected \(3, ...\) for 'before'"):
        Matches(Crowd(), 3, sensing=Wrong(9))

"""The step loop: autoreset modes, outcomes, resets and pickling."""

import pickle
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.game import EventKind
from rsoccer.rules import Restart, Rule
from rsoccer.task import Play
from rsoccer.tasks import VssSelfPlay
from tests.helpers import Crowd, begun, pushing, same, zeros


@dataclass(frozen=True)
class Counting(VssSelfPlay):
    """World i ends after i + 2 steps of a counter in memory, which is also the observation."""

    max_steps: int = 5

    def new_memory(self, n: int) -> dict[str, Array]:
        return {"count": np.zeros(n, np.int64)}

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        count = play.memory["count"].astype(np.float32)
        return {"count": np.repeat(count, len(play.observers)).reshape(-1, len(play.observers), 1)}

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        play.memory["count"] += 1
        one = np.ones((len(play.frame), 1), np.float32)
        return {"time": one, "twice": 2 * one}, play.memory["count"] == 2 + np.arange(len(one))


def test_same_step_resets_at_once_and_keeps_the_final_observation() -> None:
    matches = begun(Counting())
    matches.step(zeros(matches))
    outcome = matches.step(zeros(matches))
    assert outcome.terminated.tolist() == [True] + [False] * 4
    assert outcome.final_observations[:, 0, 0].tolist() == [2] * 5
    assert outcome.observations[:, 0, 0].tolist() == [0, 2, 2, 2, 2]
    assert matches.play.steps.tolist() == [0, 2, 2, 2, 2]
    assert not matches.done.any()


def test_the_time_limit_truncates_what_the_task_has_not_ended() -> None:
    matches = begun(Counting())
    for _ in range(5):
        outcome = matches.step(zeros(matches))
    # Worlds 0 and 1 were reset, world 3 ends by the task in its last step, world 4 by time.
    assert outcome.terminated.tolist() == [False, False, False, True, False]
    assert outcome.truncated.tolist() == [False, False, False, False, True]
    assert outcome.ended.tolist() == [False, False, False, True, True]
    assert outcome.final_observations[4, 0, 0] == 5


def test_next_step_resets_one_step_later() -> None:
    matches = begun(Counting(), autoreset="next_step")
    matches.step(zeros(matches))
    outcome = matches.step(zeros(matches))
    assert outcome.terminated[0]
    assert outcome.observations[0, 0, 0] == 2
    assert matches.done.tolist() == [True] + [False] * 4
    outcome = matches.step(zeros(matches))
    assert outcome.observations[:2, 0, 0].tolist() == [0, 3]
    assert same(outcome.observations, outcome.final_observations)
    assert outcome.rewards[:2, 0].tolist() == [0.0, 3.0]
    assert outcome.terms["twice"][:2, 0].tolist() == [0.0, 2.0]
    assert not outcome.ended[0]
    assert matches.play.steps[0] == 0
    assert matches.step(zeros(matches)).observations[0, 0, 0] == 1


def test_disabled_waits_for_a_reset() -> None:
    matches = begun(Counting(), autoreset="disabled")
    for _ in range(2):
        matches.step(zeros(matches))
    rows, streams = matches.frame.rows.copy(), matches.play.rng.state
    for _ in range(3):
        outcome = matches.step(np.ones_like(zeros(matches)))
    assert matches.done.tolist() == [True] * 5
    assert not outcome.ended[0]
    assert outcome.observations[0, 0, 0] == 2
    assert outcome.rewards[0, 0] == 0.0
    assert same(matches.frame.rows[0], rows[0])
    assert matches.play.rng.state[0] == streams[0]
    assert not same(matches.frame.rows[4], rows[4])
    shown = matches.reset(mask=np.array([True, False, False, False, True]))
    assert shown[:, 0, 0].tolist() == [0, 3, 4, 5, 0]
    assert matches.done.tolist() == [False, True, True, True, False]


def test_waiting_worlds_keep_their_metrics_and_have_no_terms() -> None:
    class Timed(Counting):
        def metrics(self, play: Play) -> dict[str, Floats]:
            return {"speed": play.frame.ball.velocity[:, 0] + play.steps.astype(np.float32)}

    matches = begun(Timed(), autoreset="disabled")
    while not matches.done[0]:
        outcome = matches.step(np.ones_like(zeros(matches)))
    last = outcome.metrics["speed"].copy()
    for _ in range(3):
        outcome = matches.step(np.ones_like(zeros(matches)))
        assert outcome.metrics["speed"][0] == last[0]
        assert outcome.metrics["speed"][4] != last[4] or matches.done[4]
        assert matches.observer_terms["twice"][0].tolist() == [0.0] * 6
    assert matches.observer_terms["twice"].shape == (5, 6)


def test_waiting_worlds_draw_no_random_numbers() -> None:
    options: dict[str, Any] = {"autoreset": "disabled", "controllers": {"yellow": "ou"}}
    waiting, control = begun(Counting(), **options), begun(Counting(), **options)
    for _ in range(2):
        waiting.step(zeros(waiting))
        control.step(zeros(control))
    held = waiting.state_dict()
    assert held["rng.yellow_0"].tolist() == control.state_dict()["rng.yellow_0"].tolist()
    waiting.step(zeros(waiting))
    after = waiting.state_dict()
    for name in ("rng.yellow_0", "yellow_0.walk", "rng.start", "rng.task", "frame", "steps"):
        assert same(after[name][0], held[name][0]), name
    for name in ("rng.yellow_0", "yellow_0.walk", "frame", "steps"):
        assert not same(after[name][4], held[name][4]), name


class Whistle(Rule):
    """An event in every world after every step."""

    def judge(self, play: Play) -> Restart | None:
        play.events.add(np.arange(len(play.frame)), EventKind.PASS)
        return None


class Whistled(Counting):
    @property
    def rules(self) -> Sequence[Rule]:
        return (Whistle(),)


@pytest.mark.parametrize("autoreset", ["disabled", "next_step"])
def test_nothing_happens_in_a_world_that_waits(autoreset: str) -> None:
    matches = begun(Whistled(), autoreset=autoreset)
    for _ in range(2):
        matches.step(zeros(matches))
    assert matches.play.events.count.tolist() == [1, 1, 1, 1, 1], "the last step of world 0 too"
    matches.step(zeros(matches))
    assert matches.play.events.count.tolist() == [0, 1, 1, 1, 1]


def test_a_reset_forgets_the_events_of_its_worlds() -> None:
    matches = begun(Whistled())
    matches.step(zeros(matches))
    matches.reset(mask=np.array([False, True, False, False, True]))
    assert matches.play.events.count.tolist() == [1, 0, 1, 1, 0]
    matches.reset()
    assert not matches.play.events.count.any()


def test_rewards_are_the_sum_of_terms() -> None:
    matches = begun(Crowd(reward_weights={"energy": 0.1}))
    outcome = matches.step(np.ones_like(zeros(matches)))
    assert sorted(outcome.terms) == ["approach", "ball_to_goal", "energy", "goal"]
    assert outcome.terms["energy"] == pytest.approx(-0.1)
    assert outcome.rewards == pytest.approx(sum(outcome.terms.values()))


def test_an_outcome_belongs_to_the_caller() -> None:
    matches, control = begun(Crowd()), begun(Crowd())
    rng = np.random.default_rng(0)
    for _ in range(60):
        actions = pushing(rng, matches)
        outcome, other = matches.step(actions), control.step(actions)
        assert same(outcome.observations, other.observations)
        arrays = [*vars(outcome).values(), *outcome.terms.values(), *outcome.metrics.values()]
        for array in arrays:
            if isinstance(array, np.ndarray):
                array[...] = 1
        assert other.observations.min() < 1, "outcomes share no memory"
    matches.reset(mask=np.zeros(5, np.bool_))[:] = 7.0
    assert same(
        matches.reset(mask=np.zeros(5, np.bool_)), control.reset(mask=np.zeros(5, np.bool_))
    )


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("autoreset", ["same_step", "disabled"])
def test_results_do_not_change_after_their_step(threads: int, autoreset: str) -> None:
    matches = Matches(Crowd(max_steps=5), 300, 0, threads, autoreset=autoreset)
    kept: list[np.ndarray] = [matches.reset()]
    for _ in range(4):
        outcome = matches.step(np.ones_like(zeros(matches)))
        kept += [outcome.observations, outcome.final_observations, outcome.rewards]
        kept += [outcome.terminated, outcome.truncated, *outcome.terms.values()]
        kept += [*outcome.metrics.values(), matches.done]
    before = [array.copy() for array in kept]
    matches.step(np.zeros_like(zeros(matches)))
    matches.reset(seed=9)
    matches.step(np.zeros_like(zeros(matches)))
    assert all(map(same, kept, before))


def test_after_a_reset_the_last_frame_equals_the_frame() -> None:
    matches = begun(Crowd())
    rng = np.random.default_rng(0)
    for _ in range(7):
        matches.step(pushing(rng, matches))
    mask = np.array([True, False, True, False, False])
    matches.reset(mask=mask)
    play = matches.play
    assert same(play.frame.rows[mask], play.last_frame.rows[mask])
    assert same(play.view.robots.data[mask], play.last_view.robots.data[mask])
    assert same(play.view.ball.data[mask], play.last_view.ball.data[mask])
    assert not play.actions[mask].any()
    assert not same(play.frame.rows[~mask], play.last_frame.rows[~mask])
    assert play.actions[~mask].any()


def test_a_reset_with_a_seed_equals_new_matches() -> None:
    used = begun(Crowd(), seed=5)
    rng = np.random.default_rng(0)
    for _ in range(50):
        used.step(pushing(rng, used))
    assert same(used.reset(seed=11), Matches(Crowd(), 5, seed=11).reset())
    first = used.reset()
    assert not same(first, used.reset()), "without a seed the streams continue"


def test_a_reset_of_no_world_changes_nothing() -> None:
    matches = begun(Crowd())
    before = matches.state_dict()
    matches.reset(mask=np.zeros(5, np.bool_))
    after = matches.state_dict()
    assert all(same(after[name], before[name]) for name in before)


def test_a_reset_can_start_from_given_rows() -> None:
    matches = begun(VssSelfPlay())
    rows = matches.frame.rows[[3, 4]].copy()
    mask = np.array([False, True, True, False, False])
    matches.reset(mask=mask, rows=rows)
    assert np.allclose(matches.frame.rows[[1, 2]], rows, atol=1e-6)


def test_step_before_reset_is_an_error() -> None:
    matches = Matches(VssSelfPlay(), 2)
    with pytest.raises(RuntimeError, match="step before reset"):
        matches.step(zeros(matches))
    matches.reset(mask=np.array([True, False]))
    with pytest.raises(RuntimeError, match="step before reset"):
        matches.step(zeros(matches))


def test_matches_can_be_pickled_within_an_episode() -> None:
    ours = begun(Crowd(), controllers={"yellow": "chase"})
    rng = np.random.default_rng(0)
    for _ in range(20):
        ours.step(pushing(rng, ours))
    theirs = pickle.loads(pickle.dumps(ours))
    for _ in range(40):
        actions = pushing(rng, ours)
        assert same(ours.step(actions).observations, theirs.step(actions).observations)
    assert same(ours.frame.rows, theirs.frame.rows)


def test_sizes_and_bounds_are_the_tasks() -> None:
    matches = Matches("VSSMulti-v0", 2)
    assert matches.agents == ("blue_0", "blue_1", "blue_2")
    assert matches.observation_size == matches.task.layout.size
    assert matches.action_size == 2
    outcome_low, outcome_high = matches.observation_low, matches.observation_high
    shown = matches.reset()
    assert ((outcome_low <= shown) & (shown <= outcome_high)).all()


def test_all_observers_have_reward_terms() -> None:
    teams = {"blue_1": "chase", "yellow": "ou"}  # `ou` observes nothing
    matches = begun(worlds=2, controllers=teams)
    assert matches.observer_terms == {}
    outcome = matches.step(zeros(matches))
    assert matches.play.observers.tolist() == [0, 1, 2]
    assert list(matches.observer_terms) == list(outcome.terms)
    for name, term in matches.observer_terms.items():
        assert same(np.ascontiguousarray(term[:, [0, 2]]), outcome.terms[name])
    assert matches.observer_terms["energy"][:, 1].any()

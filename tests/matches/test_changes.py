"""Options, policies and starts that change while matches run."""

import copy
import dataclasses
from functools import cached_property
from typing import Any
from unittest import mock

import numpy as np
import pytest

import rsoccer
from rsoccer.arrays import Floats, Mask
from rsoccer.envs.env_matches import EnvMatches
from rsoccer.matches import Matches
from rsoccer.observation_layout import ObservationLayout
from rsoccer.play import Play
from rsoccer.policies import Policy
from rsoccer.policies.base import Observes, PolicyInput
from rsoccer.registry import make_task
from rsoccer.replay import Recorder
from rsoccer.task import Task

TASK = "VSSMulti-v0"
N = 3


def stepped(matches: Matches, steps: int, seed: int = 0) -> list[Any]:
    rng = np.random.default_rng(seed)
    shape = (matches.worlds, len(matches.agents), matches.action_size)
    return [matches.step(rng.uniform(-1, 1, shape).astype(np.float32)) for _ in range(steps)]


def begun(**settings: Any) -> Matches:  # noqa: ANN401
    matches = Matches(TASK, N, 5, **settings)
    matches.reset()
    return matches


def test_time_limits_and_rewards_hold_from_the_next_step_on() -> None:
    matches, plain = begun(), begun()
    first = [stepped(each, 3) for each in (matches, plain)]
    assert np.array_equal(first[0][2].observations, first[1][2].observations)
    weights = dict.fromkeys(first[0][0].terms, 0.0)
    matches.change_options(max_steps=5, reward_weights=weights)
    changed, kept = stepped(matches, 3, 1), stepped(plain, 3, 1)
    assert [outcome.truncated.all() for outcome in changed] == [False, True, False]
    assert not any(outcome.rewards.any() for outcome in changed)
    assert any(outcome.rewards.any() for outcome in kept)
    assert np.array_equal(changed[0].observations, kept[0].observations), "physics are the same"
    assert matches.task.max_steps == 5
    assert matches.task.name == TASK


def test_starts_hold_after_automatic_resets() -> None:
    matches = begun(max_steps=4)
    matches.change_options(ball_speed=0.0)
    outcome = stepped(matches, 4)[-1]
    assert outcome.truncated.all()
    assert not matches.frame.ball.velocity.any(), "the new episodes begin with a ball at rest"
    matches.change_options(ball_speed=2.0)
    stepped(matches, 4)
    assert matches.frame.ball.velocity.any(axis=-1).all()


def test_given_states_hold_after_automatic_resets() -> None:
    matches, other = begun(max_steps=4), Matches(TASK, 2, 9)
    other.reset()
    rows = other.frame.rows.copy()
    matches.start_from(rows)
    seen = []
    for _ in range(6):
        stepped(matches, 4)
        seen += matches.frame.rows.tolist()
    found = [[np.array_equal(np.float32(row), given) for given in rows] for row in seen]
    assert all(any(each) for each in found)
    assert {tuple(each) for each in found} == {(True, False), (False, True)}, "both are drawn"
    matches.start_from(rows[0])
    assert np.array_equal(matches.reset(), np.broadcast_to(matches.reset()[:1], (N, 3, 80)))
    matches.start_from(None)
    matches.reset()
    assert not np.array_equal(matches.frame.rows[0], rows[0])


class Seeing(Policy):
    """Observes, and drives at a constant speed."""

    observes: Observes = "view"

    def __init__(self, speed: float) -> None:
        super().__init__()
        self.speed = speed

    def new_memory(self, shape: Any, rng: Any) -> Any:  # noqa: ANN401
        return {"count": np.zeros(shape[0])}

    def act(self, inputs: PolicyInput, rng: Any, memory: Any) -> Any:  # noqa: ANN401
        memory["count"] += 1
        return np.full(inputs.action_shape, self.speed * memory["count"].max(), np.float32)


def test_policies_change_with_a_new_memory() -> None:
    matches = begun(controllers={"yellow": Seeing(0.01)})
    stepped(matches, 2)
    yellow = slice(3, 6)
    assert matches.play.actions[:, yellow] == pytest.approx(0.02)
    matches.change_controllers({"yellow": Seeing(-0.1)})
    stepped(matches, 1)
    assert matches.play.actions[:, yellow] == pytest.approx(-0.1)
    matches.change_controllers({"yellow": "zero"})
    stepped(matches, 1)
    assert not matches.play.actions[:, yellow].any()
    state = matches.state_dict()
    after = stepped(matches, 2)[-1].observations
    matches.load_state_dict(state)
    assert np.array_equal(stepped(matches, 2)[-1].observations, after)
    matches.change_controllers({"yellow": Seeing(0.5)})  # these robots have observed before
    stepped(matches, 1)
    assert matches.play.actions[:, yellow] == pytest.approx(0.5)


class Reading(Seeing):
    """Keeps a copy of the observations that it gets."""

    observes = "observation"
    seen: Any = None

    def act(self, inputs: PolicyInput, rng: Any, memory: Any) -> Any:  # noqa: ANN401
        self.seen = np.array(inputs.observations)
        return super().act(inputs, rng, memory)


def test_observations_are_computed_once_a_policy_reads_them() -> None:
    matches = Matches("VSSSelfPlay-v0", 2, 0, controllers={"blue": "chase", "yellow": Seeing(0.1)})
    with mock.patch.object(ObservationLayout, "observe", side_effect=AssertionError):
        matches.reset()  # scripts read the view alone
        stepped(matches, 3)
    reading = Reading(0.1)
    matches.change_controllers({"yellow": reading})
    wanted = matches.task.layout.observe(matches.play)[:, 3:]
    stepped(matches, 1)
    assert wanted.any()
    np.testing.assert_array_equal(reading.seen, wanted)


def test_skills_change_deterministically() -> None:
    def play(threads: int) -> np.ndarray:
        matches = begun(controllers={"yellow": "scripted:0"}, threads=threads)
        stepped(matches, 5)
        matches.change_controllers({"yellow": "scripted:1"})
        rows: np.ndarray = stepped(matches, 5)[-1].observations
        return rows

    assert np.array_equal(play(1), play(2))
    constant = begun(controllers={"yellow": "scripted:0"})
    assert not np.array_equal(play(1), stepped(constant, 10)[-1].observations)


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"ball_sped": 1.0}, TypeError, r"options: unknown \['ball_sped'\]; valid are"),
        ({"n_yellow": 2}, ValueError, "expected ones that leave sizes, robots and physics"),
        ({"discrete": True}, ValueError, "action"),
        ({"max_steps": 0}, ValueError, "max_steps"),
    ],
)
def test_other_options_are_refused(
    options: dict[str, Any], error: type[Exception], message: str
) -> None:
    matches = begun()
    with pytest.raises(error, match=message):
        matches.change_options(**options)
    assert matches.task == make_task(TASK)
    stepped(matches, 1)


@pytest.mark.parametrize(
    ("controllers", "error", "message"),
    [
        ({"green": "ou"}, ValueError, r"controllers: unknown \['green'\]"),
        ({"blue_0": "ou"}, ValueError, "expected a policy for robots that do not learn"),
        ({"yellow": rsoccer.LEARN}, ValueError, "as learners stay, got <Learn"),
        ({"yellow_0": "zero"}, ValueError, "expected one policy for .* which share one"),
        ({"yellow": "scripted"}, ValueError, "begin with one that observes"),
        ({"yellow": "nobody"}, ValueError, "unknown policy"),
        ({}, ValueError, "expected robots with policies"),
    ],
)
def test_other_policies_are_refused(
    controllers: Any,  # noqa: ANN401
    error: type[Exception],
    message: str,
) -> None:
    matches = begun(controllers={"yellow": "ou"})
    with pytest.raises(error, match=message):
        matches.change_controllers(controllers)
    stepped(matches, 1)


def test_states_that_overlap_are_refused() -> None:
    matches = begun()
    row = matches.frame.rows[0].copy()
    with pytest.raises(ValueError, match="rows: expected shape"):
        matches.start_from(row[:-1])
    frame = rsoccer.Frame(row[None].copy(), 3, 3)
    frame.robots.position[:] = 0.0
    with pytest.raises(ValueError, match="overlap"):
        matches.start_from(frame.rows)
    stepped(matches, 1)


def test_copies_of_environments_keep_the_changes() -> None:
    env = rsoccer.single_env("VSS-v0", opponent="scripted:0")
    env.reset(seed=0)
    env.matches.change_options(max_steps=3)
    env.matches.change_controllers({"yellow": "scripted:1"})
    env.matches.start_from(env.frame.rows[0].copy())
    env.step(np.zeros(2, np.float32))
    other = copy.deepcopy(env)
    ends = [[each.step(np.ones(2, np.float32)) for _ in range(2)] for each in (env, other)]
    assert np.array_equal(ends[0][1][0], ends[1][1][0])
    assert ends[1][1][3], "the time limit holds"
    starts = [each.reset()[0] for each in (env, other)]
    assert np.array_equal(starts[0], starts[1])
    assert isinstance(other.matches, EnvMatches)


@pytest.mark.parametrize("given", ["scripted", "scripted:0.4", Seeing(0.3)])
def test_copies_keep_groups_that_were_given_one_policy(given: str | Policy) -> None:
    different = {f"yellow_{nth}": f"scripted:0.{nth}" for nth in range(3)}
    env = rsoccer.single_env("VSS-v0", controllers=different)
    env.reset(seed=0)
    env.matches.change_controllers({"yellow": given})
    env.step(np.zeros(2, np.float32))
    other = copy.deepcopy(env)
    for _ in range(20):
        first, second = (each.step(np.ones(2, np.float32))[0] for each in (env, other))
        assert np.array_equal(first, second)
    env.reset(seed=7)
    other.reset(seed=7)
    first, second = (each.step(np.ones(2, np.float32))[0] for each in (env, other))
    assert np.array_equal(first, second)


def test_copies_keep_groups_that_got_one_object_in_two_changes() -> None:
    different = {f"yellow_{nth}": f"scripted:0.{nth}" for nth in range(3)}
    env = rsoccer.single_env("VSS-v0", controllers=different)
    env.reset(seed=0)
    policy = Seeing(0.3)
    for robot in ("yellow_0", "yellow_1"):
        env.matches.change_controllers({robot: policy})
    policy.speed = 0.1
    other = copy.deepcopy(env)
    env.step(np.zeros(2, np.float32))
    other.step(np.zeros(2, np.float32))
    assert np.array_equal(env.matches.play.actions, other.matches.play.actions)
    policy.speed = -0.2
    env.step(np.zeros(2, np.float32))
    yellow = env.matches.play.actions[0, 3:5]
    assert (yellow == yellow[0, 0]).all(), "both play the object that was given"
    assert yellow[0, 0] < 0.0


@dataclasses.dataclass(frozen=True)
class LimitedByItsClass(Task):
    """A task whose time limit is no option."""

    max_steps = 1200
    action_size = 2
    weight: float = 1.0

    @cached_property
    def config(self) -> rsoccer.SimConfig:
        return rsoccer.SimConfig(n_blue=1, n_yellow=0)

    def get_initial_positions_frame(self, rng: rsoccer.WorldRng) -> rsoccer.Frame:
        frame = rsoccer.Frame.empty(len(rng), 1, 0)
        frame.robots.position[:] = 0.3
        return frame

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        return actions

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        return {"position": play.sensed_view.ego.position}

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        reward = np.full((len(play.steps), 1), self.weight, np.float32)
        return {"reward": reward}, np.zeros(len(play.steps), np.bool_)


def test_a_time_limit_that_is_no_option_survives_a_change() -> None:
    matches = Matches(LimitedByItsClass(), max_steps=2)
    matches.reset()
    matches.change_options(weight=2.0)
    outcomes = stepped(matches, 2)
    assert matches.task.max_steps == 2
    assert [float(outcome.rewards[0, 0]) for outcome in outcomes] == [2.0, 2.0]
    assert [bool(outcome.truncated[0]) for outcome in outcomes] == [False, True]


@dataclasses.dataclass(frozen=True)
class LimitedByAnOption(LimitedByItsClass):
    """A task whose time limit follows from an option."""

    seconds: float = 1.0

    @property
    def max_steps(self) -> int:  # type: ignore[override]
        return round(40 * self.seconds)


def test_a_time_limit_follows_the_option_on_which_it_depends() -> None:
    matches = Matches(LimitedByAnOption())
    matches.reset()
    matches.change_options(seconds=2.0)
    assert matches.task.max_steps == 80


def test_an_attached_recorder_sees_whole_episodes_beside_automatic_resets() -> None:
    matches = begun(max_steps=4)
    recorder = Recorder(matches, 1, attach=True)
    stepped(matches, 2)
    with pytest.raises(RuntimeError, match="nothing has been recorded"):
        recorder.replay()
    stepped(matches, 10, 1)
    matches.detach(recorder)
    stepped(matches, 3, 2)
    replay = recorder.replay()
    ends = [(episode.stop - episode.start, episode.end) for episode in replay.episodes]
    assert ends == [(5, "truncated"), (5, "truncated"), (1, "")]
    alone = Matches(TASK, N, 5, max_steps=4, autoreset="disabled")
    beside = Recorder(alone, 1)
    alone.reset()
    rng = np.random.default_rng
    actions = [
        rng_.uniform(-1, 1, (N, 3, 2)).astype(np.float32)
        for rng_, count in ((rng(0), 2), (rng(1), 10))
        for _ in range(count)
    ]
    for index, action in enumerate(actions):
        outcome = alone.step(action)
        if index >= 4:
            beside.add(outcome)
        if alone.done.all():
            alone.reset()
            beside.begin()
    expected = beside.replay()
    assert np.array_equal(replay.rows, expected.rows)
    assert np.array_equal(replay.commands, expected.commands)
    assert replay.terms.keys() == expected.terms.keys()
    assert all(np.array_equal(replay.terms[name], expected.terms[name]) for name in replay.terms)
    with pytest.raises(ValueError, match="or attach=True"):
        Recorder(matches)


def test_a_saved_state_has_the_given_starts() -> None:
    matches, other = begun(max_steps=4), Matches(TASK, 2, 9)
    other.reset()
    matches.start_from(other.frame.rows.copy())
    stepped(matches, 2)
    state = matches.state_dict()
    after = stepped(matches, 9)
    resumed = Matches(TASK, N, 1, max_steps=4)
    resumed.load_state_dict(state)
    again = stepped(resumed, 9)
    for one, two in zip(after, again, strict=True):
        assert np.array_equal(one.observations, two.observations)
    taken = Matches(TASK, N, 1, max_steps=4)
    taken.take_over(state, 1)
    stepped(taken, 2)
    given = {row.tobytes() for row in other.frame.rows}
    assert all(row.tobytes() in given for row in taken.frame.rows)


def test_a_saved_state_without_starts_brings_those_of_the_task_back() -> None:
    matches = begun(max_steps=4)
    state = matches.state_dict()
    after = stepped(matches, 5)[-1].observations
    matches.start_from(matches.frame.rows[0].copy())
    matches.load_state_dict(state)
    assert np.array_equal(stepped(matches, 5)[-1].observations, after)


def test_saved_starts_are_checked() -> None:
    matches = begun()
    state, before = matches.state_dict(), matches.state_dict()
    rows = matches.frame.rows.copy()
    stepped(matches, 1)
    now = matches.frame.rows.copy()
    for bad, message in (
        (rows[:, :-1], "shape"),
        (np.full_like(rows, np.nan), "finite"),
        (rows.astype(str), "rows"),
    ):
        with pytest.raises(ValueError, match=rf"state: .*'starts': .*{message}"):
            matches.load_state_dict({**state, "starts": bad})
        assert np.array_equal(matches.frame.rows, now)
    matches.load_state_dict(before)
    assert np.array_equal(matches.frame.rows, rows)

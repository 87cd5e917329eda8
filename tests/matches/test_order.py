"""The order of a step: act, physics, rules, rewards, restarts, senses, observations."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import pytest

from rsoccer import Matches, Simulator
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.game import BLUE, EventKind
from rsoccer.play import Play
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.rules import Crossings, Restart, Rule
from rsoccer.tasks import VssSelfPlay
from tests.helpers import same, zeros


class KickOff(Rule):
    """All bodies go back to their places after a goal."""

    def __init__(self, start: Floats) -> None:
        self.start = start

    def judge(self, play: Play) -> Restart | None:
        worlds = np.flatnonzero(play.events.happened(EventKind.GOAL))
        return Restart(worlds, rows=self.start[worlds]) if len(worlds) else None


@dataclass(frozen=True)
class Match(VssSelfPlay):
    """A match in which goals count and play goes on."""

    start: Floats = field(default_factory=lambda: np.zeros((2, 0), np.float32))

    @property
    def rules(self) -> Sequence[Rule]:
        return Crossings(), KickOff(self.start)

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        terms, done = super().calculate_reward_and_done(play)
        terms["seen"] = play.frame.ball.position[:, :1].copy()
        return terms, np.zeros_like(done)


def start_rows() -> Floats:
    """Balls that roll into the right goal, in world 1 a little later."""
    frame = Frame.empty(2, 3, 3)
    frame.robots.position[:] = [(x, 0.5) for x in np.linspace(-0.6, 0.6, 6)]
    frame.ball.position[:, 0] = (0.6, 0.4)
    frame.ball.velocity[:, 0] = 1.5
    return frame.rows


def test_a_goal_that_restarts_play_pays_and_counts() -> None:
    """Formerly play was restarted before the reward, so such a goal paid and counted nothing."""
    rows = start_rows()
    matches = Matches(Match(start=rows), 2)
    matches.reset(rows=rows)
    goals, rewards = np.zeros(2), np.zeros((2, 6))
    for _ in range(60):
        outcome = matches.step(zeros(matches))
        assert not outcome.ended.any()
        rewards += outcome.terms["goal"]
        for world in np.flatnonzero(matches.play.events.count).tolist():
            [event] = matches.play.events.of_world(world)
            assert event[:2] == (EventKind.GOAL, BLUE)
            goals[world] += 1
            assert outcome.terms["seen"][world, 0] > 0.75, "rewards see the ball in the goal"
            assert outcome.terms["ball_to_goal"][world, :3].sum() > 0.0, "its way is paid"
            ball = matches.frame.ball.position[world]
            assert same(ball, rows[world, :2]), "afterwards play has begun again"
            seen = outcome.observations[world, 0, matches.task.layout.blocks["ball"].columns]
            assert seen[0] == pytest.approx(ball[0] / 0.75)
    assert goals.min() > 3
    assert goals[0] > goals[1]
    assert matches.play.game.score.tolist() == [[goals[0], 0], [goals[1], 0]]
    assert outcome.metrics["goal_score"].tolist() == goals.tolist()
    assert rewards[:, 0].tolist() == (10.0 * goals).tolist()
    assert (rewards[:, :3] == -rewards[:, 3:]).all()


def test_the_jump_of_a_restart_is_not_rewarded() -> None:
    rows = start_rows()
    matches = Matches(Match(start=rows), 2)
    matches.reset(rows=rows)
    for _ in range(60):
        outcome = matches.step(zeros(matches))
        assert np.abs(outcome.terms["ball_to_goal"]).max() < 10.0 * 0.06, "no more than its way"


@dataclass
class Trace:
    """Names of the calls so far."""

    calls: list[str] = field(default_factory=list)


class Judge(Rule):
    """Restarts play in each step."""

    def __init__(self, trace: Trace) -> None:
        self._calls = trace.calls

    def begin(self, play: Play, worlds: Array) -> None:
        self._calls.append("begin")

    def judge(self, play: Play) -> Restart:
        self._calls.append("judge")
        return Restart(np.array([0]), rows=start_rows()[:1])


@dataclass(frozen=True)
class Traced(VssSelfPlay):
    """A task that traces the calls of its methods."""

    trace: Trace = field(default_factory=Trace)

    @property
    def rules(self) -> Sequence[Rule]:
        return (Judge(self.trace),)

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        self.trace.calls.append("commands")
        return super().get_commands(play, actions)

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        self.trace.calls.append("rewards")
        return super().calculate_reward_and_done(play)

    def metrics(self, play: Play) -> dict[str, Floats]:
        self.trace.calls.append("metrics")
        return {}

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        self.trace.calls.append("observe")
        return super().frame_to_observations(play)


class TracedPolicy(Policy):
    """Stands still."""

    observes = "nothing"

    def __init__(self, trace: Trace) -> None:
        super().__init__()
        self._calls = trace.calls

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        self._calls.append("act")
        return np.zeros(inputs.action_shape, np.float32)


class TracedSensors:
    """Exact senses."""

    def __init__(self, trace: Trace) -> None:
        self._calls = trace.calls

    def columns(self, n: int) -> dict[str, Array]:
        return {}

    def begin(self, frame: Frame, sensed: Frame, state: Mapping[str, Array], rng: WorldRng) -> None:
        self._calls.append("sense first")

    def sense(self, frame: Frame, sensed: Frame, state: Mapping[str, Array], rng: WorldRng) -> None:
        self._calls.append("sense")


class TracedSimulator:
    """The simulator of one match."""

    def __init__(self, task: Traced) -> None:
        self._own, self._calls = Simulator(task.config, 1), task.trace.calls
        self.reposition_balls = self._own.reposition_balls

    def place(
        self, worlds: Mask, rows: Floats, out: Floats, parameters: Floats | None = None
    ) -> None:
        self._calls.append("place")
        self._own.place(worlds, rows, out, parameters)

    def restart(self, worlds: Mask, rows: Floats, out: Floats) -> None:
        self._calls.append("restart")
        self._own.restart(worlds, rows, out)

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        self._calls.append("physics")
        self._own.step(commands, out, active)


def test_a_step_calls_its_parts_in_order() -> None:
    task = Traced()
    matches = Matches(
        task,
        controllers={"yellow": TracedPolicy(task.trace)},
        simulator=TracedSimulator(task),
        sensing=TracedSensors(task.trace),
    )
    task.trace.calls.clear()
    matches.reset(rows=start_rows()[:1])
    assert task.trace.calls == ["place", "begin", "sense first", "observe"]
    task.trace.calls.clear()
    matches.step(np.zeros((1, 3, 2), np.float32))
    assert task.trace.calls == [
        *("act", "commands", "physics", "judge", "rewards", "metrics"),
        *("restart", "begin", "sense", "observe"),
    ]

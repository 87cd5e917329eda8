"""Episodes of an evaluation: each match is played to its end and counts once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.controllers import Controller
from rsoccer.game import BLUE, NOBODY, YELLOW, EventKind
from rsoccer.matches import Matches, Outcome
from rsoccer.play import Play
from rsoccer.policies.base import (
    MatchState,
    Memory,
    Policy,
    PolicyInput,
    actions_of,
    require_actions,
)
from rsoccer.randomization import Ranges
from rsoccer.rng import WorldRng
from rsoccer.sources import SensingSource, SimulatorSource, closed_after
from rsoccer.task import Task

RETURN = "return"
"""Name of the score of a task without a success metric: the return of the episode."""


@dataclass(frozen=True)
class Episodes:
    """Results of n episodes."""

    metric: str
    """name of the score: the task's success metric, or `RETURN`"""
    scores: Doubles
    """(n,) value of the metric at the end of the episode"""
    returns: Doubles
    """(n,) sum of rewards, undiscounted, a mean over the robots that learn"""
    seconds: Doubles
    """(n,) duration"""
    decided: NDArray[np.bool_]
    """(n,) a team scored a goal (two-sided tasks), or the success was full"""
    decision_seconds: Doubles
    """(n,) time of the first goal in a two-sided task, else the duration"""
    own_goals: NDArray[np.int64]
    """(n, 2) goals that a last touch of blue gave yellow, and the opposite"""
    metrics: dict[str, Doubles]
    """(n,) values of all metrics of the task at the end of the episode, by name"""


class Recorder(Protocol):
    """Measures matches while they are played."""

    def begin(self, n: int) -> None:
        """Begin n new matches.

        Args:
            n: number of matches that are played at once from now on.
        """

    def record(self, play: Play, playing: Mask) -> None:
        """Measure a step.

        Args:
            play: state of the n matches that the step left.
            playing: (n,) the matches that it belonged to, not those that wait.
        """


@dataclass(frozen=True)
class EpisodeRunner:
    """Plays matches in which one policy controls the robots that learn."""

    task: Task
    """task that is played"""
    controllers: Mapping[str, Controller]
    """controllers by robot; `LEARN` for the robots of the policy"""
    policy: Policy
    """policy in the place of the learners"""
    worlds: int
    """matches played at once, at least 1"""
    threads: int
    """threads of the simulator, at least 1"""
    before_step: Callable[[Mask], None] | None = None
    """called before each step with the mask (n,) of the matches that have not ended"""
    simulator: SimulatorSource | None = None
    """moves the robots, as for `Matches`"""
    sensing: SensingSource | None = None
    """senses of the robots, as for `Matches`"""
    randomization: Ranges | None = None
    """numbers that each episode draws, as for `Matches`"""
    recorder: Recorder | None = None
    """measures the matches, batch after batch"""

    def run(self, count: int, first_seed: int) -> Episodes:
        """Play matches, at most `worlds` at once.

        Args:
            count: number of matches, at least 1.
            first_seed: match i has the seed `first_seed + i`.

        Returns:
            Results of all matches, in the order of their seeds.
        """
        batches = [
            self._run_batch(min(self.worlds, count - start), first_seed + start)
            for start in range(0, count, self.worlds)
        ]
        task, metric = self.task, self.task.success
        returns = np.concatenate([batch.returns for batch in batches])
        steps = np.concatenate([batch.steps for batch in batches])
        own_goals = np.concatenate([batch.own_goals for batch in batches])
        metrics = {
            name: np.concatenate([batch.metrics[name] for batch in batches])
            for name in batches[0].metrics
        }
        full = np.inf if task.full_success is None else task.full_success
        if metric is None:
            scores, decided = returns, np.zeros(count, np.bool_)
        else:
            scores = metrics[metric]
            decided = scores != 0.0 if task.two_sided else scores >= full
        first_goals = np.concatenate([batch.first_goals for batch in batches])
        by_goal = np.isfinite(first_goals) & task.two_sided
        time_step = task.config.time_step
        return Episodes(
            metric=metric or RETURN,
            scores=scores,
            returns=returns,
            seconds=steps * time_step,
            decided=decided | by_goal,
            decision_seconds=np.where(by_goal, first_goals, steps) * time_step,
            own_goals=own_goals,
            metrics=metrics,
        )

    def _run_batch(self, n: int, seed: int) -> _Batch:
        """Results of n matches that are played at once."""
        # Ended worlds wait, so long matches count as often as short ones.
        matches = Matches(
            self.task,
            n,
            seed,
            self.threads,
            controllers=self.controllers,
            autoreset="disabled",
            simulator=self.simulator,
            sensing=self.sensing,
            forecasting=self.policy,
            randomization=self.randomization,
        )
        with closed_after(matches, self.simulator):
            return self._play(matches, seed)

    def _play(self, matches: Matches, seed: int) -> _Batch:
        """Results of matches that have not begun."""
        n = matches.worlds
        observations = matches.reset()
        learners = LearnerPolicy(self.policy, matches, seed)
        own_goals = np.zeros((n, 2), np.int64)
        results = _Batch(np.zeros(n), np.zeros(n), np.full(n, np.nan), own_goals, {})
        playing = ~matches.done
        if self.recorder is not None:
            self.recorder.begin(n)
        while playing.any():
            if self.before_step is not None:
                self.before_step(playing)
            outcome = matches.step(learners.act(observations))
            observations = outcome.observations
            if self.recorder is not None:
                self.recorder.record(matches.play, playing)
            results.steps[:] += playing
            results.returns[:] += outcome.rewards.mean(axis=1)  # zero where a match waits
            scored = playing & matches.play.events.happened(EventKind.GOAL)
            if scored.any():
                results.own_goals[scored] += _own_goals(matches.play)[scored]
                first = scored & np.isnan(results.first_goals)
                results.first_goals[first] = results.steps[first]
            ending = playing & outcome.ended
            if ending.any():
                _check_scores(self.task, outcome, results.returns, ending)
                for name, values in outcome.metrics.items():
                    results.metrics.setdefault(name, np.zeros(n))[ending] = values[ending]
            playing &= ~ending
        return results


@dataclass(frozen=True)
class _Batch:
    """Results (n,) of n matches that were played at once."""

    returns: Doubles
    steps: Doubles
    first_goals: Doubles
    """steps to the first goal, NaN without one"""
    own_goals: NDArray[np.int64]
    """(n, 2) of blue and of yellow"""
    metrics: dict[str, Doubles]


def _check_scores(task: Task, outcome: Outcome, returns: Doubles, ending: Mask) -> None:
    """Raise ValueError if episodes that end have no score: no success metric, or no number."""
    metric, scores = task.success or RETURN, returns
    if task.success is not None:
        if task.success not in outcome.metrics:
            raise ValueError(f"task {task.name!r} has no metric {task.success!r} to evaluate by")
        scores = outcome.metrics[task.success].astype(np.float64)
    unknown = scores[ending & ~np.isfinite(scores)]
    if len(unknown):
        raise ValueError(
            f"{task.name}: expected finite numbers of {metric!r}, by which matches are scored, "
            f"got {unknown[0]}"
        )


def _own_goals(play: Play) -> NDArray[np.int64]:
    """Own goals (n, 2) of blue and of yellow in the last step."""
    goals = np.zeros((len(play.frame), 2), np.int64)
    for world in np.flatnonzero(play.events.happened(EventKind.GOAL)).tolist():
        for event in play.events.of_world(world):
            if event.kind is not EventKind.GOAL or event.robot == NOBODY:
                continue
            last_touch = BLUE if event.robot < play.frame.n_blue else YELLOW
            if last_touch != event.team:
                goals[world, last_touch] += 1
    return goals


@dataclass(frozen=True)
class _Team:
    """Learners that a policy drives at once."""

    agents: NDArray[np.intp]
    """(k,) their indices among the agents"""
    shape: tuple[int, int, int]
    """shape (n, k, action) of their actions"""
    rng: WorldRng
    """(n,) random streams"""
    memory: Memory
    """(n, ...) arrays of the policy"""


class LearnerPolicy:
    """A policy in the place of the learners: only learners receive rewards."""

    def __init__(self, policy: Policy, matches: Matches, seed: int) -> None:
        """Control the learners of new matches.

        Args:
            policy: the policy.
            matches: the matches, with at least one learner.
            seed: world i draws with the seed `seed + i`.

        Raises:
            TypeError: a `CommandPolicy`.
        """
        require_actions("policy", policy)
        self._policy, self._matches = policy, matches
        learners = matches.assignment.learners
        agents = np.arange(len(learners))
        teams = [agents]
        if matches.play.teams_differ:  # the policy plays each team with what that team knows
            are_yellow = learners >= matches.play.frame.n_blue
            teams = [team for team in (agents[~are_yellow], agents[are_yellow]) if len(team)]
        self._teams = [self._of_team(team, seed) for team in teams]

    def _of_team(self, agents: NDArray[np.intp], seed: int) -> _Team:
        """A policy's robots before the first step, by their indices among the agents."""
        matches = self._matches
        shape = (matches.worlds, len(agents), matches.action_size)
        rng = WorldRng.seeded(seed, matches.worlds).split(matches.agents[agents[0]])
        return _Team(agents, shape, rng, self._policy.new_memory(shape, rng))

    def act(self, observations: Floats) -> Floats:
        """Return the actions of the learners.

        Args:
            observations: (n, agents, o) observations of the learners.

        Returns:
            (n, agents, action) actions.
        """
        actions = [self._act(team, observations) for team in self._teams]
        return actions[0] if len(actions) == 1 else np.concatenate(actions, axis=1)

    def _act(self, team: _Team, observations: Floats) -> Floats:
        """Actions (n, k, action) of the k learners of a team."""
        view = match = own = None
        play, assignment = self._matches.play, self._matches.assignment
        is_whole = len(self._teams) == 1
        if self._policy.observes != "nothing":
            robots, indices = assignment.learners, assignment.learner_indices
            if not is_whole:
                robots = robots[team.agents]
                indices = np.searchsorted(assignment.observers, robots)
            view = play.sensed_view.select(indices)
            match = MatchState.of(play, robots, self._matches.task.config, ~self._matches.done)
        if self._policy.observes == "observation":
            own = observations if is_whole else observations[:, team.agents]
        optional = self._matches.task.optional_action_size
        inputs = PolicyInput(team.shape, view, own, optional, match)
        return actions_of(self._policy, inputs, team.rng, team.memory)

"""Matches behind an environment, with copying, scores, clocks and infos."""

from __future__ import annotations

import copy
import secrets
from collections.abc import Mapping
from contextlib import closing
from typing import Any

import numpy as np

from rsoccer.arrays import Array, Floats
from rsoccer.controllers import Controllers, resolve
from rsoccer.frame import Frame, team_of
from rsoccer.matches import Matches
from rsoccer.policies import Policy
from rsoccer.sources import is_shared
from rsoccer.task import Task


class EnvMatches(Matches):
    """Matches that `copy.deepcopy` and `pickle` can copy.

    A copy continues with the same future. Before the first reset there is nothing to continue: a
    copy then begins with a random seed of its own, so that the copies of one environment play
    different matches.
    """

    def __init__(self, task: Task, worlds: int, seed: int | None = None, **settings: Any) -> None:  # noqa: ANN401
        """Prepare matches; `reset` begins them.

        Args:
            task: the task that is played.
            worlds: number of matches, at least 1.
            seed: seed of the first match, at least 0; None for a random one: two environments must
                not play the same match.
            **settings: further arguments of `Matches`.
        """
        seed = secrets.randbits(63) if seed is None else seed
        super().__init__(task, worlds, seed, **settings)
        self._settings = settings
        self._has_other_policies = False  # than the settings
        self._closed = False

    def close(self) -> None:
        """Close the simulator; later calls do nothing, as environments may be closed again."""
        if not self._closed:
            self._closed = True
            super().close()

    @property
    def begun(self) -> bool:
        """True if every match has begun an episode."""
        return self._all_begun

    @property
    def fresh(self) -> bool:
        """True before the first reset of any match."""
        return not self._begun.any()

    def change_controllers(self, controllers: Controllers) -> None:
        """Replace policies while the matches run, as `Matches.change_controllers`.

        Args:
            controllers: policies by robot, team or "all", for robots that do not learn.
        """
        super().change_controllers(controllers)
        # Teams go on as they do, also where the new policies expect no forecast.
        self._settings = {**self._settings, "forecasting": self.forecasting}
        self._has_other_policies = True

    def _present_settings(self) -> dict[str, Any]:
        """Arguments for new matches with the policies that play now."""
        if not self._has_other_policies:
            return self._settings
        before: Controllers = self._settings.get("controllers") or {}
        by_robot = resolve(self.task, {**resolve(self.task, before), **_policies_by_robot(self)})
        return {**self._settings, "controllers": by_robot}

    def with_seed(self, seed: int) -> EnvMatches:
        """Return new matches with the same arguments and another seed.

        Args:
            seed: seed of the first match, at least 0.
        """
        matches = EnvMatches(self.task, self.worlds, seed, **self._present_settings())
        matches._start_rows = self._start_rows
        return matches

    def check_running(self) -> None:
        """Refuse a step that needs a reset first.

        Raises:
            RuntimeError: a match that has not begun, or whose episode has ended.
        """
        hint = "call reset() to begin an episode"
        if not self.begun:
            raise RuntimeError(f"step before reset: {hint}")
        if np.count_nonzero(self._done):
            where = "" if self.worlds == 1 else f" in worlds {np.flatnonzero(self._done).tolist()}"
            raise RuntimeError(f"step after the end of the episode{where}: {hint}")

    def score(self, world: int = 0) -> tuple[int, int]:
        """Return the goals of blue and of yellow in the episode of one match.

        Args:
            world: index of the match.
        """
        blue, yellow = self.play.game.score[world].tolist()
        return blue, yellow

    def clock(self, world: int = 0) -> float:
        """Return the time since the episode of one match began, in seconds.

        Args:
            world: index of the match.
        """
        return float(self.play.steps[world]) * self.task.config.time_step

    def __reduce__(self) -> tuple[Any, ...]:
        """Return a constructor, the constructor's arguments and the complete state.

        Raises:
            RuntimeError: the matches are inconsistent after a failure.
            TypeError: a simulator that the copy would share, or one that has no `snapshot`.
        """
        simulator = self._settings.get("simulator")
        if is_shared(simulator):
            raise TypeError(
                "simulator: a copy of these matches needs one of its own; expected a function "
                "(config, worlds, threads) that makes it, or its text 'module:name', got "
                f"{simulator!r}"
            )
        state = None if self.fresh else self.state_dict()
        settings = self._present_settings()
        return _resumed, (self.task, self.worlds, settings, state, self._start_rows)


class SeededCopies:
    """Gymnasium environment whose copies have the seed of their matches in `np_random_seed`."""

    _matches: EnvMatches

    def __setstate__(self, state: Mapping[str, Any]) -> None:
        """Restore a copy; one that was never reset draws a random seed, as a new environment."""
        self.__dict__.update(state)
        if self._matches.fresh:
            self.__dict__.update(_np_random=None, _np_random_seed=None)
            with closing(self._matches) as replaced:
                self._matches = replaced.with_seed(random_seed(self))


class PublicMatches:
    """The matches of an environment, which its users may record, read and change."""

    _matches: EnvMatches

    @property
    def matches(self) -> Matches:
        """The matches: for recorders, `change_options`, `change_controllers` and `start_from`.

        The environment resets and steps them.
        """
        return self._matches

    @property
    def frame(self) -> Frame:
        """State of all matches (n, ...), to be read only, valid until the next step."""
        return self._matches.frame


class SingleLearner(PublicMatches):
    """Properties that environments with one learner have."""

    @property
    def task(self) -> Task:
        """Task that is played."""
        return self._matches.task

    @property
    def learner(self) -> str:
        """Name of the robot that learns, such as "blue_0"."""
        return str(self._matches.agents[0])


def _policies_by_robot(matches: Matches) -> dict[str, Policy]:
    """Policies of all robots that do not learn, an object for each group.

    Robots that share an object are one group in new matches, but groups stay apart if their
    policies have been changed to one: each has its own streams and memory.
    """
    robots, policies = matches.task.robots, dict[str, Policy]()
    used = set[tuple[int, str]]()
    for group in matches.assignment.groups:
        policy, names = group.policy, [robots[robot] for robot in group.robots]
        # A policy that looks has a group for each team anyway where teams know different states.
        is_divided = matches.play.teams_differ and policy.observes != "nothing"
        key = id(policy), team_of(names[0]) if is_divided else ""
        if key in used:
            policy = copy.copy(policy)
        used.add(key)
        policies |= dict.fromkeys(names, policy)
    return policies


def random_seed(env: Any) -> int:  # noqa: ANN401  (gymnasium.Env or VectorEnv)
    """Return the random seed that Gymnasium draws for an environment without a seed.

    Args:
        env: an environment of Gymnasium, single or vector; `np_random_seed` is the seed from now
            on.
    """
    return int(env.np_random_seed or 0)


def _resumed(
    task: Task,
    worlds: int,
    settings: Mapping[str, Any],
    state: Mapping[str, Array] | None,
    start_rows: Floats | None = None,
) -> EnvMatches:
    """Matches that continue from a state; without one, new matches with a random seed."""
    matches = EnvMatches(task, worlds, None if state is None else 0, **settings)
    matches._start_rows = start_rows
    if state is not None:
        matches.load_state_dict(state)
    return matches

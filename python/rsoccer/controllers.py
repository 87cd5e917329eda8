"""Assignment of controllers to robots: external learners, or policies of this package."""

import os
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks, task_checks
from rsoccer._core import SimConfig
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import team_of
from rsoccer.policies import make_policy
from rsoccer.policies.base import (
    CommandPolicy,
    MatchState,
    Memory,
    Policy,
    PolicyInput,
    actions_of,
    check_memory,
)
from rsoccer.rng import WorldRng
from rsoccer.task import LEARN, Learn, Play, Task
from rsoccer.view import SIDES

Controller = str | os.PathLike[str] | Policy | Learn
"""`LEARN`, a policy, its name, or the path of its file."""
Controllers = Mapping[str, Controller]
"""Controllers by robot name ("blue_0"), team ("blue") or "all"."""
Indices = slice | NDArray[np.intp]
GroupState = tuple[WorldRng, Memory]


@dataclass
class PolicyGroup:
    """Robots that share one policy, with the policy's random streams and memory."""

    name: str
    """Name of the group's first robot; it selects the group's random streams."""
    policy: Policy
    """Policy of all these robots."""
    robots: NDArray[np.intp]
    """(k,) indices of the robots."""
    observer_indices: Indices
    """(k,) indices of the robots among the observers, if the policy observes anything."""
    rng: WorldRng
    """(n,) random streams."""
    memory: Memory
    """(n, ...) arrays of the policy."""
    config: SimConfig
    """Field, ball and robots of the task."""
    optional_actions: int = 0
    """Numbers at the end of an action that the policy may leave out; they are 0 then."""

    def __post_init__(self) -> None:
        """Find a slice of the robots, which is faster than indices."""
        self._written = _slice_if_possible(self.robots)

    def act(
        self, play: Play, observations: Floats, actions: Floats, playing: Mask | None = None
    ) -> None:
        """Write the actions of the group's robots.

        Args:
            play: current state of all worlds.
            observations: (n, observers, o) current observations.
            actions: (n, robots, action) output, clipped to [-1, 1]; other robots' rows stay.
            playing: (n,) worlds whose actions matter; None for all.

        Raises:
            TypeError: the policy returned no array of a floating-point type.
            ValueError: it returned actions of another shape, or that are not finite, or left other
                arrays in its memory.
        """
        shape = (len(actions), len(self.robots), actions.shape[2])
        inputs = self._inputs(play, observations, shape, playing)
        actions[:, self._written] = actions_of(self.policy, inputs, self.rng, self.memory)

    def command(self, play: Play, observations: Floats, commands: Floats) -> None:
        """Replace the commands of the group's robots, of a `CommandPolicy`.

        Args:
            play: current state of all worlds.
            observations: (n, observers, o) current observations.
            commands: (n, robots, command) commands, SI units; other robots' rows stay.

        Raises:
            ValueError: the policy returned commands of another shape, or that are not finite, or
                left other arrays in its memory.
        """
        assert isinstance(self.policy, CommandPolicy), "Matches calls this for no other policy"
        shape = (len(commands), len(self.robots), play.actions.shape[2])
        inputs = self._inputs(play, observations, shape)
        converted = commands[:, self.robots]
        before = dict(self.memory)
        chosen = self.policy.commands(inputs, converted, self.rng, self.memory)
        check_memory(self.policy, "commands", self.memory, before)
        name = f"{type(self.policy).__name__}.commands"
        commands[:, self.robots] = checks.floats(name, chosen, converted.shape)

    def _inputs(
        self,
        play: Play,
        observations: Floats,
        shape: tuple[int, int, int],
        playing: Mask | None = None,
    ) -> PolicyInput:
        """Input of the policy: view and observations of its robots, as far as it observes."""
        view = observed = match = None
        if self.policy.observes != "nothing":
            view = play.sensed_view.select(self.observer_indices)
            match = MatchState.of(play, self.robots, self.config, playing)
        if self.policy.observes == "observation":
            observed = observations[:, self.observer_indices]
        return PolicyInput(shape, view, observed, self.optional_actions, match)

    def restart(self, worlds: NDArray[np.intp], rng: WorldRng, action_size: int) -> None:
        """Begin new episodes in some worlds.

        Args:
            worlds: (k,) indices of the worlds.
            rng: (k,) random streams of these worlds from now on.
            action_size: numbers in one robot's action.

        Raises:
            ValueError: the policy's new memory has other arrays than that of other episodes.
        """
        fresh = _fresh_memory(self.policy, (len(worlds), len(self.robots), action_size), rng)
        expected = {name: array[worlds] for name, array in self.memory.items()}
        check_memory(self.policy, "new_memory", fresh, expected)
        self.rng.put(worlds, rng)
        for name, array in fresh.items():
            self.memory[name][worlds] = array

    def take(self, worlds: NDArray[np.intp]) -> GroupState:
        """Return a copy of the streams and the memory of some worlds.

        Args:
            worlds: (k,) indices of the worlds.
        """
        return self.rng[worlds], {name: array[worlds] for name, array in self.memory.items()}

    def put(self, worlds: NDArray[np.intp], state: GroupState) -> None:
        """Overwrite the streams and the memory of some worlds.

        Args:
            worlds: (k,) indices of the worlds.
            state: streams and memory of k worlds, as `take` returns them.
        """
        rng, memory = state
        self.rng.put(worlds, rng)
        for name, array in memory.items():
            self.memory[name][worlds] = array

    def arrays(self) -> dict[str, Array]:
        """Return the memory's arrays under names that no other group uses; not copied."""
        return {f"{self.name}.{name}": array for name, array in self.memory.items()}


@dataclass
class Assignment:
    """A controller for every robot: learners, and groups of robots with a policy."""

    learners: NDArray[np.intp]
    """(agents,) indices of the robots with external actions."""
    learner_indices: Indices
    """(agents,) indices of the learners among the observers."""
    observers: NDArray[np.intp]
    """(observers,) indices of the robots that observe, in the order of a state row."""
    groups: list[PolicyGroup]
    """Robots with a policy, one group per policy, or per policy and team; see `assign`."""

    def __post_init__(self) -> None:
        """Find a slice of the learners, which is faster than indices."""
        self.written: Indices = _slice_if_possible(self.learners)

    @property
    def reads_observations(self) -> bool:
        """True if a learner or a policy reads observations; scripts read the view alone."""
        if len(self.learners):
            return True
        return any(group.policy.observes == "observation" for group in self.groups)


def assign(
    task: Task, controllers: Controllers | None, worlds: int, *, by_team: bool = False
) -> Assignment:
    """Assign a controller to every robot of a task.

    Args:
        task: the task that is played.
        controllers: replacements for the task's default controllers.
        worlds: number of worlds; the groups' streams and memory have this length and are not
            started yet.
        by_team: whether teams know different states: a policy that observes then has a group for
            each team that it plays, with streams and memory of its own.

    Returns:
        The learners, the observers, and one group for each policy.

    Raises:
        TypeError: something that is not a controller.
        ValueError: an unknown robot, or a policy that does not fit the task.
    """
    resolved = resolve(task, controllers)
    learners = [
        i for i, controller in enumerate(resolved.values()) if isinstance(controller, Learn)
    ]
    robots_of: dict[tuple[int | str, str], list[int]] = {}
    policy_of: dict[int | str, Policy] = {}
    for robot, controller in enumerate(resolved.values()):
        if isinstance(controller, Learn):
            continue
        key = controller if isinstance(controller, str) else id(controller)
        if key not in policy_of:
            policy_of[key] = make_policy(controller, task)
        is_divided = by_team and policy_of[key].observes != "nothing"
        team = team_of(task.robots[robot]) if is_divided else "all"
        robots_of.setdefault((key, team), []).append(robot)
    observing = [
        robots for (key, _), robots in robots_of.items() if policy_of[key].observes != "nothing"
    ]
    observers = np.array(sorted(sum(observing, learners)), np.intp)
    groups = []
    for (key, _), robots in robots_of.items():
        rng = WorldRng.seeded(0, worlds)
        shape = (worlds, len(robots), task.action_size)
        memory = _fresh_memory(policy_of[key], shape, rng)
        indices = _indices_among(observers, robots)
        name = task.robots[robots[0]]
        groups.append(
            PolicyGroup(
                name,
                policy_of[key],
                np.array(robots, np.intp),
                indices,
                rng,
                memory,
                task.config,
                task.optional_action_size,
            )
        )
    learner_indices = _indices_among(observers, learners)
    return Assignment(np.array(learners, np.intp), learner_indices, observers, groups)


def resolve(task: Task, controllers: Controllers | None) -> dict[str, Controller]:
    """Return a controller for each robot of a task, by robot name.

    Args:
        task: the task that is played; its default controllers apply where none is given.
        controllers: by robot, team or "all"; the most specific entry wins.

    Raises:
        TypeError: not a mapping, or something that is not a controller.
        ValueError: an unknown robot or team, or a robot without a default controller.
    """
    given = given_by_name(controllers)
    valid = ["all", *SIDES, *task.robots]
    unknown = sorted(set(given) - set(valid), key=str)
    if unknown:
        raise ValueError(f"controllers: unknown {unknown}; valid are {valid}")
    resolved: dict[str, Controller] = {}
    for robot, default in task_checks.controllers(task).items():
        key = next((key for key in (robot, team_of(robot), "all") if key in given), None)
        if key is None:
            name = f"{task_checks.label(task, 'default_controllers')}: {robot!r}"
            resolved[robot] = _checked(name, default)
        else:
            resolved[robot] = _checked(f"controllers[{key!r}]", given[key])
    return resolved


def given_by_name(controllers: Controllers | None) -> dict[str, Controller]:
    """Return a copy of a mapping of controllers.

    Args:
        controllers: controllers by robot, team or "all"; None for an empty mapping.

    Raises:
        TypeError: not a mapping.
    """
    if controllers is None:
        return {}
    if not isinstance(controllers, Mapping):
        raise TypeError(
            "controllers: expected a mapping from robots to policies, as in {'blue': 'ou'}, "
            f"got {controllers!r}"
        )
    return dict(controllers)


def _checked(name: str, controller: object) -> Controller:
    """A controller, a path as text; `name` is for the error."""
    if isinstance(controller, os.PathLike):
        return str(os.fspath(controller))
    if not isinstance(controller, str | Policy | Learn):
        raise TypeError(
            f"{name}: expected {LEARN}, a policy, its name or its file, got {controller!r}"
        )
    return controller


def _indices_among(observers: NDArray[np.intp], robots: list[int]) -> Indices:
    """Indices of robots among the observers; a slice, which copies nothing, where possible."""
    return _slice_if_possible(np.searchsorted(observers, robots))


def _slice_if_possible(indices: NDArray[np.intp]) -> Indices:
    """A slice with the same indices where there is one, else the indices."""
    if (np.diff(indices) == 1).all() and len(indices):
        return slice(int(indices[0]), int(indices[0]) + len(indices))
    return indices


def _fresh_memory(policy: Policy, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
    """A policy's memory at the start of episodes, checked and copied."""
    return checks.memory(type(policy).__name__, policy.new_memory(shape, rng), shape[0])

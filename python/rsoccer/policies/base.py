"""The interface of policies: scripts, noise and trained networks drive robots through it."""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks
from rsoccer._core import SimConfig, Threads
from rsoccer.arrays import Array, Floats, Mask, read_only
from rsoccer.game import Game
from rsoccer.play import Play
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.view import View

Memory = dict[str, Array]
"""State of a policy between steps: arrays (n, ...) by name, one row per world."""

Observes = Literal["nothing", "view", "observation"]
"""Kinds of input: none, the `View` of the robots, or the view and the task's observations."""


@dataclass(frozen=True)
class MatchState:
    """A match as a whole, for policies that control teams: absolute coordinates, all robots."""

    rows: Floats
    """(n, row) state as the robots know it, see `Frame`."""
    game: Game
    """(n, ...) score, and with a referee the state of the match."""
    robots: NDArray[np.intp]
    """(robots,) indices of the robots that the policy drives, in the order of a state row."""
    threads: Threads
    """Threads that may share the work."""
    config: SimConfig
    """Field, ball and robots."""
    playing: Mask | None = None
    """(n,) worlds that play on, where others have ended and ignore actions; None for all."""

    @classmethod
    def of(
        cls,
        play: Play,
        robots: NDArray[np.intp],
        config: SimConfig,
        playing: Mask | None = None,
    ) -> "MatchState":
        """Return the match as some robots know it, in arrays that cannot be written.

        Args:
            play: state of n worlds.
            robots: (k,) indices of the robots in the order of a state row; of one team where teams
                know different states.
            config: field, ball and robots.
            playing: (n,) worlds that play on, which nobody else reads; None for all.
        """
        rows = play.known_to_robots(robots).rows
        return cls(rows, play.game.read_only, read_only(robots), play.threads, config, playing)

    def take(self, worlds: NDArray[np.intp]) -> "MatchState":
        """Return a copy of some worlds.

        Args:
            worlds: (k,) indices of worlds.
        """
        playing = None if self.playing is None else self.playing[worlds]
        return replace(self, rows=self.rows[worlds], game=self.game.take(worlds), playing=playing)


@dataclass
class PolicyInput:
    """Input of one policy step, for the robots that the policy drives, in order.

    The arrays are valid during the call: the next step overwrites them. Only
    `observations` can be written, as nobody else reads those of the policy's robots.
    """

    action_shape: tuple[int, int, int]
    """(n, robots, action): shape of the actions to return."""
    view: View | None
    """View of each robot, arrays (n, robots, ...); None if the policy observes "nothing"."""
    observations: Floats | None
    """(n, robots, o) observations of the task; None unless the policy observes "observation"."""
    optional_actions: int = 0
    """Numbers at the end of an action that the policy may leave out."""
    match: MatchState | None = None
    """The match as a whole; None if the policy observes "nothing"."""

    def required_view(self, policy: str) -> View:
        """Return the view of a policy that cannot act without one.

        Args:
            policy: name of the policy, for the error message.

        Raises:
            ValueError: there is no view.
        """
        if self.view is None:
            raise ValueError(f"{policy} needs a view, got none")
        return self.view

    def completed(self, actions: Floats) -> Floats:
        """Return the actions of a policy, with zeros for optional numbers that it left out.

        Args:
            actions: (n, robots, action), or fewer numbers by `optional_actions` at most.
        """
        missing = self.action_shape[2] - (actions.shape[-1] if actions.ndim else 0)
        if not 0 < missing <= self.optional_actions:
            return actions
        zeros = np.zeros((*actions.shape[:-1], missing), np.float32)
        return np.concatenate([actions, zeros], axis=-1)


class Policy(ABC):
    """Base class of policies, which drive some robots in each of n worlds.

    A policy object holds no state of a match. State between steps belongs in `memory`, so that
    one object can drive several teams, and matches can be copied and saved.

    Example:
        >>> import numpy as np
        >>> import rsoccer
        >>> class Forward(rsoccer.Policy):
        ...     observes = "nothing"
        ...
        ...     def act(self, inputs, rng, memory):
        ...         return np.ones(inputs.action_shape, np.float32)
        >>> matches = rsoccer.Matches("VSS-v0", 8, controllers={"yellow": Forward()})
    """

    observes: Observes
    """Input that `act` gets; unused inputs are not computed."""

    forecasts: bool = False
    """Whether it plays from the state in which its commands act, where robots see and obey late:
    its team forecasts then, as with `Sensing.forecast`, if all that look there do so."""
    needs_forecast: bool = False
    """Whether it cannot play without one, as it has learned behind a forecast: then its team
    forecasts, learners and others too."""

    _built_for: tuple[SimConfig, tuple[str, ...]] | None = None
    """Configuration and sides of the task it depends on; None if it depends on no task."""

    def __init__(self, task: Task | None = None) -> None:
        """Bind the policy to a task, or to none.

        Args:
            task: the policy fits only tasks with the same field, robots, ball and sides; None:
                it fits every task.
        """
        if task is not None:
            self._built_for = task.config, tuple(task.sides)

    @property
    def task_name(self) -> str | None:
        """Name of the task that it was trained on, for `make_task`; None if it was not trained."""
        return None

    @property
    def task_options(self) -> dict[str, Any]:
        """Options of that task, for `make_task`; {} for the defaults."""
        return {}

    def check_fits(self, task: Task, observation_size: int) -> None:
        """Check that the policy can play a task.

        Args:
            task: the task to be played.
            observation_size: numbers in one robot's observation.

        Raises:
            ValueError: the policy was built for another field, other robots or other teams.
        """
        if self._built_for not in (None, (task.config, tuple(task.sides))):
            raise ValueError(
                f"policy: expected one for the field, robots and teams of {task.name}, got a "
                f"{type(self).__name__} that was built for others; build it for this task, "
                "or pass its name"
            )

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Return the memory at the start of episodes.

        Args:
            shape: (n, robots, action), as `PolicyInput.action_shape`.
            rng: (n,) random streams of the worlds.

        Returns:
            New arrays, each (n, ...). The default is no memory.
        """
        return {}

    @abstractmethod
    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return the actions of one control step.

        Args:
            inputs: view and observations of the robots.
            rng: (n,) random streams of the worlds.
            memory: arrays as `new_memory` returned them; updated in place, and with the same
                names and shapes afterwards.

        Returns:
            (n, robots, action) in [-1, 1]; larger values are clipped.
        """


class CommandPolicy(Policy):
    """Base class of controllers whose robots take commands in SI units in place of task actions.

    Software of a team, or a person, commands wheels, velocities and chips that a task's actions do
    not have. Such a controller is assigned like any policy, and its memory and random streams are
    those of any policy. Only `Matches` executes its commands: in the place of learners, whose
    actions are evaluated, and in a mixture of opponents it is refused.

    `play.actions` of its robots, which tasks observe and reward, is what `act` returns: zeros,
    unless a subclass knows better.

    Example:
        >>> import numpy as np
        >>> import rsoccer
        >>> class Spin(rsoccer.CommandPolicy):
        ...     observes = "nothing"
        ...
        ...     def commands(self, inputs, converted, rng, memory):
        ...         wheels = np.array([-10.0, 10.0], np.float32)  # rad/s, left and right
        ...         return np.broadcast_to(wheels, converted.shape)
        >>> matches = rsoccer.Matches("VSS-v0", 8, controllers={"yellow": Spin()})
    """

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return the actions that tasks see, called before `commands` in each step.

        Args:
            inputs: view and observations of the robots.
            rng: (n,) random streams of the worlds.
            memory: arrays as `new_memory` returned them; updated in place.

        Returns:
            (n, robots, action) in [-1, 1]. Default: zeros.
        """
        return np.zeros(inputs.action_shape, np.float32)

    @abstractmethod
    def commands(
        self, inputs: PolicyInput, converted: Floats, rng: WorldRng, memory: Memory
    ) -> Floats:
        """Return the commands of one control step.

        Args:
            inputs: view and observations of the robots.
            converted: (n, robots, command) commands that follow from the actions of `act`; a copy.
            rng: (n,) random streams of the worlds.
            memory: arrays as `new_memory` returned them; updated in place.

        Returns:
            (n, robots, command) finite numbers in SI units, with the columns
            `config.command_columns`. The limits of the robot apply.
        """


def require_observes(policy: Policy) -> None:
    """Check that a policy says what it observes.

    Args:
        policy: the policy.

    Raises:
        ValueError: it does not, or it names no kind of input.
    """
    kinds, observes = get_args(Observes), getattr(policy, "observes", None)
    if observes not in kinds:
        got = repr(observes) if hasattr(policy, "observes") else "none"
        raise ValueError(
            f"{type(policy).__name__}.observes: expected one of {list(kinds)}, got {got}"
        )


def actions_of(policy: Policy, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
    """Return the checked actions of a policy for one control step.

    Args:
        policy: the policy, which acts.
        inputs: view and observations of the robots.
        rng: (n,) random streams of the worlds.
        memory: arrays of the policy; updated in place.

    Returns:
        (n, robots, action), clipped to [-1, 1], with zeros for optional numbers that it left out.

    Raises:
        TypeError: the policy returned no array of a floating-point type.
        ValueError: it returned an array of another shape, or numbers that are not finite, or left
            other arrays in its memory.
    """
    before, name = dict(memory), _label(policy, "act")
    actions = policy.act(inputs, rng, memory)
    check_memory(policy, "act", memory, before)
    if inputs.optional_actions:
        actions = inputs.completed(checks.as_array(name, actions))
    return checks.actions(actions, inputs.action_shape, name)


def check_memory(policy: Policy, method: str, memory: Memory, expected: Memory) -> None:
    """Check that a memory has the arrays that it began with: others would outlive an episode.

    Args:
        policy: the policy.
        method: name of its method that was called, for the error message.
        memory: its arrays.
        expected: arrays of the same names and shapes.

    Raises:
        ValueError: other names or shapes.
    """
    if len(memory) == len(expected) and all(
        memory.get(name) is array for name, array in expected.items()
    ):
        return
    wanted, found = _shapes_of(expected), _shapes_of(memory)
    if found != wanted:
        raise ValueError(
            f"{_label(policy, method)}: expected a memory of {wanted} by new_memory, got {found}"
        )


def _shapes_of(memory: Memory) -> dict[str, tuple[int, ...] | None]:
    """Shapes of the arrays of a memory by name; None for what is no array."""
    return {name: getattr(array, "shape", None) for name, array in memory.items()}


def _label(policy: Policy, method: str) -> str:
    """Name of a method for errors."""
    return f"{type(policy).__name__}.{method}"


def require_actions(name: str, policy: Policy) -> None:
    """Check that a policy plays by its actions alone.

    Args:
        name: name of the argument, for the error message.
        policy: the policy.

    Raises:
        TypeError: a `CommandPolicy`.
    """
    if isinstance(policy, CommandPolicy):
        raise TypeError(
            f"{name}: expected a policy that gives actions, got {type(policy).__name__}, which "
            "gives commands; pass it to Matches as a controller"
        )

"""The part of a task that its author defines: initial states, commands, observations, rewards.

A task is stateless and batched: every method handles all worlds at once. State that two
consecutive frames do not contain goes into `play.memory`. Options are the fields of a frozen
dataclass. A task names only default controllers; `Matches` assigns the actual ones.

Authors derive from `rsoccer.Task`, which adds what others read of a task.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from enum import Enum
from typing import Any, ClassVar, Final

from rsoccer._core import SimConfig
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame, robot_names
from rsoccer.markers import Marker
from rsoccer.play import Play
from rsoccer.reflection import Symmetry
from rsoccer.rng import WorldRng
from rsoccer.rules.base import Rule
from rsoccer.rules.crossings import Crossings
from rsoccer.view import SIDES


class Learn(Enum):
    """Type of `LEARN`."""

    LEARN = "learn"
    """Controller of a robot whose actions are passed to `Matches.step`."""


LEARN: Final = Learn.LEARN
"""Controller of a robot whose actions are passed to `Matches.step`."""


class TaskDefinition(ABC):
    """Definition of a task, batched over `n` worlds.

    Required are `action_size`, `max_steps`, `config` and the four methods
    `get_initial_positions_frame`, `get_commands`, `frame_to_observations` and
    `calculate_reward_and_done`. All others have defaults.
    """

    name: str
    """Registered name, set by `register`. Before that the name of the class, unless its body sets
    one; a subclass does not inherit it."""
    action_size: int
    """Numbers in the action of one robot, each in [-1, 1]."""
    optional_action_size: int = 0
    """Numbers at the end of an action that a policy may leave out; they are 0 then. So scripts play
    in a task with an option for further actions."""
    max_steps: int
    """Control steps after which an episode is truncated, at least 1."""
    sides: Sequence[str] = SIDES
    """Teams whose robots may observe. The views have slots for the largest of these teams."""
    success: ClassVar[str | None] = None
    """Metric that measures the success of an episode; None for the return."""
    training_options: ClassVar[tuple[str, ...]] = ("reward_weights",)
    """Options that change how a policy learns, not how it plays. The task on which a policy was
    trained is evaluated and shown without them."""

    def __init_subclass__(cls, **keywords: object) -> None:
        """Name a class after itself, as its parent's name stands for another task."""
        super().__init_subclass__(**keywords)
        if "name" not in {**vars(cls), **getattr(cls, "__dataclass_fields__", {})}:
            cls.name = cls.__name__

    @property
    @abstractmethod
    def config(self) -> SimConfig:
        """Configuration of the simulator: field, robots, ball and time step."""

    @property
    def rules(self) -> Sequence[Rule]:
        """Rules of the game, in the order of their precedence. Default: `Crossings`."""
        return (Crossings(),)

    def new_memory(self, n: int) -> dict[str, Array]:
        """Create the task's own state at the start of an episode.

        Args:
            n: number of worlds.

        Returns:
            Arrays (n, ...) by name. `Play.memory` holds copies of them, which
            `calculate_reward_and_done` updates in place; a reset renews them. Default: none.
        """
        return {}

    @abstractmethod
    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Draw the initial state of episodes.

        Args:
            rng: (n,) random streams, one per world. World `i` must depend on stream `i` only.

        Returns:
            One frame of n worlds.
        """

    def start_episode(self, play: Play) -> None:  # noqa: B027  (no task needs to override it)
        """Fit the memory of new episodes to their initial state. Default: leave it as it is.

        Called once for each episode, before its first observation.

        Args:
            play: state of n worlds with the memory of `new_memory`, which may be changed in place.
                Draws from `play.rng` are allowed.
        """

    @abstractmethod
    def get_commands(self, play: Play, actions: Floats) -> Floats:
        """Convert actions to robot commands.

        Args:
            play: state of n worlds, of which robots know `play.sensed`.
            actions: (n, robots, action_size) in [-1, 1].

        Returns:
            (n, robots, command) in SI units, with the columns `config.command_columns`.
        """

    @abstractmethod
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        """Compute the observation of each observer as named blocks.

        Args:
            play: state of n worlds. `play.sensed_view` is what each observer knows, in its own
                coordinates; `play.sensed` is the same in absolute ones.

        Returns:
            Blocks (n, observers, ...) by name. They are concatenated in this order and clipped to
            `observation_limits`.
        """

    @abstractmethod
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Return the reward terms of the last step and the terminations.

        Args:
            play: state of n worlds that the physics of the step left, with the score and the events
                of the step. A restart of play takes effect afterwards.

        Returns:
            Weighted reward terms by name, each (n, observers) or (n, 1); and (n,) the episodes
            that terminate. The reward is the sum of the terms. `max_steps` truncates episodes
            separately.
        """

    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        """Return the floor markers for pictures of one world: targets, gates, areas.

        Args:
            play: state of n worlds.
            world: index of the world, 0 to n - 1.
        """
        return ()

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Compute metrics of each episode; the values at its end are reported.

        Args:
            play: state of n worlds.

        Returns:
            Arrays (n,) by name. Default: none.
        """
        return {}

    @property
    def full_success(self) -> float | None:
        """Value of the metric `success` at full success; None for a metric without a maximum."""
        return 1.0

    @property
    def action_table(self) -> Floats | None:
        """(choices, action_size) actions of a discrete task; None for continuous actions."""
        return None

    def default_controllers(self) -> Mapping[str, Any]:
        """Return the default controller of each robot by name: `LEARN`, a policy or its name."""
        return dict.fromkeys(robot_names(self.config.n_blue, self.config.n_yellow), LEARN)

    def observation_limits(self) -> dict[str, float]:
        """Return the bounds of observation blocks by name.

        A block is clipped to [-bound, bound]. The bound of other blocks is
        `rsoccer.observation_layout.DEFAULT_LIMIT`. Names are those of the blocks that the task
        observes with its options.
        """
        return {}

    @property
    def action_meaning(self) -> str:
        """Meaning of the actions where options change it, as text; empty for the default one."""
        return ""

    @property
    def symmetry(self) -> Symmetry | None:
        """Reflection of actions and of observation blocks, of a symmetric task.

        That is, with left and right swapped, reflected actions lead to reflected observations and
        equal rewards. None, the default: not known, or the rules of the task tell left from right.
        """
        return None

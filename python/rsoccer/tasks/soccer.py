"""Base class of the tasks of both leagues: shared options, observation blocks, discrete actions."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from dataclasses import field as dataclass_field
from functools import cached_property
from typing import ClassVar, Final, cast

import numpy as np

from rsoccer import checks
from rsoccer._core import EgoFeatures, Field, RobotModel
from rsoccer.arrays import Floats
from rsoccer.encoded_blocks import EncodedBlocks
from rsoccer.reflection import Reflection, Symmetry
from rsoccer.task import Play, Task
from rsoccer.tasks import options
from rsoccer.view import slot_counts

OBSERVATION_LIMITS: Final = {
    "ball": 4.0,
    "ego": 2.0,
    "teammates": 2.0,
    "opponents": 2.0,
    "action": 1.0,
    "ball_polar": 3.0,
    "goal_polar": 3.0,
    "shot": 1.0,
    "own_goal_polar": 3.0,
    "own_goal_shot": 1.0,
    "body_velocities": 4.0,
    "body_positions": 3.0,
    "presence": 1.0,
}
"""Bounds of the observation blocks, in their units; a struck ball is faster than a robot."""


ROBOT_SIGNS: Final = (1, -1, 1, -1, 1, -1, -1)
"""Signs of a reflected robot: position, heading, velocity, angular velocity."""
REFLECTIONS: Final = {
    "ball_polar": Reflection.of([1, 1, -1]),
    "goal_polar": Reflection.of([1, 1, -1]),
    "shot": Reflection.of([1, -1, 1, 1]),
    "own_goal_polar": Reflection.of([1, 1, -1]),
    "own_goal_shot": Reflection.of([1, -1, 1]),
    "body_velocities": Reflection.of([1, -1]),
    "body_positions": Reflection.of([1, -1]),
}
"""Reflection of the last axis of the blocks that are the same in both leagues."""


@dataclass(frozen=True)
class Soccer(Task):
    """Base class of tasks with a ball and two goals.

    Each robot observes positions and velocities of the ball and of all robots, without noise. Not
    observed are the spin of the ball, the charge of kickers and the actions of other robots.
    Coordinates are those of the robot's team: origin at the center of the field, +x toward the
    attacked goal, +y to the left of that. Blocks from `ball_polar` to `body_positions` repeat
    positions and velocities in the coordinates of the robot's body: origin at its center, first
    axis ahead, second axis to its left.

    Blocks of the flat observation, in this order:

    ===============  =========  ===============================================  ======  =====
    Block            Shape      Meaning                                          Unit    Limit
    ===============  =========  ===============================================  ======  =====
    ball             (4,)       VSSS: position x, y; velocity x, y               L; V    4
    ..               (6,)       SSL: position x, y, z; velocity x, y, z          L; V    4
    ego              (r,)       own position x, y; cosine and sine of the        L; 1;   2
                                heading; velocity x, y; angular velocity; SSL:   V; W;
                                also 1 if the ball is in the break beam, else 0  1
    teammates        (t, r)     the same of each teammate                        as ego  2
    opponents        (o, r)     the same of each opponent                        as ego  2
    ball_polar       (3,)       distance of the ball; cosine and sine of its     L; 1    3
                                bearing
    goal_polar       (3,)       the same of the center of the attacked goal      L; 1    3
    shot             (4,)       cosine and sine of the direction from ball to    1       1
                                goal; nearness of the ball, exp(-d / 0.125 m)
                                at distance d; nearness times the cosine of
                                the angle between the directions to the ball
                                and from ball to goal
    own_goal_polar   (3,)       VSSS: as `goal_polar`, of the own goal           L; 1    3
    own_goal_shot    (3,)       VSSS: as `shot`, of the own goal, without the    1       1
                                nearness alone
    body_velocities  (2, 2)     own velocity; velocity of the ball               V       4
    body_positions   (1 + t +   offset to the ball, to each teammate and to      L       3
                     o, 2)      each opponent
    presence         (1 + t +   with `OBSERVES_PRESENCE`: 1 if the robot, each   1       1
                     o,)        teammate and each opponent is on the field,
                                else 0
    action           (a,)       last action of the robot; 0 after a reset        1       1
    ===============  =========  ===============================================  ======  =====

    Units: L is half the length of the field, V and W are the robot's top speed and top angular
    velocity. Sizes: r is 7 in VSSS and 8 in SSL, a is `action_size`, t and o are the greatest
    numbers of teammates and opponents of a robot of `sides`. A slot without a robot is 0; in
    `body_positions` it shows the center of the field. Numbers of an absent robot are 0, and an
    absent robot observes nothing but its last action and zeros. Values are clipped to
    [-limit, limit]. `Task.layout` gives the columns of each block.
    """

    field: str | Field
    """Field: a preset's name, a .json file or a `Field`."""
    robot: str | RobotModel
    """Robot model: a preset's name, a .json file or a `RobotModel`."""
    max_steps: int = 1200
    """Control steps of 25 ms until truncation, at least 1; 1200 are 30 s."""
    reward_weights: Mapping[str, float] | str = dataclass_field(default_factory=dict)
    """Weights by reward term that replace those of `REWARD_WEIGHTS`, or "paper"."""
    discrete: bool = False
    """True: agents choose from `DISCRETE_ACTIONS` instead of giving numbers."""
    engine: str = "compact"
    """Contact solver: "compact" or "rapier" (the reference, slower)."""

    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {}
    """Default weight of each reward term."""
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {}
    """Weights of the rSoccer paper (2021) in these terms: `reward_weights` "paper"."""
    OBSERVES_PRESENCE: ClassVar[bool] = False
    """Whether observations have the block `presence`: for tasks in which robots may be absent."""
    DISCRETE_ACTIONS: ClassVar[Floats]
    """(choices, action_size) actions that agents choose from with the option `discrete`."""
    ACTION_REFLECTION: ClassVar[Reflection]
    """(action_size,) reflection of an action."""

    def __post_init__(self) -> None:
        """Validate the options that both leagues share."""
        for each in fields(self):
            object.__setattr__(self, each.name, options.plain(getattr(self, each.name)))
        checks.integer("max_steps", self.max_steps, 1)
        weights = options.reward_weights(
            self.reward_weights, self.REWARD_WEIGHTS, self.PAPER_REWARD_WEIGHTS
        )
        object.__setattr__(self, "reward_weights", weights)
        checks.boolean("discrete", self.discrete)
        object.__setattr__(self, "field", options.model("field", self.field, Field))
        object.__setattr__(self, "robot", options.robot_models(self.robot))

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        """Compute the blocks of the class's table, each (n, observers, ...)."""
        # Not a dict, but with all of a dict's methods, so authors may treat it as one.
        return cast("dict[str, Floats]", EncodedBlocks(self._encode, play, self._flat_blocks))

    def observation_limits(self) -> dict[str, float]:
        """Return a copy of `OBSERVATION_LIMITS`."""
        return dict(OBSERVATION_LIMITS)

    @property
    def symmetry(self) -> Symmetry | None:
        """Return the reflections of actions and of the blocks of the class's table."""
        has_mouth = self.config.robot.has_mouth  # then heights and break beams are observed, too
        robot = Reflection.of([*ROBOT_SIGNS, 1] if has_mouth else ROBOT_SIGNS)
        ball = Reflection.of([1, -1, 1, 1, -1, 1] if has_mouth else [1, -1, 1, -1])
        robots = dict.fromkeys(("ego", "teammates", "opponents"), robot)
        action = self.action_reflection
        blocks = {"ball": ball, **robots, **REFLECTIONS, "action": action}
        if self.OBSERVES_PRESENCE:
            blocks["presence"] = Reflection.of([1] * sum((1, *self._other_slots)))
        return Symmetry(action, blocks)

    @property
    def action_table(self) -> Floats | None:
        """`DISCRETE_ACTIONS` with the option `discrete`, else None."""
        return self.DISCRETE_ACTIONS if self.discrete else None

    @property
    def action_reflection(self) -> Reflection:
        """Reflection of an action, (action_size,)."""
        return self.ACTION_REFLECTION

    @cached_property
    def term_weights(self) -> Mapping[str, np.float32]:
        """Weight of each reward term by name: `REWARD_WEIGHTS` and the option `reward_weights`."""
        given = self.reward_weights
        weights = self.PAPER_REWARD_WEIGHTS if isinstance(given, str) else given
        return {name: np.float32(weight) for name, weight in weights.items()}

    @cached_property
    def ego_features(self) -> EgoFeatures:
        """Encoder of the observation, in half field lengths and the robot's top speeds."""
        config = self.config
        return EgoFeatures(config.field, config.robot, *self._other_slots, self.OBSERVES_PRESENCE)

    @property
    def _other_slots(self) -> tuple[int, int]:
        """Numbers of teammate slots and of opponent slots."""
        return slot_counts(self.n_blue, self.n_yellow, self.sides)

    @cached_property
    def position_scale(self) -> np.float32:
        """Scale of positions in observations, per meter: the inverse of half the field's length."""
        return np.float32(1.0 / self.config.field.half_length)

    @cached_property
    def _flat_blocks(self) -> tuple[tuple[str, slice, tuple[int, ...]], ...]:
        """Name, columns and shape of each block of the core's features."""
        blocks, first = [], 0
        for name, shape in (*self.ego_features.blocks, ("action", (self.action_size,))):
            blocks.append((name, slice(first, first + math.prod(shape)), shape))
            first += math.prod(shape)
        return tuple(blocks)

    def _encode(self, play: Play, out: Floats, bounds: Floats | None) -> None:
        """Write the features of all observers to `out`, clipped to `bounds`."""
        blue, yellow = play.known_to(0), play.known_to(1)
        rotated = None if yellow is blue else yellow.rows
        self.ego_features.encode(
            play.viewpoint.core, blue.rows, play.actions, out, bounds, play.threads, rotated
        )

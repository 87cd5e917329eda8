"""Base class of hardware challenges 1 and 2: one robot attacks opponents in their half."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks, rewards, spawn
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.markers import Area, Marker
from rsoccer.reflection import Reflection, Symmetry, add_blocks
from rsoccer.rng import WorldRng
from rsoccer.task import LEARN, Learn, Play
from rsoccer.tasks.ssl import Ssl, ball_at_mouth
from rsoccer.vectors import TINY, norm

CENTER_LINE_TOLERANCE: Final = np.float32(0.2)
"""Distance that the attacker may go behind the center line, m."""
RANDOM_START_FRACTION: Final = 0.5
"""Fraction of the episodes that start with the ball, with the option `random_start`."""
RANDOM_START_CLEARANCE: Final = 0.15
"""Least distance of such a start to lines and opponents, m, so that the ball is free."""
NEARNESS_DISTANCE: Final = np.float32(0.25)
"""Gap between robots at which their nearness is 1/e, m: a robot brakes from 1.5 m/s within it."""


@dataclass(frozen=True)
class SslAttack(Ssl):
    """Base class of the tasks in which blue_0 attacks +x in the opponents' half.

    Goal of the task: score without leaving the opponents' half, entering their goal area or
    touching an opponent.

    Initial state: that of the subclass. With `random_start` the attacker starts half of the
    episodes at a random position in the half, with a random heading and the ball in its mouth.

    The observation has one block more than `Soccer`, "nearness" (o, 3), limit 1: exp(-g / 0.25 m)
    for each opponent at a gap g between the robots; the same times the direction to the opponent,
    x and y. A touch ends the episode, and positions alone teach a network little about it. A slot
    without a robot is 0.

    Reward terms, unweighted:

    ============  ==================================================================  ========
    Term          Meaning                                                             Unit
    ============  ==================================================================  ========
    goal          1 for a goal, -1 for one against                                    goals
    ball_to_goal  progress of the ball toward the attacked goal and away from the     m
                  own goal
    approach      decrease of the distance between the ball and the mouth             m
    failed        1 if the episode terminates without a goal, else 0                  episodes
    energy        negative mean magnitude of the action                               steps
    ============  ==================================================================  ========

    Termination: a goal; the ball leaves the opponents' half other than into the goal; the attacker
    leaves it by more than 0.2 m over the center line or over any other line, enters the goal area,
    or touches an opponent. Truncation: after `max_steps`.

    Metric: `goal_score`, 1 for a goal, -1 for one against, else 0.
    """

    random_start: bool = False
    """True: start with the ball in half of the episodes, which teaches shots before the way to
    the ball is known."""

    training_options = (*Ssl.training_options, "random_start")
    """Options that change how a policy learns, not how it plays."""
    half_only = True
    """The attacker must stay in the opponents' half and out of their goal area."""
    success = "goal_score"
    """Metric that measures the success of an episode."""
    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "goal": 10.0,
        "ball_to_goal": 1.0,
        "approach": 0.5,
        "failed": -1.0,
        "energy": 0.0005,
    }
    """Default weight of each reward term."""
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "goal": 5.0,
        "ball_to_goal": 1.11,  # the paper's scales: 0.9014 m and 5.0 m
        "approach": 0.2,
        "failed": 0.0,
        "energy": 0.0001,
    }
    """Weights of the rSoccer paper (2021) in these terms."""

    def __post_init__(self) -> None:
        """Validate the options."""
        checks.boolean("random_start", self.random_start)
        super().__post_init__()

    def default_controllers(self) -> dict[str, str | Learn]:
        """Return `LEARN` for blue_0 and "hold" for opponents: at rest with the dribbler on."""
        return dict.fromkeys(self.robots, "hold") | {"blue_0": LEARN}

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        """Compute the blocks of `Soccer` and the block "nearness" (n, observers, o, 3)."""
        return super().frame_to_observations(play) | {"nearness": self._nearness(play)}

    def observation_limits(self) -> dict[str, float]:
        """Return the bounds of `Soccer` and of the block "nearness"."""
        return {**super().observation_limits(), "nearness": 1.0}

    @property
    def symmetry(self) -> Symmetry | None:
        """Return the reflections of `Soccer` and of the block "nearness"."""
        return add_blocks(super().symmetry, nearness=Reflection.of([1, 1, -1]))

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Compute the reward terms of the class's table; a goal or a failure terminates."""
        goal = rewards.goal(play)
        failed = self._failed(play.frame) & (rewards.goal_score(play) <= 0.0)
        terms = {
            "goal": goal,
            "ball_to_goal": rewards.ball_to_goal(play, self.config.field),
            "approach": rewards.approach_mouth(play, self.config),
            "failed": rewards.of_blue(play, failed),
            "energy": rewards.energy(play),
        }
        return rewards.weighted_terms(terms, self.term_weights), failed | rewards.scored(play)

    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        """Return the opponents' half as an area."""
        field = self.config.field
        return (Area((0.0, -field.half_width), (field.half_length, field.half_width)),)

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Compute `goal_score`, (n,): 1 for a goal, -1 for one against, else 0."""
        return {"goal_score": rewards.goal_score(play)}

    def _place_with_ball(self, frame: Frame, rng: WorldRng) -> None:
        """Write the initial state of `random_start` into a frame with all opponents, in place."""
        moved = rng.uniform(0.0, 1.0) < RANDOM_START_FRACTION
        field, radius = self.config.field, self.config.robot.bounding_radius
        gap = np.float32(2.0 * radius + RANDOM_START_CLEARANCE)

        def forbidden(positions: Floats) -> Mask:
            offset = positions - frame.yellow.position  # (n, 1, 2) and (n, opponents, 2)
            near = norm(offset[..., 0], offset[..., 1]).min(axis=1, initial=np.inf) < gap
            in_area = self.is_in_goal_area(positions, radius + RANDOM_START_CLEARANCE)
            rejected: Mask = near[:, None] | in_area
            return rejected

        margin = radius + RANDOM_START_CLEARANCE
        low = (margin, margin - field.half_width)
        high = (field.half_length - margin, field.half_width - margin)
        position = spawn.positions_in_box(rng, (low, high), [radius], 0.0, forbidden)
        heading = spawn.headings(rng, 1)
        frame.blue.position[moved] = position[moved]
        frame.blue.heading[moved] = heading[moved]
        frame.ball.position[moved] = ball_at_mouth(frame, 0, self.mouth_offset)[moved]

    def _nearness(self, play: Play) -> Floats:
        """Block "nearness" (n, observers, o, 3)."""
        view = play.sensed_view
        offset = view.opponents.position - view.ego.position[..., None, :]  # (n, observers, o, 2)
        distance = norm(offset[..., 0], offset[..., 1])
        gap = np.maximum(distance - self._contact_distance, 0.0)
        near = np.exp(-gap / NEARNESS_DISTANCE)
        opponents = np.where(play.observers < self.n_blue, self.n_yellow, self.n_blue)
        near *= np.arange(near.shape[-1]) < opponents[:, None]  # other slots are empty
        direction = offset / np.maximum(distance, TINY)[..., None]
        block: Floats = np.concatenate([near[..., None], near[..., None] * direction], axis=-1)
        return block

    @cached_property
    def _contact_distance(self) -> np.float32:
        """Distance between the centers of two robots that touch, m."""
        return np.float32(2.0 * self.config.robot.bounding_radius)

    def _failed(self, frame: Frame) -> Mask:
        """(n,) whether ball or attacker left its area or the attacker committed a foul."""
        return self._ball_left(frame) | self._attacker_left(frame) | self._has_fouled(frame)

    def _ball_left(self, frame: Frame) -> Mask:
        """(n,) whether the ball is outside the opponents' half; the inside of the goal counts."""
        ball = frame.ball.position
        return np.logical_or(ball[:, 0] < 0.0, self.is_off_field(ball))

    def _attacker_left(self, frame: Frame) -> Mask:
        """(n,) whether the attacker is outside the opponents' half or in their goal area."""
        position = frame.blue.position[:, 0]
        outside = self.is_off_field(position) | self.is_in_goal_area(position)
        return np.logical_or(position[:, 0] < -CENTER_LINE_TOLERANCE, outside)

    def _has_fouled(self, frame: Frame) -> Mask:
        """(n,) whether the attacker touched an opponent in the last step."""
        return np.greater(frame.blue.touched_opponent[:, 0], 0.5)

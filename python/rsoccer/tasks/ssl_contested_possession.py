"""`SSLContestedPossession-v0`: take the ball from an opponent. Hardware challenge 2."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer import checks, spawn
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from rsoccer.tasks import scenarios
from rsoccer.tasks.ssl import ball_at_mouth
from rsoccer.tasks.ssl_attack import SslAttack

MAX_FOUL_SPEED: Final = 10.0
"""Greatest `foul_speed`, m/s: above that of two robots at their top speeds."""
MIN_OPPONENT_X: Final = 0.5
"""Least x of the opponent in random initial states, m; the attacker starts at 0."""


@dataclass(frozen=True)
class SslContestedPossession(SslAttack):
    """SSL attack in which blue_0 must take the ball from the dribbler of an opponent at rest.

    Goal of the task, reward terms, termination and metrics are those of `SslAttack`, except that
    contact with the opponent terminates only above a closing speed of 0.5 m/s (`foul_speed`),
    because taking a ball from a dribbler needs contact.

    Initial state: blue_0 at the center, facing the goal; an opponent at a random position in its
    half, outside its goal area, with a random heading and the ball in its mouth. With `scenario`,
    the poses of an official scenario. The opponent keeps its position with the dribbler on. With
    `random_start` half of the episodes start with blue_0 at a random position in the opponent's
    half, and the ball in its mouth.

    Source: SSL hardware challenges 2021, challenge 2, and the rSoccer paper (2021).
    """

    scenario: int | None = None
    """Official scenario, 1 to 5; None for random initial states."""
    strict_contact: bool = False
    """True: any contact with the opponent terminates, the rule of the rSoccer paper."""
    foul_speed: float = 0.5
    """Closing speed above which contact with the opponent terminates, m/s; a policy that learns
    with a lower one keeps a margin for robots that brake otherwise."""

    training_options = (*SslAttack.training_options, "foul_speed")
    """Options that change how a policy learns, not how it plays."""

    def __post_init__(self) -> None:
        """Validate the options."""
        if self.scenario is not None:
            checks.integer_in_range("scenario", self.scenario, 1, scenarios.N_CONTESTED_POSSESSION)
        checks.boolean("strict_contact", self.strict_contact)
        checks.number_in_range("foul_speed", self.foul_speed, 0.0, MAX_FOUL_SPEED)
        super().__post_init__()

    def team_sizes(self) -> tuple[int, int]:
        """Return one attacker and one opponent."""
        return 1, 1

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Place the attacker and the opponent, at random or by scenario, and the ball."""
        frame = Frame.empty(len(rng), 1, 1)
        if self.scenario is not None:
            opponent, attacker = scenarios.contested_possession(self.scenario)
            _set_pose(frame.yellow.position, frame.yellow.heading, opponent)
            _set_pose(frame.blue.position, frame.blue.heading, attacker)
        else:
            frame.yellow.heading[:] = spawn.headings(rng, 1)
            frame.yellow.position[:] = self._opponent_positions(rng)
        frame.ball.position[:] = ball_at_mouth(frame, 1, self.mouth_offset)
        if self.random_start:
            self._place_with_ball(frame, rng)
        return frame

    def _has_fouled(self, frame: Frame) -> Mask:
        """(n,) whether the attacker hit the opponent too hard, or at all if `strict_contact`."""
        if self.strict_contact:
            return super()._has_fouled(frame)
        return np.greater(frame.blue.collision_speed[:, 0], np.float32(self.foul_speed))

    def _opponent_positions(self, rng: WorldRng) -> Floats:
        """Random positions (n, 1, 2) with enough margin that the ball is inside too."""
        field = self.config.field
        margin = float(self.mouth_offset) + 2.0 * self.config.ball.radius
        low = (MIN_OPPONENT_X, margin - field.half_width)
        high = (field.half_length, field.half_width - margin)

        def forbidden(positions: Floats) -> Mask:
            beyond = positions[..., 0] > np.float32(field.half_length - margin)
            return np.logical_or(self.is_in_goal_area(positions, margin), beyond)

        radii = [self.config.robot.bounding_radius]
        return spawn.positions_in_box(rng, (low, high), radii, 0.0, forbidden)


def _set_pose(position: Floats, heading: Floats, pose: Array) -> None:
    """Write one pose (3,) into positions and headings (n, 1, 2)."""
    position[:] = pose[:2]
    heading[:] = [np.cos(pose[2]), np.sin(pose[2])]

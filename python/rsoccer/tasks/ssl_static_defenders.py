"""`SSLStaticDefenders-v0`: score past opponents at rest. Hardware challenge 1."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer import checks, spawn
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from rsoccer.tasks import scenarios
from rsoccer.tasks.ssl_attack import SslAttack

MIN_START_DISTANCE: Final = 0.25
"""Least distance between centers in the initial state, m."""
ATTACKER_CLEARANCE: Final = 0.3
"""Least distance from the attacker's initial position to ball and opponents, m."""
BALL_START_X: Final = 0.15
"""Least x of ball and opponents in the initial state, m."""
MAX_OPPONENTS: Final = 6
MAX_SHIFT: Final = 0.15
"""Greatest shift of the ball, and of the opponents together, with `scenario_fraction`, m."""
WAITING_SPACING: Final = 0.25
"""Distance between opponents that do not take part, m."""


@dataclass(frozen=True)
class SslStaticDefenders(SslAttack):
    """SSL attack by blue_0 against up to six opponents that do not move.

    Goal of the task, reward terms, termination and metrics are those of `SslAttack`.

    Initial state: blue_0 at the center, facing the goal; the ball and the opponents at random
    positions in the opponents' half, outside their goal area, opponents with random headings. With
    `scenario`, the ball and the opponents of an official scenario, one of them in the goal area.
    The opponents keep their positions with the dribbler on. With `random_start` half of the
    episodes start with blue_0 at a random position there, and the ball in its mouth.

    Scenarios have 3 to 6 opponents, but as many robots as random initial states with 6, so that one
    policy plays them all: the others wait along the attacker's own goal line.

    Source: SSL hardware challenges 2021, challenge 1, and the rSoccer paper (2021).
    """

    scenario: int | None = None
    """Official scenario, 1 to 10; None for random initial states."""
    n_opponents: int = MAX_OPPONENTS
    """Opponents in random initial states, 0 to 6; must be 6 with scenarios."""
    scenario_fraction: float = 0.0
    """Fraction of the random initial states, 0 to 1, that are near an official scenario: any of
    them, mirrored or not, ball and opponents shifted by up to 0.15 m, by little more often than by
    much. For training."""

    training_options = (*SslAttack.training_options, "scenario_fraction")
    """Options that change how a policy learns, not how it plays."""

    def __post_init__(self) -> None:
        """Validate the options."""
        checks.integer_in_range("n_opponents", self.n_opponents, 0, MAX_OPPONENTS)
        if self.scenario is not None:
            checks.integer_in_range("scenario", self.scenario, 1, scenarios.N_STATIC_DEFENDERS)
        checks.number_in_range("scenario_fraction", self.scenario_fraction, 0.0, 1.0)
        uses_scenarios = self.scenario is not None or self.scenario_fraction > 0.0
        if uses_scenarios and self.n_opponents != MAX_OPPONENTS:
            raise ValueError(
                f"n_opponents: expected {MAX_OPPONENTS} with scenarios, got {self.n_opponents}"
            )
        super().__post_init__()

    def team_sizes(self) -> tuple[int, int]:
        """Return one attacker, and the number of opponents of the option."""
        return 1, self.n_opponents

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Place the attacker at the center; ball and opponents at random or by scenario."""
        if self.scenario is not None:
            frame = self._scenario_frame(self.scenario, len(rng))
        else:
            frame = Frame.empty(len(rng), *self.team_sizes())
            self._place_at_random(frame, rng)
            if self.scenario_fraction > 0.0:
                self._place_near_scenarios(frame, rng)
        if self.random_start:
            self._place_with_ball(frame, rng)
        return frame

    def _place_at_random(self, frame: Frame, rng: WorldRng) -> None:
        """Write random positions of ball and opponents into a frame, in place."""
        field, radius = self.config.field, self.config.robot.bounding_radius
        low = (BALL_START_X, -field.half_width + radius)
        high = (field.half_length, field.half_width - radius)
        radii = [self.config.ball.radius] + [radius] * self.n_opponents
        positions = spawn.positions_in_box(
            rng, (low, high), radii, MIN_START_DISTANCE, self._forbidden
        )
        frame.ball.position[:] = positions[:, 0]
        frame.yellow.position[:] = positions[:, 1:]
        frame.yellow.heading[:] = spawn.headings(rng, self.n_opponents)

    def _scenario_frame(self, scenario: int, n: int) -> Frame:
        """Frame of n worlds with an official scenario; opponents that it lacks wait."""
        frame = Frame.empty(n, *self.team_sizes())
        ball, opponents = scenarios.static_defenders(scenario)
        count = len(opponents)
        frame.ball.position[:] = ball
        frame.yellow.position[:, :count] = opponents[:, :2]
        frame.yellow.heading[:, :count, 0] = np.cos(opponents[:, 2])
        frame.yellow.heading[:, :count, 1] = np.sin(opponents[:, 2])
        field, radius = self.config.field, self.config.robot.bounding_radius
        waiting = np.arange(MAX_OPPONENTS - count)
        frame.yellow.position[:, count:, 0] = radius - field.half_length
        frame.yellow.position[:, count:, 1] = radius - field.half_width + WAITING_SPACING * waiting
        return frame

    def _place_near_scenarios(self, frame: Frame, rng: WorldRng) -> None:
        """Write states near official scenarios into a fraction of a frame, in place."""
        chosen = rng.uniform(0.0, 1.0) < self.scenario_fraction
        scenario = np.floor(rng.uniform(0.0, scenarios.N_STATIC_DEFENDERS)).astype(np.int64)
        mirror = np.where(rng.uniform(0.0, 1.0) < 0.5, np.float32(-1.0), np.float32(1.0))
        # A random scale makes states close to the official ones frequent.
        scale = rng.uniform(0.0, 1.0)[:, None]
        ball_shift = scale * rng.uniform(-MAX_SHIFT, MAX_SHIFT, (2,))
        shift = scale * rng.uniform(-MAX_SHIFT, MAX_SHIFT, (2,))
        shift[:, 0] = -np.abs(shift[:, 0])  # a goalkeeper has no space behind it
        field = self.config.field
        low = np.array([BALL_START_X, MAX_SHIFT - field.half_width], np.float32)
        high = np.array([field.half_length, field.half_width], np.float32) - np.float32(MAX_SHIFT)
        for index in range(scenarios.N_STATIC_DEFENDERS):
            worlds = np.flatnonzero(chosen & (scenario == index))
            part = self._scenario_frame(index + 1, len(worlds))
            takes_part = part.yellow.position[..., :1] > 0.0
            part.yellow.position[:] += shift[worlds, None] * takes_part
            part.ball.position[:] = np.clip(part.ball.position + ball_shift[worlds], low, high)
            sign = mirror[worlds]
            part.ball.position[:, 1] *= sign
            part.yellow.position[..., 1] *= sign[:, None]
            part.yellow.heading[..., 1] *= sign[:, None]
            frame.rows[worlds] = part.rows

    def _forbidden(self, positions: Floats) -> Mask:
        """(n, discs) whether a robot would touch the goal area, the goal line or the attacker."""
        field, radius = self.config.field, np.float32(self.config.robot.bounding_radius)
        x, y = positions[..., 0], positions[..., 1]
        in_area = self.is_in_goal_area(positions, radius)
        beyond = x > np.float32(field.half_length) - radius
        at_attacker = np.less(x * x + y * y, np.float32(ATTACKER_CLEARANCE**2))
        forbidden: Mask = in_area | beyond | at_attacker
        return forbidden

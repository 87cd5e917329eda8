"""`SSLStaticDefenders-v0`: score past opponents at rest. Hardware challenge 1."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks, spawn
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from rsoccer.tasks import scenarios
from rsoccer.tasks.ssl_attack import SslAttack

MIN_START_DISTANCE: Final = 0.25
"""Least distance between centres in the initial state, m."""
ATTACKER_CLEARANCE: Final = 0.3
"""Least distance from the attacker's initial position to ball and opponents, m."""
BALL_START_X: Final = 0.15
"""Least x of ball and opponents in the initial state, m."""
MAX_OPPONENTS: Final = 6
VARIED_FRACTION: Final = 0.5
"""Fraction of the episodes with fewer opponents or a goalkeeper, with `varied_opponents`."""
KEEPER_X: Final = 0.1
"""Distance of a goalkeeper from the goal line, m: that of the official scenarios."""
KEEPER_Y: Final = 0.3
"""Greatest distance of a goalkeeper from the centre of the goal, m: that of the scenarios."""
WAITING_SPACING: Final = 0.25
"""Distance between opponents that do not take part, m."""


@dataclass(frozen=True)
class SslStaticDefenders(SslAttack):
    """SSL attack by blue_0 against up to six opponents that do not move.

    Goal of the task, reward terms, termination and metrics are those of `SslAttack`.

    Initial state: blue_0 at the centre, facing the goal; the ball and the opponents at random
    positions in the opponents' half, outside their goal area, opponents with random headings. With
    `scenario`, the ball and the opponents of an official scenario, one of them perhaps in the goal
    area. The opponents keep their positions with the dribbler on. With `random_start` half
    of the episodes start with blue_0 at a random position there, and the ball in its mouth.

    Source: SSL hardware challenges 2021, challenge 1, and the rSoccer paper (2021).
    """

    scenario: int | None = None
    """Official scenario, 1 to 10; None for random initial states."""
    n_opponents: int = MAX_OPPONENTS
    """Opponents in random initial states, 0 to 6; a scenario has its own number."""
    varied_opponents: bool = False
    """True: half of the random initial states have 0 to `n_opponents` opponents, the others
    waiting, and half of those with any have a goalkeeper. So a policy learns for any number."""

    def __post_init__(self) -> None:
        """Validate the options."""
        checks.integer_in_range("n_opponents", self.n_opponents, 0, MAX_OPPONENTS)
        if self.scenario is not None:
            checks.integer_in_range("scenario", self.scenario, 1, scenarios.N_STATIC_DEFENDERS)
        checks.boolean("varied_opponents", self.varied_opponents)
        super().__post_init__()

    def team_sizes(self) -> tuple[int, int]:
        """Return one attacker, and the number of opponents of the option, 6 in a scenario."""
        return 1, self.n_opponents if self.scenario is None else MAX_OPPONENTS

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Place the attacker at the centre; ball and opponents at random or by scenario."""
        frame = Frame.empty(len(rng), *self.team_sizes())
        if self.scenario is not None:
            ball, opponents = scenarios.static_defenders(self.scenario)
            count = len(opponents)
            frame.ball.position[:] = ball
            frame.yellow.position[:, :count] = opponents[:, :2]
            frame.yellow.heading[:, :count, 0] = np.cos(opponents[:, 2])
            frame.yellow.heading[:, :count, 1] = np.sin(opponents[:, 2])
            frame.yellow.heading[:, count:] = (1.0, 0.0)
            self._let_wait(frame, np.full(len(frame), count))
        else:
            self._place_at_random(frame, rng)
            if self.varied_opponents:
                self._vary(frame, rng)
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

    def _vary(self, frame: Frame, rng: WorldRng) -> None:
        """Write other numbers of opponents, and goalkeepers, into half of the worlds, in place."""
        if not self.n_opponents:
            return
        varied = rng.uniform(0.0, 1.0) < VARIED_FRACTION
        count = np.floor(rng.uniform(0.0, self.n_opponents + 1.0)).astype(np.int64)
        has_keeper = varied & (rng.uniform(0.0, 1.0) < 0.5)  # the first one; it may wait, too
        keeper_y = rng.uniform(-KEEPER_Y, KEEPER_Y)
        frame.yellow.position[has_keeper, 0, 0] = self.config.field.half_length - KEEPER_X
        frame.yellow.position[has_keeper, 0, 1] = keeper_y[has_keeper]
        self._let_wait(frame, np.where(varied, count, self.n_opponents))

    def _let_wait(self, frame: Frame, count: NDArray[np.int64]) -> None:
        """Write the positions of the opponents from `count` (n,) on into a frame, in place.

        They stand along the attacker's own goal line, from a corner on.
        """
        field, radius = self.config.field, self.config.robot.bounding_radius
        index = np.arange(frame.n_yellow)
        places = np.empty((len(index), 2), np.float32)
        places[:, 0] = radius - field.half_length
        places[:, 1] = radius - field.half_width + WAITING_SPACING * index
        waits = index >= count[:, None]
        frame.yellow.position[:] = np.where(waits[..., None], places, frame.yellow.position)

    def _forbidden(self, positions: Floats) -> Mask:
        """(n, discs) whether a robot would touch the goal area, the goal line or the attacker."""
        field, radius = self.config.field, np.float32(self.config.robot.bounding_radius)
        x, y = positions[..., 0], positions[..., 1]
        in_area = self.is_in_goal_area(positions, radius)
        beyond = x > np.float32(field.half_length) - radius
        at_attacker = np.less(x * x + y * y, np.float32(ATTACKER_CLEARANCE**2))
        forbidden: Mask = in_area | beyond | at_attacker
        return forbidden

"""`SSLStaticDefenders-v0`: score past robots that do not move. Hardware challenge 1."""

from dataclasses import dataclass

import numpy as np

from rsoccer import checks, spawn
from rsoccer.frame import Floats, Frame, Mask
from rsoccer.rng import WorldRng
from rsoccer.tasks import scenarios
from rsoccer.tasks.ssl_attack import SslAttack

APART = 0.25  # metres between centres at the start
CLEAR = 0.3  # metres that the opponents keep from the attacker's start
MAX_OPPONENTS = 6


@dataclass(frozen=True)
class SslStaticDefenders(SslAttack):
    """Six opponents and the ball lie anywhere in the opponents' half, outside the area.

    `scenario` is one of the ten official ones instead, with opponents of its own, one perhaps in the
    goal.
    """

    scenario: int | None = None
    n_opponents: int = MAX_OPPONENTS

    def __post_init__(self) -> None:
        """Refuse options that make no task, by name."""
        checks.within("n_opponents", self.n_opponents, 0, MAX_OPPONENTS)
        if self.scenario is not None:
            checks.within("scenario", self.scenario, 1, scenarios.STATIC_SCENARIOS)
        super().__post_init__()

    def team_sizes(self) -> tuple[int, int]:
        """One against six, or against those of the scenario."""
        if self.scenario is None:
            return 1, self.n_opponents
        return 1, len(scenarios.static_defenders(self.scenario)[1])

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """The attacker at the centre, facing the goal; the rest at random or by scenario."""
        frame = Frame.empty(len(rng), *self.team_sizes())
        if self.scenario is not None:
            ball, opponents = scenarios.static_defenders(self.scenario)
            frame.ball.position[:] = ball
            frame.yellow.position[:] = opponents[:, :2]
            frame.yellow.heading[..., 0] = np.cos(opponents[:, 2])
            frame.yellow.heading[..., 1] = np.sin(opponents[:, 2])
            return frame
        field, radius = self.config.field, self.config.robot.bounding_radius
        box = ((0.15, -field.half_width + radius), (field.half_length, field.half_width - radius))
        radii = [self.config.ball.radius] + [radius] * self.n_opponents
        places = spawn.inside(rng, box, radii, APART, self._forbidden)
        frame.ball.position[:] = places[:, 0]
        frame.yellow.position[:] = places[:, 1:]
        frame.yellow.heading[:] = spawn.headings(rng, self.n_opponents)
        return frame

    def _forbidden(self, places: Floats) -> Mask:
        """(n, things) in or at the area before the goal, beyond the line, or on the attacker."""
        field, radius = self.config.field, np.float32(self.config.robot.bounding_radius)
        x, y = places[..., 0], np.abs(places[..., 1])
        area_x = np.float32(field.half_length - field.goal_area_depth) - radius
        in_area = (x > area_x) & (y < np.float32(field.goal_area_width / 2) + radius)
        beyond = x > np.float32(field.half_length) - radius
        near = np.less(x * x + y * y, np.float32(CLEAR * CLEAR))
        forbidden: Mask = in_area | beyond | near
        return forbidden

"""`SSLContestedPossession-v0`: win the ball off a robot that holds it. Hardware challenge 2."""

from dataclasses import dataclass

import numpy as np

from rsoccer import checks, spawn
from rsoccer.frame import Array, Floats, Frame, Mask
from rsoccer.rng import WorldRng
from rsoccer.tasks import scenarios
from rsoccer.tasks.ssl import ball_at_mouth
from rsoccer.tasks.ssl_attack import SslAttack

CRASH: np.float32 = np.float32(0.5)
"""m/s, closing speed from which contact with the opponent ends it."""
CLEAR = 0.5  # metres that the opponent keeps from the attacker's start


@dataclass(frozen=True)
class SslContestedPossession(SslAttack):
    """An opponent anywhere in its half holds the ball on its dribbler and stands.

    Winning a ball off a dribbler takes touch, so contact ends it only above 0.5 m/s;
    `strict_contact` is the paper's rule: any contact ends it. `scenario` is one of the five
    official ones.
    """

    scenario: int | None = None
    strict_contact: bool = False

    def __post_init__(self) -> None:
        """Refuse options that make no task, by name."""
        if self.scenario is not None:
            checks.within("scenario", self.scenario, 1, scenarios.CONTESTED_SCENARIOS)
        checks.flag("strict_contact", self.strict_contact)
        super().__post_init__()

    def team_sizes(self) -> tuple[int, int]:
        """One against one."""
        return 1, 1

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """The ball in the opponent's mouth; the attacker at the centre, or opposite by scenario."""
        frame = Frame.empty(len(rng), 1, 1)
        if self.scenario is not None:
            opponent, attacker = scenarios.contested_possession(self.scenario)
            _pose(frame.yellow.position, frame.yellow.heading, opponent)
            _pose(frame.blue.position, frame.blue.heading, attacker)
        else:
            frame.yellow.heading[:] = spawn.headings(rng, 1)
            frame.yellow.position[:] = self._places(rng)
        frame.ball.position[:] = ball_at_mouth(frame, 1, self.reach)
        return frame

    def fouled(self, frame: Frame) -> Mask:
        """(n,) the attacker has touched the opponent, too hard unless `strict_contact`."""
        if self.strict_contact:
            return super().fouled(frame)
        return np.greater(frame.blue.crash_speed[:, 0], CRASH)

    def _places(self, rng: WorldRng) -> Floats:
        """Where the opponent stands, (n, 1, 2): so far inside that the ball is inside too."""
        field = self.config.field
        margin = float(self.reach) + 2.0 * self.config.ball.radius
        box = ((CLEAR, margin - field.half_width), (field.half_length, field.half_width - margin))

        def forbidden(places: Floats) -> Mask:
            x, y = places[..., 0], np.abs(places[..., 1])
            area_x = np.float32(field.half_length - field.goal_area_depth - margin)
            in_area = (x > area_x) & (y < np.float32(field.goal_area_width / 2 + margin))
            return np.logical_or(in_area, x > np.float32(field.half_length - margin))

        return spawn.inside(rng, box, [self.config.robot.bounding_radius], 0.0, forbidden)


def _pose(position: Floats, heading: Floats, pose: Array) -> None:
    """Write one pose (3,) into positions and headings (n, 1, 2)."""
    position[:] = pose[:2]
    heading[:] = [np.cos(pose[2]), np.sin(pose[2])]

"""`SSLSelfPlay-v0`: two sides of SSL robots, without a referee."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Final

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks, rewards, spawn
from rsoccer.frame import BallColumns, Floats, Frame, Mask
from rsoccer.rng import WorldRng
from rsoccer.task import Play
from rsoccer.tasks.ssl import Ssl

APART: Final = 0.3  # metres between centres at the start
INSIDE: Final = 0.2  # metres inside the line at which a ball that left is put back: SSL rules
SHIFT: Final = 0.05  # metres between the places that are tried
TRIES: Final = 60  # places along the line, before any others


@dataclass(frozen=True)
class SslSelfPlay(Ssl):
    """All robots learn. A goal ends a match; a ball that leaves the field is put back.

    It is put back 0.2 m inside of where it left, at the nearest place along the line where no
    robot is, or the nearest anywhere; everything else goes on.
    """

    n_blue: int = 3
    n_yellow: int = 3

    success = "goal_score"

    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "goal": 10.0,
        "ball_to_goal": 2.0,
        "approach": 0.5,
        "energy": 0.0002,
    }
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = (
        REWARD_WEIGHTS  # the paper has no such task
    )

    def __post_init__(self) -> None:
        """Refuse options that make no task, by name."""
        checks.whole("n_blue", self.n_blue, 1)
        checks.whole("n_yellow", self.n_yellow, 0)
        super().__post_init__()

    def team_sizes(self) -> tuple[int, int]:
        """As the options say."""
        return self.n_blue, self.n_yellow

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Ball and robots anywhere, apart; robots face anywhere."""
        return spawn.anywhere(rng, self.config, APART)

    def reposition_ball(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
        """The ball at rest inside the line that it crossed, where no robot is."""
        crossed = frame.ball.crossed
        worlds = np.flatnonzero((crossed != 0.0) & (rewards.goals_at(frame.ball) == 0.0))
        if not len(worlds):
            return None
        ball = BallColumns(np.zeros_like(frame.ball.data[worlds]))
        left_at, robots = frame.ball.crossed_at[worlds], frame.robots.position[worlds]
        ball.position[:] = self._free_places(left_at, robots)
        return worlds, ball.data

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """A goal counts most; who is nearest is paid for getting to the ball and for moving it."""
        terms = {
            "goal": rewards.goal(play),
            "ball_to_goal": rewards.ball_to_goal(play, self.config.field) * rewards.nearest(play),
            "approach": rewards.to_mouth(play, self.config) * rewards.nearest(play),
            "energy": rewards.energy(play),
        }
        return rewards.weighted(terms, self.reward_weights), rewards.scored(play)

    def metrics(self, play: Play) -> dict[str, Floats]:
        """`goal_score`: +1 if blue has scored, -1 if yellow has, else 0."""
        return {"goal_score": rewards.goals_at(play.frame.ball)}

    def _free_places(self, left_at: Floats, robots: Floats) -> Floats:
        """Nearest places (k, 2) to where balls left (k, 2), clear of robots (k, robots, 2)."""
        tried = self._along_line(left_at)
        free = self._clear(tried, robots)
        places: Floats = tried[np.arange(len(tried)), np.argmax(free, axis=1)]  # the first
        for full in np.flatnonzero(~free.any(axis=1)):
            places[full] = self._free_place(left_at[full], robots[full])
        return places

    def _along_line(self, left_at: Floats) -> Floats:
        """(k, tries, 2) places along the line that was crossed, from the nearest on, to both sides.

        Of two as near the one towards the middle is first, which is the same for both teams.
        """
        steps = np.arange(TRIES) // 2 + np.arange(TRIES) % 2
        shifts = (np.where(np.arange(TRIES) % 2, -1, 1) * steps).astype(np.float32)
        along_x = np.abs(left_at[:, 1]) > np.float32(self.config.field.half_width - 1e-3)
        outward = np.copysign(np.float32(SHIFT), left_at)[:, None] * shifts[None, :, None]
        axis = np.stack([along_x, ~along_x], axis=-1)[:, None]
        return self._within(left_at[:, None] + np.where(axis, outward, np.float32(0.0)))

    def _free_place(self, left_at: Floats, robots: Floats) -> Floats:
        """(2,) the place nearest to where a ball left (2,) that is clear of robots (robots, 2).

        The field has more places than all robots together can cover.
        """
        # From the corner nearest to it on: of two as near the same one is first for both teams.
        places = self._lattice * np.copysign(np.float32(1.0), left_at)
        way = places - self._within(left_at)
        away = way[:, 0] * way[:, 0] + way[:, 1] * way[:, 1]
        away[~self._clear(places[None], robots[None])[0]] = np.inf
        place: Floats = places[np.argmin(away)]
        return place

    def _clear(self, places: Floats, robots: Floats) -> Mask:
        """(k, places) which of places (k, places, 2) are clear of robots (k, robots, 2)."""
        clear = np.float32(self.config.robot.bounding_radius + 2.0 * self.config.ball.radius)
        way = places[:, :, None] - robots[:, None]
        near = way[..., 0] * way[..., 0] + way[..., 1] * way[..., 1] < clear * clear
        free: Mask = np.logical_not(near.any(axis=2))
        return free

    def _within(self, places: Floats) -> Floats:
        """Places (..., 2) moved inside the field's lines, by as much as the rules want."""
        inside: Floats = np.minimum(np.maximum(places, -self._most), self._most)
        return inside

    @cached_property
    def _most(self) -> Floats:
        """(2,) the farthest from the centre that a ball is put back."""
        return self._corner - np.float32(INSIDE)

    @cached_property
    def _lattice(self) -> Floats:
        """(places, 2) all over the field, the same seen from either side."""
        x, y = (np.arange(int(most / SHIFT), -int(most / SHIFT) - 1, -1) for most in self._most)
        columns = np.repeat(x, len(y)), np.tile(y, len(x))
        return np.stack(columns, axis=-1).astype(np.float32) * np.float32(SHIFT)

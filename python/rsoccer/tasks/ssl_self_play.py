"""`SSLSelfPlay-v0`: two sides of SSL robots, without a referee."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks, rewards, spawn
from rsoccer.frame import Floats, Frame, Mask
from rsoccer.rng import WorldRng
from rsoccer.task import Play
from rsoccer.tasks.ssl import Ssl

APART: Final = 0.3  # metres between centres at the start
INSIDE: Final = 0.2  # metres inside the line at which a ball that left is put back: SSL rules
SHIFT: Final = 0.05  # metres between the places that are tried
TRIES: Final = 60  # places along the line, enough to get past all robots


@dataclass(frozen=True)
class SslSelfPlay(Ssl):
    """All robots learn. A goal ends a match; a ball that leaves the field is put back.

    It is put back 0.2 m inside of where it left, at the nearest place where no robot is.
    """

    blue: int = 3
    yellow: int = 3

    WEIGHTS: ClassVar[Mapping[str, float]] = {
        "goal": 10.0,
        "ball_to_goal": 2.0,
        "approach": 0.5,
        "energy": 0.0002,
    }
    PAPER_WEIGHTS: ClassVar[Mapping[str, float]] = WEIGHTS  # the paper has no such task

    def __post_init__(self) -> None:
        """Refuse options that make no task, by name."""
        checks.whole("blue", self.blue, 1)
        checks.whole("yellow", self.yellow, 0)
        super().__post_init__()

    def team_sizes(self) -> tuple[int, int]:
        """As the options say."""
        return self.blue, self.yellow

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Ball and robots anywhere, apart; robots face anywhere."""
        return spawn.anywhere(rng, self.config, APART)

    def put_back(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
        """The ball at rest inside the line that it crossed, where no robot is."""
        crossed = frame.ball.crossed
        worlds = np.flatnonzero((crossed != 0.0) & (rewards.goals_at(frame.ball) == 0.0))
        if not len(worlds):
            return None
        rows = frame.rows[worlds].copy()
        part = Frame(rows, frame.n_blue, frame.n_yellow)
        part.ball.data[:, :] = 0.0
        part.ball.last_touch[:] = -1.0
        part.ball.position[:] = self._free_places(
            frame.ball.crossed_at[worlds], part.robots.position
        )
        return worlds, rows

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """A goal counts most; who is nearest is paid for getting to the ball and for moving it."""
        terms = {
            "goal": rewards.goal(play),
            "ball_to_goal": rewards.ball_to_goal(play, self.config.field) * rewards.nearest(play),
            "approach": rewards.to_mouth(play, self.config) * rewards.nearest(play),
            "energy": rewards.energy(play),
        }
        return rewards.weighted(terms, self.weights), rewards.scored(play)

    def metrics(self, play: Play) -> dict[str, Floats]:
        """`goal_score`: +1 if blue has scored, -1 if yellow has, else 0."""
        return {"goal_score": rewards.goals_at(play.frame.ball)}

    def _free_places(self, left_at: Floats, robots: Floats) -> Floats:
        """Nearest places (k, 2) to where balls left (k, 2), clear of robots (k, robots, 2)."""
        field, config = self.config.field, self.config
        most = np.array([field.half_length - INSIDE, field.half_width - INSIDE], np.float32)
        # Tried from the nearest on, to both sides along the line that was crossed: of two as near
        # first towards the middle, which is the same for both teams.
        steps = np.arange(TRIES) // 2 + np.arange(TRIES) % 2
        shifts = (np.where(np.arange(TRIES) % 2, -1, 1) * steps).astype(np.float32)
        along_x = np.abs(left_at[:, 1]) > np.float32(field.half_width - 1e-3)
        outward = np.copysign(np.float32(SHIFT), left_at)[:, None] * shifts[None, :, None]
        axis = np.stack([along_x, ~along_x], axis=-1)[:, None]
        tried = left_at[:, None] + np.where(axis, outward, np.float32(0.0))
        tried = np.minimum(np.maximum(tried, -most), most)  # (k, tries, 2)
        clear = np.float32(config.robot.bounding_radius + 2.0 * config.ball.radius)
        way = tried[:, :, None] - robots[:, None]
        near = way[..., 0] * way[..., 0] + way[..., 1] * way[..., 1] < clear * clear
        best = np.argmin(near.any(axis=2), axis=1)  # the first that is free
        places: Floats = tried[np.arange(len(tried)), best]
        return places

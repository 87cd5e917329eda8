"""Base class of the passing tasks: two robots that pass, opponents, and the test for a miss."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from rsoccer import checks, spawn
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame, robot_names
from rsoccer.game import BLUE, YELLOW
from rsoccer.markers import Marker, Segment, Target
from rsoccer.rng import WorldRng
from rsoccer.rules import Crossings, Possession, Rule
from rsoccer.rules.passes import REACH, STOPPED_SPEED
from rsoccer.task import LEARN, Learn, Play
from rsoccer.tasks import options
from rsoccer.tasks.ssl import Ssl, ball_at_mouth
from rsoccer.vectors import norm
from rsoccer.view import SIDES

MIN_PASS_LENGTH: Final = 1.5
"""Least length of a pass, m: SSL hardware challenges 2021, challenge 4."""
MIN_START_DISTANCE: Final = 2.0
"""Least distance between the robots in the initial state, m.

A direct pass is then long enough: the ball is released 0.25 m from the one, and received 0.1 m from
the other.
"""
MOVING_SPEED: Final = np.float32(0.3)
"""Speed of the ball above which its direction decides whether a pass misses, m/s."""
MAX_OPPONENTS: Final = 6
MIN_OPPONENT_DISTANCE: Final = np.float32(1.0)
"""Least distance of opponents from blue robots in the initial state, m."""
OPPONENT_SPACING: Final = 0.3
"""Least distance between opponents in the initial state, m."""
TAKING_SECONDS: Final = 0.25
"""Time in a row for which opponents must have the ball in a mouth, s."""


@dataclass(frozen=True)
class SslPass(Ssl):
    """Base class of the SSL tasks in which blue_0 and blue_1 pass the ball.

    Initial state: both robots at random positions at least 2 m apart, with random headings, the
    ball in the mouth of blue_0. With `n_opponents`, that many yellow robots at random positions at
    least 1 m from blue ones, with random headings; they follow the policy `opponent`.

    Reward terms that are not of single robots are those of blue; learners of yellow get the
    negatives.

    A pass counts as `rsoccer.rules.Passes` defines it: the ball leaves the passer by 0.25 m, and
    rolls or flies at least 1.5 m from there, untouched, into the break beam of the other robot.
    """

    n_opponents: int = 0
    """Yellow robots that take the ball, 0 to 6."""
    opponent: str = "take"
    """Policy of the yellow robots: a policy's name or the path of a policy file."""

    sides = ("blue",)
    """Only blue robots observe, unless there are opponents."""

    def __post_init__(self) -> None:
        """Validate the options."""
        if checks.integer_in_range("n_opponents", self.n_opponents, 0, MAX_OPPONENTS):
            object.__setattr__(self, "sides", SIDES)
        options.set_policies(self, "opponent")
        super().__post_init__()
        if self.n_opponents:
            self._check_starts("n_opponents")

    def team_sizes(self) -> tuple[int, int]:
        """Return two blue robots, and the number of opponents of the option."""
        return 2, self.n_opponents

    def default_controllers(self) -> dict[str, str | Learn]:
        """Return `LEARN` for blue robots and the policy `opponent` for yellow ones."""
        blue: dict[str, str | Learn] = dict.fromkeys(robot_names(2, 0), LEARN)
        return {**blue, **dict.fromkeys(robot_names(0, self.n_opponents), self.opponent)}

    def new_memory(self, n: int) -> dict[str, Array]:
        """Create `taken` where there are opponents, (n,) steps for which they have had the ball."""
        return {"taken": np.zeros(n, np.int64)} if self.n_opponents else {}

    @cached_property
    def rules(self) -> Sequence[Rule]:
        """The lines, and possession with passes of at least 1.5 m."""
        return Crossings(), Possession(MIN_PASS_LENGTH)

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Draw random positions and headings, and place the ball in the mouth of blue_0."""
        frame = Frame.empty(len(rng), 2, self.n_opponents)
        field, config = self.config.field, self.config
        # With this margin the ball in front of the robot is inside too.
        margin = float(self.mouth_offset) + 2.0 * config.ball.radius
        corner = np.array([field.half_length - margin, field.half_width - margin], np.float32)
        radii = [config.robot.bounding_radius] * 2
        frame.blue.position[:] = spawn.positions_in_box(
            rng, (-corner, corner), radii, MIN_START_DISTANCE
        )
        frame.blue.heading[:] = spawn.headings(rng, 2)
        frame.ball.position[:] = ball_at_mouth(frame, 0, self.mouth_offset)
        if self.n_opponents:
            self._place_opponents(frame, rng, corner)
        return frame

    def _place_opponents(self, frame: Frame, rng: WorldRng, corner: Floats) -> None:
        """Write random poses of the opponents, away from blue robots, into a frame."""

        def forbidden(drawn: Floats) -> Mask:
            offset = drawn[:, :, None] - frame.blue.position[:, None]
            distance = norm(offset[..., 0], offset[..., 1])
            near: Mask = np.any(np.less(distance, MIN_OPPONENT_DISTANCE), axis=2)
            return near

        radii = [self.config.robot.bounding_radius] * self.n_opponents
        frame.yellow.position[:] = spawn.positions_in_box(
            rng, (-corner, corner), radii, OPPONENT_SPACING, forbidden
        )
        frame.yellow.heading[:] = spawn.headings(rng, self.n_opponents)

    def _has_been_taken(self, play: Play) -> Mask | bool:
        """(n,) whether opponents have the ball; counts the steps for which they have had it."""
        if not self.n_opponents:
            return False
        taken = play.memory["taken"]
        taken[:] = np.where((play.frame.yellow.infrared > 0.5).any(axis=1), taken + 1, 0)
        has: Mask = taken >= round(TAKING_SECONDS / self.config.time_step)
        return has

    def _possession_metrics(self, play: Play) -> dict[str, Floats]:
        """Seconds with the ball of blue, and interceptions of yellow, (n,) each."""
        steps = play.game.possession_steps[:, BLUE]
        return {
            "possession": (steps * self.config.time_step).astype(np.float32),
            "interceptions": play.game.interceptions[:, YELLOW].astype(np.float32),
        }

    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        """Return the segment from the ball to the receiver, and the receiver as a target."""
        receiver = self._receiver(play, world)
        ball_x, ball_y = play.frame.ball.position[world].tolist()
        x, y = play.frame.blue.position[world, receiver].tolist()
        radius = 1.5 * self.config.robot.bounding_radius
        return Segment((ball_x, ball_y), (x, y)), Target((x, y), radius)

    def _receiver(self, play: Play, world: int) -> int:
        """Index of the robot that is to receive the ball."""
        return 1

    def _ball_distances(self, frame: Frame) -> Floats:
        """(n, 2) distances from each robot to the ball, m."""
        offset = frame.ball.position[:, None] - frame.blue.position
        return norm(offset[..., 0], offset[..., 1])

    def _is_released(self, play: Play, holder: Array) -> Mask:
        """(n,) whether the ball is out of reach of its last holder, (n,) index of the robot."""
        worlds = np.arange(len(play.frame))
        return np.greater_equal(self._ball_distances(play.frame)[worlds, holder], REACH)

    def _has_missed(self, frame: Frame, receiver: Floats) -> Mask:
        """(n,) whether a passed ball stopped or moves away from the receiver at (n, 2)."""
        ball = frame.ball
        speed = norm(ball.velocity[:, 0], ball.velocity[:, 1])
        offset = receiver - ball.position
        toward = offset[:, 0] * ball.velocity[:, 0] + offset[:, 1] * ball.velocity[:, 1]
        return np.logical_or(speed < STOPPED_SPEED, (toward < 0.0) & (speed > MOVING_SPEED))

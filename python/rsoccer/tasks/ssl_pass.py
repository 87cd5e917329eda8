"""Base class of the passing tasks: two robots of one team, passes, and the test for a miss."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from rsoccer import spawn
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.markers import Marker, Segment, Target
from rsoccer.rng import WorldRng
from rsoccer.rules import Crossings, Passes, Rule
from rsoccer.rules.passes import REACH, STOPPED_SPEED
from rsoccer.task import Play
from rsoccer.tasks.ssl import Ssl, ball_at_mouth
from rsoccer.vectors import norm

MIN_PASS_LENGTH: Final = 1.5
"""Least length of a pass, m: SSL hardware challenges 2021, challenge 4."""
MIN_START_DISTANCE: Final = 2.0
"""Least distance between the robots in the initial state, m.

A direct pass is then long enough: the ball is released 0.25 m from the one, and received 0.1 m from
the other.
"""
MOVING_SPEED: Final = np.float32(0.3)
"""Speed of the ball above which its direction decides whether a pass misses, m/s."""


@dataclass(frozen=True)
class SslPass(Ssl):
    """Base class of the SSL tasks in which blue_0 and blue_1 pass the ball; no opponents.

    Initial state: both robots at random positions at least 2 m apart, with random headings, the
    ball in the mouth of blue_0.

    A pass counts as `rsoccer.rules.Passes` defines it: the ball leaves the passer by 0.25 m, and
    rolls or flies at least 1.5 m from there, untouched, into the break beam of the other robot.
    """

    sides = ("blue",)
    """Only blue robots observe."""

    def team_sizes(self) -> tuple[int, int]:
        """Return two blue robots and no yellow ones."""
        return 2, 0

    @cached_property
    def rules(self) -> Sequence[Rule]:
        """The lines, and passes of at least 1.5 m."""
        return Crossings(), Passes(MIN_PASS_LENGTH)

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Draw random positions and headings, and place the ball in the mouth of blue_0."""
        frame = Frame.empty(len(rng), 2, 0)
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
        return frame

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

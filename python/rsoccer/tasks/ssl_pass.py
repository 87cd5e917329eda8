"""What both passing tasks share: two robots of one side, and when a pass has failed."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from rsoccer import spawn
from rsoccer.frame import Floats, Frame, Mask, length
from rsoccer.markers import Marker, Target, Way
from rsoccer.rng import WorldRng
from rsoccer.task import Play
from rsoccer.tasks.ssl import Ssl, ball_at_mouth

APART: Final = 1.6  # metres between the two at the start: more than a pass must be long
SLOW: Final = np.float32(0.1)  # m/s below which the ball has stopped
FLIES: Final = np.float32(0.3)  # m/s from which its direction says where it will get
FREE: Final = np.float32(0.15)  # metres from the passer's mouth at which the ball is on its way


@dataclass(frozen=True)
class SslPass(Ssl):
    """blue_0 starts with the ball on its dribbler, blue_1 somewhere else."""

    sides = ("blue",)
    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {}

    def team_sizes(self) -> tuple[int, int]:
        """Two of one side."""
        return 2, 0

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Robots anywhere, apart, facing anywhere; the ball in the mouth of the first."""
        frame = Frame.empty(len(rng), 2, 0)
        field, config = self.config.field, self.config
        # So far inside that the ball before the robot is inside too.
        room = float(self.reach) + 2.0 * config.ball.radius
        far = np.array([field.half_length - room, field.half_width - room], np.float32)
        radii = [config.robot.bounding_radius] * 2
        frame.blue.position[:] = spawn.inside(rng, (-far, far), radii, APART)
        frame.blue.heading[:] = spawn.headings(rng, 2)
        frame.ball.position[:] = ball_at_mouth(frame, 0, self.reach)
        return frame

    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        """The way from the ball to who is to get it."""
        receiver = self.receiver(play, world)
        ball_x, ball_y = play.frame.ball.position[world].tolist()
        teammate_x, teammate_y = play.frame.blue.position[world, receiver].tolist()
        radius = 1.5 * self.config.robot.bounding_radius
        return Way((ball_x, ball_y), (teammate_x, teammate_y)), Target(
            (teammate_x, teammate_y), radius
        )

    def receiver(self, play: Play, world: int) -> int:
        """Which robot is to get the ball."""
        return 1

    def to_ball(self, frame: Frame) -> Floats:
        """Metres from each robot to the ball, (n, 2)."""
        offset = frame.ball.position[:, None] - frame.blue.position
        return length(offset[..., 0], offset[..., 1])

    def missed(self, frame: Frame, receiver: Floats) -> Mask:
        """(n,) whether a ball on its way will not reach the receiver at (n, 2)."""
        ball = frame.ball
        speed = length(ball.velocity[:, 0], ball.velocity[:, 1])
        way = receiver - ball.position
        towards = way[:, 0] * ball.velocity[:, 0] + way[:, 1] * ball.velocity[:, 1]
        return np.logical_or(speed < SLOW, (towards < 0.0) & (speed > FLIES))

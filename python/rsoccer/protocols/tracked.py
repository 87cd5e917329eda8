"""A state that is put together from a message."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from rsoccer.arrays import Mask
from rsoccer.frame import Frame
from rsoccer.protocols.errors import MessageError, Problem
from rsoccer.protocols.layout import WireLayout

Triple = tuple[float, float, float]
"""Three numbers of a body on the wire."""


@dataclass
class Tracked:
    """A state as a message has it.

    Attributes:
        frame: frame of one world; bodies that the message lacks are as they were given.
        timestamp: time of the state by the sender's clock, s.
        seen: (robots,) robots that the message has.
        ball: whether the message has the ball.
        problems: robots that are left out.
    """

    frame: Frame
    timestamp: float
    seen: Mask
    ball: bool = False
    problems: list[Problem] = field(default_factory=list)

    @classmethod
    def begin(cls, layout: WireLayout, last: Frame | None, timestamp: float) -> Tracked:
        """Begin with what a message may lack.

        Args:
            layout: the match.
            last: frame of one world; None for `Frame.empty`, with robots that are absent.
            timestamp: time of the state, s.

        Returns:
            A state in which nothing has been seen.

        Raises:
            ValueError: `last` is a frame of other teams.
        """
        config = layout.config
        if last is None:
            frame = Frame.empty(1, config.n_blue, config.n_yellow)
            frame.robots.absent[:] = 1.0
        else:
            layout.check_frame(last, 0)
            frame = last.take(np.zeros(1, np.intp))
        return cls(frame, timestamp, np.zeros(config.n_robots, np.bool_))

    def put_robot(
        self, layout: WireLayout, identity: tuple[int, int], pose: Triple, velocity: Triple
    ) -> None:
        """Put a robot into the state; an unknown one is listed.

        Args:
            layout: the match.
            identity: team and uniform number.
            pose: x and y on the wire, m; direction, rad.
            velocity: along x and y on the wire, m/s; angular velocity, rad/s.
        """
        try:
            slot = layout.slot(*identity)
        except MessageError as error:
            self.problems.append(Problem(error.code, str(error)))
            return
        robots = self.frame.robots
        robots.data[0, slot] = 0.0
        robots.position[0, slot] = layout.rotated(np.array(pose[:2]))
        robots.heading[0, slot] = layout.heading_from_wire(pose[2])
        robots.velocity[0, slot] = layout.rotated(np.array(velocity[:2]))
        robots.angular_velocity[0, slot] = velocity[2]
        self.seen[slot] = True

    def put_ball(self, layout: WireLayout, position: Triple, velocity: Triple) -> None:
        """Put the ball into the state.

        Args:
            layout: the match.
            position: x, y and height of the lowest point on the wire, m; below 0 counts as 0.
            velocity: along x, y and upward on the wire, m/s.
        """
        ball = self.frame.ball
        ball.position[0] = layout.rotated(np.array(position[:2]))
        ball.height[0] = max(0.0, position[2])
        ball.velocity[0] = layout.rotated(np.array(velocity[:2]))
        ball.vertical_velocity[0] = velocity[2]
        self.ball = True

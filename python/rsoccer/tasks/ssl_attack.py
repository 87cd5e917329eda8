"""What both attacking challenges share: one robot shall score against opponents in their half."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from rsoccer import rewards
from rsoccer.frame import Floats, Frame, Mask
from rsoccer.markers import Area, Marker
from rsoccer.task import LEARN, Learn, Play
from rsoccer.tasks.ssl import Ssl

BACK: np.float32 = np.float32(0.2)
"""Metres behind the middle line that the attacker may go."""


@dataclass(frozen=True)
class SslAttack(Ssl):
    """blue_0 starts at the centre and attacks +x; it and the ball stay in the opponents' half.

    A goal ends it, and so do: the ball out of that half, the robot out of it, in the opponents' area,
    or in contact with an opponent.
    """

    half_only = True
    success = "goal_score"
    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "goal": 10.0,
        "ball_to_goal": 1.0,
        "approach": 0.5,
        "failed": -1.0,
        "energy": 0.0005,
    }
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "goal": 5.0,
        "ball_to_goal": 1.11,  # the paper's scales: 0.9014 m and 5.0 m
        "approach": 0.2,
        "failed": 0.0,
        "energy": 0.0001,
    }

    def default_controllers(self) -> dict[str, str | Learn]:
        """blue_0 learns, opponents hold the ball if they have it and else stand."""
        return dict.fromkeys(self.robots, "hold") | {"blue_0": LEARN}

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """The goal counts most; bringing the ball nearer to it is paid, and so is getting it."""
        goal = rewards.goal(play)
        failed = self.failed(play.frame) & (rewards.goals_at(play.frame.ball) <= 0.0)
        terms = {
            "goal": goal,
            "ball_to_goal": rewards.ball_to_goal(play, self.config.field),
            "approach": rewards.to_mouth(play, self.config),
            "failed": failed[:, None].astype(np.float32),
            "energy": rewards.energy(play),
        }
        return rewards.weighted(terms, self.reward_weights), failed | rewards.scored(play)

    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        """The half that ball and attacker have to stay in."""
        field = self.config.field
        return (Area((0.0, -field.half_width), (field.half_length, field.half_width)),)

    def metrics(self, play: Play) -> dict[str, Floats]:
        """`goal_score`: 1 for a goal, -1 for one against, else 0."""
        return {"goal_score": rewards.goals_at(play.frame.ball)}

    def failed(self, frame: Frame) -> Mask:
        """(n,) whether ball or robot is where it must not be, or the contact is one too many."""
        return self.ball_left(frame) | self.robot_left(frame) | self.fouled(frame)

    def ball_left(self, frame: Frame) -> Mask:
        """(n,) the ball has left the opponents' half, other than through the goal."""
        ball, field = frame.ball.position, self.config.field
        aside = np.abs(ball[:, 1]) > np.float32(field.half_width)
        beyond = ball[:, 0] > np.float32(field.half_length)
        return np.logical_or(ball[:, 0] < 0.0, aside | beyond)

    def robot_left(self, frame: Frame) -> Mask:
        """(n,) the attacker has left the half, or entered the opponents' area."""
        at, field = frame.blue.position[:, 0], self.config.field
        aside, x = np.abs(at[:, 1]), at[:, 0]
        area_x = np.float32(field.half_length - field.goal_area_depth)
        in_area = (x > area_x) & (aside < np.float32(field.goal_area_width / 2))
        outside = (aside > np.float32(field.half_width)) | (x > np.float32(field.half_length))
        return np.logical_or(x < -BACK, outside | in_area)

    def fouled(self, frame: Frame) -> Mask:
        """(n,) the attacker has touched an opponent."""
        return np.greater(frame.blue.touched_foe[:, 0], 0.5)

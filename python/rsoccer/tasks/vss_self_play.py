"""`VSSSelfPlay-v0`: both teams learn."""

from dataclasses import dataclass

from rsoccer.tasks.vss import Vss


@dataclass(frozen=True)
class VssSelfPlay(Vss):
    """VSSS match in which all robots of both teams learn.

    Each robot observes the game from its own side, so one policy can control both teams. Goal of
    the task, initial state, reward terms and termination are those of `Vss`. The option `free_ball`
    is on.

    Metrics: `goal_score`, 1 if blue scored, -1 if yellow scored, else 0; `free_balls`, number of
    free balls in the episode, with the option `free_ball`.
    """

    free_ball: bool = True
    """True: a ball that is stuck for 10 s leads to a free ball at the mark of its quarter."""

"""A script that goes to the ball and takes it into its mouth."""

from typing import Final, Literal

from rsoccer.frame import Floats
from rsoccer.policies import ssl_moves
from rsoccer.policies.base import Memory, Policy, Seen
from rsoccer.policies.ssl_ways import Ground, others
from rsoccer.rng import WorldRng
from rsoccer.task import Task

FASTEST: Final = 2.0  # m/s
ROOM: Final = 0.02  # metres that its centre keeps from the lines


class Fetch(Policy):
    """Drives round the others to the ball, faces it, and takes it with the dribbler on."""

    observes: Literal["nothing", "view", "observation"] = "view"

    def __init__(self, task: Task) -> None:
        """Learn the field and the robot of `task`."""
        super().__init__(task)
        self._mover = ssl_moves.Mover("fetch", task)
        self._ground = Ground.field(task.config.field, ROOM)

    def act(self, seen: Seen, rng: WorldRng, memory: Memory) -> Floats:
        """(n, robots, 5)."""
        if seen.view is None:
            raise ValueError("fetch needs a view, got none")
        me, ball = seen.view.me, seen.view.ball
        v_x, v_y, spin = ssl_moves.fetching(
            self._mover,
            me,
            (ball.position, ball.velocity),
            others(seen.view),
            self._ground,
            FASTEST,
        )
        return self._mover.actions(me, v_x, v_y, spin)

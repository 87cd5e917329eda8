"""A script that goes to the ball and takes it into its mouth."""

from typing import Final, Literal

from rsoccer.frame import Floats
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.paths import Ground, others
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
        self._mover = motion.Mover("fetch", task)
        self._ground = Ground.field(task.config.field, ROOM)

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """(n, robots, 5)."""
        if inputs.view is None:
            raise ValueError("fetch needs a view, got none")
        ego, ball = inputs.view.ego, inputs.view.ball
        v_x, v_y, spin = motion.fetching(
            self._mover,
            ego,
            (ball.position, ball.velocity),
            others(inputs.view),
            self._ground,
            FASTEST,
        )
        return self._mover.actions(ego, v_x, v_y, spin)

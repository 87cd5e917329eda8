"""The `fetch` policy: go to the ball and take it into the mouth."""

from typing import Final

from rsoccer.arrays import Floats
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.policies.ssl.approach import approach_ball
from rsoccer.policies.ssl.path_planning import other_robots
from rsoccer.policies.ssl.region import Region
from rsoccer.policies.ssl.robot_control import RobotControl, require_ssl
from rsoccer.rng import WorldRng
from rsoccer.task import Task

MAX_SPEED: Final = 2.0  # m/s
LINE_MARGIN: Final = 0.02  # m between the robot's center and the field's lines


class Fetch(Policy):
    """A script that drives past other robots to the ball and takes it with the dribbler on."""

    observes: Observes = "view"
    forecasts = True

    def __init__(self, task: Task) -> None:
        """Prepare the script for a task.

        Args:
            task: an SSL task.
        """
        super().__init__(task)
        self._control = RobotControl(require_ssl("fetch", task))
        self._region = Region.of_field(task.config.field, LINE_MARGIN)

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions, (n, robots, 5)."""
        view = inputs.required_view("fetch")
        ball = view.ball.position, view.ball.velocity
        robots = other_robots(view)
        v_x, v_y, angular_velocity = approach_ball(
            self._control, view.ego, ball, robots, self._region, MAX_SPEED
        )
        return self._control.actions(view.ego, v_x, v_y, angular_velocity)

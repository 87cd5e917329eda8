"""The `scripted` policy: a VSSS team of keeper, attacker and support."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.policies.vss.drive_control import (
    DriveController,
    DriveTarget,
    require_differential_drive,
)
from rsoccer.policies.vss.field_geometry import FieldGeometry
from rsoccer.policies.vss.roles import NONE, assign_roles
from rsoccer.policies.vss.tactics import role_targets
from rsoccer.rng import WorldRng
from rsoccer.task import Task

MIN_SPEED: Final = 0.03  # wheel speed, 1 is full speed, at skill 0: about as strong as `ou`
MAX_DELAY: Final = 0.275  # s added between two decisions at skill 0


class Scripted(Policy):
    """A team script: one robot keeps the goal, one attacks, the others support.

    The roles follow the game. A robot counts teammates of other policies as if they played the
    roles that fit them.
    """

    observes: Observes = "view"

    def __init__(self, task: Task, skill: float = 1.0) -> None:
        """Prepare the script for a task.

        Args:
            task: a task whose robots have a differential drive.
            skill: 0 to 1; scales the speed and shortens the reaction time.

        Raises:
            ValueError: a task with other robots, or a skill out of range.
        """
        require_differential_drive("scripted", task)
        if not 0.0 <= skill <= 1.0:
            raise ValueError(f"scripted: expected a skill from 0 to 1, got {skill}")
        super().__init__(task)
        self._field = FieldGeometry(task.config)
        self._controller = DriveController(task.config.robot)
        sizes = {"blue": task.n_blue, "yellow": task.n_yellow}
        self._team_size = max(sizes[side] for side in task.sides)
        self._max_wheel_speed = np.float32(MIN_SPEED + (1.0 - MIN_SPEED) * skill)
        self._delay_steps = round((1.0 - skill) * MAX_DELAY / task.config.time_step)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Return roles in the team, motion targets, delay and slow steps.

        | array | shape | content |
        | --- | --- | --- |
        | `roles` | (n, robots, team) | roles of ego and its teammates |
        | `targets` | (n, robots, 4) | current `DriveTarget` |
        | `delay` | (n,) | control steps until the next decision |
        | `slow_steps` | (n, robots) | counters of `back_off` |
        """
        return {
            "roles": np.full((*shape[:2], self._team_size), NONE, np.int8),
            "targets": np.zeros((*shape[:2], len(DriveTarget._fields)), np.float32),
            "delay": np.zeros(shape[0], np.int64),
            "slow_steps": np.zeros(shape[:2], np.int64),
        }

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return the normalized wheel speeds, (n, robots, 2)."""
        view = inputs.required_view("scripted")
        assign_roles(self._field, view, memory["roles"])
        ego_roles = memory["roles"][:, :, 0]
        new_targets = np.stack(role_targets(self._field, view, ego_roles), axis=-1)
        targets, delay = memory["targets"], memory["delay"]
        decides = delay == 0
        targets[decides] = new_targets[decides]
        delay[:] = np.where(decides, self._delay_steps, delay - 1)
        target = DriveTarget(*(targets[..., i] for i in range(targets.shape[-1])))
        slow_steps = memory["slow_steps"]
        return self._controller.drive(view.ego, target, self._max_wheel_speed, slow_steps, rng)

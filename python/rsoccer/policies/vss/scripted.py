"""The `scripted` policy: a VSSS team of keeper, attacker and support."""

from typing import Final

import numpy as np

from rsoccer.arrays import Array, Floats
from rsoccer.policies.base import MatchState, Memory, Observes, Policy, PolicyInput
from rsoccer.policies.vss import penalty
from rsoccer.policies.vss.drive_control import (
    DriveController,
    DriveTarget,
    require_differential_drive,
)
from rsoccer.policies.vss.field_geometry import FieldGeometry
from rsoccer.policies.vss.goal_areas import GoalAreas
from rsoccer.policies.vss.roles import ATTACKER, HYSTERESIS, NONE, assign_roles
from rsoccer.policies.vss.tactics import role_targets
from rsoccer.policies.vss.waiting import may_play, wait
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.view import View

MIN_SPEED: Final = 0.03  # wheel speed, 1 is full speed, at skill 0: about as strong as `ou`
KEEPER_LOYALTY: Final = np.float32(0.5)  # `HYSTERESIS` of a keeper under a referee: only it may be
# in the goal area, so that another one has to wait until it has left
TURN: Final = DriveTarget._fields.index("turn")
MAX_DELAY: Final = 0.275  # s added between two decisions at skill 0


class Scripted(Policy):
    """A team script: one robot keeps the goal, one attacks, the others support.

    The roles follow the game. A robot counts teammates of other policies as if they played the
    roles that fit them.

    Under a referee it stands while play is stopped, and keeps to the rules of the goal areas: the
    keeper alone is in the own one, and plays the ball there; one attacker is in that of the others.
    """

    observes: Observes = "view"
    forecasts = True

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
        self._areas = GoalAreas(task.config)
        self._controller = DriveController(task.config.robot)
        sizes = {"blue": task.n_blue, "yellow": task.n_yellow}
        self._n_blue = task.n_blue
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
        | `kick` | (n, robots) | stage of a penalty kick, with the sign of y of its corner |
        """
        return {
            "roles": np.full((*shape[:2], self._team_size), NONE, np.int8),
            "targets": np.zeros((*shape[:2], len(DriveTarget._fields)), np.float32),
            "delay": np.zeros(shape[0], np.int64),
            "slow_steps": np.zeros(shape[:2], np.int64),
            "kick": np.full(shape[:2], penalty.NONE, np.int8),
        }

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return the normalized wheel speeds, (n, robots, 2)."""
        view, match = inputs.required_view("scripted"), inputs.match
        is_judged = match is not None and "referee" in match.game
        loyalty = KEEPER_LOYALTY if is_judged else HYSTERESIS
        assign_roles(self._field, view, memory["roles"], loyalty)
        ego_roles = memory["roles"][:, :, 0].copy()
        new_targets = np.stack(self._targets(view, ego_roles, is_judged), axis=-1)
        if match is not None and is_judged:
            self._follow_penalty(match, view, ego_roles, memory["kick"], rng, new_targets)
        targets, delay = memory["targets"], memory["delay"]
        decides = delay == 0
        targets[decides] = new_targets[decides]
        delay[:] = np.where(decides, self._delay_steps, delay - 1)
        target = DriveTarget(*(targets[..., i] for i in range(targets.shape[-1])))
        slow_steps = memory["slow_steps"]
        actions = self._controller.drive(view.ego, target, self._max_wheel_speed, slow_steps, rng)
        if match is not None and is_judged:
            wait(~may_play(match, ego_roles, self._n_blue), memory, actions)
        return actions

    def _follow_penalty(
        self,
        match: MatchState,
        view: View,
        roles: Array,
        stage: Array,
        rng: WorldRng,
        targets: Floats,
    ) -> None:
        """Replace targets (n, robots, 4) of the kicker and of the keeper at penalty kicks."""
        kicking = penalty.kicks(match, roles, self._n_blue)
        waiting = penalty.awaits(match, view, roles, self._n_blue)
        if not (kicking | waiting).any():
            stage[:] = penalty.NONE
            return
        penalty.choose_corner(self._field, view, kicking, stage, rng)
        kick = np.stack(penalty.kick_target(self._field, view, stage), axis=-1)
        targets[kicking] = kick[kicking]
        turns = penalty.waiting_turn(view)
        targets[waiting, TURN] = turns[waiting]

    def _targets(self, view: View, roles: Array, is_judged: bool) -> DriveTarget:
        """Motion targets by roles; under a referee they keep to the rules of the areas."""
        if not is_judged:
            return role_targets(self._field, view, roles)
        played = np.where(self._areas.clears(view, roles), ATTACKER, roles)
        return self._areas.keep_out(view, roles, role_targets(self._field, view, played))

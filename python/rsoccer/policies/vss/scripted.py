"""A script that plays as a VSSS side: a keeper, an attacker, support."""

from typing import Final, Literal

import numpy as np

from rsoccer.frame import Floats
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.policies.vss import driving, roles
from rsoccer.policies.vss.driving import Driver, Orders
from rsoccer.policies.vss.orders import give
from rsoccer.policies.vss.pitch import Pitch
from rsoccer.rng import WorldRng
from rsoccer.task import Task

SLOWEST: Final = 0.03  # share of full power without any skill: about as strong as drifting
REACTION: Final = 0.275  # seconds more between two looks at the game, without any skill


class Scripted(Policy):
    """One of the side keeps the goal, one attacks, others back them up; roles follow the game.

    `skill` from 0 to 1 scales how fast it drives and how soon it reacts. Teammates that others drive
    count as if they played the roles that fit them.
    """

    observes: Literal["nothing", "view", "observation"] = "view"

    def __init__(self, task: Task, skill: float = 1.0) -> None:
        """Learn the pitch and the robot of `task`."""
        driving.expect_two_wheels(task, "scripted")
        if not 0.0 <= skill <= 1.0:
            raise ValueError(f"scripted: expected a skill from 0 to 1, got {skill}")
        super().__init__(task)
        self._pitch = Pitch(task.config)
        self._driver = Driver(task.config.robot)
        self._side = max({"blue": task.n_blue, "yellow": task.n_yellow}[s] for s in task.sides)
        self._pace = np.float32(SLOWEST + (1.0 - SLOWEST) * skill)
        self._rest = round((1.0 - skill) * REACTION / task.config.time_step)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Roles in the side, standing orders, steps until the next look, slow steps."""
        return {
            "roles": np.full((*shape[:2], self._side), roles.NONE, np.int8),
            "orders": np.zeros((*shape[:2], len(Orders._fields)), np.float32),
            "rest": np.zeros(shape[0], np.int64),
            "slow": np.zeros(shape[:2], np.int64),
        }

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Powers of the two wheels, (n, robots, 2)."""
        if inputs.view is None:
            raise ValueError("scripted needs a view, got none")
        roles.assign(self._pitch, inputs.view, memory["roles"])
        mine = memory["roles"][:, :, 0]
        fresh = np.stack(give(self._pitch, inputs.view, mine), axis=-1)
        orders, rest = memory["orders"], memory["rest"]
        looks = rest == 0
        orders[looks] = fresh[looks]
        rest[:] = np.where(looks, self._rest, rest - 1)
        standing = Orders(*(orders[..., i] for i in range(orders.shape[-1])))
        return self._driver.drive(inputs.view.ego, standing, self._pace, memory["slow"], rng)

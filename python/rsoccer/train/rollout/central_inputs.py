"""Inputs of a centralized critic: the global state of the match with the observation of the robot.

Multi-agent PPO (MAPPO), Yu et al., "The Surprising Effectiveness of PPO in Cooperative Multi-Agent
Games" (2022): only training needs the value network, so it may read more than one robot observes.
The observation, which is in the robot's own coordinates, says which robot the value is for.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import torch
from torch import Tensor

from rsoccer.arrays import Floats
from rsoccer.global_state import StateEncoder
from rsoccer.task import Task
from rsoccer.train.network.actor_critic import OBSERVATION_CLIP
from rsoccer.train.rollout.running_mean_std import RunningMeanStd


class CentralInputs:
    """Inputs (..., s + o) of a centralized critic: a normalized state and observation.

    Attributes:
        rms: running mean and standard deviation of the states.
    """

    def __init__(self, task: Task, *, symmetric: bool) -> None:
        """Start without statistics.

        Args:
            task: the task to train on.
            symmetric: reflected states count in the statistics, too.
        """
        encoder = StateEncoder(task.config)
        self.rms = RunningMeanStd(
            encoder.size, reflection=encoder.reflection if symmetric else None
        )

    def update(self, states: Sequence[Floats]) -> None:
        """Add states to the statistics.

        Args:
            states: arrays (n, s) from `Matches.states`.
        """
        # In one order of memory, as sums depend on it: a restored array has another one.
        self.rms.update(np.ascontiguousarray(np.concatenate(states)))

    def join(self, states: Floats, observations: Tensor) -> Tensor:
        """Return the inputs for the robots of some matches, (n x agents, s + o).

        Args:
            states: (n, s) states of the matches.
            observations: (n x agents, o) normalized observations.
        """
        mean, std = self.rms.as_float32()
        normalized = np.clip((states - mean) / std, -OBSERVATION_CLIP, OBSERVATION_CLIP)
        rows = torch.tensor(normalized).repeat_interleave(len(observations) // len(states), 0)
        return torch.cat([rows, observations], dim=-1)

"""Training of DDPG and SAC with Stable-Baselines3, for a given processor time."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
import torch
from stable_baselines3 import DDPG, SAC
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.noise import OrnsteinUhlenbeckActionNoise, VectorizedActionNoise
from stable_baselines3.common.vec_env import VecEnv

from benches.learning.relu_actor import Layer, ReluActor
from benches.learning.sb3_wrapper import ActionRepeat, MaskedObservations
from rsoccer.arrays import Floats
from rsoccer.lineup import DEFAULT_OPPONENT, learning_team
from rsoccer.registry import make_task
from rsoccer.sb3 import SoccerVecEnv
from rsoccer.train.observation_mask import observation_mask

SNAPSHOTS: Final = np.geomspace(0.03, 1.0, 12)
"""Shares of the time after which the actor is measured."""

Measure = Callable[[ReluActor], float]
"""Score of an actor."""


@dataclass
class Log:
    """Progress of a run: the score of the actor at some times."""

    samples: list[int] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)
    scores: list[float] = field(default_factory=list)
    total: int = 0
    """Samples of the whole run."""
    gradient_steps: int = 0


def train(
    task_name: str, values: dict[str, Any], seed: int, seconds: float, measure: Measure
) -> tuple[ReluActor, Log]:
    """Train until the processor time is used up.

    Args:
        task_name: Registered task.
        values: Settings of `sb3_run`, with the algorithm.
        seed: Seed of the run.
        seconds: Processor time of this process, without that of the measurements.
        measure: Measures an actor.

    Returns:
        The actor, and the progress.

    Raises:
        ValueError: Rows that are no multiple of the samples of a gradient step.
    """
    torch.set_num_threads(1)
    envs = environments(task_name, values)
    gradient_steps, rest = divmod(envs.num_envs, values["samples_per_gradient_step"])
    if rest:
        raise ValueError(
            f"rows: expected a multiple of samples_per_gradient_step, got {envs.num_envs} rows "
            f"for {values['samples_per_gradient_step']}"
        )
    arguments: dict[str, Any] = {
        "learning_rate": values["learning_rate"],
        "buffer_size": values["buffer_size"],
        "learning_starts": values["learning_starts"],
        "batch_size": values["batch_size"],
        "tau": values["tau"],
        "gamma": values["gamma"] ** values["action_repeat"],
        "train_freq": 1,
        "gradient_steps": gradient_steps,
        "n_steps": values["n_steps"],
        "policy_kwargs": {"net_arch": list(values["hidden_sizes"])},
        "seed": seed,
        "device": "cpu",
    }
    mask = mask_of(task_name, values)

    def actor() -> ReluActor:
        return actor_of(model, values["action_repeat"], mask)

    progress = Progress(seconds, lambda: measure(actor()))
    if values["algorithm"] == "ddpg":
        progress.noise = Noise(envs, values)
        model: Any = DDPG("MlpPolicy", envs, action_noise=progress.noise.process, **arguments)
    else:
        model = SAC("MlpPolicy", envs, **arguments)
    model.learn(10**12, callback=progress, log_interval=None)
    log = progress.log
    log.total, log.gradient_steps = int(model.num_timesteps), int(model._n_updates)
    envs.close()
    return actor(), log


def environments(task_name: str, values: dict[str, Any]) -> VecEnv:
    """Return a vector environment with at least `rows` rows.

    Where both teams learn, blue learns against `DEFAULT_OPPONENT`.
    """
    task = make_task(task_name, **values["task_options"])
    learners = learning_team(task)
    controllers = {"yellow": DEFAULT_OPPONENT} if len(learners) < len(task.agents) else None
    matches = -(-values["rows"] // len(learners))
    envs: VecEnv = SoccerVecEnv(task, matches, threads=1, controllers=controllers)
    if values["masked_observations"]:
        envs = MaskedObservations(envs, mask_of(task_name, values))
    return ActionRepeat(envs, values["action_repeat"], values["gamma"])


def mask_of(task_name: str, values: dict[str, Any]) -> Floats:
    """Return the mask of the observation, (o,): 0 for numbers that the networks do not read."""
    task = make_task(task_name, **values["task_options"])
    return observation_mask(task, values["masked_observations"])


class Noise:
    """Ornstein-Uhlenbeck noise of each row, whose spread falls over the run."""

    def __init__(self, envs: VecEnv, values: dict[str, Any]) -> None:
        """Create the noise, with the time of a decision as its step."""
        theta, self._first, self._last = values["noise"]
        self._size = envs.action_space.shape[0]
        step = envs.get_attr("task")[0].config.time_step * values["action_repeat"]
        zero, sigma = np.zeros(self._size), np.full(self._size, self._first)
        one = OrnsteinUhlenbeckActionNoise(zero, sigma, theta, dt=step)
        self.process = VectorizedActionNoise(one, envs.num_envs)

    def anneal(self, progress: float) -> None:
        """Set the spread for a progress from 0 to 1."""
        sigma = self._first + (self._last - self._first) * progress
        for one in self.process.noises:
            one._sigma = np.full(self._size, sigma)


class Progress(BaseCallback):  # type: ignore[misc]
    """Ends the run after its time, lowers the noise, and measures the actor."""

    noise: Noise | None = None

    def __init__(self, seconds: float, measure: Callable[[], float]) -> None:
        """Prepare a run; its time begins with the first step.

        Args:
            seconds: Processor time of the run.
            measure: Measures the present actor.
        """
        super().__init__()
        self.log = Log()
        self._limit, self._measure = seconds, measure

    def _on_training_start(self) -> None:
        self._began = time.process_time()

    def _on_step(self) -> bool:
        spent = time.process_time() - self._began
        if self.noise is not None:
            self.noise.anneal(min(spent / self._limit, 1.0))
        done = len(self.log.scores)
        if done < len(SNAPSHOTS) and spent >= SNAPSHOTS[done] * self._limit:
            self._add_point(spent)
        return spent < self._limit

    def _add_point(self, spent: float) -> None:
        """Measure the actor, while the clock of the run stands still."""
        before = time.process_time()
        self.log.samples.append(self.num_timesteps)
        self.log.seconds.append(spent)
        self.log.scores.append(self._measure())
        self._began += time.process_time() - before


def actor_of(model: Any, action_repeat: int, mask: Floats) -> ReluActor:  # noqa: ANN401
    """Return the actor of a model of Stable-Baselines3 as a policy in NumPy.

    Args:
        model: The model.
        action_repeat: Control steps per decision.
        mask: (o,) 0 for numbers of the observation that the actor does not read, 1 for others.
    """

    def arrays(layer: Any) -> Layer:  # noqa: ANN401
        return layer.weight.detach().numpy().copy(), layer.bias.detach().numpy().copy()

    def linear(sequence: Any) -> list[Layer]:  # noqa: ANN401
        return [arrays(layer) for layer in sequence if isinstance(layer, torch.nn.Linear)]

    def masked(layers: list[Layer]) -> list[Layer]:
        (weight, bias), *others = layers
        return [(weight * mask, bias), *others]

    actor = model.policy.actor
    if hasattr(actor, "latent_pi"):
        layers = [*linear(actor.latent_pi), arrays(actor.mu)]
        return ReluActor(masked(layers), action_repeat, arrays(actor.log_std))
    return ReluActor(masked(linear(actor.mu)), action_repeat)

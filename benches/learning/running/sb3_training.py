"""Training of DDPG and SAC with Stable-Baselines3."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
import torch
from stable_baselines3 import DDPG, SAC
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.logger import Logger
from stable_baselines3.common.noise import OrnsteinUhlenbeckActionNoise, VectorizedActionNoise
from stable_baselines3.common.vec_env import VecEnv

from benches.learning.running.relu_actor import Layer, ReluActor
from benches.learning.running.sb3_wrapper import ActionRepeat, MaskedObservations
from benches.learning.sb3_settings import number_of_matches
from rsoccer.arrays import Floats
from rsoccer.lineup import DEFAULT_OPPONENT, learning_team
from rsoccer.registry import make_task
from rsoccer.sb3 import SoccerVecEnv
from rsoccer.train.network.observation_mask import observation_mask

SNAPSHOTS: Final = np.geomspace(0.03, 1.0, 12)
"""Shares of the samples after which the actor is measured."""

Measure = Callable[[ReluActor], float]
"""Score of an actor."""


@dataclass
class Log:
    """Progress of a run: the score of the actor at some times."""

    samples: list[int] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)
    """Processor time of learning until then, without that of the measurements."""
    scores: list[float] = field(default_factory=list)
    total: int = 0
    """Samples of the whole run."""
    gradient_steps: int = 0
    learning_seconds: float = 0.0
    """Processor time of the whole run, without that of the measurements."""


def train(
    task_name: str, values: dict[str, Any], seed: int, measure: Measure
) -> tuple[ReluActor, Log]:
    """Train for the samples of the settings, rounded up to whole steps of the environment.

    Args:
        task_name: Registered task.
        values: Settings from `sb3_settings`, with the algorithm.
        seed: Seed of the run.
        measure: Measures an actor.

    Returns:
        The actor, and the progress.

    Raises:
        ValueError: Rows that are no multiple of the samples of a gradient step.
    """
    model, noise = create_model(task_name, values, seed)
    mask = mask_of(task_name, values)

    def actor() -> ReluActor:
        return actor_of(model, values["action_repeat"], mask)

    progress = Progress(values["samples"], noise, lambda: measure(actor()))
    model.learn(values["samples"], callback=progress, log_interval=None)
    log = progress.log
    log.total, log.gradient_steps = int(model.num_timesteps), int(model._n_updates)
    model.get_env().close()
    return actor(), log


def create_model(
    task_name: str, values: dict[str, Any], seed: int
) -> tuple[DDPG | SAC, Noise | None]:
    """Return an untrained model with its environments, and the noise that explores for DDPG.

    Args:
        task_name: Registered task.
        values: Settings from `sb3_settings`, with the algorithm.
        seed: Seed of weights, environments and actions.

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
    noise: Noise | None = None
    if values["algorithm"] == "ddpg":
        noise = Noise(envs, values)
        model = DDPG("MlpPolicy", envs, action_noise=noise.process, **arguments)
    else:
        model = SAC("MlpPolicy", envs, **arguments)
    # Its own logger makes a folder in the system's one for temporary files in each call of `learn`.
    model.set_logger(Logger(folder=None, output_formats=[]))
    return model, noise


def environments(task_name: str, values: dict[str, Any]) -> VecEnv:
    """Return a vector environment with at least `rows` rows.

    Where both teams learn, blue learns against `DEFAULT_OPPONENT`.
    """
    task = make_task(task_name, **values["task_options"])
    learners = learning_team(task)
    controllers = {"yellow": DEFAULT_OPPONENT} if len(learners) < len(task.agents) else None
    matches = number_of_matches(task, values["rows"])
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
    """Lowers the noise over a run, and measures the actor."""

    def __init__(self, samples: int, noise: Noise | None, measure: Callable[[], float]) -> None:
        """Prepare a run.

        Args:
            samples: Samples of the run.
            noise: The noise that explores, if there is some.
            measure: Measures the present actor.
        """
        super().__init__()
        self.log = Log()
        self._samples, self._noise, self._measure = samples, noise, measure

    def _on_training_start(self) -> None:
        self._began = time.process_time()

    def _on_step(self) -> bool:
        share = self.num_timesteps / self._samples
        if self._noise is not None:
            self._noise.anneal(min(share, 1.0))
        done = len(self.log.scores)
        if done < len(SNAPSHOTS) and share >= SNAPSHOTS[done]:
            self._add_point()
        return True

    def _on_training_end(self) -> None:
        self.log.learning_seconds = time.process_time() - self._began

    def _add_point(self) -> None:
        """Measure the actor, while the clock of the run stands still."""
        before = time.process_time()
        self.log.samples.append(self.num_timesteps)
        self.log.seconds.append(before - self._began)
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

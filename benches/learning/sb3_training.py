"""Training of DDPG and SAC with Stable-Baselines3, for a given processor time."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
import torch
from stable_baselines3 import DDPG, SAC
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.noise import OrnsteinUhlenbeckActionNoise, VectorizedActionNoise
from stable_baselines3.common.vec_env import VecEnv

from benches.learning.relu_actor import Layer, ReluActor
from benches.learning.sb3_wrapper import ActionRepeat
from rsoccer.frame import team_of
from rsoccer.registry import make_task
from rsoccer.sb3 import SoccerVecEnv

LOG_INTERVAL: Final = 100  # steps of the vector environment


@dataclass
class Log:
    """Progress of a run: a point after some steps of the vector environment."""

    samples: list[int] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)
    means: list[float] = field(default_factory=list)
    """Mean of the metric over the episodes since the last point; NaN without episodes."""
    episodes: list[int] = field(default_factory=list)
    total: int = 0
    """Samples of the whole run."""
    gradient_steps: int = 0


def train(
    task_name: str, values: dict[str, Any], seed: int, seconds: float
) -> tuple[ReluActor, Log]:
    """Train until the processor time is used up.

    Args:
        task_name: Registered task.
        values: Settings of `sb3_run`, with the algorithm.
        seed: Seed of the run.
        seconds: Processor time of this process.

    Returns:
        The actor, and the progress.
    """
    torch.set_num_threads(1)
    envs = environments(task_name, values)
    arguments: dict[str, Any] = {
        "learning_rate": values["learning_rate"],
        "buffer_size": values["buffer_size"],
        "learning_starts": values["learning_starts"],
        "batch_size": values["batch_size"],
        "tau": values["tau"],
        "gamma": values["gamma"] ** values["action_repeat"],
        "train_freq": 1,
        "gradient_steps": max(1, envs.num_envs // values["samples_per_gradient_step"]),
        "n_steps": values["n_steps"],
        "policy_kwargs": {"net_arch": list(values["hidden_sizes"])},
        "seed": seed,
        "device": "cpu",
    }
    progress = Progress(make_task(task_name).success, seconds)
    if values["algorithm"] == "ddpg":
        progress.noise = Noise(envs, values)
        model: Any = DDPG("MlpPolicy", envs, action_noise=progress.noise.process, **arguments)
    else:
        model = SAC("MlpPolicy", envs, **arguments)
    model.learn(10**12, callback=progress, log_interval=None)
    log = progress.log
    log.total, log.gradient_steps = int(model.num_timesteps), int(model._n_updates)
    envs.close()
    return actor_of(model, values["action_repeat"]), log


def environments(task_name: str, values: dict[str, Any]) -> VecEnv:
    """Return a vector environment with at least `rows` rows.

    Where both teams learn, blue learns against `ou`.
    """
    task = make_task(task_name, **values["task_options"])
    teams = {team_of(name) for name in task.agents}
    controllers = {"yellow": "ou"} if len(teams) == 2 else None
    learners = len(task.agents) // len(teams)
    matches = -(-values["rows"] // learners)
    envs = SoccerVecEnv(task, matches, threads=1, controllers=controllers)
    return ActionRepeat(envs, values["action_repeat"], values["gamma"])


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
    """Ends the run after its time, lowers the noise, and keeps the curve."""

    def __init__(self, metric: str | None, seconds: float) -> None:
        """Prepare a run; its time begins with the first step.

        Args:
            metric: Metric of an episode, in the infos; None is the return.
            seconds: Processor time of the run.
        """
        super().__init__()
        self.log, self.noise = Log(), None
        self._metric, self._limit = metric, seconds
        self._values: list[float] = []

    log: Log
    noise: Noise | None

    def _on_training_start(self) -> None:
        self._began = time.process_time()

    def _on_step(self) -> bool:
        spent = time.process_time() - self._began
        if self.noise is not None:
            self.noise.anneal(min(spent / self._limit, 1.0))
        ended = [info["episode"] for info in self.locals["infos"] if "episode" in info]
        self._values += [float(episode[self._metric or "r"]) for episode in ended]
        if self.n_calls % LOG_INTERVAL == 0 or spent >= self._limit:
            self._add_point(spent)
        return spent < self._limit

    def _add_point(self, spent: float) -> None:
        self.log.samples.append(self.num_timesteps)
        self.log.seconds.append(spent)
        self.log.means.append(float(np.mean(self._values)) if self._values else float("nan"))
        self.log.episodes.append(len(self._values))
        self._values = []


def actor_of(model: Any, action_repeat: int) -> ReluActor:  # noqa: ANN401
    """Return the actor of a model of Stable-Baselines3 as a policy in NumPy."""

    def arrays(layer: Any) -> Layer:  # noqa: ANN401
        return layer.weight.detach().numpy().copy(), layer.bias.detach().numpy().copy()

    def linear(sequence: Any) -> list[Layer]:  # noqa: ANN401
        return [arrays(layer) for layer in sequence if isinstance(layer, torch.nn.Linear)]

    actor = model.policy.actor
    if hasattr(actor, "latent_pi"):
        layers = [*linear(actor.latent_pi), arrays(actor.mu)]
        return ReluActor(layers, action_repeat, arrays(actor.log_std))
    return ReluActor(linear(actor.mu), action_repeat)

"""Networks and their inputs for tests."""

import numpy as np

from rsoccer.policies.base import PolicyInput
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import FORMAT
from rsoccer.task import Task

Arrays = dict[str, np.ndarray]
Metadata = dict[str, str]

OBSERVATION, HIDDEN, ACTION = 5, 8, 2


def network_parts(**extra: str) -> tuple[Arrays, Metadata]:
    """Random arrays of a network without `action_std`, and its metadata with `extra` keys."""
    rng = np.random.default_rng(0)
    shapes = [(HIDDEN, OBSERVATION), (HIDDEN, HIDDEN), (ACTION, HIDDEN)]
    arrays: Arrays = {}
    for index, shape in enumerate(shapes):
        arrays[f"layers.{index}.weight"] = rng.normal(size=shape).astype(np.float32)
        arrays[f"layers.{index}.bias"] = rng.normal(size=shape[0]).astype(np.float32)
    arrays["mean"] = rng.normal(size=OBSERVATION).astype(np.float32)
    arrays["std"] = rng.uniform(0.5, 2.0, OBSERVATION).astype(np.float32)
    metadata = {
        "format": FORMAT,
        "task": "VSSSelfPlay-v0",
        "observation_size": str(OBSERVATION),
        "action_size": str(ACTION),
        "activation": "tanh",
        "clip": "10",
    }
    return arrays, {**metadata, **extra}


def network_for(task: Task) -> Network:
    """A network that fits a task; its mean actions are 0, with a standard deviation of 0.4."""
    arrays = {
        "layers.0.weight": np.zeros((task.action_size, task.layout.size), np.float32),
        "layers.0.bias": np.zeros(task.action_size, np.float32),
        "mean": np.zeros(task.layout.size, np.float32),
        "std": np.ones(task.layout.size, np.float32),
        "action_std": np.full(task.action_size, 0.4, np.float32),
    }
    sizes = {"observation_size": task.layout.size, "action_size": task.action_size}
    metadata = {"format": FORMAT, "task": task.name, "activation": "tanh"}
    return Network(arrays, metadata | {name: str(size) for name, size in sizes.items()})


def random_observations(n: int = 4, robots: int = 3, seed: int = 1) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(n, robots, OBSERVATION)).astype(np.float32)


def network_input(observations: np.ndarray) -> PolicyInput:
    n, robots = observations.shape[:2]
    return PolicyInput((n, robots, ACTION), None, observations.astype(np.float32))

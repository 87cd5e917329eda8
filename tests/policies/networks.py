"""Networks and their inputs for tests."""

from itertools import pairwise

import numpy as np

from rsoccer.history import ObservationStack
from rsoccer.policies.base import PolicyInput
from rsoccer.policies.heads import CHOOSING
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import FORMAT
from rsoccer.registry import make_task
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


VALUE_NUMBERS = '{"discount": 0.95, "action_repeat": 3, "reward_std": 2.0}'


def with_value(arrays: Arrays, metadata: Metadata) -> tuple[Arrays, Metadata]:
    """The same parts with those of a value network."""
    rng = np.random.default_rng(1)
    arrays["value.0.weight"] = rng.normal(size=(HIDDEN, OBSERVATION)).astype(np.float32)
    arrays["value.0.bias"] = rng.normal(size=HIDDEN).astype(np.float32)
    arrays["value.1.weight"] = rng.normal(size=(1, HIDDEN)).astype(np.float32)
    arrays["value.1.bias"] = rng.normal(size=1).astype(np.float32)
    metadata["value"] = VALUE_NUMBERS
    return arrays, metadata


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


def random_network(kind: str = "gaussian", activation: str = "tanh", history: int = 1) -> Network:
    """A network of random weights for VSS-v0 with a normalization, with some kind of head.

    Args:
        kind: a head, or a kind of deviation of a squashed Gaussian.
        activation: activation between the layers.
        history: observations in a stacked one.
    """
    task = make_task("VSS-v0", discrete=kind in CHOOSING)
    rng = np.random.default_rng(5)
    deviations = {"exp": "exp -20 2", "tanh": "tanh -5 2", "softplus": "softplus 0.54 0.01 0.0001"}
    table = task.action_table
    outputs = task.action_size * 2 if kind in deviations else task.action_size
    size = ObservationStack.of(task, history).size
    sizes = [size, 32, 16, outputs if table is None else len(table)]
    return Network.from_layers(
        task,
        [(rng.normal(0.0, a**-0.5, (b, a)), rng.normal(0.0, 0.3, b)) for a, b in pairwise(sizes)],
        [0.3, 0.4] if kind in ("gaussian", "squashed") else None,
        activation=activation,
        head="squashed" if kind in deviations else kind,
        deviation=deviations.get(kind),
        history=history,
        action_repeat=2,
        mean=rng.normal(0.0, 0.2, size),
        std=rng.uniform(0.3, 1.5, size),
        clip=3.0,
    )


def task_observations(network: Network, n: int = 6) -> np.ndarray:
    """Observations (n, 3, o) from -1 to 1 for a network."""
    rng = np.random.default_rng(2)
    return rng.uniform(-1.0, 1.0, (n, 3, network.observation_size)).astype(np.float32)

"""Agents in the form of CleanRL's scripts as policies."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np

from rsoccer.policies.heads import Deviation
from rsoccer.policies.layers import join_outputs, read_layers
from rsoccer.policies.libraries.parts import (
    Actor,
    Normalization,
    chain,
    conditions_of,
    running_normalization,
    task_of,
)
from rsoccer.policies.network import Network
from rsoccer.task import Task

LOG_STD: Final = (-5.0, 2.0)
"""Bounds of the logarithm of the standard deviation in CleanRL's SAC."""
CLIP: Final = 10.0
"""Bound of normalized observations in CleanRL's scripts."""
_TOLERANCE: Final = 1e-4
"""Difference between the outputs of an agent and of the layers that were read from it."""


def from_cleanrl(
    agent: Any,  # noqa: ANN401  (a module of torch)
    task: Task | str | None = None,
    *,
    envs: Any = None,  # noqa: ANN401
    clip: float = CLIP,
    **settings: Any,  # noqa: ANN401
) -> Network:
    """Return the policy of an agent in the form of CleanRL's scripts.

    | script | parts that are read |
    | --- | --- |
    | `ppo_continuous_action` | `actor_mean`, an `nn.Sequential`, and `actor_logstd` |
    | `ppo` (discrete) | `actor`, an `nn.Sequential` |
    | `sac_continuous_action` | `fc1`, `fc2`, `fc_mean`, `fc_logstd`, with ReLU |
    | `td3_continuous_action`, `ddpg_continuous_action` | `fc1`, `fc2`, `fc_mu`, with ReLU |
    | `dqn` | `network`, an `nn.Sequential` |

    The last three rows are compared with the outputs of the agent itself.

    Args:
        agent: the module: `Agent`, `Actor` or `QNetwork` of the script.
        task: the task of the training, or its name; None for that of `envs`.
        envs: the environments; a `NormalizeObservation` of Gymnasium among their wrappers gives the
            normalization. An agent does not hold it: without `envs` the policy plays without
            normalization, and nothing warns of it.
        clip: bound of normalized observations, above 0.
        **settings: further arguments of `Network.from_layers`, such as `action_repeat`, or `mean`
            and `std` of a normalization of another form.

    Returns:
        A network with a copy of the weights.

    Raises:
        TypeError: an unknown setting.
        ValueError: no task, an agent of another form, or one that does not fit the task.
    """
    if not settings.keys().isdisjoint(("mean", "std")):
        settings["clip"] = clip
    found = task_of(task, envs)
    actor = _actor(agent)
    return actor.network(found, _normalization(envs, clip), {**conditions_of(envs), **settings})


def _actor(agent: Any) -> Actor:  # noqa: ANN401
    """The actor of an agent, by the names of its parts."""
    for parts, read in _FORMS.items():
        if all(hasattr(agent, part) for part in parts):
            return read(agent)
    forms = "; ".join(", ".join(parts) for parts in _FORMS)
    names = ", ".join(name for name, _ in agent.named_children()) or "none"
    raise ValueError(f"agent: expected one with the parts {forms}, got {names}")


def _gaussian(agent: Any) -> Actor:  # noqa: ANN401
    std = agent.actor_logstd.detach().exp().cpu().numpy().reshape(-1)
    return Actor(agent.actor_mean, action_std=std)


def _categorical(agent: Any) -> Actor:  # noqa: ANN401
    return Actor(agent.actor, "categorical")


def _greedy(agent: Any) -> Actor:  # noqa: ANN401
    return Actor(agent.network, "greedy")


def _squashed(agent: Any) -> Actor:  # noqa: ANN401
    """The actor of SAC; its `forward` gives mean and log_std."""
    last = join_outputs(agent.fc_mean, agent.fc_logstd)
    deviation = Deviation("tanh", LOG_STD)
    layers = [*read_layers([agent.fc1])[0], *read_layers([agent.fc2])[0], last]

    def expected(outputs: Any) -> Any:  # noqa: ANN401
        mean, raw = np.split(outputs, 2, axis=-1)
        return np.concatenate([mean, np.log(deviation.of(raw))], axis=-1)

    _check_scale(agent)
    _compare(agent, layers, expected)
    return Actor(layers, "squashed", deviation=deviation, activation="relu")


def _deterministic(agent: Any) -> Actor:  # noqa: ANN401
    """The actor of TD3 and DDPG; its `forward` gives actions."""
    layers = [read_layers([part])[0][0] for part in (agent.fc1, agent.fc2, agent.fc_mu)]
    _check_scale(agent)
    _compare(agent, layers, np.tanh)
    return Actor(layers, "squashed", activation="relu")


_FORMS: Final[dict[tuple[str, ...], Callable[[Any], Actor]]] = {
    ("actor_mean", "actor_logstd"): _gaussian,
    ("actor",): _categorical,
    ("fc1", "fc2", "fc_mean", "fc_logstd"): _squashed,
    ("fc1", "fc2", "fc_mu"): _deterministic,
    ("network",): _greedy,
}


def _check_scale(agent: Any) -> None:  # noqa: ANN401
    """Refuse actions outside [-1, 1]."""
    for name, wanted in (("action_scale", 1.0), ("action_bias", 0.0)):
        value = getattr(agent, name, None)
        if value is not None and not bool((value == wanted).all()):
            raise ValueError(f"agent: expected an {name} of {wanted}, got {value.tolist()}")


def _compare(agent: Any, layers: list[Any], of_outputs: Callable[[Any], Any]) -> None:  # noqa: ANN401
    """Compare an agent's outputs with those of its layers, which may be used in another way."""
    import torch

    size = layers[0][0].shape[1]
    inputs = np.random.default_rng(0).uniform(-2.0, 2.0, (16, size)).astype(np.float32)
    hidden = inputs
    for weight, bias in layers[:-1]:
        hidden = np.maximum(hidden @ weight.T + bias, 0.0)
    expected = of_outputs(hidden @ layers[-1][0].T + layers[-1][1])
    device = next(agent.parameters()).device
    with torch.no_grad():
        given = agent(torch.from_numpy(inputs).to(device))
    parts = given if isinstance(given, tuple) else (given,)
    found = np.concatenate([part.cpu().numpy() for part in parts], axis=-1)
    if found.shape != expected.shape or np.abs(found - expected).max() > _TOLERANCE:
        raise ValueError(
            "agent: expected ReLU after fc1 and fc2, and the outputs of CleanRL's scripts, got an "
            "agent that computes something else; Network.from_layers takes its layers"
        )


def _normalization(envs: object, clip: float) -> Normalization:
    """Normalization of a `NormalizeObservation` in the chain of the environments."""
    for each in chain(envs):
        for candidate in [
            each,
            *(part for env in getattr(each, "envs", [])[:1] for part in chain(env)),
        ]:
            if "obs_rms" in getattr(candidate, "__dict__", {}):
                statistics = candidate.obs_rms
                return running_normalization(
                    statistics.mean, statistics.var, candidate.epsilon, clip
                )
    return Normalization()

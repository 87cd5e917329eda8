"""Models of Stable-Baselines3 as policies."""

from __future__ import annotations

from typing import Any, Final

from rsoccer.policies.heads import Deviation
from rsoccer.policies.layers import join_outputs
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

LOG_STD: Final = (-20.0, 2.0)
"""Bounds of the logarithm of the standard deviation in the library's SAC."""


def from_sb3(
    model: Any,  # noqa: ANN401  (types only where it is installed)
    task: Task | str | None = None,
    *,
    normalize: Any = None,  # noqa: ANN401
    **settings: Any,  # noqa: ANN401
) -> Network:
    """Return the policy of a model of Stable-Baselines3.

    PPO, A2C, SAC, TD3, DDPG and DQN are known, and models of sb3-contrib with the same actors, such
    as TRPO and TQC. Mode "mean" is `predict(deterministic=True)`, mode "sample" what the model
    draws from without it.

    Args:
        model: the model, with "MlpPolicy".
        task: the task of the training, or its name; None for that of the model's environment.
        normalize: a `VecNormalize` whose statistics of observations apply; None for the one around
            the model's environment. A model that was loaded without its environment holds none: the
            policy then plays without normalization, and nothing warns of it.
        **settings: further arguments of `Network.from_layers`, such as `action_repeat`, or `mean`,
            `std` and `clip` of a normalization.

    Returns:
        A network with a copy of the weights.

    Raises:
        TypeError: not such a model, or an unknown setting.
        ValueError: no task, a policy with other parts than linear layers and an activation, state-
            dependent exploration (gSDE), or a model that does not fit the task.
    """
    policy = getattr(model, "policy", None)
    if policy is None:
        raise TypeError(f"model: expected one of Stable-Baselines3, got {type(model).__name__}")
    env = model.get_env()
    found = task_of(task, env)
    if getattr(model, "use_sde", False):
        raise ValueError("model: expected one without use_sde, whose noise depends on layers")
    actor = _actor(policy)
    normalization = _normalization(env if normalize is None else normalize)
    return actor.network(found, normalization, {**conditions_of(env), **settings})


def _actor(policy: Any) -> Actor:  # noqa: ANN401
    """The actor of a policy, by the parts that it has."""
    if hasattr(policy, "mlp_extractor"):
        _check_extractor(policy.pi_features_extractor)
        layers = [*policy.mlp_extractor.policy_net, policy.action_net]
        if hasattr(policy, "log_std"):
            return Actor(layers, action_std=policy.log_std.detach().exp().cpu().numpy())
        return Actor(layers, "categorical")
    actor = getattr(policy, "actor", None)
    if actor is not None and hasattr(actor, "latent_pi"):
        _check_extractor(actor.features_extractor)
        last = join_outputs(actor.mu, actor.log_std)
        return _joined(actor.latent_pi, last)
    if actor is not None:
        _check_extractor(actor.features_extractor)
        *layers, squash = actor.mu
        if type(squash).__name__ != "Tanh":
            raise ValueError(f"model: expected an actor that ends in Tanh, got {squash}")
        return Actor(layers, "squashed")
    if hasattr(policy, "q_net"):
        _check_extractor(policy.q_net.features_extractor)
        return Actor(policy.q_net.q_net, "greedy")
    raise ValueError(f"model: expected an actor or Q-values, got {type(policy).__name__}")


def _joined(body: Any, last: Any) -> Actor:  # noqa: ANN401
    """Actor of hidden layers, which end in an activation, and one layer of outputs."""
    from torch import nn, tensor

    linear = nn.Linear(last[0].shape[1], last[0].shape[0])
    linear.weight.data, linear.bias.data = tensor(last[0]), tensor(last[1])
    return Actor([*body, linear], "squashed", deviation=Deviation("exp", LOG_STD))


def _check_extractor(extractor: Any) -> None:  # noqa: ANN401
    """Refuse features other than the observation itself."""
    name = type(extractor).__name__
    if name != "FlattenExtractor":
        raise ValueError(f"model: expected the features of MlpPolicy, FlattenExtractor, got {name}")


def _normalization(env: object) -> Normalization:
    """Normalization of a `VecNormalize` in the chain of an environment."""
    for each in chain(env):
        if hasattr(each, "obs_rms") and hasattr(each, "norm_obs"):
            if not each.norm_obs:
                return Normalization()
            statistics = each.obs_rms
            return running_normalization(
                statistics.mean, statistics.var, each.epsilon, each.clip_obs
            )
    return Normalization()

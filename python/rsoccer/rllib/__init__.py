"""RLlib: a multi-agent environment, and a runner that steps many matches as arrays.

>>> from ray.rllib.algorithms.ppo import PPOConfig  # doctest: +SKIP
>>> from rsoccer.rllib import MatchesEnvRunner, SoccerMultiAgentEnv  # doctest: +SKIP
>>> config = (  # doctest: +SKIP
...     PPOConfig()
...     .environment(SoccerMultiAgentEnv, env_config={"task": "VSSSelfPlay-v0"})
...     .env_runners(env_runner_cls=MatchesEnvRunner, num_envs_per_env_runner=32)
...     .multi_agent(policies={"shared"}, policy_mapping_fn=lambda *_, **__: "shared")
... )

It needs RLlib and torch: `pip install "ray[rllib]>=2.60" torch`.
"""

try:
    import ray.rllib  # noqa: F401
    import torch  # noqa: F401
except ImportError as error:
    raise ImportError(
        'rsoccer.rllib needs RLlib and torch: pip install "ray[rllib]>=2.60" torch'
    ) from error

from rsoccer.rllib.callback import EvaluationCallback
from rsoccer.rllib.env import MetricsCallback, SoccerMultiAgentEnv
from rsoccer.rllib.league import League
from rsoccer.rllib.runner import MatchesEnvRunner

__all__ = ["EvaluationCallback", "League", "MatchesEnvRunner", "MetricsCallback"]
__all__ += ["SoccerMultiAgentEnv"]

"""Many matches for Stable-Baselines3, with a row for each robot that learns.

>>> from stable_baselines3 import PPO  # doctest: +SKIP
>>> from rsoccer.sb3 import SoccerVecEnv  # doctest: +SKIP
>>> envs = SoccerVecEnv("VSS-v0", worlds=64, threads=2)  # doctest: +SKIP
>>> PPO("MlpPolicy", envs, n_steps=128, batch_size=2048).learn(200_000)  # doctest: +SKIP

`SoccerVecNormalize` is the library's `VecNormalize` with compiled statistics. `EvaluationCallback`
plays the model against named opponents while it learns.

It needs Stable-Baselines3: `pip install "stable-baselines3>=2.4"`.
"""

try:
    import stable_baselines3  # noqa: F401
except ImportError as error:
    raise ImportError(
        'rsoccer.sb3 needs Stable-Baselines3: pip install "stable-baselines3>=2.4"'
    ) from error

from rsoccer.sb3.callback import EvaluationCallback
from rsoccer.sb3.vec_env import SoccerVecEnv
from rsoccer.sb3.vec_normalize import SoccerVecNormalize

__all__ = ["EvaluationCallback", "SoccerVecEnv", "SoccerVecNormalize"]

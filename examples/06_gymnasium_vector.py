"""Many matches through Gymnasium's vector interface, with explicit resets of ended episodes."""

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode

import rsoccer  # noqa: F401  (registers the environment ids)

envs = gymnasium.make_vec(
    "rsoccer/VSS-v0",
    num_envs=64,
    vectorization_mode="vector_entry_point",
    threads=2,
    autoreset_mode=AutoresetMode.DISABLED,  # the default resets automatically, one step later
    max_steps=200,
    opponent="chase",
)
observations, infos = envs.reset(seed=0)
envs.action_space.seed(0)
scores: list[float] = []
for _ in range(400):
    actions = envs.action_space.sample()
    observations, rewards, terminations, truncations, infos = envs.step(actions)
    ended = terminations | truncations
    if ended.any():
        scores += infos["goal_score"][ended].tolist()
        observations, infos = envs.reset(options={"reset_mask": ended})
print(f"{len(scores)} matches ended, mean goal score {np.mean(scores):+.2f}")
envs.close()

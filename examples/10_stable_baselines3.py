"""PPO of Stable-Baselines3 on VSSS: 64 matches, in which every robot that learns is a row."""

import sys

import numpy as np
from stable_baselines3 import PPO

from rsoccer.sb3 import SoccerVecEnv


def main(matches: int = 64, steps: int = 200_000) -> None:
    """Train for a while and print the mean goal score of the last matches."""
    envs = SoccerVecEnv("VSS-v0", matches, threads=2)
    model = PPO(
        "MlpPolicy", envs, n_steps=128, batch_size=32 * matches, n_epochs=5, seed=0, device="cpu"
    )
    model.learn(steps)
    scores = [episode["goal_score"] for episode in model.ep_info_buffer]
    score = f"{np.mean(scores):+.2f}" if scores else "unknown (no match ended)"
    print(f"{model.num_timesteps:,} steps; goal score of the last {len(scores)} matches: {score}")
    envs.close()


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))

"""A mixed team through PettingZoo: actions for one robot, policies for the others."""

import numpy as np

import rsoccer

controllers = {
    "blue_1": "chase",
    "blue_2": "zero",  # or the path of a trained policy
    "yellow": "ou",
}
env = rsoccer.parallel_env("VSSSelfPlay-v0", controllers=controllers, max_steps=400)
print("agents that need actions:", env.possible_agents)

scores = []
for match in range(6):
    observations, infos = env.reset(seed=match)
    episode_return = 0.0
    while env.agents:
        actions = {
            agent: np.array([0.3, 0.5], np.float32) for agent in env.agents
        }  # drive in circles
        observations, rewards, terminations, truncations, infos = env.step(actions)
        episode_return += rewards["blue_0"]
    scores.append(env.last_metrics["goal_score"])
print(f"mean goal score of blue {np.mean(scores):+.1f}; last return {episode_return:+.2f}")
env.close()

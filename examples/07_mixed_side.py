"""A side of three kinds through PettingZoo: one robot is yours, the others follow policies."""

import numpy as np

import rsoccer

controllers = {
    "blue_1": "chase",
    "blue_2": "zero",  # or the path of a policy that was trained
    "yellow": "ou",
}
env = rsoccer.parallel_env("VSSSelfPlay-v0", controllers=controllers, max_steps=400)
print("to be driven from here:", env.possible_agents)

scores = []
for match in range(6):
    observations, infos = env.reset(seed=match)
    total = 0.0
    while env.agents:
        actions = {agent: np.array([0.3, 0.5], np.float32) for agent in env.agents}  # in circles
        observations, rewards, terminations, truncations, infos = env.step(actions)
        total += rewards["blue_0"]
    scores.append(env.last_metrics["goal_score"])
print(f"blue's goal score in 6 matches: {np.mean(scores):+.1f}; the last paid {total:+.2f}")
env.close()

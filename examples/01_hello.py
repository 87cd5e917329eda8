"""One match of six robots with random actions, through PettingZoo's parallel interface."""

import rsoccer

env = rsoccer.parallel_env("VSSSelfPlay-v0", max_steps=400)
observations, infos = env.reset(seed=7)
returns = dict.fromkeys(env.agents, 0.0)
while env.agents:
    actions = {agent: env.action_space(agent).sample() for agent in env.agents}
    observations, rewards, terminations, truncations, infos = env.step(actions)
    for agent, reward in rewards.items():
        returns[agent] += reward
for agent, episode_return in returns.items():
    print(f"{agent:<9} observation size {len(observations[agent])}, return {episode_return:+.3f}")
env.close()

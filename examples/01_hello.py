"""One match of six robots that act at random, through PettingZoo's own interface."""

import rsoccer

env = rsoccer.parallel_env("VSSSelfPlay-v0", max_steps=400)
observations, infos = env.reset(seed=7)
totals = dict.fromkeys(env.agents, 0.0)
while env.agents:
    actions = {agent: env.action_space(agent).sample() for agent in env.agents}
    observations, rewards, terminations, truncations, infos = env.step(actions)
    for agent, reward in rewards.items():
        totals[agent] += reward
for agent, total in totals.items():
    print(f"{agent:<9} {len(observations[agent])} numbers seen, {total:+.3f} earned")
env.close()

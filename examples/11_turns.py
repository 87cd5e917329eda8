"""PettingZoo's AEC interface: agents act one after the other, in turns."""

import rsoccer

env = rsoccer.env("VSSSelfPlay-v0", max_steps=200)
env.reset(seed=0)
rewards = dict.fromkeys(env.possible_agents, 0.0)
for agent in env.agent_iter():
    observation, reward, terminated, truncated, info = env.last()
    rewards[agent] += reward
    ended = terminated or truncated
    env.step(None if ended else env.action_space(agent).sample())
for agent, total in rewards.items():
    print(f"{agent} {total:+.2f}")

"""One robot through Gymnasium: a scripted policy drives to the ball and faces it."""

import gymnasium
import numpy as np

import rsoccer  # registers the environment ids

env = gymnasium.make("rsoccer/SSLGoToBall-v0")
blocks = rsoccer.make_task("SSLGoToBall-v0").layout.blocks  # columns of each observation block
ego, ball = blocks["ego"].columns.start, blocks["ball"].columns.start
sine = blocks["ball_polar"].columns.start + 2  # sine of the ball's bearing

reached = 0
for episode in range(20):
    observation, info = env.reset(seed=episode)
    ended = False
    while not ended:
        offset = observation[ball : ball + 2] - observation[ego : ego + 2]
        behind = observation[sine - 1] < 0
        turn = np.sign(observation[sine]) if behind else observation[sine]
        x, y = 0.3 * offset / np.linalg.norm(offset) * (0.0 if behind else 1.0)
        action = np.array([x, y, 0.5 * turn, -1.0, -1.0], np.float32)  # no kick, no dribbler
        observation, reward, terminated, truncated, info = env.step(action)
        ended = terminated or truncated
    reached += int(info["reached"])
print(f"reached the ball in {reached} of 20 episodes")
env.close()

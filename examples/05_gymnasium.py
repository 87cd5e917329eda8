"""One robot through Gymnasium: it drives straight to the ball, turning its mouth towards it."""

import gymnasium
import numpy as np

import rsoccer  # makes the ids known

env = gymnasium.make("rsoccer/SSLGoToBall-v0")
blocks = rsoccer.make_task("SSLGoToBall-v0").blocks  # where each part of what is seen lies
ego, ball = blocks["ego"].columns.start, blocks["ball"].columns.start
sine = blocks["ball_polar"].columns.start + 2  # of the angle between the ball and straight ahead

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
print(f"got to the ball in {reached} of 20 episodes")
env.close()

"""The paper's entities: robots by team and number, angles in degrees."""

import numpy as np

import rsoccer
from rsoccer import entities

task = rsoccer.make_task("VSSSelfPlay-v0")
matches = rsoccer.Matches(task, seed=0)
matches.reset()
state = entities.from_frame(matches.frame, 0)
parameters = entities.FieldParameters.from_config(task.config)
print(f"a goal is {parameters.goal_width} m wide")

ball, robot = state.ball, state.robots_blue[0]
robot.x, robot.y, robot.theta = ball.x - 0.1, ball.y, 0.0  # behind the ball, facing yellow's goal
matches.reset(rows=entities.to_row(state, task.n_blue, task.n_yellow)[None])

actions = np.zeros((1, len(matches.agents), task.action_size), np.float32)
actions[0, 0] = 1.0  # blue 0 drives forward
for _ in range(20):
    matches.step(actions)
print(entities.from_frame(matches.frame, 0))

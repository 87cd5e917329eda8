"""The paper's objects, for code that thinks in them: robots by colour and number, in degrees."""

import numpy as np

import rsoccer
from rsoccer import entities

task = rsoccer.make_task("VSSSelfPlay-v0")
matches = rsoccer.Matches(task, seed=0)
matches.reset()
moment = entities.of(matches.frame, 0)
print(f"a goal is {entities.Field.of(task.config).goal_width} m wide")

ball, first = moment.ball, moment.robots_blue[0]
first.x, first.y, first.theta = ball.x - 0.1, ball.y, 0.0  # behind the ball, facing their goal
matches.reset(rows=entities.to_row(moment, task.n_blue, task.n_yellow)[None])

actions = np.zeros((1, len(matches.agents), task.action_size), np.float32)
actions[0, 0] = 1.0  # blue 0 drives on
for _ in range(20):
    matches.step(actions)
print(entities.of(matches.frame, 0))

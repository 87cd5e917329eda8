"""Code for rSim (rc-robosim 1.2) with one import changed: push the ball into the goal."""

import numpy as np

from rsoccer.compat import robosim  # was: import robosim

FIELD_3V3, STEP_MS = 0, 25
ball, blue, yellow = [0.0, 0.1, 0.0, 0.0], [[-0.4, 0.0, 90.0]], [[0.4, 0.4, 180.0]]
simulator = robosim.VSS(FIELD_3V3, 1, 1, STEP_MS, ball, blue, yellow)
field = simulator.get_field_params()
max_speed = field["rbt_motor_max_rpm"] / 60 * 2 * np.pi  # rad/s

for step in range(400):
    ball_x, ball_y, *_ = state = simulator.get_state()
    x, y, degrees = state[5:8]  # of blue 0
    if ball_x > field["length"] / 2:
        print(f"goal after {step * STEP_MS / 1000:.2f} s")
        break
    to_goal = np.array([field["length"] / 2 - ball_x, -ball_y])
    behind = np.array([ball_x, ball_y]) - 0.12 * to_goal / np.linalg.norm(to_goal)
    target = behind if x < behind[0] - 0.05 else np.array([ball_x, ball_y])
    bearing = np.degrees(np.arctan2(target[1] - y, target[0] - x)) - degrees
    turn = np.clip(((bearing + 180) % 360 - 180) / 180, -0.5, 0.5)
    commands = np.zeros((2, 2))  # a row for each robot, blue first: left and right wheel, rad/s
    commands[0] = max_speed * np.array([0.5 - turn, 0.5 + turn])
    simulator.step(commands)
else:
    print("no goal in 10 s")

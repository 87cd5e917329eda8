"""Environments in the style of rSim (rc-robosim 1.2): its interface only, states by index."""

import random
from collections.abc import Callable
from types import ModuleType

import numpy as np

State = np.ndarray


class PushBall:
    """VSS: blue 0 takes the ball to the goal at +x; two others stand at random places."""

    def __init__(self, robosim: ModuleType, seed: int) -> None:
        self.random = random.Random(seed)
        start = [0, 0, 0, 0], [[-0.2, 0, 0], [-0.4, 0, 0]], [[0.2, 0, 0]]
        self.sim = robosim.VSS(0, 2, 1, 25, *start)
        self.field = self.sim.get_field_params()
        self.max_wheel = self.field["rbt_motor_max_rpm"] / 60 * 2 * np.pi

    def reset(self) -> State:
        across = self.random.uniform(0.3, 0.5)
        blue = [[-0.4, 0.0, 0.0], [-0.6, across, self.random.uniform(0, 360)]]
        yellow = [[0.2, -across, self.random.uniform(0, 360)]]
        self.sim.reset(np.array([-0.1, 0.0, 0.0, 0.0]), np.array(blue), np.array(yellow))
        return np.array(self.sim.get_state())

    def step(self, action: State) -> tuple[State, bool]:
        wheels = np.zeros((3, 2))
        wheels[0] = np.clip(action, -1, 1) * self.max_wheel
        self.sim.step(wheels)
        state = np.array(self.sim.get_state())
        return state, bool(state[0] > self.field["length"] / 2)


class FetchAndShoot:
    """SSL hardware challenge: blue 0 starts with the ball, turns to the goal and shoots."""

    def __init__(self, robosim: ModuleType, seed: int) -> None:
        self.random = random.Random(seed)
        self.sim = robosim.SSL(2, 1, 0, 25, [0, 0, 0, 0], [[-0.2, 0, 0]], [])
        self.field = self.sim.get_field_params()

    def reset(self) -> State:
        angle = self.random.uniform(100, 260)
        ahead = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
        ball = np.array([1.0, 0.0]) + 0.1 * ahead  # 2.5 mm inside the kicker
        self.sim.reset(np.array([*ball, 0, 0]), np.array([[1.0, 0.0, angle]]), np.array([]))
        return np.array(self.sim.get_state())

    def step(self, action: State) -> tuple[State, bool]:
        command = np.zeros((1, 8))
        command[0, 3], command[0, 5], command[0, 7] = action
        self.sim.step(command)
        state = np.array(self.sim.get_state())
        inside = abs(state[1]) < self.field["goal_width"] / 2
        return state, bool(state[0] > self.field["length"] / 2 and inside)


def to_goal(state: State) -> State:
    """VSS: drive forward, turning back to the x axis."""
    angle = (state[5 + 2] + 180) % 360 - 180
    aim = np.degrees(np.arctan2(-state[5 + 1], 0.3))
    turn = (aim - angle) / 180
    return np.array([0.6 - turn, 0.6 + turn])


def turn_and_shoot(state: State) -> State:
    """SSL: turn slowly to +x with the dribbler on, then kick."""
    angle = (state[5 + 2] + 180) % 360 - 180
    if abs(angle) < 3.0:
        return np.array([0.0, 5.0, 0.0])
    return np.array([-np.sign(angle) * min(1.5, abs(angle) / 20), 0.0, 1.0])


def play(env: PushBall | FetchAndShoot, policy: Callable[[State], State]) -> tuple[State, bool]:
    """All states of an episode of at most 400 steps, and whether the episode ended in a goal."""
    states, done = [env.reset()], False
    while not done and len(states) <= 400:
        state, done = env.step(policy(states[-1]))
        states.append(state)
    return np.array(states), done

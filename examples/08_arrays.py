"""Array interface: many matches of two teams, and saving and restoring of their state."""

import numpy as np

from rsoccer import Matches
from rsoccer.arrays import Floats

WORLDS = 64
matches = Matches("VSSSelfPlay-v0", WORLDS, seed=3, threads=2, controllers={"yellow": "ou"})
observations = matches.reset()  # (worlds, agents, features)
print(f"agents {matches.agents}, observations {observations.shape}")


def drive(observations: Floats, steps: int) -> tuple[Floats, float]:
    """Drive all robots toward the ball; return the last observations and the mean reward."""
    sine = matches.task.layout.blocks["ball_polar"].columns.start + 2
    mean_reward = 0.0
    for _ in range(steps):
        turn = np.clip(observations[..., sine], -1, 1)
        outcome = matches.step(np.stack([0.6 - turn, 0.6 + turn], axis=-1))
        observations = outcome.observations
        mean_reward += float(outcome.rewards.mean()) / steps
    return observations, mean_reward


observations = drive(observations, 20)[0]
state = matches.state_dict()
first = drive(observations, 100)[1]
matches.load_state_dict(state)
again = drive(observations, 100)[1]
print(f"mean reward {first:+.5f}; repeated from the same state {again:+.5f}")

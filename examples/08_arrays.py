"""Arrays in, arrays out: many matches of two teams, and a state to which all of them return."""

import numpy as np

from rsoccer import Matches
from rsoccer.frame import Floats

WORLDS = 64
matches = Matches("VSSSelfPlay-v0", WORLDS, seed=3, threads=2, controllers={"yellow": "ou"})
observations = matches.reset()  # (worlds, agents, numbers)
print(f"{matches.agents} see {observations.shape}")


def drive(seen: Floats, steps: int) -> tuple[Floats, float]:
    """Each robot turns to the ball as it drives; what is seen then, and earned a step."""
    left = matches.task.blocks["ball_polar"].columns.start + 2
    earned = 0.0
    for _ in range(steps):
        turn = np.clip(seen[..., left], -1, 1)
        outcome = matches.step(np.stack([0.6 - turn, 0.6 + turn], axis=-1))
        seen = outcome.observations
        earned += float(outcome.rewards.mean()) / steps
    return seen, earned


seen = drive(observations, 20)[0]
state = matches.state_dict()
first = drive(seen, 100)[1]
matches.load_state_dict(state)
again = drive(seen, 100)[1]
print(f"a step earned {first:+.5f}; again from the same state: {again:+.5f}")

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.policies.base import PolicyInput
from rsoccer.policies.noise import OrnsteinUhlenbeck
from rsoccer.rng import WorldRng
from rsoccer.tasks import VssSelfPlay


def test_ou_starts_at_zero_and_follows_its_equation() -> None:
    theta, sigma, dt = 0.17, 0.5, 0.025
    n, steps = 4000, 400
    policy = OrnsteinUhlenbeck()
    rng = WorldRng.seeded(0, n)
    memory = policy.new_memory((n, 1, 2), rng)
    walk = np.empty((steps, n, 2))
    for step in range(steps):
        action = policy.act(PolicyInput((n, 1, 2), None, None), rng, memory)
        walk[step] = memory["walk"][:, 0]
        assert (action == np.clip(memory["walk"], -1.0, 1.0)).all()
    keep = 1.0 - theta * dt
    variance = sigma**2 * dt * (1 - keep ** (2 * np.arange(1, steps + 1))) / (1 - keep**2)
    assert np.abs(walk.var(axis=(1, 2)) / variance - 1.0).max() < 0.1
    assert np.abs(walk.mean(axis=(1, 2))).max() < 0.05
    slope = np.polyfit(walk[-2].ravel(), walk[-1].ravel(), 1)[0]
    assert slope == pytest.approx(keep, abs=0.003)
    assert np.abs(walk[-1]).max() > 1.0, "actions are clipped, the state is not"


def test_ou_restarts_at_zero_with_a_new_episode() -> None:
    matches = Matches(VssSelfPlay(max_steps=30), 2, controllers={"all": "ou"})
    matches.reset()
    no_actions = np.zeros((2, 0, 2), np.float32)
    deviation = 0.5 * 0.025**0.5  # of the first step from zero
    for _ in range(31):
        matches.step(no_actions)
    assert np.abs(matches.play.actions).max() < 6 * deviation

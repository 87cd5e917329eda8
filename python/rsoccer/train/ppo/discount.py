"""Schedule of the discount factor.

A short horizon is learned fast, but it rewards haste: with .99 per control step of 25 ms, a goal a
second later is worth a third less, so a shot at once that often fails beats a sure one. A horizon
that grows during the run has both advantages, as in OpenAI Five (Berner et al., 2019).
"""

from __future__ import annotations

from rsoccer.train.ppo.settings import PpoSettings


def discount_per_decision(settings: PpoSettings, action_repeat: int, progress: float) -> float:
    """Return the discount factor per decision.

    From `gamma` to `final_gamma`, the horizon 1 / (1 - discount) changes geometrically.

    Args:
        settings: settings of PPO.
        action_repeat: control steps per decision.
        progress: share of the run's samples so far, 0 to 1.
    """
    first, last = settings.gamma, settings.final_gamma
    per_step = first
    if last is not None:
        per_step = 1.0 - (1.0 - first) ** (1.0 - progress) * (1.0 - last) ** progress
    return float(per_step**action_repeat)

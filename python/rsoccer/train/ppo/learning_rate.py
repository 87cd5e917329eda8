"""Schedules of the learning rate.

The adaptive schedule follows the KL divergence, as in rl_games and RSL-RL. The divergence of an
update grows with the width of the networks and, for equal mean actions, with the inverse square of
the spread, so no fixed rate suits a whole run.
"""

from __future__ import annotations

from typing import Final

from rsoccer.train.ppo.settings import PpoSettings

TARGET_KL: Final = 0.02
"""KL divergence from the policy that played at which the passes over a batch stop."""
DECREASE: Final = 1.1
"""Factor by which the rate falls after an update that the KL divergence cut short."""
INCREASE: Final = 1.05
"""Factor by which the rate rises after an update that changed the policy little."""
LITTLE: Final = 0.7
"""Share of `TARGET_KL` below which a full update changed the policy little."""
BOUNDS: Final = (1e-5, 1e-2)
"""Least and greatest adaptive rate."""
FINAL_SHARE: Final = 0.1
"""Rate at the end of a run, relative to that at the start, in the linear schedule."""


class LearningRate:
    """Learning rate of a run.

    Attributes:
        value: step size of the next update.
    """

    def __init__(self, settings: PpoSettings) -> None:
        """Begin with the rate of the settings.

        Args:
            settings: settings of PPO.
        """
        self._settings = settings
        self.value = settings.learning_rate

    def start_update(self, progress: float) -> float:
        """Return the step size of an update.

        Args:
            progress: share of the run's samples after this update, 0 to 1.
        """
        if self._settings.learning_rate_schedule == "linear":
            self.value = self._settings.learning_rate * (1.0 - (1.0 - FINAL_SHARE) * progress)
        return self.value

    def end_update(self, n_epochs: float, approx_kl: float) -> None:
        """Adapt the rate to an update.

        Args:
            n_epochs: passes over the batch.
            approx_kl: KL divergence in the last of them.
        """
        if self._settings.learning_rate_schedule == "linear":
            return
        if n_epochs < self._settings.n_epochs:
            self.value = max(self.value / DECREASE, BOUNDS[0])
        elif approx_kl < LITTLE * TARGET_KL:
            self.value = min(self.value * INCREASE, BOUNDS[1])

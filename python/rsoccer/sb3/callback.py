"""Evaluations against named opponents while a model of Stable-Baselines3 learns."""

from __future__ import annotations

from typing import Any

from stable_baselines3.common.callbacks import BaseCallback

from rsoccer.match_evaluation import MatchEvaluation, StopWhen
from rsoccer.policies.libraries import from_sb3


class EvaluationCallback(BaseCallback):  # type: ignore[misc]
    """Plays the model against named opponents at intervals, and logs its scores.

    Scores are in the model's logger, such as `evaluation/goal_score_ou`, beside its own values.

    Example:
        >>> from rsoccer.match_evaluation import MatchEvaluation
        >>> measured = MatchEvaluation(("ou", "scripted"), every=100_000)
        >>> model.learn(1_000_000, EvaluationCallback(measured))  # doctest: +SKIP
    """

    def __init__(
        self,
        evaluation: MatchEvaluation,
        *,
        stop_when: StopWhen | None = None,
        **settings: Any,  # noqa: ANN401
    ) -> None:
        """Choose the evaluation.

        Args:
            evaluation: opponents, intervals in rows of the environment, and the folder of pages.
            stop_when: function of the scores by name that ends the training by True.
            **settings: further arguments of `from_sb3`, such as `action_repeat`.
        """
        super().__init__()
        self.evaluation, self._stop_when, self._settings = evaluation, stop_when, settings

    def _on_step(self) -> bool:
        """Play if it is due; return False to end the training."""
        settings = {**self.evaluation.naming, **self._settings}
        scores = self.evaluation(lambda: from_sb3(self.model, **settings), self.num_timesteps)
        for name, score in scores.items():
            self.logger.record(name, score)
        return not (scores and self._stop_when is not None and self._stop_when(scores))

"""Evaluations against named opponents while an algorithm of RLlib learns."""

from __future__ import annotations

from typing import Any, Final

from rsoccer.match_evaluation import PREFIX, MatchEvaluation
from rsoccer.policies.libraries import from_rllib

_STEPS: Final = "num_env_steps_sampled_lifetime"


class EvaluationCallback:
    """Plays a module against named opponents at intervals, as RLlib's callback `on_train_result`.

    Scores are in `result["evaluation_matches"]`, such as `goal_score_ou`, in iterations with an
    evaluation. Trainings with Ray Tune can stop by them.

    Example:
        >>> from rsoccer.match_evaluation import MatchEvaluation
        >>> measured = MatchEvaluation(("ou", "scripted"), every=100_000)
        >>> config.callbacks(on_train_result=EvaluationCallback(measured))  # doctest: +SKIP
    """

    def __init__(
        self,
        evaluation: MatchEvaluation,
        *,
        module: str | None = None,
        **settings: Any,  # noqa: ANN401
    ) -> None:
        """Choose the evaluation.

        Args:
            evaluation: opponents, intervals in steps of matches, and the folder of pages.
            module: name of the module, such as "shared"; None for the only one.
            **settings: further arguments of `from_rllib`, such as `action_repeat`.
        """
        self.evaluation, self._module, self._settings = evaluation, module, settings

    def __call__(self, algorithm: Any, result: dict[str, Any], **kwargs: Any) -> None:  # noqa: ANN401
        """Play if it is due, and add the scores to the result.

        Args:
            algorithm: the algorithm.
            result: result of the iteration, which gets the scores.
            **kwargs: ignored.
        """
        samples = int(result.get("env_runners", {}).get(_STEPS, 0))
        settings = {**self.evaluation.naming, **self._settings}
        scores = self.evaluation(
            lambda: from_rllib(algorithm, module=self._module, **settings), samples
        )
        if scores:
            result["evaluation_matches"] = {
                name.removeprefix(PREFIX): score for name, score in scores.items()
            }

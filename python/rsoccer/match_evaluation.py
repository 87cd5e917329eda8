"""Evaluations during a training, in any library: scores against named opponents, and match pages.

`MatchEvaluation` is called with the policy and the samples so far. `rsoccer.sb3.EvaluationCallback`
and `rsoccer.rllib.EvaluationCallback` do so for these libraries; `rsoccer.train.train` takes a
callback from which it can be called.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Final

from rsoccer import checks
from rsoccer.evaluate import Evaluation, evaluate, matches_per_side
from rsoccer.files import as_path
from rsoccer.lineup import lineup, opponents_of, task_for
from rsoccer.matches import Matches
from rsoccer.policies import Policy, PolicyLike, check_policy_like, name_of, trained_on
from rsoccer.policies.labels import labels
from rsoccer.randomization import Ranges
from rsoccer.randomization import check as check_ranges
from rsoccer.registry import as_task
from rsoccer.replay.recorder import record_replay
from rsoccer.sources import SensingSource, make_sensing
from rsoccer.task import LEARN, Task

PREFIX: Final = "evaluation/"
"""Begin of the names of scores."""
OWN: Final = "default"
"""Name in scores of the opponents that the task has by default."""

StopWhen = Callable[[Mapping[str, float]], bool]
"""Function of the scores by name that says whether the training should end."""


class MatchEvaluation:
    """Plays a policy against named opponents at intervals, and writes a page of a match.

    Scores are named `evaluation/<metric>_<opponent>`, such as `evaluation/goal_score_ou`. The
    matches are the same each time. They change nothing in the training, whose random streams are
    others.

    Attributes:
        results: samples and evaluations of each call that was due, in order.
        pages: pages of matches that were written, in order.

    Example:
        >>> measured = MatchEvaluation(("ou", "scripted"), every=100_000)
        >>> measured.is_due(50_000)
        True
        >>> scores = measured(policy, 50_000)  # doctest: +SKIP
    """

    def __init__(
        self,
        opponents: Sequence[PolicyLike] = (),
        *,
        every: int = 1,
        matches: int = 40,
        seed: int = 0,
        task: Task | str | None = None,
        folder: Path | str | None = None,
        seconds: float = 30.0,
        threads: int | None = None,
        sensing: SensingSource | None = None,
        randomization: Ranges | None = None,
    ) -> None:
        """Choose opponents and intervals.

        What depends on the task is checked here if `task` is given, else with the first policy.

        Args:
            opponents: policies of the other team, their names or files; none for those that the
                task has by default.
            every: samples between evaluations, at least 1.
            matches: matches against each opponent, at least 1, even in two-sided tasks.
            seed: seed of the matches, at least 0.
            task: the task to play; None for the one that the policy was trained on, without options
                for training alone.
            folder: existing folder for pages of matches; None for none.
            seconds: duration of the match on a page, s, above 0.
            threads: threads of the simulator, at least 1; None for all.
            sensing: what robots know of the true state, as for `Matches`.
            randomization: numbers that each episode draws, as for `Matches`.

        Raises:
            FileNotFoundError: no such policy file among the opponents.
            ImportError: a text "module:name" whose module or name does not exist.
            TypeError: an argument of the wrong type.
            ValueError: a number out of range, an odd number of matches in a two-sided task, an
                unknown task, opponent or preset, one that does not fit the task, or no such folder.
        """
        self.opponents = _checked_opponents(opponents)
        self.every = checks.integer("every", every, 1)
        self.matches = checks.integer("matches", matches, 1)
        self.seed = checks.integer("seed", seed, 0)
        self.task = None if task is None else as_task(task)
        self.folder = None if folder is None else _checked_folder(folder)
        self.seconds = checks.positive_number("seconds", seconds)
        self.threads = None if threads is None else checks.integer("threads", threads, 1)
        make_sensing(sensing)  # it refuses what is none
        if randomization is not None:
            check_ranges(randomization)
        self.sensing, self.randomization = sensing, randomization
        if self.task is not None:
            self._check_matches(self.task)
        self.results: list[tuple[int, list[Evaluation]]] = []
        self.pages: list[Path] = []
        self._due_at, self._last_samples = 0, 0

    @property
    def naming(self) -> dict[str, str]:
        """Argument of `Network.from_layers` with which a policy needs no registered task.

        It is there where `task` is given, as then the name in the policy is not used.
        """
        return {} if self.task is None else {"task_name": self.task.name}

    def _check_matches(self, task: Task) -> None:
        """Refuse what cannot be played in a task."""
        matches_per_side(task, self.matches)
        for opponent in self.opponents or (None,):
            Matches(
                task,
                controllers=lineup(task, LEARN, opponent),
                sensing=self.sensing,
                randomization=self.randomization,
            ).close()

    def is_due(self, samples: int) -> bool:
        """Return whether the policy should be played: at first, and `every` samples later.

        A smaller number than the one before belongs to a training that has begun again, as a second
        `learn` of Stable-Baselines3 does; the policy is then played at once.

        Args:
            samples: samples of the training so far.
        """
        if samples < self._last_samples:
            self._due_at = 0
        self._last_samples = samples
        return samples >= self._due_at

    def __call__(self, policy: Policy | Callable[[], Policy], samples: int) -> dict[str, float]:
        """Play the policy if it is due.

        Args:
            policy: the policy, or a function that returns it, which is called if it is due.
            samples: samples of the training so far.

        Returns:
            Mean scores by name; empty if it is not due.

        Raises:
            ValueError: an opponent that is unknown or does not fit the task.
        """
        if not self.is_due(samples):
            return {}
        self._due_at = samples + self.every
        player = policy if isinstance(policy, Policy) else policy()
        task = self.task or trained_on(player) or task_for(player)
        evaluations = [
            evaluate(
                player,
                opponent,
                self.matches,
                self.seed,
                task=task,
                threads=self.threads,
                sensing=self.sensing,
                randomization=self.randomization,
            )
            for opponent in self.opponents or (None,)
        ]
        self.results.append((samples, evaluations))
        if self.folder is not None:
            self.pages.append(self._page(player, task, samples))
        names = labels(self.opponents) or [OWN]
        return {
            f"{PREFIX}{each.metric}_{name}": each.score
            for name, each in zip(names, evaluations, strict=True)
        }

    def _page(self, policy: Policy, task: Task, samples: int) -> Path:
        """Page of a match against the last, and usually strongest, of the opponents."""
        assert self.folder is not None
        opponent = self.opponents[-1] if self.opponents else None
        other = " ".join(opponents_of(task)) if opponent is None else name_of(opponent)
        replay = record_replay(
            task,
            lineup(task, policy, opponent),
            self.seed,
            self.seconds,
            names=(f"{samples:,} SAMPLES", other.upper()),
            sensing=self.sensing,
            randomization=self.randomization,
        )
        return replay.save_html(self.folder / f"match_{samples}.html")


def _checked_opponents(opponents: object) -> tuple[PolicyLike, ...]:
    """Several policies that exist."""
    if isinstance(opponents, str) or not isinstance(opponents, Iterable):
        raise TypeError(f"opponents: expected several policies, got {opponents!r}")
    found = tuple(opponents)
    for opponent in found:
        check_policy_like("opponents", opponent)
        trained_on(opponent)  # it refuses an unknown name, and files that cannot be read
    return found


def _checked_folder(folder: object) -> Path:
    """A folder that exists."""
    path = as_path("folder", folder)
    if not path.is_dir():
        raise ValueError(f"folder: expected one that exists, got {folder}")
    return path

"""Tournament: every policy plays every other one, from both sides, and gets a rating."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks
from rsoccer.controllers import Controller
from rsoccer.evaluate.cycles import cycles
from rsoccer.evaluate.episodes import EpisodeRunner
from rsoccer.evaluate.ratings import rate
from rsoccer.evaluate.results import MIN_PER_SIDE
from rsoccer.evaluate.schedule import first_seed, matches_per_side, processors
from rsoccer.evaluate.standings import Standing, Standings
from rsoccer.evaluate.tournament_report import draw, report, report_html
from rsoccer.lineup import task_for
from rsoccer.policies import PolicyLike, check_policy_like, is_registered, make_policy, name_of
from rsoccer.policies.base import Policy
from rsoccer.policies.labels import identity, labels
from rsoccer.randomization import Ranges
from rsoccer.registry import as_task
from rsoccer.sources import SensingSource, SimulatorSource
from rsoccer.task import LEARN, Task

ANCHOR = "ou"
"""Policy whose rating is fixed, if it plays."""


@dataclass(frozen=True)
class Tournament(Standings):
    """Result of `tournament`; `print` shows it."""

    def as_dict(self) -> dict[str, object]:
        """Return the fields as numbers, texts, lists and dictionaries, ready for JSON."""
        return dataclasses.asdict(self)

    def save_picture(self, path: str | os.PathLike[str]) -> Path:
        """Draw the goal scores as a heat map, and the ratings as bars; needs matplotlib.

        Args:
            path: the PNG file to write.

        Returns:
            `path`.
        """
        return draw(self, Path(path))

    def __str__(self) -> str:
        return report(self)

    def _repr_html_(self) -> str:
        """Ratings, and scores as a heat map, for notebooks."""
        return report_html(self)


def tournament(
    policies: Sequence[PolicyLike],
    matches: int = 100,
    seed: int = 0,
    *,
    task: str | Task | None = None,
    worlds: int = 50,
    threads: int | None = None,
    on_pair: Callable[[int, int], None] | None = None,
    simulator: SimulatorSource | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
) -> Tournament:
    """Play every policy against every other one, and rate them.

    Each policy controls all robots of its team. Each two policies play half of their matches on
    one side and half on the other, from the same starts, which are also those of all other pairs.
    Ratings are those of the Bradley-Terry model on the Elo scale: a difference of 400 stands for
    odds of 10 to 1. `ou` has 1000 if it plays; otherwise the mean has.

    Example:
        >>> import rsoccer
        >>> result = rsoccer.tournament(["chase", "zero", "ou"], matches=2)
        >>> result.standings[0].label
        'chase'

    Args:
        policies: at least two policies, names, or paths of files.
        matches: matches between each two policies, even and at least 2. With fewer than 20 there
            are no intervals, see `rsoccer.evaluate.results`, and no cycles.
        seed: at least 0; equal seeds give equal results for any `threads`.
        task: a task that two teams play, or its name; by default the one that the first policy
            file was trained on, and VSSSelfPlay-v0 for scripts.
        worlds: matches played at once, at least 1.
        threads: threads of the simulator, at least 1; by default one per available processor.
        on_pair: called after the matches of each pair with the number of pairs that are complete
            and the number of all.
        simulator: moves the robots, as for `evaluate`.
        sensing: what robots know of the true state, as for `evaluate`.
        randomization: numbers that each episode draws, as for `evaluate`.

    Returns:
        Ratings with 95% bootstrap intervals over matches, scores of each pair, and cycles.

    Raises:
        ImportError: a text "module:name" whose module or name does not exist.
        ValueError: fewer than two policies, the same one twice, a policy that does not fit the
            task, a task that two teams do not play, or a number out of range.
        TypeError: an argument of the wrong type.
        FileNotFoundError: a policy file does not exist.
    """
    _check_policies(policies)
    task = task_for(*policies) if task is None else as_task(task)
    if not task.two_sided:
        raise ValueError(f"task: expected one that two teams play, got {task.name}")
    per_side = matches_per_side(task, matches)
    seed = checks.integer("seed", seed, 0)
    worlds = checks.integer("worlds", worlds, 1)
    threads = processors() if threads is None else checks.integer("threads", threads, 1)
    made = [_fitting(policy, task) for policy in policies]
    counts = np.zeros((len(made), len(made), 3), np.int64)
    pairs = list(combinations(range(len(made)), 2))
    for done, (a, b) in enumerate(pairs, 1):
        for blue, yellow in ((a, b), (b, a)):
            controllers: dict[str, Controller] = {"blue": LEARN, "yellow": made[yellow]}
            runner = EpisodeRunner(
                task,
                controllers,
                made[blue],
                worlds,
                threads,
                simulator=simulator,
                sensing=sensing,
                randomization=randomization,
            )
            scores = runner.run(per_side, first_seed(seed, 0)).scores
            counts[blue, yellow] = [(np.sign(scores) == sign).sum() for sign in (1, 0, -1)]
        if on_pair is not None:
            on_pair(done, len(pairs))
    return summarize(policies, counts, task.name, seed)


def summarize(
    policies: Sequence[PolicyLike], counts: NDArray[np.int64], task: str, seed: int
) -> Tournament:
    """Return the ratings, scores and cycles of counted results.

    Args:
        policies: (k,) policies, names or paths of files.
        counts: (k, k, 3) wins, draws and losses of the row as blue against the column as yellow,
            equally many matches for all pairs; zeros on the diagonal.
        task: name of the task.
        seed: seed of the tournament, at least 0; it also draws the resamples of the bootstrap.
    """
    names, short = [name_of(policy) for policy in policies], labels(policies)
    # A file or a class may have the anchor's name, too.
    anchors = [is_registered(policy) and name_of(policy) == ANCHOR for policy in policies]
    anchor = anchors.index(True) if any(anchors) else None
    rng = np.random.default_rng(np.random.SeedSequence((seed, len(names))))
    rated = rate(counts, anchor, rng)
    order = np.argsort(-rated.ratings, kind="stable")
    results = counts.sum(axis=1) + counts.sum(axis=0)[:, ::-1]
    scores, low, high = (
        part[np.ix_(order, order)] for part in (rated.scores, rated.scores_low, rated.scores_high)
    )
    has_intervals = min(counts[0, 1].sum(), counts[1, 0].sum()) >= MIN_PER_SIDE
    found = cycles(low > 0.0) if has_intervals else []
    standings = []
    for i in order.tolist():
        bounds = (rated.low[i], rated.high[i])
        low_i, high_i = map(float, bounds) if has_intervals else (None, None)
        wins, draws, losses = results[i].tolist()
        score, rating = (wins - losses) / (wins + draws + losses), float(rated.ratings[i])
        standings.append(
            Standing(names[i], short[i], rating, low_i, high_i, wins, draws, losses, score)
        )
    return Tournament(
        task=task,
        seed=seed,
        matches=int(counts[0, 1].sum() + counts[1, 0].sum()),
        anchor=None if anchor is None else short[anchor],
        standings=tuple(standings),
        scores=_rows(scores),
        low=_rows(low) if has_intervals else None,
        high=_rows(high) if has_intervals else None,
        cycles=tuple(tuple(standings[i].label for i in cycle) for cycle in found),
    )


def _rows(matrix: NDArray[np.float64]) -> tuple[tuple[float, ...], ...]:
    """A matrix as tuples of numbers."""
    return tuple(map(tuple, matrix.tolist()))


def _check_policies(policies: object) -> None:
    """Check number and types of the policies, and that none is there twice."""
    if isinstance(policies, str) or not isinstance(policies, Sequence):
        raise TypeError(f"policies: expected a list of policies, got {policies!r}")
    for policy in policies:
        check_policy_like("policies", policy)
    if len(policies) < 2:
        raise ValueError(f"policies: expected at least two, got {len(policies)}")
    known: set[object] = set()
    for policy in policies:
        key = identity(policy)
        if key in known:
            raise ValueError(f"policies: expected each one once, got {name_of(policy)!r} twice")
        known.add(key)


def _fitting(policy: PolicyLike, task: Task) -> Policy:
    """The policy for the task; an error names it."""
    try:
        return make_policy(policy, task)
    except ValueError as error:
        raise ValueError(f"policies: {name_of(policy)} cannot play {task.name}: {error}") from error

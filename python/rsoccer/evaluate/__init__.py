"""How good a policy is at a task: matches from a fixed list of starts, with intervals.

    >>> print(rsoccer.evaluate("chase", "ou", matches=200, seed=0))  # doctest: +SKIP

Every match starts anew, ends as the task says or at the clock, and counts once. What counts is the
task's own: the metric that it names as its success. Where yellow can play blue's part, a policy
plays half of the matches from each side: one that has learned a single side, or a slip in what
yellow sees, shows in nothing else.
"""

from __future__ import annotations

import os

import numpy as np

from rsoccer import checks
from rsoccer.evaluate.episodes import Doubles, Episodes, Terms, play
from rsoccer.evaluate.results import Evaluation, Interval, Results, estimated, results
from rsoccer.evaluate.tables import table
from rsoccer.lineup import lineup, opponents_of, task_for
from rsoccer.policies import PolicyLike, check_policy_like, make, name_of
from rsoccer.policies.base import Policy
from rsoccer.registry import as_task
from rsoccer.task import LEARN, Task
from rsoccer.view import SIDES

__all__ = ["Evaluation", "Interval", "Results", "evaluate", "table"]


def evaluate(
    policy: PolicyLike,
    opponent: PolicyLike | None = None,
    matches: int = 200,
    seed: int = 0,
    *,
    task: str | Task | None = None,
    worlds: int = 50,
    threads: int | None = None,
) -> Evaluation:
    """Play a policy at a task: the one it was trained on, or VSSSelfPlay-v0 for a script.

    It drives the robots that learn. All others follow who the task has for them; `opponent` takes
    the other team's place, which is `ou` where that team learns too. Where yellow can play blue's
    part (`Task.two_sided`), half of the matches are played from each side, so `matches` must be
    even there. The same seed gives the same result whatever `threads` is (default: every
    processor). `worlds` matches are played at once; another number plays the same starts, and a
    network's last bits may differ.
    """
    check_policy_like("policy", policy)
    if opponent is not None:
        check_policy_like("opponent", opponent)
    task = task_for(policy) if task is None else as_task(task)
    sides = SIDES if task.two_sided else (None,)
    each = _matches_of_a_side(task, matches)
    checks.integer("seed", seed, 0)
    checks.integer("worlds", worlds, 1)
    threads = _processors() if threads is None else checks.integer("threads", threads, 1)
    other: Policy | None = None
    if opponent is not None:
        other = make(opponent, task)
    driver = make(policy, task)
    played = []
    for number, side in enumerate(sides):
        start = np.random.SeedSequence((seed, number))
        base = int(start.generate_state(1, np.uint64)[0]) >> 1
        terms = Terms(task, lineup(task, LEARN, other, side), driver, worlds, threads)
        played.append(play(terms, each, base))
    chance = np.random.default_rng(np.random.SeedSequence((seed, len(SIDES))))
    others = opponents_of(task) if opponent is None else [name_of(opponent)]
    names = (name_of(policy), " ".join(others) or "-")
    return _evaluation(task, names, seed, played, chance)


def _evaluation(
    task: Task,
    names: tuple[str, str],
    seed: int,
    played: list[Episodes],
    chance: np.random.Generator,
) -> Evaluation:
    """What the matches of all sides come to."""
    # What is reported is blue's; no draw shall read as -0.
    scores = [each.score * (1 - 2 * side) + 0.0 for side, each in enumerate(played)]
    seconds = [episodes.seconds for episodes in played]
    decided = np.concatenate(seconds)[np.concatenate([each.decided for each in played])]
    return Evaluation(
        **vars(results(scores, chance)),
        policy=names[0],
        opponent=names[1],
        task=task.name,
        seed=seed,
        metric=played[0].metric,
        sides=_by_side(scores, chance) if task.two_sided else {},
        returns=estimated([episodes.returns for episodes in played], chance),
        seconds=estimated(seconds, chance),
        decided_after=float(decided.mean()) if len(decided) else None,
    )


def _by_side(scores: list[Doubles], chance: np.random.Generator) -> dict[str, Results]:
    return {side: results([each], chance) for side, each in zip(SIDES, scores, strict=True)}


def _matches_of_a_side(task: Task, matches: int) -> int:
    """How many to play from each side, so that there are exactly as many as were asked for."""
    if task.two_sided and task.success is None:
        raise ValueError(f"task: {task.name} has two sides and must name its success, got None")
    if not task.two_sided:
        return checks.integer("matches", matches, 1)
    if checks.integer("matches", matches, 2) % 2:
        raise ValueError(
            f"matches: expected an even number, as {task.name} is played from both sides, "
            f"got {matches}"
        )
    return matches // 2


def _processors() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1

"""How strong a policy is: matches from both sides of the field, with intervals.

    >>> print(rsoccer.evaluate("chase", "ou", matches=200, seed=0))  # doctest: +SKIP

Every match starts anew, ends with a goal or at the clock, and counts once. A policy plays half
of the matches as blue and half as yellow: one that has learned a single side, or a slip in what
yellow sees, shows in nothing else.
"""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks
from rsoccer.frame import Floats
from rsoccer.matches import Matches
from rsoccer.policies import make
from rsoccer.policies.base import Policy
from rsoccer.registry import make_task
from rsoccer.task import Task

SIDES = ("blue", "yellow")
METRIC = "goal_score"  # what the task reports at the end: +1, 0, -1 from blue's side
RESAMPLES = 10_000  # of the bootstrap; an interval's ends then repeat to about 0.005

HEADER = (
    *("policy", "opponent", "matches", "won", "drawn", "lost"),
    *("goal score", "95% interval", "as blue", "as yellow", "goal after"),
)

Player = str | os.PathLike[str] | Policy
"""A policy by name (`zero`, `ou`, ...), by the path of its file, or itself."""


@dataclass(frozen=True)
class Results:
    """Results of some matches; the interval holds the true goal score 19 times in 20."""

    wins: int
    draws: int
    losses: int
    goal_score: float  # (wins - losses) / matches, from -1 to 1
    low: float  # lower end of the 95% bootstrap interval of the goal score
    high: float  # its upper end; both equal the score where all matches ended alike

    @property
    def matches(self) -> int:
        """Matches played."""
        return self.wins + self.draws + self.losses


@dataclass(frozen=True)
class Evaluation(Results):
    """What `evaluate` found; `print` it, or put several into one `table`."""

    policy: str
    opponent: str
    task: str
    seed: int
    blue: Results  # the matches in which the policy played blue
    yellow: Results  # the matches in which it played yellow
    goal_time: float | None  # mean seconds to the goal, in matches with a goal of either team

    def as_dict(self) -> dict[str, object]:
        """Numbers, texts and dictionaries, ready for JSON."""
        return {**dataclasses.asdict(self), "matches": self.matches}

    def __str__(self) -> str:
        return table([self])


def evaluate(
    policy: Player,
    opponent: Player = "ou",
    matches: int = 200,
    seed: int = 0,
    *,
    task: str | Task = "VSSSelfPlay-v0",
    worlds: int = 50,
    threads: int | None = None,
) -> Evaluation:
    """Play a policy against an opponent, half of the matches from each side of the field.

    An odd number of `matches` is rounded up. The same seed gives the same result whatever
    `threads` is (default: every processor). `worlds` matches are played at once; another number
    plays the same starts, and a network's last bits may differ.
    """
    half = (checks.whole("matches", matches, 2) + 1) // 2
    checks.whole("seed", seed, 0)
    checks.whole("worlds", worlds, 1)
    threads = _processors() if threads is None else checks.whole("threads", threads, 1)
    task = make_task(task) if isinstance(task, str) else task
    _expect_two_sides(task)
    mine, theirs = (make(player, task) for player in (policy, opponent))
    scores: list[NDArray[np.int64]] = []
    seconds: list[Floats] = []
    for number, side in enumerate(SIDES):
        teams = {side: mine, SIDES[1 - number]: theirs}
        start = np.random.SeedSequence((seed, number))
        score, time = _play(task, teams, half, start, worlds, threads)
        scores.append(score if side == "blue" else -score)
        seconds.append(time)
    chance = np.random.default_rng(np.random.SeedSequence((seed, len(SIDES))))
    goals = np.concatenate(seconds)[np.concatenate(scores) != 0]
    return Evaluation(
        **vars(_results(scores, chance)),
        policy=_name(policy),
        opponent=_name(opponent),
        task=task.name,
        seed=seed,
        blue=_results(scores[:1], chance),
        yellow=_results(scores[1:], chance),
        goal_time=float(goals.mean()) if len(goals) else None,
    )


def table(evaluations: Iterable[Evaluation]) -> str:
    """Evaluations as lines of text, one each under a header, columns aligned."""
    rows = [HEADER, *(_row(evaluation) for evaluation in evaluations)]
    widths = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)]
    return "\n".join(_aligned(row, widths) for row in rows)


def _play(
    task: Task,
    teams: Mapping[str, Policy],
    count: int,
    start: np.random.SeedSequence,
    worlds: int,
    threads: int,
) -> tuple[NDArray[np.int64], Floats]:
    """Blue's score (+1, 0, -1) and duration in seconds of `count` matches, both (count,)."""
    base = int(start.generate_state(1, np.uint64)[0]) >> 1
    scores = np.zeros(count, np.int64)
    steps = np.zeros(count, np.int64)
    for first in range(0, count, worlds):
        n = min(worlds, count - first)
        # Ended worlds wait, so long matches count as often as short ones.
        matches = Matches(
            task, n, base + first, threads, controllers=dict(teams), autoreset="disabled"
        )
        matches.reset()
        nobody = np.zeros((n, 0, task.action_size), np.float32)  # no robot is left to learn
        playing = np.ones(n, np.bool_)
        chunk = slice(first, first + n)
        while playing.any():
            outcome = matches.step(nobody)
            if METRIC not in outcome.metrics:
                raise ValueError(f"task {task.name!r} has no metric {METRIC!r} to evaluate by")
            steps[chunk] += playing
            ending = playing & outcome.ended
            scores[chunk][ending] = np.rint(outcome.metrics[METRIC][ending])
            playing &= ~ending
    return scores, (steps * task.config.time_step).astype(np.float32)


def _results(strata: Sequence[NDArray[np.int64]], chance: np.random.Generator) -> Results:
    """Count scores and resample them, each side among its own matches."""
    counts = [np.array([(scores == score).sum() for score in (1, 0, -1)]) for scores in strata]
    wins, draws, losses = np.sum(counts, axis=0).tolist()
    total = wins + draws + losses
    # Drawing matches with replacement is drawing their counts from a multinomial.
    drawn = [chance.multinomial(part.sum(), part / part.sum(), RESAMPLES) for part in counts]
    margins = np.sum(drawn, axis=0) @ np.array([1, 0, -1])
    low, high = np.quantile(margins / total, (0.025, 0.975)).tolist()
    return Results(wins, draws, losses, (wins - losses) / total, low, high)


def _row(evaluation: Evaluation) -> tuple[str, ...]:
    goal_time = "-" if evaluation.goal_time is None else f"{evaluation.goal_time:.1f} s"
    counts = (evaluation.matches, evaluation.wins, evaluation.draws, evaluation.losses)
    return (
        evaluation.policy,
        evaluation.opponent,
        *(str(count) for count in counts),
        f"{evaluation.goal_score:+.3f}",
        f"[{evaluation.low:+.3f}, {evaluation.high:+.3f}]",
        f"{evaluation.blue.goal_score:+.3f}",
        f"{evaluation.yellow.goal_score:+.3f}",
        goal_time,
    )


def _aligned(row: Sequence[str], widths: Sequence[int]) -> str:
    """Names to the left, numbers to the right."""
    cells = (
        cell.ljust(width) if column < 2 else cell.rjust(width)
        for column, (cell, width) in enumerate(zip(row, widths, strict=True))
    )
    return "  ".join(cells).rstrip()


def _name(player: Player) -> str:
    return type(player).__name__ if isinstance(player, Policy) else os.fspath(player)


def _processors() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _expect_two_sides(task: Task) -> None:
    """Both teams must have robots, and the task must show the game to both."""
    sizes = {"blue": task.n_blue, "yellow": task.n_yellow}
    missing = [side for side in SIDES if not sizes[side] or side not in task.sides]
    if missing:
        raise ValueError(
            f"task {task.name!r} has no {' or '.join(missing)} side that a policy could play"
        )

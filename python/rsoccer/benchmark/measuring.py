"""Measurement of a policy by the protocol, row after row."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Sequence

from rsoccer import checks
from rsoccer.benchmark.conditions import CONDITIONS
from rsoccer.benchmark.entry import Entry, Row
from rsoccer.benchmark.protocol import MATCHES, SEED, TASKS
from rsoccer.evaluate import evaluate
from rsoccer.evaluate.episodes import LearnerPolicy
from rsoccer.evaluate.results import MIN_PER_SIDE
from rsoccer.matches import Matches
from rsoccer.policies import PolicyLike, check_policy_like, make_policy
from rsoccer.policies.base import Policy, require_actions


def run_benchmark(
    policy: PolicyLike,
    tasks: Sequence[str] | None = None,
    *,
    name: str | None = None,
    description: str = "",
    link: str = "",
    matches: int = MATCHES,
    robust: bool = True,
    threads: int | None = None,
    begun: Entry | None = None,
    on_row: Callable[[Entry, str, Row], None] | None = None,
) -> Entry:
    """Measure a policy on the tasks of the benchmark, on the true state and with other senses.

    Example:
        >>> from rsoccer.benchmark import run_benchmark
        >>> entry = run_benchmark("fetch", ["SSLGoToBall-v0"], matches=20, robust=False)
        >>> entry.tasks["SSLGoToBall-v0"][0].metric
        'reached'

    Args:
        policy: a policy, its name, its file, or "module:name". Tasks that it cannot play are
            listed with the reason.
        tasks: names of tasks of the benchmark; None for all of them.
        name: name in the table; by default that of `begun`, or of the policy.
        description: how the policy was made, in a sentence.
        link: address of code or paper.
        matches: matches of each row, even and at least 20; the leaderboard takes 200 or more.
        robust: whether the first opponent of each task is met under all conditions, too.
        threads: threads of the simulator; by default one per available processor.
        begun: an entry of the same policy, whose rows are kept; rows that it lacks are added, those
            of other conditions too if it was measured without them.
        on_row: called after each row with the entry so far, the task and the row.

    Returns:
        The entry with all rows.

    Raises:
        FileNotFoundError: the policy file does not exist.
        ImportError: a "module:name" that does not exist.
        TypeError: an argument of the wrong type.
        ValueError: a task that is not part of the benchmark, too few matches, a policy that plays
            none of the tasks, or an entry that differs in policy, protocol, physics or machine.
    """
    check_policy_like("policy", policy)
    chosen = _checked(tasks)
    if checks.integer("matches", matches, 2 * MIN_PER_SIDE) % 2:
        raise ValueError(f"matches: expected an even number, got {matches}")
    entry = Entry.begun(
        policy, name, description=description, link=link, matches=matches, robust=robust
    )
    if begun is not None:
        entry = _continued(begun, entry, name)
    # With more conditions than before, the tasks of the begun entry have rows to add, too.
    chosen = tuple(task for task in TASKS if task in {*chosen, *entry.tasks})
    entry = _without_others(entry, policy, chosen)
    for task in chosen:
        for opponent, condition in entry.missing(task):
            row = measured(policy, task, opponent, condition, matches, threads)
            entry = entry.with_row(task, row)
            if on_row is not None:
                on_row(entry, task, row)
    return entry


def _checked(tasks: Sequence[str] | None) -> tuple[str, ...]:
    """The tasks to play."""
    chosen = tuple(TASKS if tasks is None else tasks)
    if isinstance(tasks, str) or [task for task in chosen if task not in TASKS]:
        raise ValueError(f"tasks: expected some of {list(TASKS)}, got {tasks!r}")
    return chosen


def _without_others(entry: Entry, policy: PolicyLike, tasks: Sequence[str]) -> Entry:
    """The entry with the tasks that the policy cannot play, unless it can play none."""
    reasons = {}
    entry = dataclasses.replace(  # what refused it before may be mended
        entry, refused={task: why for task, why in entry.refused.items() if task not in tasks}
    )
    for task in tasks:
        if (reason := _reason_against(policy, task)) is not None:
            reasons[task], entry = reason, entry.without(task, reason)
    if len(reasons) == len(tasks):
        raise ValueError(f"policy: expected one that plays one of the tasks: {reasons}")
    return entry


def _continued(begun: Entry, new: Entry, name: str | None) -> Entry:
    """The begun entry, if the new one would go on with it."""
    for field in ("policy", "digest", "matches", "seed", "versions", "machine"):
        before, now = getattr(begun, field), getattr(new, field)
        if field == "machine":  # the number of cores changes no result
            before, now = ({**each, "cores": 0} for each in (before, now))
        if before != now:
            why = "; the policy has changed since" if field == "digest" else ""
            raise ValueError(
                f"begun: expected an entry whose {field} is {now!r}, got {before!r}{why}: measure "
                "into another file, or remove that one"
            )
    if begun.robust and not new.robust:
        raise ValueError(
            "begun: expected an entry without other conditions, as robust is False, got one with "
            "them: measure into another file, or with robust"
        )
    return dataclasses.replace(
        begun,
        robust=new.robust,
        name=name or begun.name,
        description=new.description or begun.description,
        link=new.link or begun.link,
    )


def _reason_against(policy: PolicyLike, task: str) -> str | None:
    """Reason for which a policy cannot play a task; None if it can."""
    try:
        made = make_policy(policy, task)
        require_actions("policy", made)
    except (TypeError, ValueError) as error:
        return str(error)
    try:
        _play_a_step(made, task)
    except Exception as error:  # any that code for other robots may raise
        return f"{type(error).__name__}: {error}"
    return None


def _play_a_step(policy: Policy, task: str) -> None:
    """Let a policy act once: a script may be made for a task whose robots it cannot drive."""
    matches = Matches(task, seed=SEED, threads=1)
    matches.step(LearnerPolicy(policy, matches, SEED).act(matches.reset()))


def measured(
    policy: PolicyLike,
    task: str,
    opponent: str | None,
    condition: str,
    matches: int,
    threads: int | None,
) -> Row:
    """Return the row of one opponent under one condition.

    Args:
        policy: a policy that plays the task.
        task: name of the task.
        opponent: policy of the other team; None for the task's own.
        condition: name of the condition.
        matches: number of matches.
        threads: threads of the simulator; None for one per available processor.

    Raises:
        RuntimeError: too few matches for an interval.
    """
    start = time.perf_counter()
    found = evaluate(
        policy,
        opponent,
        matches,
        SEED,
        task=task,
        threads=threads,
        sensing=CONDITIONS[condition].sensing({}),
        randomization=CONDITIONS[condition].randomization(task),
    )
    if found.low is None or found.high is None:
        raise RuntimeError(f"matches: expected enough for an interval, got {matches}")
    return Row(
        opponent=opponent or "-",
        condition=condition,
        metric=found.metric,
        matches=found.matches,
        wins=found.wins,
        draws=found.draws,
        losses=found.losses,
        score=found.score,
        low=found.low,
        high=found.high,
        seconds=found.seconds.mean,
        wall_clock=time.perf_counter() - start,
    )

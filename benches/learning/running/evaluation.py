"""The evaluation of a policy, the same for all algorithms."""

from __future__ import annotations

from typing import Any, Final

from benches.learning.experiments import Protocol, Run
from benches.learning.opponents import OFFICIAL, SCENARIOS
from benches.learning.run_files import Folders
from benches.learning.running.learned import Learned
from benches.learning.running.workplace import reference
from rsoccer import Sensing
from rsoccer.benchmark.conditions import CONDITIONS
from rsoccer.benchmark.protocol import MATCHES, opponents_of
from rsoccer.evaluate import Evaluation, evaluate
from rsoccer.policies import PolicyLike
from rsoccer.randomization import Ranges
from rsoccer.registry import make_task

DIGITS: Final = 4


def evaluate_run(
    run: Run, learned: Learned, protocol: Protocol, folders: Folders
) -> list[dict[str, Any]]:
    """Return the evaluations of a policy against each opponent in each of its modes.

    Args:
        run: The run.
        learned: Its policy; its own mode comes first.
        protocol: Numbers of matches and seed.
        folders: Folders with the policies of other experiments.
    """
    opponents = run.experiment.opponents
    if opponents is None:
        opponents = opponents_of(run.experiment.task)
    if run.experiment.conditions:
        return under_conditions(run, learned, protocol, opponents[0])
    rows = []
    for opponent in opponents:
        other: PolicyLike | None = opponent
        if opponent is not None and opponent.startswith("@"):
            other = reference(folders, opponent, run)
        for mode, policy in learned.policies.items():
            row = evaluated(run.experiment.task, policy, other, protocol)
            rows.append({"opponent": opponent or "-", "mode": mode, **row})
    if run.experiment.task in SCENARIOS:
        for mode, policy in learned.policies.items():
            row = on_scenarios(run.experiment.task, policy, protocol)
            rows.append({"opponent": OFFICIAL, "mode": mode, **row})
    return rows


def under_conditions(
    run: Run, learned: Learned, protocol: Protocol, opponent: str | None
) -> list[dict[str, Any]]:
    """Return the evaluations of a policy in its own mode under each condition of its experiment.

    Args:
        run: The run.
        learned: Its policy.
        protocol: Numbers of matches and seed.
        opponent: Name of the opponent; None for the task's own.
    """
    mode, policy = next(iter(learned.policies.items()))
    rows = []
    for name in run.experiment.conditions:
        condition = CONDITIONS[name]
        row = evaluated(
            *(run.experiment.task, policy, opponent, protocol),
            matches=MATCHES,
            sensing=condition.sensing(run.experiment.senses),
            randomization=condition.randomization(run.experiment.task),
        )
        rows.append({"opponent": opponent or "-", "mode": mode, "condition": name, **row})
    return rows


def on_scenarios(task: str, policy: PolicyLike, protocol: Protocol) -> dict[str, Any]:
    """Return the numbers of a policy on all official scenarios of a task, with equal weights.

    Each begins in one state, so matches differ by the noise of the actions. Those of a policy
    without noise differ by rounding alone, which changes with a match's place in the batch.
    """
    count = SCENARIOS[task]
    parts = [
        numbers(
            evaluate(
                policy,
                matches=protocol.starts // count,
                seed=protocol.seed,
                task=make_task(task, scenario=scenario),
                threads=1,
            )
        )
        for scenario in range(1, count + 1)
    ]
    sums = ("matches", "wins", "draws", "losses", "decided", "own_goals")
    decided = [part for part in parts if part["decided"]]
    seconds = sum(part["decided"] * part["seconds_to_decision"] for part in decided)
    total = sum(part["decided"] for part in decided)
    scores = [part["score"] for part in parts]
    return {
        "metric": parts[0]["metric"],
        **{name: sum(part[name] for part in parts) for name in sums},
        "score": round(sum(scores) / count, DIGITS),
        "by_scenario": scores,
        "sides": {},
        "seconds": round(sum(part["seconds"] for part in parts) / count, DIGITS),
        "seconds_to_decision": round(seconds / total, DIGITS) if total else None,
        "metrics": {},
    }


def evaluated(
    task: str,
    policy: PolicyLike,
    opponent: PolicyLike | None,
    protocol: Protocol,
    *,
    matches: int | None = None,
    sensing: Sensing | None = None,
    randomization: Ranges | None = None,
) -> dict[str, Any]:
    """Return the numbers of one evaluation, ready for JSON."""
    if matches is None:
        matches = protocol.starts * (2 if make_task(task).two_sided else 1)
    evaluation = evaluate(
        *(policy, opponent, matches, protocol.seed),
        task=task,
        worlds=250,
        threads=1,
        sensing=sensing,
        randomization=randomization,
    )
    return numbers(evaluation)


def numbers(evaluation: Evaluation) -> dict[str, Any]:
    """Return the numbers that a study keeps: counts, means and intervals."""
    sides = {side: round(part.score, DIGITS) for side, part in evaluation.sides.items()}
    return {
        "metric": evaluation.metric,
        "matches": evaluation.matches,
        "wins": evaluation.wins,
        "draws": evaluation.draws,
        "losses": evaluation.losses,
        "score": round(evaluation.score, DIGITS),
        "low": _rounded(evaluation.low),
        "high": _rounded(evaluation.high),
        "sides": sides,
        "seconds": round(evaluation.seconds.mean, DIGITS),
        "decided": evaluation.decided,
        "own_goals": evaluation.own_goals,
        "seconds_to_decision": _rounded(evaluation.seconds_to_decision),
        "metrics": {name: round(value, DIGITS) for name, value in evaluation.metrics.items()},
    }


def _rounded(value: float | None) -> float | None:
    """A number that may be missing."""
    return None if value is None else round(value, DIGITS)

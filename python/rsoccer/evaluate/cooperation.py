"""Cooperation of a team: scores with a teammate replaced, play of the team, cross-play."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rsoccer import checks
from rsoccer.evaluate.cooperation_report import Cooperation, CrossPlay, LineUp
from rsoccer.evaluate.results import Interval, bootstrap_interval
from rsoccer.evaluate.schedule import matches_per_side, processors
from rsoccer.evaluate.team_matches import Played, Team
from rsoccer.lineup import opponents_of, script_of, task_for
from rsoccer.policies import PolicyLike, check_policy_like, make_policy, name_of
from rsoccer.policies.base import Policy, require_actions
from rsoccer.policies.labels import identity, labels
from rsoccer.randomization import Ranges
from rsoccer.registry import as_task
from rsoccer.sources import SensingSource, SimulatorSource
from rsoccer.task import Task
from rsoccer.view import SIDES

WHOLE_TEAM = "-"
"""Replacement of the line-up in which the policy drives all of its robots."""


def cooperation(
    policy: PolicyLike,
    opponent: PolicyLike | None = None,
    matches: int = 200,
    seed: int = 0,
    *,
    task: str | Task | None = None,
    replacements: Sequence[PolicyLike] | None = None,
    partners: Sequence[PolicyLike] = (),
    worlds: int = 50,
    threads: int | None = None,
    simulator: SimulatorSource | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
) -> Cooperation:
    """Measure how much the robots of a team do for each other.

    The policy first drives its whole team, as in `evaluate`. Then another policy replaces it in one
    robot of the team, every robot in an equal share of the matches, from the same starts. A team
    that cooperates scores less then; one of soloists does not. Where the policy drives one robot
    only, its teammates are replaced. Cross-play lets teams play that are half of one policy and
    half of another: those of several seeds, say, which may have learned different conventions.

    Example:
        >>> import rsoccer
        >>> result = rsoccer.cooperation("chase", "zero", matches=6, replacements=["zero"])
        >>> [line_up.replacement for line_up in result.line_ups]
        ['-', 'zero']

    Args:
        policy: a policy, its name, or the path of its file. It controls the robots that learn.
        opponent: a policy for all robots of the other team, as for `evaluate`.
        matches: matches of each line-up, at least 1; even and at least 2 in two-sided tasks, half
            of them for each side. With fewer than 10 a side there are no intervals.
        seed: at least 0; equal seeds give equal results for any `threads`.
        task: a task or its name, in which a team has at least two robots; by default the one that
            the policy was trained on, and VSSSelfPlay-v0 for scripts.
        replacements: policies that replace one robot: one that has learned alone, say. By default
            "zero" and the script of the task.
        partners: policies for cross-play with the policy, such as its other seeds.
        worlds: matches played at once, at least 1, as for `evaluate`.
        threads: threads of the simulator, at least 1; by default one per available processor.
        simulator: moves the robots, as for `evaluate`.
        sensing: what robots know of the true state, as for `evaluate`.
        randomization: numbers that each episode draws, as for `evaluate`.

    Returns:
        Scores and play of each line-up with 95% intervals, and the scores of cross-play.

    Raises:
        ImportError: a text "module:name" whose module or name does not exist.
        ValueError: a number out of range, an unknown policy or task, a policy that does not fit
            the task, an opponent in a task with one team, a team of one robot, cross-play of a
            policy that drives one robot, or the same partner twice.
        TypeError: an argument of the wrong type.
        FileNotFoundError: a policy file does not exist.
    """
    check_policy_like("policy", policy)
    if opponent is not None:
        check_policy_like("opponent", opponent)
    _check_list("partners", partners)
    task = task_for(policy) if task is None else as_task(task)
    if replacements is None:
        replacements = list(dict.fromkeys(("zero", script_of(task))))
    _check_list("replacements", replacements)
    per_side = matches_per_side(task, matches)
    seed = checks.integer("seed", seed, 0)
    worlds = checks.integer("worlds", worlds, 1)
    threads = processors() if threads is None else checks.integer("threads", threads, 1)
    other = None if opponent is None else make_policy(opponent, task)
    own = _acting("policy", policy, task)
    others = [_acting("replacements", each, task) for each in replacements]
    teammates = [_acting("partners", each, task) for each in partners]
    if len({identity(each) for each in (policy, *partners)}) <= len(partners):
        raise ValueError(f"partners: expected other policies, each once, got {_names(partners)}")
    team = Team(task, other, per_side, seed, worlds, threads, simulator, sensing, randomization)
    if partners and len(team.learners(0)) < 2:
        raise ValueError(f"partners: expected a task with two learners a team, got {task.name}")
    rng = np.random.default_rng(np.random.SeedSequence((seed, len(SIDES))))
    whole = team.play(own, None)
    line_ups = [_line_up(WHOLE_TEAM, whole, None, rng)]
    for name, replacement in zip(_names(replacements), others, strict=True):
        line_ups.append(_line_up(name, team.play(own, replacement), whole, rng))
    cross_play = None
    if teammates:
        names = labels((policy, *partners))
        cross_play = _cross_play(team, names, [own, *teammates], whole, rng)
    return Cooperation(
        policy=name_of(policy),
        opponent=(" ".join(opponents_of(task)) or "-") if opponent is None else name_of(opponent),
        task=task.name,
        seed=seed,
        matches=per_side * len(team.sides),
        metric=whole.metric,
        line_ups=tuple(line_ups),
        cross_play=cross_play,
    )


def _line_up(
    replacement: str, played: Played, whole: Played | None, rng: np.random.Generator
) -> LineUp:
    """Summary of a line-up, and its difference to the whole team from the same starts."""
    lost = None
    if whole is not None:
        pairs = zip(played.scores, whole.scores, strict=True)
        lost = bootstrap_interval([one - other for one, other in pairs], rng)
    measures = {name: bootstrap_interval(values, rng) for name, values in played.measures.items()}
    return LineUp(replacement, bootstrap_interval(played.scores, rng), lost, measures)


def _cross_play(
    team: Team,
    names: list[str],
    policies: list[Policy],
    whole: Played,
    rng: np.random.Generator,
) -> CrossPlay:
    """Scores of teams of each two policies."""
    played: dict[tuple[int, int], Played] = {(0, 0): whole}
    for i, first in enumerate(policies):
        for j in range(i, len(policies)):
            if (i, j) not in played:
                is_whole = i == j
                played[i, j] = (
                    team.play(first, None) if is_whole else team.play_halves(first, policies[j])
                )
    scores: list[list[Interval]] = [
        [bootstrap_interval(played[min(i, j), max(i, j)].scores, rng) for j in range(len(names))]
        for i in range(len(names))
    ]
    mixed = [pair for pair in played if pair[0] != pair[1]]
    gaps = [
        np.mean([played[pair].scores[side] for pair in mixed], axis=0)
        - np.mean([played[i, i].scores[side] for i in range(len(names))], axis=0)
        for side in range(len(team.sides))
    ]
    return CrossPlay(tuple(names), tuple(map(tuple, scores)), bootstrap_interval(gaps, rng))


def _acting(name: str, policy: PolicyLike, task: Task) -> Policy:
    """A policy for the task, which gives actions."""
    made = make_policy(policy, task)
    require_actions(name, made)
    return made


def _names(policies: Sequence[PolicyLike]) -> list[str]:
    return [name_of(policy) for policy in policies]


def _check_list(name: str, policies: object) -> None:
    """Check the type of a list of policies."""
    if isinstance(policies, str) or not isinstance(policies, Sequence):
        raise TypeError(f"{name}: expected a list of policies, got {policies!r}")
    for policy in policies:
        check_policy_like(name, policy)

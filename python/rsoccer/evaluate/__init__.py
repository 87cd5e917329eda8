"""Evaluation of policies: matches from a fixed list of starts, with confidence intervals.

    >>> print(rsoccer.evaluate("chase", "ou", matches=200, seed=0))  # doctest: +SKIP

Every match starts from a new state, ends by the task's rules or at the time limit, and counts
once. Its score is the metric that the task names as its success. In two-sided tasks, where yellow
can play blue's part, a policy plays half of the matches for each team. Otherwise a policy that has
learned one side only, or an error in yellow's view, would go unnoticed.

`tournament` plays every policy against every other one, and rates them. `cooperation` measures how
much the robots of a team do for each other.
"""

from __future__ import annotations

import numpy as np

from rsoccer import checks
from rsoccer.arrays import Doubles
from rsoccer.evaluate.cooperation import cooperation
from rsoccer.evaluate.cooperation_report import Cooperation
from rsoccer.evaluate.episodes import EpisodeRunner, Episodes
from rsoccer.evaluate.evaluation import Evaluation, table
from rsoccer.evaluate.rates import goal_rates
from rsoccer.evaluate.results import Interval, Results, bootstrap_interval, count_results
from rsoccer.evaluate.schedule import first_seed, matches_per_side, processors
from rsoccer.evaluate.standings import Standing
from rsoccer.evaluate.tournament import Tournament, tournament
from rsoccer.lineup import lineup, opponents_of, task_for
from rsoccer.policies import PolicyLike, check_policy_like, make_policy, name_of
from rsoccer.policies.base import Policy
from rsoccer.randomization import Ranges
from rsoccer.registry import as_task
from rsoccer.sources import SensingSource, SimulatorSource
from rsoccer.task import LEARN, Task
from rsoccer.view import SIDES

__all__ = ["Cooperation", "Evaluation", "Interval", "Results"]
__all__ += ["cooperation", "evaluate", "table"]
__all__ += ["Standing", "Tournament", "first_seed", "matches_per_side", "tournament"]


def evaluate(
    policy: PolicyLike,
    opponent: PolicyLike | None = None,
    matches: int = 200,
    seed: int = 0,
    *,
    task: str | Task | None = None,
    worlds: int = 50,
    threads: int | None = None,
    simulator: SimulatorSource | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
) -> Evaluation:
    """Play matches of a task with a policy in the place of its learners.

    All other robots keep the task's default controllers. In two-sided tasks (`Task.two_sided`) the
    policy plays half of the matches for blue and half for yellow.

    Args:
        policy: a policy, its name, or the path of its file. It controls the robots that learn.
        opponent: a policy for all robots of the other team. By default the task's own, and "ou"
            for robots that learn.
        matches: number of matches, at least 1; even and at least 2 in two-sided tasks. With fewer
            than 10, or 20 in two-sided tasks, there are no intervals.
        seed: at least 0; equal seeds give equal results for any `threads`.
        task: a task or its name; by default the one that the policy was trained on, and
            VSSSelfPlay-v0 for scripts.
        worlds: matches played at once, at least 1. The starts do not depend on it, but a network's
            actions may differ in their last bits.
        threads: threads of the simulator, at least 1; by default one per available processor.
        simulator: moves the robots, as for `Matches`. A simulator itself has to fit the number of
            matches at once, and stays open.
        sensing: what robots know of the true state, as for `Matches`.
        randomization: numbers that each episode draws, as for `Matches`.

    Returns:
        Counts, the mean score, the mean return and the mean duration with their intervals.

    Raises:
        ImportError: a text "module:name" whose module or name does not exist.
        ValueError: a number out of range, an unknown policy or task, a policy that does not fit
            the task, an opponent in a task with one team, or a two-sided task without a success
            metric.
        TypeError: an argument of the wrong type.
        FileNotFoundError: the policy file does not exist.
    """
    check_policy_like("policy", policy)
    if opponent is not None:
        check_policy_like("opponent", opponent)
    task = task_for(policy) if task is None else as_task(task)
    sides = SIDES if task.two_sided else (None,)
    per_side = matches_per_side(task, matches)
    seed = checks.integer("seed", seed, 0)
    worlds = checks.integer("worlds", worlds, 1)
    threads = processors() if threads is None else checks.integer("threads", threads, 1)
    opponent_policy: Policy | None = None
    if opponent is not None:
        opponent_policy = make_policy(opponent, task)
    own_policy = make_policy(policy, task)
    episodes = []
    for index, side in enumerate(sides):
        controllers = lineup(task, LEARN, opponent_policy, side)
        runner = EpisodeRunner(
            task,
            controllers,
            own_policy,
            worlds,
            threads,
            simulator=simulator,
            sensing=sensing,
            randomization=randomization,
        )
        episodes.append(runner.run(per_side, first_seed(seed, index)))
    rng = np.random.default_rng(np.random.SeedSequence((seed, len(SIDES))))
    opponents = opponents_of(task) if opponent is None else [name_of(opponent)]
    names = (name_of(policy), " ".join(opponents) or "-")
    return _evaluation(task, names, seed, episodes, rng)


def _evaluation(
    task: Task,
    names: tuple[str, str],
    seed: int,
    episodes: list[Episodes],
    rng: np.random.Generator,
) -> Evaluation:
    """Summary of the episodes of each side."""
    # Scores are blue's, so those of yellow change their sign; adding 0.0 turns -0.0 into 0.0.
    scores = [part.scores * (1 - 2 * side) + 0.0 for side, part in enumerate(episodes)]
    own_goals = sum(int(part.own_goals[:, side].sum()) for side, part in enumerate(episodes))
    seconds = [part.seconds for part in episodes]
    decided = np.concatenate([part.decision_seconds[part.decided] for part in episodes])
    return Evaluation(
        **vars(count_results(scores, rng)),
        policy=names[0],
        opponent=names[1],
        task=task.name,
        seed=seed,
        metric=episodes[0].metric,
        sides=_by_side(scores, rng) if task.two_sided else {},
        returns=bootstrap_interval([part.returns for part in episodes], rng),
        seconds=bootstrap_interval(seconds, rng),
        seconds_to_decision=float(decided.mean()) if len(decided) else None,
        decided=len(decided),
        own_goals=own_goals,
        metrics=_other_metrics(task, episodes),
        goal_rates=goal_rates(episodes, rng) if task.two_sided else {},
    )


def _other_metrics(task: Task, episodes: list[Episodes]) -> dict[str, float]:
    """Means of the metrics beside the score, with teams named from the policy's view."""
    names = [name for name in episodes[0].metrics if name != episodes[0].metric]
    if not task.two_sided:
        return {name: float(episodes[0].metrics[name].mean()) for name in names}
    blue, yellow = SIDES
    parts: dict[str, list[Doubles]] = {}
    for own, other, part in zip(SIDES, (yellow, blue), episodes, strict=True):
        for name in names:
            team, _, rest = name.partition("_")
            named = {own: f"own_{rest}", other: f"opponent_{rest}"}.get(team, name)
            parts.setdefault(named, []).append(part.metrics[name])
    return {name: float(np.concatenate(values).mean()) for name, values in parts.items()}


def _by_side(scores: list[Doubles], rng: np.random.Generator) -> dict[str, Results]:
    """Results of each side by its name."""
    return {side: count_results([part], rng) for side, part in zip(SIDES, scores, strict=True)}

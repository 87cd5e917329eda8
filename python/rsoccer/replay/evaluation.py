"""The last match of an evaluation, played once more and recorded."""

from __future__ import annotations

from rsoccer.evaluate import first_seed, matches_per_side
from rsoccer.evaluate.episodes import LearnerPolicy
from rsoccer.lineup import lineup, opponents_of, task_for
from rsoccer.matches import Matches
from rsoccer.policies import PolicyLike, make_policy, name_of
from rsoccer.randomization import Ranges
from rsoccer.registry import as_task
from rsoccer.replay.recorder import Recorder
from rsoccer.replay.replay import Replay
from rsoccer.sources import SensingSource, SimulatorSource, closed_after
from rsoccer.task import LEARN, Task
from rsoccer.view import SIDES


def record_last_match(
    policy: PolicyLike,
    opponent: PolicyLike | None = None,
    matches: int = 200,
    seed: int = 0,
    *,
    task: str | Task | None = None,
    names: tuple[str, str] | None = None,
    simulator: SimulatorSource | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
) -> Replay:
    """Record the last match of `rsoccer.evaluate` with these arguments.

    It is the one that the evaluation played, up to the last bits of a network's actions. In
    two-sided tasks the policy plays for yellow in it.

    Args:
        policy: a policy, its name or its file.
        opponent: a policy for all robots of the other team, or None, as for `rsoccer.evaluate`.
        matches: number of matches of the evaluation.
        seed: seed of the evaluation.
        task: a task or its name, as for `rsoccer.evaluate`.
        names: names of policy and opponent on the score board; by default those of the policies.
        simulator: moves the robots, as for `rsoccer.evaluate`.
        sensing: what robots know of the true state, as for `rsoccer.evaluate`.
        randomization: numbers that each episode draws, as for `rsoccer.evaluate`.

    Returns:
        The replay of one episode.

    Raises:
        ImportError: a text "module:name" whose module or name does not exist.
        ValueError: an argument that `rsoccer.evaluate` refuses.
        TypeError: an argument of the wrong type.
    """
    task = task_for(policy) if task is None else as_task(task)
    side = len(SIDES) - 1 if task.two_sided else 0
    match_seed = first_seed(seed, side) + matches_per_side(task, matches) - 1
    own_policy = make_policy(policy, task)
    opponent_policy = None if opponent is None else make_policy(opponent, task)
    controllers = lineup(task, LEARN, opponent_policy, SIDES[side] if task.two_sided else None)
    if names is None:
        opponents = opponents_of(task) if opponent is None else [name_of(opponent)]
        names = (name_of(policy).upper(), " ".join(opponents).upper())
    world = Matches(
        task,
        1,
        match_seed,
        controllers=controllers,
        autoreset="disabled",
        simulator=simulator,
        sensing=sensing,
        forecasting=own_policy,
        randomization=randomization,
    )
    with closed_after(world, simulator):
        recorder = Recorder(world, names=names[::-1] if side else names, controllers=controllers)
        observations = world.reset()
        recorder.begin()
        learners = LearnerPolicy(own_policy, world, match_seed)
        while not world.done[0]:
            outcome = world.step(learners.act(observations))
            recorder.add(outcome)
            observations = outcome.observations
        return recorder.replay()

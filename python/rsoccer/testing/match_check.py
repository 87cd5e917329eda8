"""Checks of whole matches: a batch against single matches, and episodes after others."""

from __future__ import annotations

import numpy as np

from rsoccer.arrays import Array, Floats
from rsoccer.matches import Matches, Outcome
from rsoccer.task import Task
from rsoccer.testing.errors import TaskError, expect
from rsoccer.testing.method_results import same
from rsoccer.testing.pressure import Pressing


def check_batch(task: Task, worlds: int, steps: int, seed: int, autoreset: str) -> None:
    """Check that row i of a batch equals a single world seeded `seed + i`.

    Args:
        task: the task.
        worlds: number of worlds.
        steps: control steps, in which an episode has to end.
        seed: seed of the first world.
        autoreset: mode of `Matches`; "same_step" gets random actions, others press at the ball.

    Raises:
        TaskError: a world differs, or no episode ended.
    """
    batch = Matches(task, worlds, seed, autoreset=autoreset)
    singles = [Matches(task, 1, seed + i, autoreset=autoreset) for i in range(worlds)]
    rng, pressing = np.random.default_rng(seed), Pressing(task, seed)
    ended = 0
    _compare(batch.reset(), [single.reset() for single in singles], "the first observations")
    for step in range(steps):
        actions = (
            random_actions(rng, batch) if autoreset == "same_step" else pressing.actions(batch)
        )
        outcome = batch.step(actions)
        outcomes = [single.step(actions[i : i + 1]) for i, single in enumerate(singles)]
        where = f"in step {step} ({autoreset})"
        _compare_outcomes(outcome, outcomes, where)
        _compare(batch.frame.rows, [single.frame.rows for single in singles], f"the frame {where}")
        ended += int(outcome.ended.sum())
        mask = rng.random(worlds) < 0.02
        if autoreset == "disabled":
            mask |= batch.done & (rng.random(worlds) < 0.3)  # the others wait for a while
        if mask.any():
            rows = [single.reset() for single, resets in zip(singles, mask, strict=True) if resets]
            _compare(batch.reset(mask=mask)[mask], rows, f"a reset of some worlds {where}")
    expect(ended > 0, "no episode ended, so resets were not compared; give it more steps")


def check_history(task: Task, worlds: int, steps: int, seed: int) -> None:
    """Check that episodes after others equal the same episodes in fresh matches.

    Args:
        task: the task.
        worlds: number of worlds.
        steps: control steps, half of them compared.
        seed: seed of the first world.

    Raises:
        TaskError: a world differs.
    """
    used, fresh = Matches(task, worlds, seed + worlds), Matches(task, worlds, seed)
    rng = np.random.default_rng(seed)
    used.reset()
    for _ in range(steps // 2):
        used.step(random_actions(rng, used))
    _compare(used.reset(seed), [fresh.reset()], "a reset to the same seed after other episodes")
    for step in range(steps // 2):
        actions = random_actions(rng, fresh)
        outcome, expected = used.step(actions), fresh.step(actions)
        _compare_outcomes(outcome, [expected], f"in step {step} after other episodes")


def random_actions(rng: np.random.Generator, matches: Matches) -> Floats:
    """Return random actions (n, agents, action), mostly forward, so that robots meet.

    Args:
        rng: generator of the actions.
        matches: the matches.
    """
    shape = (matches.worlds, len(matches.agents), matches.action_size)
    return rng.uniform(-0.5, 1.0, shape).astype(np.float32)


def _compare_outcomes(batch: Outcome, singles: list[Outcome], where: str) -> None:
    for name in ("observations", "final_observations", "rewards", "terminated", "truncated"):
        parts = [getattr(single, name) for single in singles]
        _compare(getattr(batch, name), parts, f"{name} {where}")
    for name, term in batch.terms.items():
        _compare(term, [single.terms[name] for single in singles], f"term {name!r} {where}")
    for name, metric in batch.metrics.items():
        _compare(metric, [single.metrics[name] for single in singles], f"metric {name!r} {where}")


def _compare(batch: Array, singles: list[Array], label: str) -> None:
    """Expect that the rows of an array equal the rows of the other arrays, bit for bit."""
    expected = np.concatenate(singles)
    if not same(batch, expected):
        pairs = enumerate(zip(batch, expected, strict=True))
        worlds = [i for i, (row, single) in pairs if not same(row, single)]
        raise TaskError(f"{label}: worlds {worlds} of a batch differ from the same worlds alone")

"""A decision held for `action_repeat` control steps, and its result.

Only `Matches` and `Outcome` of a task are used.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Array, Floats, Mask
from rsoccer.matches import Matches, Outcome
from rsoccer.policies.base import MatchState
from rsoccer.policies.shield import Shield


@dataclass
class Transition:
    """Result of one decision in n worlds, after its last control step."""

    observations: Floats
    """(n, agents, o) next observations; the last ones of the episode where it ended."""
    rewards: Floats
    """(n, agents) sums over the control steps."""
    terms: dict[str, float]
    """Sum over the control steps of each reward term's mean over worlds and agents."""
    terminated: Mask
    """(n,) the task ended the episode."""
    ended: Mask
    """(n,) the episode terminated or reached the time limit."""
    metrics: dict[str, Array]
    """(n,) metrics of the task by name, valid where the episode ended."""
    states: Floats | None = None
    """(n, s) next global states, the last ones of the episode where it ended; None if not asked."""


def repeat_action(
    matches: Matches,
    actions: Floats,
    action_repeat: int,
    *,
    with_states: bool = False,
    shield: Shield | None = None,
) -> Transition:
    """Hold actions for some control steps, in each world until its episode ends.

    A world whose episode ends waits for the next decision, so no reward of one episode counts for
    an action of another.

    Args:
        matches: matches without automatic resets.
        actions: (n, agents, action) actions in [-1, 1].
        action_repeat: control steps, at least 1.
        with_states: return the global states, too.
        shield: changes the actions of each control step; None for none.

    Returns:
        The transition from before the first step to after the last.
    """
    outcome = matches.step(shielded(matches, actions, shield))
    result = Transition(
        outcome.observations,
        outcome.rewards,
        {name: _mean(term) for name, term in outcome.terms.items()},
        outcome.terminated,
        outcome.ended,
        outcome.metrics,
        matches.states() if with_states else None,
    )
    for _ in range(action_repeat - 1):
        waiting = np.flatnonzero(result.ended)  # few, mostly none
        outcome = matches.step(shielded(matches, actions, shield))
        states = None if result.states is None else matches.states()
        if len(waiting):
            _wait(result, outcome, states, waiting)
        result.observations, result.states = outcome.observations, states
        result.rewards += outcome.rewards
        for name, term in outcome.terms.items():
            result.terms[name] += _mean(term)
        result.terminated |= outcome.terminated
        result.ended |= outcome.ended
        result.metrics = outcome.metrics
    return result


def _wait(
    result: Transition, outcome: Outcome, states: Floats | None, worlds: NDArray[np.intp]
) -> None:
    """Let a step change nothing in some worlds: replace their part of its results."""
    outcome.observations[worlds] = result.observations[worlds]
    if states is not None and result.states is not None:
        states[worlds] = result.states[worlds]
    for array in (outcome.rewards, *outcome.terms.values()):
        array[worlds] = 0.0
    for ends in (outcome.terminated, outcome.truncated):
        ends[worlds] = False
    for name, values in outcome.metrics.items():
        values[worlds] = result.metrics[name][worlds]


def _mean(term: Floats) -> float:
    """Mean of all numbers of a term, as `term.mean()` in a third of its time."""
    return float(np.add.reduce(term, axis=None) / np.float32(term.size))


def shielded(matches: Matches, actions: Floats, shield: Shield | None) -> Floats:
    """Return the learners' actions of a control step, behind the shield.

    Args:
        matches: the matches, before the step.
        actions: (n, agents, action) actions.
        shield: changes them; None for none.

    Returns:
        New actions in [-1, 1]; the argument itself without a shield.
    """
    if shield is None:
        return actions
    play, config = matches.play, matches.task.config
    shielded = np.clip(actions, -1.0, 1.0)
    learners = matches.assignment.learners
    for team in (learners < config.n_blue, learners >= config.n_blue):  # each has its own senses
        if team.any():
            part = shielded[:, team]
            shield.apply(MatchState.of(play, learners[team], config), part)
            shielded[:, team] = part
    return shielded

"""Decisions in many matches: actions that are held, the shield, and teams that a policy plays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Array, Floats
from rsoccer.controllers import PolicyGroup, assign
from rsoccer.frame import team_of
from rsoccer.matches import Episodes, Matches, Outcome
from rsoccer.policies.shield import Shield
from rsoccer.rng import WorldRng
from rsoccer.task import LEARN
from rsoccer.train.clock import Clock
from rsoccer.train.opponents.policy_mix import PolicyMix
from rsoccer.train.rollout.transition import shielded

Indices = NDArray[np.intp]

NOBODY: Final = -1
"""Code of a team whose robots have actions of RLModules."""


class FixedTeams:
    """Policies of the package in the place of modules: each plays whole teams of some matches.

    A policy acts in all of its matches at once. Its random streams follow from the seed.
    """

    def __init__(self, matches: Matches, policies: Mapping[str, str], seed: int) -> None:
        """Make the policies.

        Args:
            matches: matches in which both teams learn.
            policies: name or file of a policy by the name of the module in whose place it plays.
            seed: seed of the random streams of the first match, at least 0.

        Raises:
            FileNotFoundError: no such policy file.
            ValueError: an unknown policy or one that does not fit the task, teams that do not
                learn, discrete actions, or a policy that observes in matches with a history.
        """
        self._matches, self._groups = matches, dict[str, tuple[PolicyGroup, Indices]]()
        self.modules = frozenset(policies)
        if not policies:
            return
        if len(matches.agents) < len(matches.task.robots) or matches.task.action_table is not None:
            raise ValueError("fixed: expected a task in which all robots learn continuous actions")
        names = list(dict.fromkeys(policies.values()))
        self._codes = {module: names.index(policy) for module, policy in policies.items()}
        streams = WorldRng.seeded(seed, matches.worlds)
        for team in dict.fromkeys(team_of(agent) for agent in matches.agents):
            mix = PolicyMix(matches.task, dict.fromkeys(names, 1.0), Clock())
            if mix.observes == "observation" and matches.history > 1:
                raise ValueError("fixed: expected scripts in matches with a history")
            group = assign(matches.task, {"all": LEARN, team: mix}, matches.worlds).groups[0]
            group.rng = streams.split(team)
            teams = np.array([team_of(agent) for agent in matches.agents])
            self._groups[team] = group, np.flatnonzero(teams == team)

    def begin(self, world: int, modules: Mapping[str, str]) -> None:
        """Begin an episode in a match.

        Args:
            world: index of the match.
            modules: module of each robot.

        Raises:
            ValueError: a team in which a policy plays beside modules.
        """
        for team, (group, agents) in self._groups.items():
            chosen = {modules[self._matches.agents[agent]] for agent in agents}
            if len(chosen) > 1 and chosen & self.modules:
                raise ValueError(f"policy_mapping_fn: expected one module in {team}, got {chosen}")
            worlds = np.array([world])
            group.restart(worlds, group.rng[worlds], self._matches.action_size)
            group.memory["drawn"][world] = self._codes.get(chosen.pop(), NOBODY)

    def act(self, observations: Floats, actions: Array) -> None:
        """Replace the actions of the teams that policies play.

        Args:
            observations: (n, agents, o) current observations.
            actions: (n, agents, action) actions; changed in place.
        """
        for group, agents in self._groups.values():
            playing = group.memory["drawn"] != NOBODY
            worlds = np.flatnonzero(playing)
            if len(worlds):
                chosen = np.zeros_like(self._matches.play.actions)
                group.act(self._matches.play, observations, chosen, playing)
                actions[np.ix_(worlds, agents)] = chosen[np.ix_(worlds, group.robots)]


def play_decision(
    matches: Matches,
    observations: Floats,
    actions: Array,
    action_repeat: int,
    shield: Shield | None,
    fixed: FixedTeams,
) -> Outcome:
    """Hold actions for some control steps, in each match until its episode ends.

    A match whose episode ended waits for the end of the decision, and begins a new one then. No
    reward of an episode counts for an action of another.

    Args:
        matches: matches without automatic resets.
        observations: (n, agents, o) current observations.
        actions: (n, agents, action) actions, or (n, agents) indices of the `action_table`.
        action_repeat: control steps, at least 1.
        shield: changes the actions of each control step; None for none.
        fixed: policies that play some teams; they decide in each control step.

    Returns:
        The outcome of all control steps, as matches with resets within the step have it.
    """
    episodes: list[Episodes] = []
    result: Outcome | None = None
    for _ in range(action_repeat):
        held = shielded(matches, actions, shield)
        if fixed.modules:
            held = np.array(held, np.float32)
            fixed.act(observations, held)
        outcome = matches.step(held)
        observations = outcome.observations
        if outcome.episodes is not None:
            episodes.append(outcome.episodes)
        if result is not None:
            outcome.rewards = result.rewards + outcome.rewards
            outcome.terms = {
                name: result.terms[name] + term for name, term in outcome.terms.items()
            }
            outcome.terminated |= result.terminated
            outcome.truncated |= result.truncated
        result = outcome
    assert result is not None, "action_repeat is at least 1"
    if episodes:
        result.episodes = _joined(episodes)
        result.observations = matches.reset(mask=result.ended)
    return result


def _joined(parts: Sequence[Episodes]) -> Episodes:
    """Episodes that ended in several control steps, in ascending order of their worlds."""
    if len(parts) == 1:
        return parts[0]
    worlds = np.concatenate([part.worlds for part in parts])
    order = np.argsort(worlds)

    def joined(arrays: Sequence[Array]) -> Array:
        return np.concatenate(arrays)[order]

    return replace(
        parts[0],
        worlds=worlds[order],
        lengths=joined([part.lengths for part in parts]),
        returns=joined([part.returns for part in parts]),
        terminated=joined([part.terminated for part in parts]),
        metrics={name: joined([part.metrics[name] for part in parts]) for name in parts[0].metrics},
    )

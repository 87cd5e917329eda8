"""Samples of a distillation: what the student knew, and what its teacher does when that arrives."""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

import numpy as np
import torch
from torch import nn

from rsoccer.arrays import Floats, Mask
from rsoccer.matches import Matches
from rsoccer.policies.network import Network
from rsoccer.train.rollout.transition import shielded


class Samples(NamedTuple):
    """Inputs of the student and the actions that it should choose."""

    observations: Floats
    """(k, o) stacked observations, not normalized."""
    actions: Floats
    """(k, action) mean actions of the teacher, in [-1, 1]."""


class _Decision(NamedTuple):
    """Decisions of all learners of all matches, whose labels are not known yet."""

    observations: Floats
    """(n, agents, o) stacked observations."""
    arrival: int
    """Control step in which they arrive."""
    playing: Mask
    """(n,) matches whose episode goes on since."""


class HindsightMatches:
    """Matches of a student whose commands arrive a known number of control steps late."""

    def __init__(self, matches: Matches, teacher: Network, delay: int) -> None:
        """Begin the matches.

        Args:
            matches: matches with senses, without automatic resets.
            teacher: policy that knows the true state; it decides for the robots of the learners.
            delay: control steps from a command to its arrival.
        """
        self._matches, self._teacher, self._delay = matches, teacher, delay
        self._observations = matches.reset()
        self._open: list[_Decision] = []
        self._step = 0

    def collect(
        self,
        student: nn.Module,
        normalize: nn.Module,
        noise: float,
        decisions: int,
        generator: torch.Generator,
    ) -> Samples:
        """Play some decisions of the student.

        Args:
            student: network from normalized observations to mean actions.
            normalize: module that normalizes observations.
            noise: standard deviation of the actions.
            decisions: decisions of each robot.
            generator: draws the noise.

        Returns:
            The samples whose labels have become known, of all matches.
        """
        found: list[Samples] = []
        for _ in range(decisions):
            with torch.no_grad():
                flat = torch.tensor(self._observations.reshape(-1, self._observations.shape[-1]))
                means = student(normalize(flat))
                drawn = means + noise * torch.randn(means.shape, generator=generator)
            actions = drawn.clamp(-1.0, 1.0).numpy().reshape(*self._observations.shape[:2], -1)
            playing = np.ones(self._matches.worlds, np.bool_)
            self._open.append(_Decision(self._observations, self._step + self._delay, playing))
            found += self._play(actions)
        return Samples(*(np.concatenate(parts) for parts in zip(*found, strict=True)))

    def _play(self, actions: Floats) -> list[Samples]:
        """Hold actions as the teacher does, behind its shield; label decisions that arrive."""
        found = self._label()
        ended = np.zeros(self._matches.worlds, np.bool_)
        for step in range(self._teacher.action_repeat):
            outcome = self._matches.step(shielded(self._matches, actions, self._teacher.shield))
            self._step += 1
            ended |= outcome.ended
            for decision in self._open:
                decision.playing[ended] = False
            if step < self._teacher.action_repeat - 1:
                found += self._label()
        self._observations = outcome.observations
        if ended.any():
            self._observations = self._matches.reset(mask=ended)
        return found

    def _label(self) -> list[Samples]:
        """Samples of the decisions that arrive now."""
        due = [decision for decision in self._open if decision.arrival == self._step]
        self._open = [decision for decision in self._open if decision.arrival > self._step]
        if not due:
            return []
        play = self._matches.play
        truth = dataclasses.replace(play, senses=None)
        layout = self._matches.task.layout
        true = layout.observe(truth)[:, self._matches.assignment.learner_indices]
        found = []
        for decision in due:
            seen = decision.observations
            block = layout.blocks.get("action")
            if block is not None:  # commands since then are still on their way
                true[..., block.columns] = seen[..., block.columns]
            labels = self._teacher.mean_actions(true)
            rows = decision.playing
            found.append(
                Samples(
                    seen[rows].reshape(-1, seen.shape[-1]),
                    labels[rows].reshape(-1, labels.shape[-1]),
                )
            )
        return found

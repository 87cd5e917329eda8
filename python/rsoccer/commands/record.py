"""`rsoccer record`: matches as a data set for offline learning."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

from tyro.conf import Positional, arg

from rsoccer.commands.imports import Imports
from rsoccer.commands.output import write
from rsoccer.commands.sources import Sources
from rsoccer.commands.subject import check_policy_names
from rsoccer.commands.task_options import TASK_OPTIONS, named_task
from rsoccer.datasets import record_episodes, save_minari
from rsoccer.evaluate.tables import align

_POLICIES = arg(metavar="POLICY", help_behavior_hint="")


@dataclass(frozen=True)
class Record(Sources, Imports):
    """Play matches with each policy and write them as a data set for offline learning."""

    policies: Annotated[tuple[str, ...], Positional, _POLICIES]
    """policies in the place of the learners; each plays as many matches as the others"""
    task: Annotated[str, arg(metavar="TASK")]
    """task to play"""
    minari: Annotated[str, arg(metavar="NAME")]
    """name of a new Minari data set, such as rsoccer/SSLGoToBall/mixed-v0"""
    task_options: Annotated[Mapping[str, Any], TASK_OPTIONS] = field(default_factory=dict)
    """options of the task (`rsoccer list` prints them), such as n_opponents=2"""
    opponents: Annotated[str | None, arg(metavar="POLICY", help_behavior_hint="")] = None
    """policy of the other team; by default the task's own"""
    matches: int = 100
    """matches of each policy; each has an episode for each robot of the policy"""
    seed: int = 0
    """seed of the first match; all matches have different ones"""
    worlds: int = 50
    """matches played at once"""
    threads: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(default: all)")] = None
    """threads of the simulator"""
    folder: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """folder of the data sets, in place of MINARI_DATASETS_PATH or ~/.minari"""

    def run(self) -> None:
        """Play the matches, write the data set, and print what it holds.

        Raises:
            ValueError: no policy, or an option that is refused.
        """
        if not self.policies:
            raise ValueError("policies: expected at least one, got none")
        if self.simulator is not None:
            raise ValueError(f"simulator: expected none, got {self.simulator}")
        check_policy_names([*self.policies, self.opponents])
        task = named_task(self.task, self.task_options)
        assert task is not None, "it is named"
        parts = [
            record_episodes(
                policy,
                task,
                self.matches,
                self.seed + index * self.matches,
                opponent=self.opponents,
                worlds=self.worlds,
                threads=self.threads,
                sensing=self.sensing,
                randomization=self.randomization,
            )
            for index, policy in enumerate(self.policies)
        ]
        if self.folder is not None:
            os.environ["MINARI_DATASETS_PATH"] = str(self.folder.resolve())
        episodes = [episode for part in parts for episode in part]
        save_minari(self.minari, episodes, task)
        metric = task.success
        rows = [
            (
                policy,
                str(len(part)),
                f"{sum(map(len, part)):,}",
                f"{sum(float(each.rewards.sum()) for each in part) / len(part):.2f}",
                "-"
                if metric is None
                else f"{sum(each.metrics[metric] for each in part) / len(part):.3f}",
            )
            for policy, part in zip(self.policies, parts, strict=True)
        ]
        header = ("policy", "episodes", "steps", "return", (metric or "-").replace("_", " "))
        write(f"{self.minari}\n\n{align([header, *rows], 1)}")

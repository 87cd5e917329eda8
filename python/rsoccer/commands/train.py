"""`rsoccer train`: `Args` with the options that tyro cannot parse by itself."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Final, Self

from tyro.conf import UseAppendAction, arg
from tyro.constructors import PrimitiveConstructorSpec

from rsoccer.commands.imports import IMPORTS
from rsoccer.commands.output import write
from rsoccer.commands.task_options import RANDOMIZATION, TASK_OPTIONS
from rsoccer.option_words import check_entries
from rsoccer.train import Args, OpponentSettings, train
from rsoccer.train.args import SETTINGS_FILE

_NOT_RESUMED: Final = {"out", "resume", "overwrite", "run.progress"}
"""Settings that belong to one call of the command, and not to the run."""


def _parse_mix(words: list[str]) -> dict[str, float]:
    """Policies with their shares, given as POLICY SHARE in turn."""
    if len(words) % 2:
        raise ValueError(f"expected pairs of POLICY and SHARE, got {' '.join(words)!r}")
    check_entries("policies", words[::2])
    return {name: float(share) for name, share in zip(words[::2], words[1::2], strict=True)}


# tyro's own would turn the policies of a default mix into options each, and refuse other policies.
_MIX = PrimitiveConstructorSpec[dict[str, float]](
    nargs="*",
    metavar="[POLICY SHARE [POLICY SHARE ...]]",
    instance_from_str=_parse_mix,
    is_instance=lambda value: isinstance(value, dict),
    str_from_instance=lambda mix: [str(part) for pair in mix.items() for part in pair],
)


@dataclass(frozen=True)
class Opponents(OpponentSettings):
    """Opponents of the learners, by share of the matches."""

    # By the word for opponents that all commands have.
    fixed: Annotated[dict[str, float], _MIX, arg(name="opponents", prefix_name=False)] = field(
        default_factory=dict
    )
    """policies with their shares in all other matches, else ou or the task's own"""


@dataclass(frozen=True)
class CommandArgs(Args):
    """Settings as the command line takes them."""

    imports: Annotated[tuple[str, ...], UseAppendAction, IMPORTS] = ()
    """module to import first, of the current folder or installed: one that registers a task or
    policies of your own; resumed runs import it again"""
    task_options: Annotated[Mapping[str, Any], TASK_OPTIONS] = field(default_factory=dict)
    """options of the task (`rsoccer list` prints them), such as opponent=chase or
    robot=heavy.json"""
    randomization: Annotated[Mapping[str, Any], RANDOMIZATION] = field(default_factory=dict)
    """numbers that each episode draws, by name, such as robot.mass=0.9,1.1"""
    opponents: Opponents = field(default_factory=Opponents)
    """opponents of the learners, by share of the matches"""

    @classmethod
    def of_run(cls, folder: Path) -> Self | None:
        """Return the settings of the run in a folder, the defaults when it resumes.

        Args:
            folder: the `out` of the run.

        Returns:
            None if its file of settings is missing, damaged or of a version with other settings.
        """
        try:
            saved = json.loads((folder / SETTINGS_FILE).read_bytes())
            return cls.from_json({name: saved[name] for name in saved if name not in _NOT_RESUMED})
        except (OSError, TypeError, ValueError):  # resuming reports what is wrong with the run
            return None


@dataclass(frozen=True)
class Train:
    """Train one policy for all learning robots with PPO, by self-play where both teams learn."""

    args: Annotated[CommandArgs, arg(name="")]
    """settings of the run"""

    def run(self) -> None:
        """Train, and print the path of the policy file."""
        write(f"policy: {train(self.args)}")

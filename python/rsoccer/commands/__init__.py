"""Commands of the command line, a module for each: a class whose fields are the options."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, TypeVar

from tyro.conf import subcommand

from rsoccer.commands.benchmark import Benchmark
from rsoccer.commands.convert import Convert
from rsoccer.commands.cooperation import Cooperation
from rsoccer.commands.distill import CommandDistillArgs, Distill
from rsoccer.commands.drive import Drive
from rsoccer.commands.evaluate import Evaluate
from rsoccer.commands.evolve import CommandEvolveArgs, Evolve
from rsoccer.commands.export import Export
from rsoccer.commands.identify import Identify
from rsoccer.commands.imports import imported
from rsoccer.commands.list import List
from rsoccer.commands.play import Play
from rsoccer.commands.record import Record
from rsoccer.commands.serve import Serve
from rsoccer.commands.tournament import Tournament
from rsoccer.commands.train import CommandArgs, Train
from rsoccer.commands.watch import Watch
from rsoccer.commands.what_if import WhatIf
from rsoccer.plugins import import_modules
from rsoccer.train.distillation import DistillArgs

A = TypeVar("A", CommandArgs, CommandEvolveArgs)


def command_type(words: Sequence[str]) -> Any:  # noqa: ANN401  (a union made at run time)
    """Return the union of the commands, as tyro takes it.

    Args:
        words: the words after `rsoccer`. Options of `train` and `evolve` that they do not give have
            the values of the run that they resume, or else the recommended ones for the task that
            they name.

    Raises:
        ImportError: a module that the words import does not exist or raises an error.
        ValueError: another text in the place of a module's name.
    """
    import_modules(imported(words))  # settings may be those of a task that one registers
    train_default = Train(_run_settings(words, "train", CommandArgs))
    evolve_default = Evolve(_run_settings(words, "evolve", CommandEvolveArgs))
    task = _last_value(words, "--task") or DistillArgs.task
    distill_default = Distill(CommandDistillArgs.for_task(task))
    return (
        Annotated[List, subcommand("list")]
        | Annotated[Train, subcommand("train", default=train_default)]
        | Annotated[Distill, subcommand("distill", default=distill_default)]
        | Annotated[Evolve, subcommand("evolve", default=evolve_default)]
        | Annotated[Evaluate, subcommand("evaluate")]
        | Annotated[Tournament, subcommand("tournament")]
        | Annotated[Cooperation, subcommand("cooperation")]
        | Annotated[Export, subcommand("export")]
        | Annotated[Benchmark, subcommand("benchmark")]
        | Annotated[Record, subcommand("record")]
        | Annotated[Identify, subcommand("identify")]
        | Annotated[Watch, subcommand("watch")]
        | Annotated[WhatIf, subcommand("what-if")]
        | Annotated[Play, subcommand("play")]
        | Annotated[Convert, subcommand("convert")]
        | Annotated[Serve, subcommand("serve")]
        | Annotated[Drive, subcommand("drive")]
    )


def _run_settings(words: Sequence[str], command: str, kind: type[A]) -> A:
    """Settings of the run that a command resumes, or else the recommended ones for its task."""
    resumed = None
    if _resumes(words, command):
        resumed = kind.of_run(Path(_last_value(words, "--out") or kind.out))
    return resumed or kind.for_task(_last_value(words, "--task") or kind.task)


def _resumes(words: Sequence[str], command: str) -> bool:
    """Whether the words are those of a command that resumes a run."""
    switches = [word for word in words if word in ("--resume", "--no-resume")]
    return command in words[:1] and switches[-1:] == ["--resume"]


def _last_value(words: Sequence[str], option: str) -> str | None:
    """Value of an option, given as two words or with "="; of its last use, as in parsers."""
    value = None
    for word, following in pairwise([*words, ""]):
        if word == option:
            value = following
        elif word.startswith(f"{option}="):
            value = word.partition("=")[2]
    return value

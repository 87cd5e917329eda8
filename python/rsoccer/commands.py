"""What the command line can do: a class for each command, whose fields are its options."""

from __future__ import annotations

import json
import math
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg, subcommand

from rsoccer import policies, registry
from rsoccer.evaluate import Evaluation, evaluate, table
from rsoccer.files import write_atomically
from rsoccer.lineup import lineup, opponents_of, task_for
from rsoccer.task import Task
from rsoccer.train import Args, train

PLAYER = (
    "a name that `rsoccer list` prints, or the path of a policy file, which plays as it was "
    "trained unless :mean or :sample follows"
)
OWN_TASK = "(default: the one that the policy was trained on, or VSSSelfPlay-v0)"
OWN_OPPONENT = "(default: whom the task has, or ou)"
POLICY = arg(metavar="POLICY", help=PLAYER)


@dataclass(frozen=True)
class List:
    """Name the tasks with their options, and the policies."""

    def run(self) -> None:
        """Print them."""
        for name in registry.list_tasks():
            task = registry.make_task(name)
            _write(f"{name}: {_summary(task)}")
            _write("\n".join(f"    {option}" for option in _options(task)) + "\n")
        for name, (task_name, options) in registry.list_aliases().items():
            told = [f"{option}={value!r}" for option, value in options.items()]
            _write(f"{name}: {', '.join([task_name, *told])}")
        _write(f"policies: {', '.join(policies.names())}, or the path of a policy file")
        skilled = (f"{name}:0.5" for name in policies.names_with_skill())
        _write("a file plays as it was trained; :mean or :sample may follow its name")
        _write(f"a skill from 0 to 1 may follow, as in {', '.join(skilled)}")


@dataclass(frozen=True)
class Train(Args):
    """Teach one policy to drive every learning robot, by playing against itself."""

    def run(self) -> None:
        """Train, and say where the policy is."""
        _write(f"policy: {train(self)}")


@dataclass(frozen=True)
class Evaluate:
    """Play a policy at its task, and print how well it does; from both sides where two play."""

    policy: Annotated[str, Positional, POLICY]
    opponents: Annotated[tuple[str, ...], arg(help_behavior_hint=OWN_OPPONENT)] = ()
    """one row of the table for each; names or paths, as for the policy"""
    matches: int = 200
    """for each opponent; where two sides play, half of them as blue, half as yellow"""
    seed: int = 0
    """the same seed gives the same table"""
    task: Annotated[str | None, arg(metavar="TASK", help_behavior_hint=OWN_TASK)] = None
    """what is played"""
    worlds: int = 50
    """matches played at once"""
    threads: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(default: all)")] = None
    """processors to use"""
    json: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """also write the results into this file"""

    def run(self) -> None:
        """Play, then print the table."""
        if self.json is not None and not self.json.parent.is_dir():
            raise ValueError(f"json: expected a file in a folder that exists, got {self.json}")
        evaluations = [self._against(opponent) for opponent in self.opponents or (None,)]
        _write(f"{evaluations[0].task}\n\n{table(evaluations)}")
        if self.json is not None:
            results = [evaluation.as_dict() for evaluation in evaluations]
            write_atomically(self.json, (json.dumps(results, indent=2) + "\n").encode())

    def _against(self, opponent: str | None) -> Evaluation:
        return evaluate(
            self.policy,
            opponent,
            self.matches,
            self.seed,
            task=self.task,
            worlds=self.worlds,
            threads=self.threads,
        )


@dataclass(frozen=True)
class Watch:
    """Show a match in a window, or film it."""

    policy: Annotated[str, Positional, POLICY] = "chase"
    opponent: Annotated[str | None, arg(metavar="POLICY", help_behavior_hint=OWN_OPPONENT)] = None
    """who plays yellow, against the policy in blue; likewise"""
    task: Annotated[str | None, arg(metavar="TASK", help_behavior_hint=OWN_TASK)] = None
    """what is played"""
    seed: int = 0
    """another seed, another match"""
    seconds: float = 60.0
    """of play; after a goal a new episode begins"""
    speed: float = 1.0
    """of the window's clock: 2 is twice as fast as life"""
    width: int | None = None
    """of the picture, in pixels; one at which robots can be told apart if not given"""
    video: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """write an .mp4 or .gif file in place of the window; needs no display"""

    def run(self) -> None:
        """Play on the screen, or into the file."""
        if not 0.0 < self.speed < math.inf:
            raise ValueError(f"speed: expected a positive number, got {self.speed}")
        from rsoccer.render.record import film_match
        from rsoccer.render.video import write_video

        task = task_for(self.policy) if self.task is None else registry.make_task(self.task)
        opponents = opponents_of(task) if self.opponent is None else [self.opponent]
        images, fps = film_match(
            task,
            lineup(task, self.policy, self.opponent),
            self.seed,
            self.seconds,
            names=(_team_name(self.policy), " ".join(map(_team_name, opponents))),
            width=self.width,
        )
        if self.video is not None:
            _write(f"video: {write_video(self.video, images, fps)}")
            return
        from rsoccer.render.window import Window

        window = Window(task.name, fps * self.speed)
        for image in images:
            if not window.show(image):
                break
        window.close()


Command = (
    Annotated[List, subcommand("list")]
    | Annotated[Train, subcommand("train")]
    | Annotated[Evaluate, subcommand("evaluate")]
    | Annotated[Watch, subcommand("watch")]
)


def _summary(task: Task) -> str:
    """The first line of what a task says of itself."""
    return (type(task).__doc__ or "").strip().split("\n")[0]


def _options(task: Task) -> list[str]:
    """A task's options for `make_task`, each with its default."""
    names = registry.list_options(type(task))
    return [f"{name}={getattr(task, name)!r}" for name in names]


def _team_name(player: str) -> str:
    """What stands on the score board."""
    if player.partition(":")[0] in policies.names():
        return player.upper()
    path = Path(player)
    return (path.parent.name or path.stem if path.suffix else player).upper()


def _write(text: str) -> None:
    sys.stdout.write(text + "\n")

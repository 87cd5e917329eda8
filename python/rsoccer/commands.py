"""Commands of the command line: one class per command, its fields are the options."""

from __future__ import annotations

import ast
import json
import math
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from tyro.conf import Positional, arg, subcommand
from tyro.constructors import PrimitiveConstructorSpec

from rsoccer import policies, registry
from rsoccer.controllers import Controller
from rsoccer.evaluate import evaluate, table, tournament
from rsoccer.files import write_atomically
from rsoccer.frame import team_of
from rsoccer.human.teams import SCRIPTS, team_controllers
from rsoccer.lineup import DEFAULT_TASK, lineup, opponents_of, task_for
from rsoccer.policies import trained
from rsoccer.policies.policy_file import Score
from rsoccer.replay.evaluation import record_last_match
from rsoccer.replay.recorder import record_replay
from rsoccer.replay.replay import SUFFIX, Replay
from rsoccer.task import Task
from rsoccer.train import Args, train
from rsoccer.view import SIDES

if TYPE_CHECKING:
    from rsoccer.render.image import Image

_SUBJECT_HELP = (
    "a policy: a name that `rsoccer list` prints, or the path of a policy file, which plays as it "
    "was trained unless :mean or :sample follows; or a task, whose policy --policy names"
)
_POLICIES = arg(
    metavar="POLICY [POLICY ...]",
    help="names that `rsoccer list` prints, or paths of policy files; at least two",
    help_behavior_hint="",
)
_SUBJECT = arg(metavar="POLICY|TASK", help=_SUBJECT_HELP, help_behavior_hint="")
_SUBJECT_OR_REPLAY = arg(
    metavar="POLICY|TASK|REPLAY",
    help=f"{_SUBJECT_HELP}; or a replay (.rsr)",
    help_behavior_hint="(default: best in VSSSelfPlay-v0)",
)
_POLICY = arg(
    metavar="POLICY", help_behavior_hint="(default: best, or a script where there is none)"
)
_DEFAULT_TASK = "(default: the one that the policy was trained on, or VSSSelfPlay-v0)"
_DEFAULT_PLAYER = "(default: the task's own, or a script where robots learn)"
_FIRST_ROBOT = "(default: the first learner)"
_DEFAULT_OPPONENT = "(default: the task's own, or ou where that team learns)"


def _parse_options(words: list[str]) -> dict[str, Any]:
    """Options given as NAME=VALUE; values as `rsoccer list` prints them, or text without quotes."""
    options: dict[str, Any] = {}
    for word in words:
        name, separator, value = word.partition("=")
        if not name or not separator:
            raise ValueError(f"task_options: expected NAME=VALUE, got {word!r}")
        try:
            options[name] = ast.literal_eval(value)
        except (SyntaxError, ValueError):
            options[name] = value
    return options


_TASK_OPTIONS = PrimitiveConstructorSpec[Mapping[str, Any]](
    nargs="*",
    metavar="[NAME=VALUE [NAME=VALUE ...]]",
    instance_from_str=_parse_options,
    is_instance=lambda value: isinstance(value, Mapping),
    str_from_instance=lambda options: [f"{name}={value!r}" for name, value in options.items()],
)


def _parse_mix(words: list[str]) -> dict[str, float]:
    """Policies with their shares, given as POLICY SHARE in turn."""
    if len(words) % 2:
        raise ValueError(f"expected pairs of POLICY and SHARE, got {' '.join(words)!r}")
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
class List:
    """Print the tasks with their options, and the policies."""

    def run(self) -> None:
        """Print the lists."""
        for name in registry.list_tasks():
            task = registry.make_task(name)
            _write(f"{name}: {_summary(task)}")
            _write("\n".join(f"    {option}" for option in _options(task)) + "\n")
        for name, (task_name, options) in registry.list_aliases().items():
            values = [f"{option}={value!r}" for option, value in options.items()]
            _write(f"{name}: {', '.join([task_name, *values])}")
        _write(f"policies: {', '.join(policies.list_policies())}, or the path of a policy file")
        _write("best is the trained policy of the task; its mean scores, with 95% intervals:")
        for name, path in trained.list_trained().items():
            scores = [_score_text(score) for score in trained.list_scores(path)]
            _write("\n".join(f"    {name}: {score}" for score in scores or ["not measured"]))
        examples = (f"{name}:0.5" for name in policies.list_policies_with_skill())
        _write("best and files play as they were trained; :mean or :sample may follow the name")
        _write(f"a skill from 0 to 1 may follow, as in {', '.join(examples)}")


@dataclass(frozen=True)
class Train(Args):
    """Train one policy for all learning robots with PPO, by self-play where both teams learn."""

    task_options: Annotated[Mapping[str, Any], _TASK_OPTIONS] = field(default_factory=dict)
    """options of the task (`rsoccer list` prints them), such as reward_weights=paper or
    opponent=chase"""
    opponents: Annotated[dict[str, float], _MIX] = field(default_factory=dict)
    teammates: Annotated[dict[str, float], _MIX] = field(default_factory=dict)

    def run(self) -> None:
        """Train, and print the path of the policy file."""
        _write(f"policy: {train(self)}")


@dataclass(frozen=True)
class Evaluate:
    """Play matches with a policy and print its scores, half for each team in two-sided tasks."""

    subject: Annotated[str | None, Positional, _SUBJECT] = None
    """policy in the place of the learners, or the task"""
    policy: Annotated[str | None, _POLICY] = None
    """policy in the place of the learners, after a task"""
    opponents: Annotated[tuple[str, ...], arg(help_behavior_hint=_DEFAULT_OPPONENT)] = ()
    """policies of the other team, names or paths; one row of the table for each"""
    matches: int = 200
    """matches against each opponent; in two-sided tasks half of them as blue, half as yellow"""
    seed: int = 0
    """random seed; equal seeds give equal tables"""
    task: Annotated[str | None, arg(metavar="TASK", help_behavior_hint=_DEFAULT_TASK)] = None
    """task to play"""
    worlds: int = 50
    """matches played at once"""
    threads: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(default: all)")] = None
    """threads of the simulator"""
    json: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """file to write the results to as JSON, in addition to the table"""
    html: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.html file to write: a page that plays the last match in a browser"""
    save: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.rsr file to write: the last match as a replay, which `rsoccer watch` plays"""

    def run(self) -> None:
        """Play the matches, then print the table.

        Raises:
            ValueError: neither a policy nor a task, the folder of a file does not exist, or
                `evaluate` refuses an option.
        """
        _check_output("json", self.json)
        _check_output("html", self.html, ".html")
        _check_output("save", self.save, SUFFIX)
        if (self.subject, self.policy, self.task) == (None, None, None):
            raise ValueError("policy: expected a policy or a task, got none")
        policy, task = _policy_and_task(self.subject, self.policy, self.task)
        evaluations = [
            evaluate(
                policy,
                opponent,
                self.matches,
                self.seed,
                task=task,
                worlds=self.worlds,
                threads=self.threads,
            )
            for opponent in self.opponents or (None,)
        ]
        _write(f"{evaluations[0].task}\n\n{table(evaluations)}")
        if self.json is not None:
            results = [evaluation.as_dict() for evaluation in evaluations]
            write_atomically(self.json, (json.dumps(results, indent=2) + "\n").encode())
        if self.html is not None or self.save is not None:
            self._write_last_match(policy, task)

    def _write_last_match(self, policy: str, task: Task) -> None:
        """Record the last match against the last opponent."""
        opponent = self.opponents[-1] if self.opponents else None
        opponents = opponents_of(task) if opponent is None else [opponent]
        replay = record_last_match(
            policy,
            opponent,
            self.matches,
            self.seed,
            task=task,
            names=(_team_name(policy), " ".join(map(_team_name, opponents))),
        )
        if self.html is not None:
            _write(f"page: {replay.save_html(self.html)}")
        if self.save is not None:
            _write(f"replay: {replay.save(self.save)}")


@dataclass(frozen=True)
class Tournament:
    """Play every policy against every other one, from both sides, and print their ratings."""

    policies: Annotated[tuple[str, ...], Positional, _POLICIES]
    """policies that play, at least two"""
    matches: int = 100
    """matches between each two policies, half of them on either side"""
    seed: int = 0
    """random seed; equal seeds give equal tables"""
    task: Annotated[str | None, arg(metavar="TASK", help_behavior_hint=_DEFAULT_TASK)] = None
    """task to play, one that two teams play; each policy controls all robots of its team"""
    worlds: int = 50
    """matches played at once"""
    threads: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(default: all)")] = None
    """threads of the simulator"""
    json: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """file to write the results to as JSON, in addition to the tables"""
    picture: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.png file to write: the goal scores as a heat map, and the ratings"""

    def run(self) -> None:
        """Play the matches, then print the tables.

        Raises:
            ValueError: the folder of a file does not exist, or `tournament` refuses an option.
        """
        _check_output("json", self.json)
        _check_output("picture", self.picture, ".png")
        if self.picture is not None:
            import matplotlib  # noqa: F401  (a missing package is reported before the matches)
        result = tournament(
            self.policies,
            self.matches,
            self.seed,
            task=self.task,
            worlds=self.worlds,
            threads=self.threads,
            on_pair=_show_pairs,
        )
        _write(str(result))
        if self.json is not None:
            write_atomically(self.json, (json.dumps(result.as_dict(), indent=2) + "\n").encode())
        if self.picture is not None:
            _write(f"picture: {result.save_picture(self.picture)}")


@dataclass(frozen=True)
class Watch:
    """Show a match or a replay in a window, or write it to files: video, page, replay."""

    subject: Annotated[str | None, Positional, _SUBJECT_OR_REPLAY] = None
    """policy in the place of the learners, the task, or a replay to play"""
    policy: Annotated[str | None, _POLICY] = None
    """policy in the place of the learners, after a task"""
    opponent: Annotated[str | None, arg(metavar="POLICY", help_behavior_hint=_DEFAULT_OPPONENT)] = (
        None
    )
    """policy of the yellow team, a name or path, against the policy in blue"""
    task: Annotated[str | None, arg(metavar="TASK", help_behavior_hint=_DEFAULT_TASK)] = None
    """task to play"""
    seed: int = 0
    """random seed; each seed gives another match"""
    seconds: float = 60.0
    """seconds of play; a new episode begins when one ends. A replay has its own duration"""
    speed: float = 1.0
    """speed of the window, above 0: 1 is real time, 2 is twice as fast"""
    width: int | None = None
    """width of the picture in pixels; by default one at which robots can be distinguished"""
    video: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.mp4 or .gif file to write instead of opening a window; needs no display"""
    html: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.html file to write instead: a page that plays the match in a browser"""
    save: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.rsr file to write instead: a replay, which `rsoccer watch` plays again"""
    snapshots: Annotated[
        float | None, arg(metavar="SECONDS", help_behavior_hint="(default: none)")
    ] = None
    """seconds of play between the snapshots of the saved replay, from which it can be resumed"""

    def run(self) -> None:
        """Show the match, or write the files.

        Raises:
            ValueError: the speed is not positive and finite, or another option is refused.
        """
        if not 0.0 < self.speed < math.inf:
            raise ValueError(f"speed: expected a positive number, got {self.speed}")
        _check_output("html", self.html, ".html")
        _check_output("save", self.save, SUFFIX)
        if self.subject is not None and self.subject.endswith(SUFFIX):
            self._play_replay(self._load(self.subject))
        elif self.html or self.save:
            self._play_replay(self._record())
        else:
            self._play_match()

    def _load(self, path: str) -> Replay:
        """The replay that is named in the place of a policy."""
        for name in ("policy", "opponent", "task", "snapshots"):
            if getattr(self, name) is not None:
                raise ValueError(f"{name}: expected none for a replay, got {getattr(self, name)}")
        return Replay.load(path)

    def _record(self) -> Replay:
        """A new match as a replay."""
        task, controllers, names = self._match()
        return record_replay(
            task,
            controllers,
            self.seed,
            self.seconds,
            names=names,
            snapshot_interval=self.snapshots,
        )

    def _play_replay(self, replay: Replay) -> None:
        """Write a replay to the files, or show it."""
        if self.save is not None:
            path = replay.save(self.save)
            _write(f"replay: {path} ({path.stat().st_size / 1024 / replay.seconds:.1f} KiB/s)")
        if self.html is not None:
            _write(f"page: {replay.save_html(self.html)}")
        if self.video is not None or not (self.html or self.save):
            from rsoccer.replay.film import film_replay

            self._show(replay.task, *film_replay(replay, self.width))

    def _play_match(self) -> None:
        """Show a new match while it is played."""
        from rsoccer.render.record import film_match

        task, controllers, names = self._match()
        images, fps = film_match(
            task, controllers, self.seed, self.seconds, names=names, width=self.width
        )
        self._show(task.name, images, fps)

    def _match(self) -> tuple[Task, dict[str, Controller], tuple[str, str]]:
        """The task, the controllers, and the names of the teams."""
        policy, task = _policy_and_task(self.subject, self.policy, self.task)
        opponents = opponents_of(task) if self.opponent is None else [self.opponent]
        names = (_team_name(policy), " ".join(map(_team_name, opponents)))
        return task, lineup(task, policy, self.opponent), names

    def _show(self, title: str, images: Iterator[Image], fps: float) -> None:
        """Write images to the video file, or show them in a window."""
        from rsoccer.render.video import write_video

        if self.video is not None:
            _write(f"video: {write_video(self.video, images, fps)}")
            return
        from rsoccer.render.window import Window

        window = Window(title, fps * self.speed)
        for image in images:
            if not window.show(image):
                break
        window.close()


@dataclass(frozen=True)
class Play:
    """Drive a robot by keyboard or gamepad, against policies and with them."""

    task: Annotated[str, Positional, arg(metavar="TASK")] = DEFAULT_TASK
    """task to play"""
    robot: Annotated[str | None, arg(metavar="ROBOT", help_behavior_hint=_FIRST_ROBOT)] = None
    """robot to drive first, such as blue_0 or yellow_1"""
    policy: Annotated[str | None, arg(metavar="POLICY", help_behavior_hint=_DEFAULT_PLAYER)] = None
    """policy of the other learners in the driven robot's team"""
    opponent: Annotated[str | None, arg(metavar="POLICY", help_behavior_hint=_DEFAULT_PLAYER)] = (
        None
    )
    """policy of the other team"""
    controllers: Annotated[
        tuple[str, ...], arg(metavar="NAME=POLICY", help_behavior_hint="(default: none)")
    ] = ()
    """policies of single robots, of "blue", "yellow" or "all", as in yellow_0=zero"""
    seed: int = 0
    """random seed; each seed gives another match"""
    seconds: Annotated[float, arg(help_behavior_hint="(default: until the window is closed)")] = (
        math.inf
    )
    """longest duration, in real time"""
    speed: float = 1.0
    """speed of play, above 0: 1 is real time, 2 is twice as fast"""
    width: int | None = None
    """width of the picture in pixels; by default one at which robots can be distinguished"""

    def run(self) -> None:
        """Open the window and play.

        Raises:
            ValueError: a controller without "=", or another option is refused.
        """
        from rsoccer.human.session import Session

        task = registry.make_task(self.task)
        robot = self.robot or next(iter(task.agents or task.robots))
        controllers = self._controllers(task, robot)
        session = Session(
            task,
            controllers,
            robot,
            seed=self.seed,
            speed=self.speed,
            width=self.width,
            names=self._names(task, robot, controllers),
        )
        session.run(self.seconds)

    def _controllers(self, task: Task, robot: str) -> dict[str, Controller]:
        """Policies of all robots: the task's own, then the options, the most specific last."""
        chosen = team_controllers(task, robot, self.policy, self.opponent)
        # A team's name overrules the names above it, and a robot's name that of its team.
        for entry in sorted(self.controllers, key=_rank):
            name, equals, policy = entry.partition("=")
            if not (name and equals and policy):
                raise ValueError(f"controllers: expected NAME=POLICY, got {entry!r}")
            robots = [r for r in task.robots if name in ("all", team_of(r), r)]
            if not robots:
                raise ValueError(
                    f"controllers: expected a robot, a team or all of {task.name}, got {name!r}"
                )
            chosen |= dict.fromkeys(robots, policy)
        return chosen

    def _names(self, task: Task, robot: str, controllers: dict[str, Controller]) -> tuple[str, str]:
        """Names of the teams on the score board: the person's, and the other's policies."""
        others = [name for name in task.robots if team_of(name) != team_of(robot)]
        policies = dict.fromkeys(_team_name(str(controllers[name])) for name in others)
        rival = " ".join(policies)
        return ("YOU", rival) if team_of(robot) == "blue" else (rival, "YOU")


def command_type(words: Sequence[str]) -> Any:  # noqa: ANN401  (a union made at run time)
    """Return the union of the commands, as tyro takes it.

    Args:
        words: the words after `rsoccer`. Options of `train` that they do not give have the
            recommended values for the task that they name.
    """
    default = Train.for_task(_last_value(words, "--task") or Train.task)
    return (
        Annotated[List, subcommand("list")]
        | Annotated[Train, subcommand("train", default=default)]
        | Annotated[Evaluate, subcommand("evaluate")]
        | Annotated[Tournament, subcommand("tournament")]
        | Annotated[Watch, subcommand("watch")]
        | Annotated[Play, subcommand("play")]
    )


def _last_value(words: Sequence[str], option: str) -> str | None:
    """Value of an option, given as two words or with "="; of its last use, as in parsers."""
    value = None
    for word, following in pairwise([*words, ""]):
        if word == option:
            value = following
        elif word.startswith(f"{option}="):
            value = word.partition("=")[2]
    return value


def _policy_and_task(subject: str | None, policy: str | None, task: str | None) -> tuple[str, Task]:
    """The policy and the task of a command, whose first word names either.

    Raises:
        ValueError: two policies, two tasks, or an unknown task.
    """
    if subject is not None and registry.is_task_name(subject) and not Path(subject).exists():
        if task is not None:
            raise ValueError(f"task: expected one task, got {subject} and {task}")
        task = subject
    elif subject is not None:
        if policy is not None:
            raise ValueError(f"policy: expected a task before --policy {policy}, got {subject}")
        policy = subject
    if task is not None:
        made = registry.make_task(task)
    else:
        made = registry.make_task(DEFAULT_TASK) if policy is None else task_for(policy)
    return policy or _default_policy(made), made


def _default_policy(task: Task) -> str:
    """The trained policy of a task, or a script that plays in the place of one."""
    try:
        trained.load_best(task)
    except ValueError:
        return SCRIPTS[task.config.robots[0].drive]
    return trained.BEST


def _score_text(score: Score) -> str:
    """A score in one line."""
    opponent = "" if score.opponent == "-" else f" against {score.opponent}"
    return (
        f"{score.metric} {score.score:.3f} ({score.low:.3f} to {score.high:.3f}){opponent}, "
        f"{score.matches} matches"
    )


def _rank(entry: str) -> int:
    """Order of an option NAME=POLICY: all robots, a team, a robot."""
    name = entry.partition("=")[0]
    return 0 if name == "all" else 1 if name in SIDES else 2


def _summary(task: Task) -> str:
    """First line of the task's docstring."""
    return (type(task).__doc__ or "").strip().split("\n")[0]


def _options(task: Task) -> list[str]:
    """Options of a task for `make_task`, each with its default."""
    names = registry.list_options(type(task))
    return [f"{name}={getattr(task, name)!r}" for name in names]


def _team_name(player: str) -> str:
    """Name of a policy on the scoreboard: for a file its folder's name."""
    if player.partition(":")[0] in policies.list_policies():
        return player.upper()
    path = Path(player)
    return (path.parent.name or path.stem if path.suffix else player).upper()


def _check_output(option: str, path: Path | None, suffix: str = "") -> None:
    """Refuse a file in a folder that does not exist, or with another suffix."""
    if path is not None and not path.parent.is_dir():
        raise ValueError(f"{option}: expected a file in a folder that exists, got {path}")
    if path is not None and suffix and path.suffix != suffix:
        raise ValueError(f"{option}: expected a name ending in {suffix}, got {path}")


def _show_pairs(done: int, total: int) -> None:
    """Show on a terminal how many pairs have played."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r{done} of {total} pairs" + ("\n" if done == total else ""))


def _write(text: str) -> None:
    """Print a line on standard output."""
    sys.stdout.write(text + "\n")

"""`rsoccer watch`: a match or a replay in a window or in files."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

from tyro.conf import Positional, arg

from rsoccer import checks
from rsoccer.commands.imports import Imports
from rsoccer.commands.output import check_output, write
from rsoccer.commands.sources import Sources
from rsoccer.commands.subject import (
    DEFAULT_OPPONENT_HINT,
    DEFAULT_TASK_HINT,
    POLICY,
    SUBJECT_OR_REPLAY,
    check_policy_names,
    policy_and_task,
    team_name,
)
from rsoccer.commands.task_options import TASK_OPTIONS
from rsoccer.controllers import Controller
from rsoccer.lineup import lineup, opponents_of, script_of
from rsoccer.render.video import VIDEO_SUFFIXES
from rsoccer.replay.recorder import record_replay
from rsoccer.replay.replay import SUFFIX, Replay
from rsoccer.task import Task
from rsoccer.tasks.match import Match

if TYPE_CHECKING:
    from rsoccer.render.image import Image


_OPPONENTS_HINT: Final = f"{DEFAULT_OPPONENT_HINT[:-1]}; scripted in whole matches)"
_OF_MATCHES: Final = (
    *("policy", "opponents", "task", "task_options", "snapshots"),
    *("simulator", "sensing", "randomization"),
)
"""Options that a replay does not take."""


@dataclass(frozen=True)
class Watch(Sources, Imports):
    """Show a match or a replay in a window, or write it to files: video, page, replay."""

    subject: Annotated[str | None, Positional, SUBJECT_OR_REPLAY] = None
    """policy in the place of the learners, the task, or a replay to play"""
    policy: Annotated[str | None, POLICY] = None
    """policy in the place of the learners, after a task"""
    opponents: Annotated[str | None, arg(metavar="POLICY", help_behavior_hint=_OPPONENTS_HINT)] = (
        None
    )
    """policy of the yellow team, a name or path, against the policy in blue"""
    task: Annotated[str | None, arg(metavar="TASK", help_behavior_hint=DEFAULT_TASK_HINT)] = None
    """task to play"""
    task_options: Annotated[Mapping[str, Any], TASK_OPTIONS] = field(default_factory=dict)
    """options of the task that is named (`rsoccer list` prints them), such as n_opponents=2"""
    seed: int = 0
    """random seed; each seed gives another match"""
    seconds: float = 60.0
    """seconds of play; a new episode begins when one ends. A replay has its own duration"""
    speed: float = 1.0
    """speed of the window, above 0: 1 is real time, 2 is twice as fast"""
    width: int | None = None
    """width of the picture in pixels; by default one at which robots can be distinguished"""
    ghosts: bool = True
    """show ball and robots as the robots know them too, in thin outlines, if they have senses"""
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
            ValueError: the speed is not positive and finite, snapshots without a replay to save, or
                another option is refused.
        """
        if not 0.0 < self.speed < math.inf:
            raise ValueError(f"speed: expected a positive number, got {self.speed}")
        check_output("video", self.video, *VIDEO_SUFFIXES)
        check_output("html", self.html, ".html")
        check_output("save", self.save, SUFFIX)
        if self.snapshots is not None:
            checks.positive_number("snapshots", self.snapshots)
            if self.save is None:
                raise ValueError(f"snapshots: expected none without --save, got {self.snapshots}")
        if self.subject is not None and self.subject.endswith(SUFFIX):
            self._play_replay(self._load(self.subject))
        elif self.html or self.save:
            self._play_replay(self._record())
        else:
            self._play_match()

    def _load(self, path: str) -> Replay:
        """The replay that is named in the place of a policy."""
        for name in _OF_MATCHES:
            if getattr(self, name) not in (None, {}):
                raise ValueError(f"{name}: expected none for a replay, got {getattr(self, name)}")
        for name in ("seed", "seconds"):
            if getattr(self, name) != getattr(Watch, name):
                raise ValueError(f"{name}: expected no other than the replay's own")
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
            simulator=self.simulator,
            sensing=self.sensing,
            randomization=self.randomization,
        )

    def _play_replay(self, replay: Replay) -> None:
        """Write a replay to the files, or show it."""
        if self.save is not None:
            path = replay.save(self.save)
            size = path.stat().st_size / 1024
            rate = f"{size / replay.seconds:.1f} KiB/s" if replay.seconds else f"{size:.1f} KiB"
            write(f"replay: {path} ({rate})")
        if self.html is not None:
            write(f"page: {replay.save_html(self.html)}")
        if self.video is not None or not (self.html or self.save):
            from rsoccer.replay.film import film_replay

            self._show(replay.task, *film_replay(replay, self.width, ghosts=self.ghosts))

    def _play_match(self) -> None:
        """Show a new match while it is played."""
        from rsoccer.recording import film_match

        task, controllers, names = self._match()
        images, fps = film_match(
            task,
            controllers,
            self.seed,
            self.seconds,
            names=names,
            width=self.width,
            ghosts=self.ghosts,
            simulator=self.simulator,
            sensing=self.sensing,
            randomization=self.randomization,
        )
        with closing(images):
            self._show(task.name, images, fps)

    def _match(self) -> tuple[Task, dict[str, Controller], tuple[str, str]]:
        """The task, the controllers, and the names of the teams."""
        check_policy_names([self.opponents])
        policy, task = policy_and_task(self.subject, self.policy, self.task, self.task_options)
        opponent = self.opponents
        if opponent is None and isinstance(task, Match):
            opponent = script_of(task)  # noise under a referee is not worth watching
        opponents = opponents_of(task) if opponent is None else [opponent]
        names = (team_name(policy), " ".join(map(team_name, opponents)))
        return task, lineup(task, policy, opponent), names

    def _show(self, title: str, images: Iterator[Image], fps: float) -> None:
        """Write images to the video file, or show them in a window."""
        from rsoccer.render.video import write_video

        if self.video is not None:
            write(f"video: {write_video(self.video, images, fps)}")
            return
        from rsoccer.render.window import Window

        window = Window(title, fps * self.speed)
        for image in images:
            if not window.show(image):
                break
        window.close()

"""`rsoccer what-if`: a recorded match played on by other policies."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from rsoccer.commands.imports import Imports
from rsoccer.commands.output import check_output, write
from rsoccer.commands.subject import check_policy_names, team_name
from rsoccer.controllers import Controllers
from rsoccer.policies import is_module_text
from rsoccer.replay import Replay, ReplayError, what_if
from rsoccer.replay.branch import has_exact_start
from rsoccer.replay.replay import SUFFIX

_TEAM = arg(metavar="POLICY", help_behavior_hint="(default: as recorded)")


@dataclass(frozen=True)
class WhatIf(Imports):
    """Play on from a moment of a replay with other policies, and compare with the recording."""

    replay: Annotated[Path, Positional, arg(metavar="REPLAY")]
    """.rsr file of the recording"""
    at: float
    """second of play of the recording at which the policies change"""
    blue: Annotated[str | None, _TEAM] = None
    """policy of blue from then on"""
    yellow: Annotated[str | None, _TEAM] = None
    """policy of yellow from then on"""
    seconds: float = 30.0
    """longest duration from then on; the match may end before"""
    seed: int = 0
    """random seed of the new policies"""
    matches: int = 1
    """number of continuations, with seeds from --seed on; the files have the first one"""
    html: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.html file to write: a page that plays the new match in a browser"""
    save: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.rsr file to write: the new match as a replay"""

    def run(self) -> None:
        """Play on, print the goals of both matches, and write the files.

        Raises:
            ValueError: no other policy, or an option that is refused.
        """
        check_output("html", self.html, ".html")
        check_output("save", self.save, SUFFIX)
        if self.blue is None and self.yellow is None:
            raise ValueError("blue: expected another policy of blue or of yellow, got none")
        if self.matches < 1:
            raise ValueError(f"matches: expected 1 or more, got {self.matches}")
        check_policy_names([self.blue, self.yellow])
        recorded = Replay.load(self.replay)
        frame = self._frame(recorded)
        controllers = self._controllers(recorded)
        given = (self.blue, self.yellow)
        names = [
            old if player is None else team_name(player)
            for old, player in zip(recorded.names, given, strict=True)
        ]
        continued = [
            what_if(
                *(recorded, frame, controllers),
                seed=self.seed + index,
                seconds=self.seconds,
                names=(names[0], names[1]),
            )
            for index in range(self.matches)
        ]
        if not has_exact_start(recorded, frame):
            write("no snapshot before this moment: a new match begins with the bodies of the frame")
        self._report(recorded, frame, continued)
        if self.html is not None:
            write(f"page: {continued[0].save_html(self.html)}")
        if self.save is not None:
            write(f"replay: {continued[0].save(self.save)}")

    def _frame(self, recorded: Replay) -> int:
        """The frame of the recording at the moment."""
        if not 0.0 <= self.at <= recorded.seconds:
            raise ValueError(f"at: expected 0 to {recorded.seconds:g} s, got {self.at:g}")
        return int(recorded.clock.searchsorted(self.at - 1e-9))

    def _controllers(self, recorded: Replay) -> Controllers:
        """The policies of all robots from the moment on."""
        given = {"blue": self.blue, "yellow": self.yellow}
        found = {}
        for robot, name in recorded.controllers.items():
            team = robot.partition("_")[0]
            player = given[team] or name
            if player is None or player == "LEARN":
                raise ReplayError(f"{team}: expected a policy for {robot}")
            if given[team] is None and is_module_text(player):  # a file must not decide what runs
                raise ReplayError(
                    f"{team}: expected a policy for {robot}, as the recorded one is code: {player}"
                )
            found[robot] = player
        return found

    def _report(self, recorded: Replay, frame: int, continued: list[Replay]) -> None:
        """Print the goals after the moment, in the recording and without it."""
        end = next(part.stop for part in recorded.episodes if frame < part.stop) - 1
        end = min(end, frame + round(self.seconds / recorded.config.time_step))
        blue, yellow = (recorded.score[end] - recorded.score[frame]).tolist()
        passed = (end - frame) * recorded.config.time_step
        write(f"recorded: {' : '.join(recorded.names)} {blue} : {yellow} in {passed:.1f} s")
        for index, replay in enumerate(continued):
            blue, yellow = replay.score[-1].tolist()
            seed = f" (seed {self.seed + index})" if len(continued) > 1 else ""
            teams = " : ".join(replay.names)
            write(f"what if:  {teams} {blue} : {yellow} in {replay.seconds:.1f} s{seed}")
        if len(continued) > 1:
            goals = sum(replay.score[-1] for replay in continued) / len(continued)
            write(f"mean of {len(continued)}: {goals[0]:.2f} : {goals[1]:.2f}")

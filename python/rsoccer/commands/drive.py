"""`rsoccer drive`: a policy for another simulator or for robots."""

from __future__ import annotations

import math
import signal
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import FrameType
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal

from tyro.conf import Positional, arg

from rsoccer import checks
from rsoccer.commands.entries import named_entries
from rsoccer.commands.imports import Imports
from rsoccer.commands.output import write
from rsoccer.commands.subject import DEFAULT_TASK_HINT, POLICY, SUBJECT, policy_and_task
from rsoccer.commands.task_options import TASK_OPTIONS
from rsoccer.task import Task

if TYPE_CHECKING:
    from rsoccer.drive.connection import Connection
    from rsoccer.drive.session import Session
    from rsoccer.drive.settings import Settings
    from rsoccer.protocols.limits import Limits

_IDS = arg(metavar="[INT [INT ...]]", help_behavior_hint="(default: 0, 1, ...)")
_CAMERAS = arg(metavar="PRESET|FILE", help_behavior_hint="(default: rc2021 at 60 Hz)")
_LIMIT = arg(help_behavior_hint="(default: none)")
REPORTED_STEPS: Final = 20
"""Control steps of an episode from which its end is reported."""
_USUAL = "(default: those of the protocol)"


@dataclass(frozen=True)
class Drive(Imports):
    """Drive a team of another simulator, or of robots, with a policy."""

    subject: Annotated[str | None, Positional, SUBJECT] = None
    """policy in the place of the learners, or the task"""
    to: Literal["grsim", "firasim", "ssl-simulation"] = "ssl-simulation"
    """protocol of the commands"""
    team: Literal["blue", "yellow"] = "blue"
    """team to drive"""
    policy: Annotated[str | None, POLICY] = None
    """policy in the place of the learners, after a task"""
    task: Annotated[str | None, arg(metavar="TASK", help_behavior_hint=DEFAULT_TASK_HINT)] = None
    """task that the policy plays, with its field, ball and robots"""
    task_options: Annotated[Mapping[str, Any], TASK_OPTIONS] = field(default_factory=dict)
    """options of the task that is named (`rsoccer list` prints them)"""
    ids: Annotated[tuple[int, ...], _IDS] = ()
    """uniform numbers of the team's robots"""
    opponent_ids: Annotated[tuple[int, ...], _IDS] = ()
    """uniform numbers of the other team's robots"""
    check: Annotated[int | None, arg(metavar="ID", help_behavior_hint="(default: none)")] = None
    """uniform number of a robot to check sides, signs and the delay with, instead of playing"""
    delay: float = 0.0
    """time from a command until vision shows its effect, seconds: the policy knows the state after
    it. --check measures it"""
    cameras: Annotated[str | None, _CAMERAS] = None
    """senses whose noise and frame rate the cameras have, with which the tracker averages;
    `rsoccer identify` measures them"""
    max_speed: Annotated[float, _LIMIT] = math.inf
    """greatest speed of a robot, m/s"""
    max_angular_velocity: Annotated[float, _LIMIT] = math.inf
    """greatest angular velocity of a robot, rad/s"""
    max_kick_speed: Annotated[float, _LIMIT] = math.inf
    """greatest speed of a kick, m/s; 0 for no kicks"""
    source: Literal["vision", "tracker"] = "vision"
    """source of the state: cameras, or a tracker (SSL)"""
    referee: Literal["obey", "require", "ignore"] = "obey"
    """obey: once it is heard; require: robots stand until it is heard"""
    blue_on_positive_half: Annotated[
        bool | None, arg(help_behavior_hint="(default: by the referee, or as the simulator has it)")
    ] = None
    """whether blue's goal is at +x on the network"""
    host: str = "127.0.0.1"
    """address to which commands go"""
    interface: str = "127.0.0.1"
    """address of the interface on which vision and referee are heard"""
    ttl: int = 0
    """routers that multicast may pass, plus 1; 0 for this machine alone"""
    ports: Annotated[tuple[str, ...], arg(metavar="NAME=PORT", help_behavior_hint=_USUAL)] = ()
    """other ports, such as vision=10006"""
    groups: Annotated[tuple[str, ...], arg(metavar="NAME=HOST", help_behavior_hint=_USUAL)] = ()
    """other multicast groups or hosts, such as vision=127.0.0.1"""
    synchronous: bool = False
    """the simulator waits for commands after each frame, as `rsoccer serve --speed max` does"""
    vision_timeout: Annotated[
        float | None, arg(help_behavior_hint="(default: 0.2, or 5 with --synchronous)")
    ] = None
    """time without a frame after which robots stop, seconds, also where the policy computes for
    longer"""
    patience: float = 10.0
    """time without what is needed to go on until the command gives up, seconds"""
    seconds: Annotated[float, arg(help_behavior_hint="(default: until Ctrl-C)")] = math.inf
    """longest duration, by the clock of the frames"""
    episodes: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(default: any)")] = None
    """number of the task's episodes after which to stop, such as 1 to reach the ball once"""
    seed: int = 0
    """random seed of the policy"""

    def run(self) -> None:
        """Drive until Ctrl-C.

        Raises:
            OSError: a port is taken, an address is not one of this machine, or nothing is seen.
            RuntimeError: the simulator refuses all commands.
            ValueError: an option is refused.
        """
        checks.number_in_range("seconds", self.seconds, 0.0, math.inf)
        if self.episodes is not None:
            checks.integer("episodes", self.episodes, 1)
        checks.number_in_range("delay", self.delay, 0.0, 1.0)
        policy, task = policy_and_task(self.subject, self.policy, self.task, self.task_options)
        settings = self.settings()
        previous = signal.signal(signal.SIGTERM, _interrupt)
        try:
            if self.check is not None:
                self._check(task, settings)
            else:
                self._play(policy, task, settings)
        except KeyboardInterrupt:
            sys.stderr.write("stopped\n")
        finally:
            signal.signal(signal.SIGTERM, previous)

    def _limits(self) -> Limits:
        """Greatest speeds, in the words of the options."""
        from rsoccer.protocols.limits import Limits

        names = ("max_speed", "max_angular_velocity", "max_kick_speed")
        for name in names:
            if (value := getattr(self, name)) != math.inf:
                checks.number_in_range(name, value, 0.0, 1e6)
        return Limits(*(getattr(self, name) for name in names))

    def settings(self) -> Settings:
        """Return the settings of the connection.

        Raises:
            ValueError: an option is refused.
        """
        from rsoccer.drive.settings import Settings

        ports = {}
        for name, value in named_entries("ports", self.ports):
            if not value.isdecimal():
                raise ValueError(f"ports: expected a number for {name}, got {value!r}")
            ports[name] = int(value)
        return Settings(
            self.to,
            team=self.team,
            ids=self.ids or None,
            opponent_ids=self.opponent_ids or None,
            host=self.host,
            interface=self.interface,
            ttl=self.ttl,
            ports=ports,
            groups=dict(named_entries("groups", self.groups)),
            source=self.source,
            blue_on_positive_half=self.blue_on_positive_half,
            referee=self.referee,
            limits=self._limits(),
            is_synchronous=self.synchronous,
            vision_timeout=self.vision_timeout,
            patience=self.patience,
        )

    def _play(self, policy: str, task: Task, settings: Settings) -> None:
        from rsoccer.drive.session import Session

        session = Session(
            policy, task, settings, delay=self.delay, cameras=self.cameras, seed=self.seed
        )
        try:
            session.connection.on_event.append(_tell)
            session.begin()
            self._steps(session)
        finally:
            session.close()
            _report(session.connection)

    def _steps(self, session: Session) -> None:
        clock = session.connection.sight.clock
        end = clock.now + self.seconds
        most = math.inf if self.episodes is None else self.episodes
        while clock.now < end and len(session.episodes) < most:
            begun = session.matches.play.steps[0]
            outcome = session.step()
            # An episode may end as soon as it has begun, again and again, if bodies stay in place.
            if outcome.episodes is not None and (
                begun >= REPORTED_STEPS or len(session.episodes) == 1
            ):
                metrics = session.episodes[-1].items()
                numbers = ", ".join(f"{name} {value:.3g}" for name, value in metrics)
                write(f"{clock.now:.1f} s: an episode ended, {numbers}")
        write(f"{len(session.episodes)} episodes of {session.matches.task.name}")

    def _check(self, task: Task, settings: Settings) -> None:
        from rsoccer.drive.check import check_robot, describe
        from rsoccer.drive.connection import Connection
        from rsoccer.protocols.layout import TEAM_NAMES

        assert self.check is not None, "the caller has checked it"
        connection = Connection(task.config, settings)
        try:
            connection.on_event.append(_tell)
            layout, team = connection.layout, TEAM_NAMES.index(settings.team)
            numbers = layout.ids[layout.exchanged(team)]
            if self.check not in numbers:
                raise ValueError(
                    f"check: expected one of the robots {list(numbers)} (--ids), got {self.check}"
                )
            slot = layout.slot(team, self.check)
            found = check_robot(connection, slot)
            write(describe(connection, found, slot))
        finally:
            connection.close()
        if not found.is_right:
            raise RuntimeError("check: expected all movements to be right")


def _interrupt(*_: int | FrameType | None) -> None:
    raise KeyboardInterrupt


def _tell(text: str) -> None:
    sys.stderr.write(f"{text}\n")


def _report(connection: Connection) -> None:
    _tell(f"{connection.sight.clock.now:.1f} s, {connection.sight.frames} frames were seen")
    if connection.sight.clock.jumps:
        _tell(f"vision: clock jumped {connection.sight.clock.jumps} times")
    for name, count in sorted(connection.counts.items()):
        _tell(f"{name} {count}")

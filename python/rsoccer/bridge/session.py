"""A match that is served, with its clients: who drives which team, and what may be changed."""

from __future__ import annotations

import ipaddress
from collections import Counter
from collections.abc import Callable
from typing import Final, NamedTuple

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.bridge.arena import Arena
from rsoccer.bridge.clocks import ScaledClock
from rsoccer.bridge.match_tasks import make_match
from rsoccer.bridge.refusals import Reason, Refusal
from rsoccer.bridge.settings import BLUE_ON_POSITIVE_HALF, Settings
from rsoccer.bridge.stand_ins import StandIns
from rsoccer.bridge.team import Address, Team
from rsoccer.protocols.layout import TEAMS, WireLayout
from rsoccer.protocols.placing import Placement
from rsoccer.tasks.match import Match

IDENTITY: Final = "rSoccer-serve"
"""Identity of a sender that has no other one."""


class Datagram(NamedTuple):
    """Bytes to send."""

    port: str
    """Name of the port whose socket sends them: replies come from where the message went."""
    data: bytes
    """The bytes."""
    address: Address | None = None
    """Receiver; None for the group of the port."""


class Session:
    """The state that all ports share.

    Attributes:
        settings: the settings.
        arena: the match.
        layout: sides and numbers on the wire.
        teams: blue and yellow.
        stand_ins: policies for robots without a client.
        clock: the clock; None if the simulation goes on as fast as clients answer.
        epoch: time of the start, Unix time, s.
        identity: identity of tracker and referee.
        recorders: recorders at work whose robots must stay the same.
        counts: numbers of messages by what became of them, such as "blue: received".
        is_own_host: whether a host is one of this machine beside the loopback; `SocketLoop` sets
            it, as nobody knows without a network.
    """

    def __init__(self, settings: Settings, epoch: float = 0.0, identity: str = IDENTITY) -> None:
        """Begin a match.

        Args:
            settings: the settings.
            epoch: time of the start, Unix time, s: that of the simulated time 0.
            identity: identity of tracker and referee.

        Raises:
            ValueError: an option of the match, or a policy that does not fit.
        """
        self.settings = settings
        task = _new_task(settings)
        self.stand_ins = StandIns(task, settings.blue, settings.yellow, settings.seed)
        self.arena = Arena(
            task,
            settings.sensing,
            settings.seed,
            referee=settings.referee,
            observers=self.stand_ins.observers,
            forecasting=self.stand_ins.forecasting,
        )
        side = settings.blue_on_positive_half
        self._on_positive = BLUE_ON_POSITIVE_HALF[settings.league] if side is None else side
        self.layout = self._new_layout()
        self.teams = tuple(
            Team(team, self.layout, settings.command_timeout, settings.client_timeout)
            for team in TEAMS
        )
        self.clock = None if settings.speed is None else ScaledClock(settings.speed)
        self.epoch, self.identity = epoch, identity
        self.recorders = 0
        self.counts: Counter[str] = Counter()
        self.is_own_host: Callable[[str], bool] = lambda host: False
        config = self.arena.config
        self._commands: Floats = np.zeros(
            (config.n_robots, len(config.command_columns)), np.float32
        )

    def _new_layout(self) -> WireLayout:
        return WireLayout(self.arena.config, blue_on_positive_half=self._on_positive)

    def tick(self, now: float) -> None:
        """Advance the match by one tick.

        Args:
            now: time on the wall, s.
        """
        arena, stand_ins = self.arena, self.stand_ins
        seconds = arena.seconds
        for team in self.teams:
            self.release_silent(team, now)
        if stand_ins.are_there and stand_ins.is_due(arena.ticks):
            arena.sense_for_policies()
            stand_ins.act(arena.play)
        robots = arena.frame.robots
        for team in self.teams:
            stand_in = stand_ins.commands if stand_ins.plays(team.index) else None
            team.write(self._commands, seconds, stand_in, robots)
        arena.step(self._commands)

    def release_silent(self, team: Team, now: float) -> None:
        """Release a team whose client is silent, and count that it left.

        Args:
            team: the team.
            now: time on the wall, s.
        """
        if team.expire(now):
            self.counts[f"{_name(team)}: left"] += 1

    @property
    def commands(self) -> Floats:
        """(robots, command) commands of the last tick."""
        return self._commands

    def may_control(self, address: Address) -> bool:
        """Return whether a client may control the simulator.

        Args:
            address: its address.
        """
        return self.settings.allow_remote_control or self.is_of_this_machine(address)

    def is_of_this_machine(self, address: Address) -> bool:
        """Return whether an address is one of this machine.

        Args:
            address: host and port.
        """
        return is_loopback(address) or self.is_own_host(address[0])

    def place(self, placement: Placement) -> list[Reason]:
        """Return what is refused of a message that puts bodies; the rest is done.

        Args:
            placement: the state, and what of it moved.
        """
        reasons = [Reason(str(problem.code), problem.message) for problem in placement.problems]
        try:
            self.arena.place(placement)
        except ValueError as error:
            reasons.append(Reason(Refusal.BLOCKED, str(error)))
        return reasons

    def refresh_layout(self) -> None:
        """Take note of other robots."""
        self.layout = self._new_layout()


def _new_task(settings: Settings) -> Match:
    """The match task of some settings."""
    try:
        return make_match(settings.league, settings.division, settings.robots, settings.options)
    except TypeError as error:
        raise ValueError(f"options: {error}") from error


def is_loopback(address: Address) -> bool:
    """Return whether an address is one of the loopback, which no other machine has.

    Args:
        address: host and port.
    """
    try:
        return ipaddress.ip_address(address[0]).is_loopback
    except ValueError:
        return False


def remote_control_refused(address: Address) -> Reason:
    """Return the reason for which another machine may not control the simulator.

    Args:
        address: address of the client.
    """
    return Reason(
        Refusal.REMOTE_CONTROL,
        f"control: expected a client on this machine, got {address[0]}; "
        "start the server with --allow-remote-control",
    )


def taken(team: Team) -> Reason:
    """Return the reason for which a second client cannot drive a team.

    Args:
        team: the team.
    """
    holder = "nobody" if team.address is None else f"{team.address[0]}:{team.address[1]}"
    return Reason(Refusal.TEAM_TAKEN, f"team: {_name(team)} is driven by {holder}")


def _name(team: Team) -> str:
    return ("blue", "yellow")[team.index]

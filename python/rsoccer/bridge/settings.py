"""Settings of a server, and the ports of both leagues."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from rsoccer import checks
from rsoccer._core import Sensing
from rsoccer.bridge.match_tasks import LEAGUES

REFEREES: Final = ("own", "external", "off")
"""Choices of the referee: that of the match tasks, one on the network, or nobody."""
MAX_SPEED: Final = 1000.0
"""Greatest speed of a clock, times real time; `speed=None` has no limit."""
SSL_PORTS: Final = {
    "control": 10300,
    "blue": 10301,
    "yellow": 10302,
    "grsim": 20011,
    "status_blue": 30011,
    "status_yellow": 30012,
    "vision": 10006,
    "tracker": 10010,
    "referee": 10003,
}
"""Ports of the SSL by name."""
VSSS_PORTS: Final = {"command": 20011, "vision": 10002, "referee": 10003, "replacer": 10004}
"""Ports of VSSS by name."""
SSL_GROUPS: Final = {"vision": "224.5.23.2", "tracker": "224.5.23.2", "referee": "224.5.23.1"}
"""Multicast groups of the SSL by the name of the port."""
VSSS_GROUPS: Final = {
    "vision": "224.0.0.1",
    "referee": "224.5.23.2",
    "replacer": "224.5.23.2",
}
"""Multicast groups of VSSS by the name of the port."""

OWN_OPTIONS: Final[Mapping[str, Mapping[str, str]]] = {
    "ssl": {
        "division": "the argument `division` for it",
        "n_blue": "`robots` for the size of both teams",
        "n_yellow": "`robots` for the size of both teams",
        "max_steps": "`half_seconds` for the length of a match",
    },
    "vsss": {
        "field": "`robots`, by which the field follows",
        "n_blue": "`robots` for the size of both teams",
        "n_yellow": "`robots` for the size of both teams",
        "max_steps": "`half_seconds` for the length of a match",
    },
}
"""Options of the match tasks that a server sets itself, by league, and what to give instead."""

BLUE_ON_POSITIVE_HALF: Final[Mapping[str, bool]] = {"ssl": False, "vsss": True}
"""Whether blue's goal is at +x on the wire, by league: as grSim and FIRASim have it."""


def default_ports(league: str) -> Mapping[str, int]:
    """Return the ports of a league by name.

    Args:
        league: "ssl" or "vsss".
    """
    return SSL_PORTS if league == "ssl" else VSSS_PORTS


def default_groups(league: str) -> Mapping[str, str]:
    """Return the multicast groups of a league by the name of the port.

    Args:
        league: "ssl" or "vsss".
    """
    return SSL_GROUPS if league == "ssl" else VSSS_GROUPS


@dataclass(frozen=True)
class Settings:
    """Settings of a server.

    Attributes:
        league: "ssl" or "vsss".
        division: division of the SSL, "A" or "B".
        robots: robots of a team; None for those of the rules.
        sensing: senses of the robots; None for exact ones.
        speed: simulated seconds in a second; None for as fast as the clients answer.
        blue: policy of blue's robots that no client drives; None if they stand still.
        yellow: the same of yellow.
        referee: one of `REFEREES`.
        blue_on_positive_half: whether blue's goal is at +x on the wire; None for
            `BLUE_ON_POSITIVE_HALF`.
        command_timeout: simulated time after which a robot without a command stops, s.
        client_timeout: time after which a silent client has left its team, s.
        allow_remote_control: whether other machines may control the simulator.
        seed: seed of the match.
        options: further options of the match task by name.
    """

    league: str = "ssl"
    division: str = "B"
    robots: int | None = None
    sensing: Sensing | None = None
    speed: float | None = 1.0
    blue: str | None = None
    yellow: str | None = None
    referee: str = "own"
    blue_on_positive_half: bool | None = None
    command_timeout: float = 0.2
    client_timeout: float = 1.0
    allow_remote_control: bool = False
    seed: int = 0
    options: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Check the numbers and choices.

        Raises:
            TypeError: a value of a wrong type.
            ValueError: a value out of its range.
        """
        self._check_choices()
        if self.robots is not None:
            checks.integer("robots", self.robots, 1)
        given_elsewhere = OWN_OPTIONS[self.league]
        for name in self.options:
            if name in given_elsewhere:
                raise ValueError(f"options: expected {given_elsewhere[name]}, got {name!r} here")
        if self.speed is not None:
            checks.number_in_range("speed", self.speed, 0.0, MAX_SPEED)
        checks.number_in_range("command_timeout", self.command_timeout, 0.01, 3600.0)
        checks.number_in_range("client_timeout", self.client_timeout, 0.01, 3600.0)
        if self.blue_on_positive_half is not None:
            checks.boolean("blue_on_positive_half", self.blue_on_positive_half)
        checks.boolean("allow_remote_control", self.allow_remote_control)
        checks.integer("seed", self.seed, 0)

    def _check_choices(self) -> None:
        """Refuse unknown words."""
        if self.league not in LEAGUES:
            raise ValueError(f"league: expected one of {LEAGUES}, got {self.league!r}")
        if self.referee not in REFEREES:
            raise ValueError(f"referee: expected one of {REFEREES}, got {self.referee!r}")
        if self.league == "vsss" and self.division != "B":
            raise ValueError(f"division: expected none in the VSSS, got {self.division!r}")

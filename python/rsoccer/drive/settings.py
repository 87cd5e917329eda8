"""Numbers and places of a connection to other simulators and to robots."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from rsoccer import checks
from rsoccer.bridge.settings import SSL_GROUPS, SSL_PORTS, VSSS_GROUPS, VSSS_PORTS
from rsoccer.protocols.layout import TEAM_NAMES
from rsoccer.protocols.limits import Limits

PEERS: Final = ("grsim", "firasim", "ssl-simulation")
"""Names of the protocols in which robots are commanded."""
SOURCES: Final = ("vision", "tracker")
"""Sources of states in the SSL: detections of cameras, or the frames of a tracker."""
REFEREES: Final = ("obey", "require", "ignore")
"""Meanings of a referee: obeyed once it is heard; needed, so that robots stand until it is heard;
or ignored."""
_PORTS: Final[Mapping[str, Mapping[str, int]]] = {
    "grsim": {
        **{name: SSL_PORTS[name] for name in ("tracker", "referee", "grsim")},
        "vision": 10020,  # its default; SSL-Vision's is 10006
    },
    "ssl-simulation": {
        name: SSL_PORTS[name]
        for name in ("vision", "tracker", "referee", "control", "blue", "yellow")
    },
    "firasim": {name: VSSS_PORTS[name] for name in ("vision", "referee", "command")},
}
MAX_ID: Final = 15
"""Greatest uniform number of a robot: the rules of the SSL have 16 patterns of colors, and FIRASim
numbers the 5 robots of a team from 0."""
LISTENING: Final = ("vision", "tracker", "referee")
"""Names of the ports at which a connection receives what is sent to groups."""


@dataclass(frozen=True)
class Settings:
    """A connection.

    Attributes:
        peer: protocol of the commands, one of `PEERS`.
        team: team that policies of blue drive, "blue" or "yellow" on the wire.
        ids: uniform numbers of its robots by slot, 0 to `MAX_ID`; None for 0, 1, ...
        opponent_ids: those of the other team.
        host: address to which commands go.
        interface: address of the interface on which vision and referee are heard.
        ttl: routers that multicast to a group may pass, plus 1; 0 for this machine alone.
        ports: other ports by name: "vision", "tracker", "referee"; "grsim"; "control", "blue",
            "yellow"; "command".
        groups: other groups or hosts of vision, tracker and referee by the name of the port.
        source: one of `SOURCES`.
        blue_on_positive_half: whether blue's goal is at +x on the wire; None for what referees of
            the SSL tell, and before them yes for FIRASim and no for the others.
        referee: one of `REFEREES`.
        limits: greatest speeds.
        is_synchronous: whether the simulator waits for commands after each frame, as
            `rsoccer serve --speed max` does. Then no time passes but that of its frames.
        vision_timeout: time without a frame after which robots stop, s, also where this program
            has not looked for one; None for 0.2, and 5 with a simulator that waits.
        patience: time without what is needed to go on until a connection gives up, s.
        rate: rate at which commands are repeated while no frames come, Hz. With each frame they are
            sent again anyway.
        guard: whether a second process stops the robots when this one fails.
        guard_timeout: time without a sign of life after which it does, s. With a simulator that
            waits only the end of the process counts, as its time stands still until then.
        contact_gap: gap up to which a robot touches the ball, m: about the noise of vision.
    """

    peer: str
    team: str = "blue"
    ids: tuple[int, ...] | None = None
    opponent_ids: tuple[int, ...] | None = None
    host: str = "127.0.0.1"
    interface: str = "127.0.0.1"
    ttl: int = 0
    ports: Mapping[str, int] = field(default_factory=dict)
    groups: Mapping[str, str] = field(default_factory=dict)
    source: str = "vision"
    blue_on_positive_half: bool | None = None
    referee: str = "obey"
    limits: Limits = field(default_factory=Limits)
    is_synchronous: bool = False
    vision_timeout: float | None = None
    patience: float = 10.0
    rate: float = 60.0
    guard: bool = True
    guard_timeout: float = 0.3
    contact_gap: float = 0.005

    def __post_init__(self) -> None:
        """Check the choices and numbers.

        Raises:
            TypeError: a value of another type.
            ValueError: a value out of its range, or an unknown name.
        """
        for name, choices in (
            ("peer", PEERS),
            ("team", TEAM_NAMES),
            ("source", SOURCES),
            ("referee", REFEREES),
        ):
            value = getattr(self, name)
            if value not in choices:
                raise ValueError(f"{name}: expected one of {choices}, got {value!r}")
        if self.source != "vision" and self.league != "ssl":
            raise ValueError(f"source: expected 'vision' with firasim, got {self.source!r}")
        self._check_places()
        self._check_ids()
        for name, low, high in (
            ("patience", 0.01, 1e6),
            ("rate", 1.0, 1000.0),
            ("guard_timeout", 0.02, 60.0),
            ("contact_gap", 0.0, 1.0),
        ):
            checks.number_in_range(name, getattr(self, name), low, high)
        if self.vision_timeout is not None:
            checks.number_in_range("vision_timeout", self.vision_timeout, 0.01, 1e6)
        if self.blue_on_positive_half is not None:
            checks.boolean("blue_on_positive_half", self.blue_on_positive_half)
        checks.boolean("is_synchronous", self.is_synchronous)
        checks.boolean("guard", self.guard)

    def _check_places(self) -> None:
        known = sorted(_PORTS[self.peer])
        for name, number in self.ports.items():
            if name not in known:
                raise ValueError(f"ports: expected names of {known}, got {name!r}")
            checks.integer_in_range(f"ports: {name}", number, 1, 65535)
        groups = [name for name in LISTENING if name in known]
        for name in self.groups:
            if name not in groups:
                raise ValueError(f"groups: expected names of {groups}, got {name!r}")

    def _check_ids(self) -> None:
        for name in ("ids", "opponent_ids"):
            for number in getattr(self, name) or ():
                if checks.integer(name, number, 0) > MAX_ID:
                    raise ValueError(f"{name}: expected 0 to {MAX_ID}, got {number}")

    @property
    def league(self) -> str:
        """League, "ssl" or "vsss"."""
        return "vsss" if self.peer == "firasim" else "ssl"

    @property
    def port_numbers(self) -> dict[str, int]:
        """All ports by name."""
        return {**_PORTS[self.peer], **self.ports}

    @property
    def group_hosts(self) -> dict[str, str]:
        """Groups or hosts by the name of the port at which they are heard."""
        groups = VSSS_GROUPS if self.league == "vsss" else SSL_GROUPS
        return {name: groups[name] for name in self.heard} | dict(self.groups)

    @property
    def heard(self) -> tuple[str, ...]:
        """Names of the ports at which something is heard."""
        referee = () if self.referee == "ignore" else ("referee",)
        return (self.source, *referee)

    @property
    def seconds_to_stop(self) -> float:
        """Time without a frame after which robots stop, s."""
        if self.vision_timeout is not None:
            return self.vision_timeout
        return 5.0 if self.is_synchronous else 0.2

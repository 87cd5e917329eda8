"""Other simulators, and what is played in them: data of `benches.transfer`."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

from rsoccer import Sensing, SimConfig
from rsoccer.drive import Settings
from rsoccer.policies import make_policy
from rsoccer.registry import make_task
from rsoccer.sources import make_sensing
from rsoccer.task import Task

HOME: Final = "home"
"""Name of this package's own simulator, in which robots know the true state at once."""
FORECAST: Final = ", forecast"
"""Ending of the name of a trial whose policy knows the state after the delay."""


@dataclass(frozen=True)
class Place:
    """Another simulator."""

    title: str
    """Name and settings."""
    peer: str
    """Protocol, one of `rsoccer.drive.settings.PEERS`."""
    delay: float
    """Time from a command until vision shows it, s, as `rsoccer drive --check` measured it."""
    ports: Mapping[str, int] = field(default_factory=dict)
    """Ports that differ from those of the protocol."""
    groups: Mapping[str, str] = field(default_factory=dict)
    """Groups that differ."""
    tracker: Mapping[str, Any] = field(default_factory=dict)
    """Noise of its vision, with which the tracker counts: numbers of `Sensing`."""
    sensing: str = ""
    """Senses of its likeness: a preset, also with numbers."""
    robot: str = ""
    """Preset of its robots; empty for those of the task."""
    ball: str = ""
    """Preset of its ball; empty for that of the task."""

    @property
    def league(self) -> str:
        """League, "ssl" or "vsss"."""
        return "vsss" if self.peer == "firasim" else "ssl"

    def config(self) -> SimConfig:
        """Return a match of one robot of the place with its ball."""
        field = "ssl_b" if self.league == "ssl" else "vss_3v3"
        return SimConfig(field, 1, 0, robot=self.robot or None, ball=self.ball or None)

    def settings(self, ports: Mapping[str, int]) -> Settings:
        """Return the settings of the connection.

        Args:
            ports: ports that differ from those of the place.
        """
        return Settings(
            self.peer, ports={**self.ports, **ports}, groups=self.groups, referee="ignore"
        )


PLACES: Final[Mapping[str, Place]] = {
    "grsim": Place(
        "grSim",
        "grsim",
        delay=0.03,
        sensing="grsim",
        robot="ssl_grsim",
        ball="grsim",
    ),
    "er-force": Place(
        "ER-Force, realism None",
        "ssl-simulation",
        delay=0.05,
        sensing="erforce_simulator",
        ports={"vision": 10020},
        robot="ssl_erforce_simulator",
        ball="ssl_erforce_simulator",
    ),
    "er-force-rc2021": Place(
        "ER-Force, realism RC2021",
        "ssl-simulation",
        delay=0.055,
        sensing="rc2021, command_delay=0.01",
        ports={"vision": 10020},
        tracker={
            "frame_rate": 66.67,
            "ball_position_noise": 0.001,
            "robot_position_noise": 0.0013,
            "heading_noise": 0.01,
        },
        robot="ssl_erforce_simulator_rc2021",
        ball="ssl_erforce_simulator",
    ),
    "firasim": Place(
        "FIRASim",
        "firasim",
        delay=0.035,
        sensing="firasim",
        robot="vss_firasim",
    ),
}
"""Other simulators by name."""


def port_numbers(words: Sequence[str]) -> dict[str, int]:
    """Return the ports of a command line by name.

    Args:
        words: such as "vision=10020".
    """
    return {name: int(port) for name, port in (word.split("=") for word in words)}


@dataclass(frozen=True)
class Trial:
    """A task, and who plays it."""

    task: str
    """Name of the task."""
    policy: str
    """Policy of the learners."""
    opponent: str | None = None
    """Policy of the other team; None for the task's own."""
    forecasts: bool = False
    """Whether robots know the state after the delay of the place."""

    @property
    def name(self) -> str:
        """Name of the trial."""
        against = "" if self.opponent is None else f" against {self.opponent}"
        return f"{self.task}, {self.policy}{against}{FORECAST if self.forecasts else ''}"

    @property
    def league(self) -> str:
        """League, "ssl" or "vsss"."""
        return "vsss" if self.task.startswith("VSS") else "ssl"


TRIALS: Final = (
    Trial("SSLGoToBall-v0", "best"),
    Trial("SSLGoToBall-v0", "best", forecasts=True),
    Trial("SSLGoToBall-v0", "best:robust"),
    Trial("SSLGoToBall-v0", "fetch"),
    Trial("VSS-v0", "best"),
    Trial("VSS-v0", "best", forecasts=True),
    Trial("VSS-v0", "best:robust"),
    Trial("VSS-v0", "best:lookahead"),
    Trial("VSS-v0", "best:lookahead", forecasts=True),
    Trial("VSSSelfPlay-v0", "best", "zero"),
    Trial("VSSSelfPlay-v0", "best", "zero", forecasts=True),
    Trial("VSSSelfPlay-v0", "best:lookahead", "zero"),
    Trial("VSSSelfPlay-v0", "best:lookahead", "zero", forecasts=True),
    Trial("SSLContestedPossession-v0", "best"),
    Trial("SSLContestedPossession-v0", "best", forecasts=True),
    Trial("SSLContestedPossession-v0", "best:robust"),
    Trial("SSLContestedPossession-v0", "strike"),
    Trial("SSLContestedPossession-v0", "strike", forecasts=True),
    Trial("SSLPassEndurance-v1", "best"),
    Trial("SSLPassEndurance-v1", "best", forecasts=True),
    Trial("SSLPassEndurance-v1", "passer"),
    Trial("SSLPassEndurance-v1", "passer", forecasts=True),
    Trial("SSLPassEnduranceMulti-v1", "best", forecasts=True),
    Trial("SSLPassEnduranceMulti-v1", "best:robust"),
    Trial("SSLPassEnduranceMulti-v1", "passer"),
    Trial("SSLPassEnduranceMulti-v1", "passer", forecasts=True),
)
"""Tasks and policies to play, in this order."""


def is_forecast(trial: Trial) -> bool:
    """Return whether robots forecast: as the trial says, or since its policy needs it.

    Args:
        trial: what is played.
    """
    return trial.forecasts or make_policy(trial.policy, trial.task).needs_forecast


def likeness(place: Place, trial: Trial) -> tuple[Task, Sensing]:
    """Return the task and the senses with which this package's simulator is like a place.

    Args:
        place: the place.
        trial: what is played.
    """
    options = _bodies(place)
    forecast = ", forecast=1" if is_forecast(trial) else ""
    sensing = make_sensing(f"{place.sensing}{forecast}")
    assert isinstance(sensing, Sensing), "a preset"
    return make_task(trial.task, **options), sensing


def as_played(place: Place, trial: Trial) -> tuple[Task, Sensing | None]:
    """Return the task as policies play it in a place, and what they know there.

    Args:
        place: the place.
        trial: what is played.
    """
    task = make_task(trial.task, **_bodies(place))
    if is_forecast(trial):
        return task, Sensing(command_delay=place.delay, forecast=1.0, **place.tracker)
    return task, Sensing(**place.tracker) if place.tracker else None


def _bodies(place: Place) -> dict[str, Any]:
    """Options `robot` and `ball` of tasks that are played in a place."""
    names = {"robot": place.robot, "ball": place.ball}
    return {option: name for option, name in names.items() if name}

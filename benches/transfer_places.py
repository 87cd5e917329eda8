"""Other simulators, and what is played in them: data of `benches.transfer`."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from rsoccer import BallModel, RobotModel, Sensing
from rsoccer.registry import make_task
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
    tracker: Mapping[str, float] = field(default_factory=dict)
    """Noise of its vision, with which the tracker counts: numbers of `Sensing`."""
    sensing: Mapping[str, Any] = field(default_factory=dict)
    """Numbers of the senses of its likeness."""
    robot: Mapping[str, Any] = field(default_factory=dict)
    """Numbers of the robot of its likeness."""
    ball: Mapping[str, Any] = field(default_factory=dict)
    """Numbers of the ball of its likeness; none for that of the task."""
    drives_model: bool = False
    """Whether policies drive the robot of the likeness there too: its wheels differ from those of
    the task's, and commands are speeds of wheels."""

    @property
    def league(self) -> str:
        """League, "ssl" or "vsss"."""
        return "vsss" if self.peer == "firasim" else "ssl"


PLACES: Final[Mapping[str, Place]] = {
    "grsim": Place("grSim", "grsim", delay=0.04),
    "er-force": Place(
        "ER-Force, realism None", "ssl-simulation", delay=0.065, ports={"vision": 10020}
    ),
    "er-force-rc2021": Place(
        "ER-Force, realism RC2021", "ssl-simulation", delay=0.065, ports={"vision": 10020}
    ),
    "firasim": Place("FIRASim", "firasim", delay=0.035),
}
"""Other simulators by name."""


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
    Trial("VSSSelfPlay-v0", "best", "zero"),
    Trial("VSSSelfPlay-v0", "best", "zero", forecasts=True),
    Trial("SSLContestedPossession-v0", "best"),
    Trial("SSLContestedPossession-v0", "best", forecasts=True),
    Trial("SSLContestedPossession-v0", "best:robust"),
    Trial("SSLPassEndurance-v1", "best"),
    Trial("SSLPassEndurance-v1", "best", forecasts=True),
)
"""What is played, the first ones first."""


def likeness(place: Place, trial: Trial) -> tuple[Task, Sensing]:
    """Return the task and the senses with which this package's simulator is like a place.

    Args:
        place: the place.
        trial: what is played.
    """
    options: dict[str, Any] = {"robot": RobotModel(**place.robot)} if place.robot else {}
    if place.ball and place.league == "ssl":
        options["ball"] = BallModel(**place.ball)
    numbers = dict(place.sensing) or {"command_delay": place.delay}
    forecast = {"forecast": 1.0} if trial.forecasts else {}
    return make_task(trial.task, **options), Sensing(**numbers, **forecast)


def as_played(place: Place, trial: Trial) -> tuple[Task, Sensing | None]:
    """Return the task as policies play it in a place, and what they know there.

    Args:
        place: the place.
        trial: what is played.
    """
    options = {"robot": RobotModel(**place.robot)} if place.drives_model else {}
    task = make_task(trial.task, **options)
    if trial.forecasts:
        return task, Sensing(command_delay=place.delay, forecast=1.0, **place.tracker)
    return task, Sensing(**place.tracker) if place.tracker else None

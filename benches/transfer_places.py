"""Other simulators, and what is played in them: data of `benches.transfer`."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

from rsoccer import BallModel, RobotModel, Sensing
from rsoccer.policies import make_policy
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
    tracker: Mapping[str, Any] = field(default_factory=dict)
    """Noise of its vision, with which the tracker counts: numbers of `Sensing`."""
    sensing: Mapping[str, Any] = field(default_factory=dict)
    """Numbers of the senses of its likeness."""
    robot: Mapping[str, Any] = field(default_factory=dict)
    """Numbers of its robots that differ from those of the task: wheels, place of the mouth."""
    ball: Mapping[str, Any] = field(default_factory=dict)
    """Numbers of the ball of its likeness; none for that of the task."""

    @property
    def league(self) -> str:
        """League, "ssl" or "vsss"."""
        return "vsss" if self.peer == "firasim" else "ssl"


_ER_FORCE: Final = {
    "name": "ssl_erforce",
    "front_distance": 0.064,
    "beam_distance": 0.013,
    "max_acceleration": 5.8,
    "max_deceleration": 7.9,
    "max_angular_acceleration": 67.0,
    "max_angular_deceleration": 96.0,
}
"""Its robots, by `rsoccer identify` from a log of `benches.transfer_logs`; the ball touches their
dribbler at .0855 m, and is pushed at up to .0985 m."""
PLACES: Final[Mapping[str, Place]] = {
    "grsim": Place(
        "grSim",
        "grsim",
        delay=0.03,
        sensing={"frame_rate": 60.0, "tracker": 1.0, "command_delay": 0.03},
        robot={
            "name": "ssl_generic",
            "front_distance": 0.0805,
            "mouth_width": 0.08,
            "max_acceleration": 3.6,
            "max_deceleration": 3.9,
            "max_angular_acceleration": 49.0,
            "max_angular_deceleration": 39.0,
        },
        ball={"name": "grsim"},
    ),
    "er-force": Place(
        "ER-Force, realism None",
        "ssl-simulation",
        delay=0.05,
        sensing={"frame_rate": 66.67, "tracker": 1.0, "command_delay": 0.05},
        ports={"vision": 10020},
        robot=_ER_FORCE,
        ball={"name": "ssl_erforce"},
    ),
    "er-force-rc2021": Place(
        "ER-Force, realism RC2021",
        "ssl-simulation",
        delay=0.055,
        sensing={"name": "rc2021", "command_delay": 0.01},
        ports={"vision": 10020},
        tracker={
            "frame_rate": 66.67,
            "ball_position_noise": 0.001,
            "robot_position_noise": 0.0013,
            "heading_noise": 0.01,
        },
        robot=_ER_FORCE,
        ball={"name": "ssl_erforce"},
    ),
    "firasim": Place(
        "FIRASim",
        "firasim",
        delay=0.035,
        sensing={"command_delay": 0.035},
        robot={
            "name": "vss_440rpm",
            "wheel_radius": 0.02,
            "track_width": 0.085,
            "max_wheel_speed": 59.9,
            "longitudinal_grip": 1.26,
        },
    ),
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
    Trial("SSLPassEnduranceMulti-v1", "best", forecasts=True),
    Trial("SSLPassEnduranceMulti-v1", "best:robust"),
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
    options = _robot(place)
    if place.ball and place.league == "ssl":
        options["ball"] = BallModel(**place.ball)
    numbers = dict(place.sensing) or {"command_delay": place.delay}
    forecast: dict[str, Any] = {"forecast": 1.0} if is_forecast(trial) else {}
    return make_task(trial.task, **options), Sensing(**numbers, **forecast)


def as_played(place: Place, trial: Trial) -> tuple[Task, Sensing | None]:
    """Return the task as policies play it in a place, and what they know there.

    Args:
        place: the place.
        trial: what is played.
    """
    task = make_task(trial.task, **_robot(place))
    if is_forecast(trial):
        return task, Sensing(command_delay=place.delay, forecast=1.0, **place.tracker)
    return task, Sensing(**place.tracker) if place.tracker else None


def _robot(place: Place) -> dict[str, Any]:
    """The option `robot` of tasks that are played in a place."""
    return {"robot": RobotModel(**place.robot)} if place.robot else {}

"""Settings of a training run; the defaults learn three-a-side play on two cores.

Each part of the trainer has settings of its own, in the file `settings.py` of its folder. In files,
in errors and on the command line a setting of a part has the part's name before its own, as in
`ppo.gamma`. This module does not import torch, because the command line builds its help from it.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final, Literal, Self, get_type_hints

from rsoccer import plugins
from rsoccer.option_values import encoded
from rsoccer.registry import task_with_options
from rsoccer.sources import make_sensing, plays_one_match
from rsoccer.task import Task
from rsoccer.train.network.settings import NetworkSettings
from rsoccer.train.opponents.settings import OpponentSettings
from rsoccer.train.ppo.settings import PpoSettings
from rsoccer.train.rollout.settings import RolloutSettings
from rsoccer.train.run.settings import RunSettings
from rsoccer.train.setting_types import Count, Natural, convert_fields, expect
from rsoccer.train.task_settings import recommended_settings

SETTINGS_FILE = "args.json"
"""File in a run's folder with its settings, written when the run starts and when it resumes."""

Device = Literal["auto", "cpu", "cuda"]
"""Names of devices."""

PARTS: Final = ("rollout", "network", "ppo", "opponents", "run")
"""Fields of `Args` that hold the settings of a part."""

CHANGEABLE_ON_RESUME: Final = (
    *("imports", "out", "device", "resume", "overwrite", "samples", "threads"),
    *(f"run.{setting.name}" for setting in dataclasses.fields(RunSettings)),
)
"""Settings that may change when a run resumes. Two of them affect the updates: the linear schedule
of the learning rate, the standard deviation of the actions and a discount with a final value depend
on `samples`, the end of the run; and each `device` rounds in its own way."""


# The docstrings of the fields are the help of `rsoccer train`.
@dataclass(frozen=True)
class Args:
    """Settings of one training run. A sample is one decision of one learning robot.

    Raises:
        ImportError: a module of `imports`, `simulator` or `sensing` does not exist or raises an
            error, or a name is not in its module.
        TypeError: `sensing` names something else than senses.
        ValueError: a value of another type or outside its range, options of the task that JSON
            cannot hold, or `resume` together with `overwrite`.
    """

    task: str = "VSSSelfPlay-v0"
    """registered task to train on, as `rsoccer list` prints it"""
    out: Path = Path("out/train")
    """folder for the policy, checkpoints and logs"""
    samples: Count = 10_000_000
    """decisions of all learning robots, up to a full update"""
    task_options: Mapping[str, Any] = field(default_factory=dict)
    """options of the task, such as opponent=chase; models of robots, balls and fields, or files"""
    simulator: str | None = None
    """grsim, firasim or ssl-simulation on this machine, with `rollout.worlds` 1, or module:function
    (config, worlds, threads) that makes the simulator, in place of the own"""
    sensing: str | None = None
    """senses of the robots: a preset's name, also with numbers as in "rc2021, delay=0.1", a .json
    file, or module:name"""
    randomization: Mapping[str, Any] = field(default_factory=dict)
    """numbers that each episode draws, by name, such as {"robot.mass": [0.9, 1.1]}"""
    history: Count = 1
    """observations in a stacked one, with the actions between them; 1 is the current one alone"""
    imports: tuple[str, ...] = ()
    """modules to import first: those that register a task or policies of one's own"""
    seed: Natural = 0
    """random seed; equal settings give equal runs on a machine"""
    threads: Count = 2
    """threads of the simulator, of acting and of learning; they change no result"""
    torch_threads: Count = 1
    """threads of torch in each of them; more help wide networks on many cores only"""
    device: Device = "cpu"
    """device of the updates; auto is a GPU if there is one"""
    resume: bool = False
    """continue the run in `out` from its last checkpoint"""
    overwrite: bool = False
    """replace a run that `out` already holds"""
    rollout: RolloutSettings = field(default_factory=RolloutSettings)
    """matches from which an update learns"""
    network: NetworkSettings = field(default_factory=NetworkSettings)
    """policy and value network"""
    ppo: PpoSettings = field(default_factory=PpoSettings)
    """advantages and updates of PPO"""
    opponents: OpponentSettings = field(default_factory=OpponentSettings)
    """opponents of the learners, by share of the matches"""
    run: RunSettings = field(default_factory=RunSettings)
    """files, progress and measurements"""

    def __post_init__(self) -> None:
        """Convert every value to the type of its field, and check it."""
        for name in ("simulator", "sensing"):
            given = getattr(self, name)
            text = "a text, by which a resumed run finds it again"
            expect(name, given is None or isinstance(given, str), text, given)
        convert_fields(self)
        plugins.import_modules(self.imports)
        if self.is_on_network and self.rollout.worlds != 1:
            raise ValueError(
                f"rollout.worlds: expected 1 with the simulator {self.simulator}, which steps one "
                f"match at a time, got {self.rollout.worlds}"
            )
        make_sensing(self.sensing)
        for name in ("task_options", "randomization"):
            object.__setattr__(self, name, _as_json(name, getattr(self, name)))
        if self.resume and self.overwrite:
            raise ValueError("resume and overwrite exclude each other, got both")

    @property
    def is_on_network(self) -> bool:
        """True if another simulator plays, one match at a time: training is all that is played."""
        return plays_one_match(self.simulator)

    @property
    def play_action_repeat(self) -> int:
        """Control steps for which the saved policy holds a decision."""
        chosen = self.network.play_action_repeat
        return self.rollout.action_repeat if chosen is None else chosen

    @classmethod
    def for_task(cls, task: str, **changes: Any) -> Self:  # noqa: ANN401  (any field)
        """Return the recommended settings for a task, with changes.

        Args:
            task: a registered name or an alias.
            **changes: values by field. For a part, a mapping of the settings in it that change. All
                others have the values of `rsoccer.train.task_settings`, or their defaults.

        Raises:
            TypeError: a setting that does not exist.
            ValueError: a value that the settings refuse.

        Example:
            >>> args = Args.for_task("VSS-v0", samples=1_000_000, rollout={"worlds": 64})
            >>> args.samples, args.rollout.worlds, args.ppo.mirror_augmentation
            (1000000, 64, True)
        """
        plugins.import_modules(changes.get("imports", ()))  # one may register the name
        return cls.from_json({"task": task, **recommended_settings(task), **_flat(changes)})

    @classmethod
    def from_json(cls, settings: Mapping[str, Any]) -> Self:
        """Return settings from values by name, others with their defaults.

        Args:
            settings: values by name, as in `to_json`: `samples`, `ppo.gamma`.

        Raises:
            TypeError: a setting that does not exist.
            ValueError: a value that the settings refuse.

        Example:
            >>> Args.from_json({"seed": 3, "ppo.gamma": 0.99}).ppo.gamma
            0.99
        """
        own: dict[str, Any] = {}
        parts: dict[str, dict[str, Any]] = {}
        for name, value in settings.items():
            part, separator, rest = name.partition(".")
            if separator:
                parts.setdefault(part, {})[rest] = value
            else:
                own[name] = value
        kinds = get_type_hints(cls)
        for part, values in parts.items():
            if part not in PARTS:
                raise TypeError(f"expected a part of {list(PARTS)} before the dot, got {part!r}")
            own[part] = kinds[part](**values)
        return cls(**own)

    def to_json(self) -> dict[str, Any]:
        """Return the settings as JSON values by name, as in `ppo.gamma`."""
        values = {**_flat(vars(self)), "out": str(self.out)}
        return {
            name: list(value) if isinstance(value, tuple) else value
            for name, value in values.items()
        }

    def make_task(self) -> Task:
        """Return a new task with its options.

        Raises:
            ValueError: an unknown task, or options that it refuses.
        """
        return task_with_options(self.task, self.task_options)

    def differences(self, saved: Mapping[str, Any]) -> list[str]:
        """Return the settings that differ from a saved run's and would change its updates.

        Args:
            saved: settings of the saved run, from `to_json`. Settings that it lacks are newer than
                the run, and count with their defaults.

        Returns:
            One text per setting, such as "ppo.gamma was 0.985, now 0.9"; empty if the run may
            resume. Settings in `CHANGEABLE_ON_RESUME` are ignored.
        """
        current = self.to_json()
        saved = {**type(self)().to_json(), **saved}
        names = [name for name in {**current, **saved} if name not in CHANGEABLE_ON_RESUME]
        return [
            f"{name} was {saved.get(name)!r}, now {current.get(name)!r}"
            for name in names
            if current.get(name) != saved.get(name)
        ]


def _flat(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Settings with those of each part, an instance or a mapping, by `part.name`."""
    flat: dict[str, Any] = {}
    for name, value in settings.items():
        if name not in PARTS:
            flat[name] = value
            continue
        values = value if isinstance(value, Mapping) else vars(value)
        flat |= {f"{name}.{setting}": each for setting, each in values.items()}
    return flat


def _as_json(argument: str, options: Mapping[str, Any]) -> dict[str, Any]:
    """Copy of the entries of an argument as JSON values, with the models of files."""
    try:
        return {name: encoded(f"{argument}: {name}", value) for name, value in options.items()}
    except (OSError, TypeError) as error:
        raise ValueError(str(error)) from error

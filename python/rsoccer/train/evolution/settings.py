"""Settings of an evolution."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Final, Self

from rsoccer.option_values import encoded
from rsoccer.policies.evolved import SCRIPTS
from rsoccer.sources import make_sensing
from rsoccer.train.setting_types import Count, Natural, Positive, Range, convert_fields, expect

STATE_FILE: Final = "evolution.json"
"""Name of the file from which a run resumes."""
_OF_ONE_CALL: Final = {"out", "resume"}
"""Settings that belong to one call, and not to the run."""

Momentum = Annotated[float, Range("at least 0 and below 1", 0.0, 0.999)]
"""Share of the last step."""

_RECOMMENDED: Final[Mapping[str, Mapping[str, Any]]] = {
    "SSLMatch-v0": {
        "task_options": {"half_seconds": 60.0},
        "opponents": ("scripted:0.5", "scripted"),
    },
    "SSLKeepaway-v0": {"script": "keep", "matches": 200},
    # From scratch most passes fail, and scores say little.
    "SSLPassEnduranceMulti-v1": {
        "script": "keep",
        "first": "SSLKeepaway-v0",
        "task_options": {"n_opponents": 1},
        "generations": 15,
        "matches": 300,
    },
}
"""Values of settings by name, by the name of the task; whole matches take two minutes."""


# The docstrings of the fields are the help of `rsoccer evolve`.
@dataclass(frozen=True)
class EvolveArgs:
    """Settings of an evolution.

    Raises:
        ImportError: a module of `sensing` does not exist.
        ValueError: a value of another type or outside its range.
    """

    task: str = "SSLMatch-v0"
    """registered task that the script plays"""
    script: str = "scripted"
    """script whose numbers change: scripted, the whole SSL team, or keep"""
    first: str | None = None
    """tactics to begin with: those of a policy file, best, or another task for its best; None
    begins with those that were set by hand"""
    out: Path = Path("out/evolve")
    """folder for the policy, the log and the state from which the run resumes"""
    task_options: Mapping[str, Any] = field(default_factory=dict)
    """options of the task (`rsoccer list` prints them), such as half_seconds=60"""
    opponents: tuple[str, ...] = ()
    """policies of the other team, each in an equal share of the matches; none where there is no
    other team, or for the task's own"""
    generations: Count = 12
    """steps of the tactics"""
    matches: Count = 100
    """matches of a generation against each opponent from each side, an even number: one for each
    draw and one for its mirror image"""
    spread: Positive = 0.25
    """standard deviation of the logarithm of a number around the present one"""
    step_size: Positive = 4.0
    """step in units of `spread`, for a score that grows by its standard deviation with one"""
    momentum: Momentum = 0.6
    """share of the last step in the next one"""
    sensing: str | None = None
    """senses of the robots: a preset's name, also with numbers as in "rc2021, delay=0.1", a .json
    file, or module:name"""
    randomization: Mapping[str, Any] = field(default_factory=dict)
    """numbers that each episode draws, by name, such as {"robot.mass": [0.9, 1.1]}"""
    seed: Natural = 0
    """random seed; equal settings give equal runs"""
    threads: Count = 1
    """threads of the simulator"""
    resume: bool = False
    """go on with the run in `out`, up to `generations`"""

    def __post_init__(self) -> None:
        """Convert and check the values."""
        convert_fields(self)
        for setting in ("task_options", "randomization"):
            given = getattr(self, setting)
            values = {name: encoded(f"{setting}: {name}", value) for name, value in given.items()}
            object.__setattr__(self, setting, values)
        expect("matches", self.matches % 2 == 0, "an even number", self.matches)
        expect("script", self.script in SCRIPTS, f"one of {tuple(SCRIPTS)}", self.script)
        make_sensing(self.sensing)

    @classmethod
    def for_task(cls, task: str, **changes: Any) -> Self:  # noqa: ANN401  (any field)
        """Return the recommended settings for a task, with changes.

        Args:
            task: a registered name.
            **changes: values by field.

        Raises:
            TypeError: a setting that does not exist.
            ValueError: a value that the settings refuse.

        Example:
            >>> EvolveArgs.for_task("SSLMatch-v0").opponents
            ('scripted:0.5', 'scripted')
        """
        return cls(task, **{**_RECOMMENDED.get(task, {}), **changes})

    @classmethod
    def of_run(cls, folder: Path) -> Self | None:
        """Return the settings of the run in a folder, the defaults when it resumes.

        Args:
            folder: the `out` of the run.

        Returns:
            None if the file of its state is missing, damaged or of a version with other settings.
        """
        try:
            saved = json.loads((folder / STATE_FILE).read_bytes())["settings"]
            return cls(**{name: saved[name] for name in saved if name not in _OF_ONE_CALL})
        except (OSError, LookupError, TypeError, ValueError):  # resuming reports what is wrong
            return None

    def to_json(self) -> dict[str, Any]:
        """Return the settings as JSON values by name."""
        values = {name: list(v) if isinstance(v, tuple) else v for name, v in vars(self).items()}
        values |= {"task_options": dict(self.task_options)}
        return {**values, "out": str(self.out), "randomization": dict(self.randomization)}

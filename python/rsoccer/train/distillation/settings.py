"""Settings of a distillation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any, Self

from rsoccer._core import Sensing
from rsoccer.option_values import encoded
from rsoccer.sources import make_sensing
from rsoccer.train.distillation.task_settings import recommended_settings
from rsoccer.train.setting_types import Count, Natural, Positive, Range, convert_fields, expect

Delay = Annotated[float, Range("finite and at least 0", 0.0)]
"""A time, s."""


# The docstrings of the fields are the help of `rsoccer distill`.
@dataclass(frozen=True)
class DistillArgs:
    """Settings of a distillation. A sample is one decision of one learning robot.

    Raises:
        ImportError: a module of `sensing` does not exist.
        ValueError: a value of another type or outside its range.
    """

    task: str = "SSLGoToBall-v0"
    """registered task of the teacher and of the student"""
    out: Path = Path("out/distill")
    """folder for the policy and the log"""
    teacher: str = "best"
    """trained policy that knows the true state: best, or a policy file"""
    student: str | None = None
    """policy with whose weights the student begins; None is the teacher"""
    samples: Count = 600_000
    """decisions of all learning robots, up to a full round"""
    sensing: str | None = "rc2021"
    """senses of the robots: a preset's name, also with numbers as in "rc2021, forecast=1", or a
    .json file"""
    randomization: Mapping[str, Any] = field(default_factory=dict)
    """numbers that each episode draws, by name, such as {"robot.mass": [0.9, 1.1]}"""
    command_delays: tuple[Delay, ...] = (0.0, 0.025, 0.05, 0.075, 0.1)
    """times that commands take, s, multiples of the control step; each in an equal share of the
    matches, which draw it within half a step of it, or exactly 0; a forecast knows the middle"""
    history: Count = 5
    """observations in a stacked one, with the actions between them"""
    seed: Natural = 0
    """random seed; equal settings give equal runs on a machine"""
    threads: Count = 1
    """threads of the simulator"""
    worlds: Count = 320
    """matches at once"""
    decisions: Count = 32
    """decisions of a robot in a round, before the student learns from all rounds so far; more than
    the longest delay takes"""
    noise: Positive = 0.1
    """standard deviation of the student's actions while it learns"""
    minibatches: Count = 120
    """minibatches in a round"""
    minibatch: Count = 1024
    """samples in a minibatch"""
    learning_rate: Positive = 1e-3
    """step size of Adam at first; it falls to a twentieth"""
    buffer: Count = 400_000
    """newest samples from which the student learns"""

    def __post_init__(self) -> None:
        """Convert and check the values."""
        convert_fields(self)
        expect("command_delays", bool(self.command_delays), "one or more times", ())
        words = f"at least one for each of the {len(self.command_delays)} command_delays"
        expect("worlds", self.worlds >= len(self.command_delays), words, self.worlds)
        is_known = isinstance(make_sensing(self.sensing), Sensing | None)
        words = "a preset or a .json file, with which commands may be late"
        expect("sensing", is_known, words, self.sensing)
        for name, value in self.randomization.items():
            owned = name not in ("sensing.command_delay", "sensing.command_jitter")
            expect("randomization", owned, "without command delays, see command_delays", name)
            encoded(f"randomization: {name}", value)

    @classmethod
    def for_task(cls, task: str, **changes: Any) -> Self:  # noqa: ANN401  (any field)
        """Return the recommended settings for a task, with changes.

        Args:
            task: a registered name or an alias.
            **changes: values by field.

        Raises:
            TypeError: a setting that does not exist.
            ValueError: a value that the settings refuse.

        Example:
            >>> DistillArgs.for_task("SSLStaticDefenders-v0", seed=3).history
            1
        """
        return cls(task, **{**recommended_settings(task), **changes})

    def to_json(self) -> dict[str, Any]:
        """Return the settings as JSON values by name."""
        values = {name: list(v) if isinstance(v, tuple) else v for name, v in vars(self).items()}
        return {**values, "out": str(self.out), "randomization": dict(self.randomization)}

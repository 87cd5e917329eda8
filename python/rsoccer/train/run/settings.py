"""Settings of what a run saves, shows and measures, none of which changes what it learns."""

from __future__ import annotations

from dataclasses import dataclass

from rsoccer.train.setting_types import Count, Natural, Positive, convert_fields


# The docstrings of the fields are the help of `rsoccer train`.
@dataclass(frozen=True)
class RunSettings:
    """Files, progress and measurements; they may change when a run resumes.

    Raises:
        ValueError: a value of another type or outside its range.
    """

    checkpoint_interval: Positive = 30.0
    """seconds between checkpoints"""
    progress: bool = True
    """show a progress bar"""
    match_page: bool = True
    """write a match of the policy to `out` at the end, unless a simulator on a network plays"""
    ladder_interval: Natural = 100
    """updates between measurements of strength; 0, and simulators on a network, have none"""
    ladder_matches: Count = 100
    """matches of a measurement, always the same"""

    def __post_init__(self) -> None:
        """Convert and check the values."""
        convert_fields(self, "run.")

"""Match tasks whose control step is a tick, so that commands act at once when they arrive."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any, Final

from rsoccer import checks
from rsoccer._core import SimConfig
from rsoccer.registry import list_options
from rsoccer.tasks.match import Match
from rsoccer.tasks.ssl_match import SslMatch
from rsoccer.tasks.vss_match import VssMatch

TICK: Final = 0.005
"""Control step of a simulation that is served, s: 200 Hz."""
LEAGUES: Final = ("ssl", "vsss")
"""Leagues whose matches are served."""


class TickedSslMatch(SslMatch):
    """`SslMatch` with a control step of one tick."""

    name = "SSL match at 200 Hz"

    @cached_property
    def config(self) -> SimConfig:
        """Configuration of `SslMatch` with steps of `TICK`."""
        return with_ticks(super().config)


class TickedVssMatch(VssMatch):
    """`VssMatch` with a control step of one tick."""

    name = "VSSS match at 200 Hz"

    @cached_property
    def config(self) -> SimConfig:
        """Configuration of `VssMatch` with steps of `TICK`."""
        return with_ticks(super().config)


def with_ticks(config: SimConfig, time_step: float = TICK) -> SimConfig:
    """Return a configuration with ticks of `TICK`, without senses.

    Args:
        config: the configuration.
        time_step: length of a control step, s.
    """
    return SimConfig(
        config.field,
        config.n_blue,
        config.n_yellow,
        robot=list(config.robots),
        ball=config.ball,
        time_step=time_step,
        tick=TICK,
        engine=config.engine,
    )


def make_match(league: str, division: str, robots: int | None, options: Mapping[str, Any]) -> Match:
    """Return the task of a match.

    Args:
        league: "ssl" or "vsss".
        division: division of the SSL, "A" or "B".
        robots: robots of a team; None for those of the rules: 11 in division A, 6 in B, 3 in VSSS,
            which plays on the field for 5 above 3.
        options: further options of the task, by name.

    Raises:
        TypeError: an option of a wrong type.
        ValueError: an unknown league, division or option, or an option out of its range.
    """
    if league not in LEAGUES:
        raise ValueError(f"league: expected one of {LEAGUES}, got {league!r}")
    if league == "vsss":
        size = 3 if robots is None else robots
        checks.integer_in_range("robots", size, 1, _most_robots("vss_5v5"))
        _check_names(TickedVssMatch, options)
        field = "vss_5v5" if size > 3 else "vss_3v3"
        return TickedVssMatch(n_blue=size, n_yellow=size, field=field, **options)
    size = (11 if division == "A" else 6) if robots is None else robots
    checks.integer_in_range("robots", size, 1, _most_robots("ssl_a"))
    _check_names(TickedSslMatch, options)
    return TickedSslMatch(division=division, n_blue=size, n_yellow=size, **options)


def _check_names(task_class: type[Match], options: Mapping[str, Any]) -> None:
    """Refuse options that the task does not have, or that `make_match` sets."""
    settled = ("n_blue", "n_yellow", "field", "division", "max_steps")
    valid = [name for name in list_options(task_class) if name not in settled]
    unknown = sorted(set(options) - set(valid))
    if unknown:
        raise ValueError(f"options: unknown {unknown}; valid are {valid}")


def _most_robots(field: str) -> int:
    """Greatest number of robots of a team on a field."""
    return SimConfig(field, 0, 0).field.max_robots

"""Tables of `benches.transfer`: scores in other simulators beside those at home."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from benches.markdown import table
from benches.transfer import LIKENESS, STORED
from benches.transfer_places import HOME, PLACES, TRIALS, Trial
from rsoccer.evaluate.results import Interval, bootstrap_interval

Z: Final = 1.96
"""Quantile of the normal distribution for intervals of 95%."""


def interval(sides: Mapping[str, Sequence[float]]) -> Interval:
    """Return the mean of scores and its interval of 95%: Wilson's for shares, else a bootstrap.

    Args:
        sides: scores by side.
    """
    strata = [np.array(scores, np.float64) for scores in sides.values()]
    values = np.concatenate(strata)
    n, mean = len(values), float(values.mean())
    if not np.isin(values, (0.0, 1.0)).all():
        return bootstrap_interval(strata, np.random.default_rng(0))
    center = (mean + Z * Z / (2 * n)) / (1 + Z * Z / n)
    half = Z * math.sqrt(mean * (1 - mean) / n + Z * Z / (4 * n * n)) / (1 + Z * Z / n)
    return Interval(mean, max(0.0, center - half), min(1.0, center + half))


def transfer() -> str:
    """Return the table of all places."""
    return report(STORED)


def report(folder: Path) -> str:
    """Return the table of the results in a folder.

    Args:
        folder: the folder.
    """
    found = {path.stem: json.loads(path.read_text()) for path in sorted(folder.glob("*.json"))}
    rows = []
    for name, place in PLACES.items():
        for trial in TRIALS:
            if trial.name not in found.get(name, {}):
                continue
            there = _interval(found, name, trial)
            assert there is not None
            home = _interval(found, HOME, replace(trial, forecasts=False))
            like = _interval(found, f"{name}{LIKENESS}".replace(" ", "_"), trial)
            share = "-" if home is None or there.low is None else f"{there.low / home.mean:.0%}"
            episodes = sum(map(len, found[name][trial.name]["scores"].values()))
            policy = trial.name.removeprefix(f"{trial.task}, ")
            cells = (place.title, f"`{trial.task}`", policy, str(episodes))
            rows.append((*cells, _cell(home), _cell(there), share, _cell(like)))
    header = ("simulator", "task", "policy", "episodes", "score at home", "score there")
    return table((*header, "lower end / home", "its likeness here"), rows)


def _interval(found: Mapping[str, Any], place: str, trial: Trial) -> Interval | None:
    row = found.get(place, {}).get(trial.name)
    return None if row is None else interval(row["scores"])


def _cell(found: Interval | None) -> str:
    """A score with its interval."""
    if found is None:
        return "-"
    if found.low is None or found.high is None:
        return f"{found.mean:.3g}"
    return f"{found.mean:.3g} ({found.low:.3g} to {found.high:.3g})"

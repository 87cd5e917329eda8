"""Senses and varied numbers of a training, in the metadata of a policy file.

They tell what a policy has learned to cope with. They do not change how it plays, but one that has
learned behind a forecast needs it: matches with senses give it to its team
(`Policy.needs_forecast`).
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from rsoccer import randomization as numbers
from rsoccer import sensing_text

if TYPE_CHECKING:
    from rsoccer._core import Sensing
    from rsoccer.randomization import Ranges
    from rsoccer.sources import SensingSource


def written(sensing: SensingSource | None, randomization: Ranges | None) -> dict[str, str]:
    """Return the metadata of the matches of a training.

    Args:
        sensing: what robots knew, as for `Matches`; a model that is an object has no text and is
            left out.
        randomization: distributions of numbers, as for `Matches`.

    Returns:
        Text by key; no keys where robots knew the true state and no numbers varied.

    Raises:
        TypeError: no distributions by name, or one of another type.
        ValueError: a text that is no preset's name, an unknown name, or a distribution that is
            none.
    """
    metadata = {}
    recorded = sensing_text.recordable(sensing)
    if recorded is not None:
        metadata["sensing"] = sensing_text.to_text(recorded)
    if randomization is not None:
        numbers.check(randomization)
    if randomization:
        metadata["randomization"] = json.dumps(numbers.written(randomization), sort_keys=True)
        read_randomization(metadata)
    return metadata


def read_sensing(metadata: Mapping[str, str]) -> Sensing | str | None:
    """Read what robots knew of the true state; nothing is imported.

    Args:
        metadata: text by key.

    Returns:
        A `Sensing`, or the text "module:name" of a sensor model; None if the file has neither.

    Raises:
        ValueError: another text.
    """
    text = metadata.get("sensing")
    try:
        return None if text is None else sensing_text.from_text(text)
    except ValueError as error:
        raise ValueError(f"metadata 'sensing': {error}") from error


def has_forecast(metadata: Mapping[str, str]) -> bool:
    """Return whether robots forecast in the training.

    Args:
        metadata: text by key.

    Raises:
        ValueError: senses that cannot be read.
    """
    sensing = read_sensing(metadata)
    return sensing is not None and not isinstance(sensing, str) and sensing.forecast >= 0.5


def read_randomization(metadata: Mapping[str, str]) -> dict[str, Any]:
    """Read the distributions of numbers.

    Args:
        metadata: text by key.

    Returns:
        Distributions by name; none if all matches had the same numbers.

    Raises:
        ValueError: other values than a JSON object of distributions.
    """
    text = metadata.get("randomization", "{}")
    try:
        ranges = json.loads(text)
        numbers.describe(ranges)
    except (AttributeError, TypeError, ValueError) as error:
        raise ValueError(f"metadata 'randomization': {error}") from error
    return dict(ranges)


def describe(metadata: Mapping[str, str]) -> str:
    """Return the conditions in a line, such as "sensing vsss, robot.mass 0.9 to 1.1".

    Args:
        metadata: text by key.

    Raises:
        ValueError: conditions that cannot be read.
    """
    sensing, ranges = read_sensing(metadata), read_randomization(metadata)
    known = [] if sensing is None else [f"sensing {sensing_text.describe(sensing)}"]
    return ", ".join([*known, *([numbers.describe(ranges)] if ranges else [])])

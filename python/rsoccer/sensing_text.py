"""Senses as text, in the headers of replays and policy files, and in a few words for people."""

from __future__ import annotations

import json

import numpy as np

from rsoccer._core import Sensing


def recordable(source: object) -> Sensing | str | None:
    """Return what files can hold of senses.

    Args:
        source: what robots know of the true state, as for `Matches`.

    Returns:
        A `Sensing`, also for the name of a preset; the text "module:name" as it is; None for a
        model that is an object, and without senses.

    Raises:
        ValueError: a text that is no preset's name.
    """
    if isinstance(source, str) and ":" not in source:
        return Sensing(source)
    return source if isinstance(source, Sensing | str) else None


def to_text(sensing: Sensing | str) -> str:
    """Return senses as files hold them.

    Args:
        sensing: a `Sensing`, or the text "module:name" of a sensor model.

    Returns:
        JSON of `Sensing.to_json`, or "module:name".
    """
    return sensing.to_json() if isinstance(sensing, Sensing) else sensing


def from_text(text: str) -> Sensing | str:
    """Return senses that `to_text` wrote; nothing is imported.

    Args:
        text: the text.

    Raises:
        ValueError: neither the numbers of a `Sensing` nor "module:name".
    """
    if text.startswith("{"):
        return Sensing.from_json(text)
    if not all(part.strip() for part in text.partition(":")):
        raise ValueError(f"sensing: expected JSON of a Sensing or 'module:name', got {text!r:.80}")
    return text


def with_number(sensing: Sensing, name: str, value: float) -> Sensing:
    """Return senses with another value of a number.

    Args:
        sensing: the senses.
        name: name of the number.
        value: the value.

    Raises:
        ValueError: a value out of range.
    """
    return Sensing.from_json(json.dumps({**json.loads(sensing.to_json()), name: value}))


def describe(sensing: Sensing | str) -> str:
    """Return senses in a few words: the preset with the numbers that differ, or "module:name".

    Args:
        sensing: a `Sensing`, or the text "module:name" of a sensor model.
    """
    if isinstance(sensing, str):
        return sensing
    numbers = json.loads(sensing.to_json())
    name = numbers.pop("name")
    preset = json.loads(Sensing.preset(name).to_json()) if name in Sensing.PRESETS else {}
    changed = [
        f"{key}={_digits(value)}" for key, value in numbers.items() if preset.get(key) != value
    ]
    return ", ".join(changed if name == "none" and changed else [name, *changed])


def _digits(value: float) -> str:
    """A number of senses, float32, in as many digits as it needs to be read again."""
    text = f"{value:g}"
    return text if np.float32(text) == np.float32(value) else f"{value:.9g}"

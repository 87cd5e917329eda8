"""Output of the commands: files and lines."""

from __future__ import annotations

import sys
from pathlib import Path


def check_output(option: str, path: Path | None, suffix: str = "") -> None:
    """Refuse a file in a folder that does not exist, or with another suffix.

    Args:
        option: name of the option.
        path: its value; None if it was not given.
        suffix: suffix of its files, with the point; "" for any.

    Raises:
        ValueError: the file cannot be written there, or has another suffix.
    """
    if path is not None and not path.parent.is_dir():
        raise ValueError(f"{option}: expected a file in a folder that exists, got {path}")
    if path is not None and suffix and path.suffix != suffix:
        raise ValueError(f"{option}: expected a name ending in {suffix}, got {path}")


def write(text: str) -> None:
    """Print a text and a line break on standard output.

    Args:
        text: one or more lines.
    """
    sys.stdout.write(text + "\n")

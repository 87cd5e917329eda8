"""Output of the commands: files and lines."""

from __future__ import annotations

import sys
from pathlib import Path

from rsoccer.files import check_writable


def check_output(option: str, path: Path | None, *suffixes: str) -> None:
    """Refuse a file that cannot be written, before there is anything to write.

    Args:
        option: name of the option.
        path: its value; None if it was not given.
        *suffixes: suffixes of its files, with the point; none for any.

    Raises:
        ValueError: a folder or a device, a file in a folder that does not exist or cannot be
            written, or another suffix.
    """
    if path is None:
        return
    check_writable(option, path)
    if suffixes and path.suffix not in suffixes:
        expected = " or ".join(suffixes)
        raise ValueError(f"{option}: expected a name ending in {expected}, got {path}")


def write(text: str) -> None:
    """Print a text and a line break on standard output.

    Args:
        text: one or more lines.
    """
    sys.stdout.write(text + "\n")

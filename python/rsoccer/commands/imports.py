"""`--import`: modules that register tasks and policies of one's own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated

from tyro.conf import UseAppendAction, arg

OPTION = "--import"

IMPORTS = arg(name=OPTION.removeprefix("--"), metavar="MODULE")


@dataclass(frozen=True, kw_only=True)
class Imports:
    """Option of all commands; the module is imported before the words are parsed."""

    imports: Annotated[tuple[str, ...], UseAppendAction, IMPORTS] = ()
    """module to import first, of the current folder or installed: one that registers a task or
    policies of your own"""


def imported(words: Sequence[str]) -> list[str]:
    """Return the modules that the words name.

    Args:
        words: the words after `rsoccer`.
    """
    following = [b for a, b in pairwise(words) if a == OPTION]
    joined = [word.partition("=")[2] for word in words if word.startswith(f"{OPTION}=")]
    return [*following, *joined]

"""Starts of Ray on a busy machine."""

from collections.abc import Callable
from typing import Final, TypeVar

SLOW_START: Final = "The current node timed out during startup"
"""Ray's message if its agent needs more than 15 seconds to start, a limit without a setting.

https://github.com/ray-project/ray/issues/65983
"""
STARTS: Final = 3

Result = TypeVar("Result")


def patiently(call: Callable[[], Result], clean: Callable[[], object] = lambda: None) -> Result:
    """Return the result of a call; after a slow start of Ray clean up and call again."""
    for _ in range(STARTS - 1):
        try:
            return call()
        except Exception as error:
            if SLOW_START not in str(error):
                raise
            clean()
    return call()

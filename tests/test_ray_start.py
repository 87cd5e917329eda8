"""Retries of a slow start of Ray, without Ray."""

from collections.abc import Callable

import pytest

from tests.ray_start import SLOW_START, STARTS, patiently


def failing(times: int, message: str) -> tuple[Callable[[], str], list[str]]:
    """A call that fails some times, and the list of its failures."""
    failures: list[str] = []

    def call() -> str:
        if len(failures) < times:
            failures.append(message)
            raise RuntimeError(message)
        return "started"

    return call, failures


def test_a_slow_start_is_tried_again_after_cleaning() -> None:
    cleaned: list[int] = []
    call, failures = failing(STARTS - 1, f"Exception: {SLOW_START}. This")
    assert patiently(call, lambda: cleaned.append(1)) == "started"
    assert len(failures) == len(cleaned) == STARTS - 1


@pytest.mark.parametrize(("times", "message"), [(STARTS, SLOW_START), (1, "another error")])
def test_other_errors_and_the_last_start_are_reported(times: int, message: str) -> None:
    call, failures = failing(times, message)
    with pytest.raises(RuntimeError, match=message):
        patiently(call)
    assert len(failures) == times

"""Options of tasks as words of a command line."""

import pytest

from rsoccer.option_words import parse_options


def test_words_become_values_by_name() -> None:
    words = ["half_seconds=30", "division=A", "referee={'a': 1}", "text='1'"]
    assert parse_options("task_options", words) == {
        "half_seconds": 30,
        "division": "A",
        "referee": {"a": 1},
        "text": "1",
    }


@pytest.mark.parametrize("words", [["half_seconds"], ["=3"], ["a=1", "a=2"]])
def test_other_words_are_refused(words: list[str]) -> None:
    with pytest.raises(ValueError, match="task_options: expected"):
        parse_options("task_options", words)

"""Options with several words on the command line."""

import pytest

from rsoccer import cli

PLAYED = ["chase", "--task", "VSS-v0", "--task-options", "max_steps=4", "--matches", "2"]


@pytest.mark.parametrize(
    "words",
    [
        ["evaluate", *PLAYED, "--opponents"],
        ["evaluate", *PLAYED, "--randomization"],
        ["evaluate", "chase", "--matches", "2", "--task-options"],
        ["cooperation", *PLAYED, "--partners"],
        ["train", "--opponents"],
    ],
    ids=lambda words: f"{words[0]} {words[-1]}",
)
def test_an_option_with_nothing_behind_it_is_refused(
    words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    """Formerly it was as if it were absent."""
    with pytest.raises(SystemExit) as error:
        cli.main(words)
    assert error.value.code == 2
    shown = " ".join(capsys.readouterr().err.replace("│", " ").split())
    assert "expected at least one value behind the option, got none" in shown
    assert words[-1] in shown


def test_several_words_are_values_of_one_option(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["evaluate", *PLAYED, "--opponents", "ou", "zero"]) == 0
    rows = capsys.readouterr().out.splitlines()
    assert [row.split()[1] for row in rows[-2:]] == ["ou", "zero"]

"""Whole numbers on the command line."""

import pytest

from rsoccer import cli
from rsoccer.commands import train as train_command
from rsoccer.commands.numbers import parse
from rsoccer.train import Args


@pytest.mark.parametrize(
    ("word", "number"), [("1e6", 1_000_000), ("1_000", 1000), ("-2", -2), ("2.5e1", 25), ("7", 7)]
)
def test_numbers_may_have_an_exponent(word: str, number: int) -> None:
    assert parse(word) == number


@pytest.mark.parametrize("word", ["1.5", "1e-1", "many", "nan", "inf", "1e400", ""])
def test_other_texts_are_refused(word: str) -> None:
    with pytest.raises(ValueError, match="expected a whole number, such as 100 or 1e6, got "):
        parse(word)


def test_all_commands_take_them(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    received: list[Args] = []
    monkeypatch.setattr(train_command, "train", received.append)
    words = ["train", "--samples", "1e6", "--network.hidden-sizes", "1e1", "20"]
    words += ["--rollout.worlds", "1_000"]
    assert cli.main(words) == 0
    (args,) = received
    assert (args.samples, args.network.hidden_sizes, args.rollout.worlds) == (
        1_000_000,
        (10, 20),
        1000,
    )
    assert cli.main(["evaluate", "zero", "--matches", "2e0", "--seed", "1e1"]) == 0
    with pytest.raises(SystemExit):
        cli.main(["evaluate", "zero", "--matches", "1.5"])
    assert "expected a whole number" in " ".join(capsys.readouterr().err.split())


def test_settings_take_whole_floats() -> None:
    samples: float = 1e6
    assert Args(samples=samples).samples == 1_000_000  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"samples must be an integer at least 1, got 0\.5"):
        Args(samples=0.5)  # type: ignore[arg-type]

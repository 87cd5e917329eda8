"""Senses as text."""

import pytest

from rsoccer import Sensing, sensing_text
from tests.simulators import BLIND


@pytest.mark.parametrize("sensing", [Sensing("rc2021", delay=0.2), Sensing(), "module:name"])
def test_senses_come_back(sensing: Sensing | str) -> None:
    assert sensing_text.from_text(sensing_text.to_text(sensing)) == sensing


@pytest.mark.parametrize("text", ["", "vsss", ":", "module:", " :name", "{", "{}"])
def test_other_texts_are_refused(text: str) -> None:
    with pytest.raises(ValueError, match="Sensing"):
        sensing_text.from_text(text)


@pytest.mark.parametrize(
    ("source", "recorded"),
    [
        (None, None),
        ("vsss", Sensing("vsss")),
        ("vsss, position_noise=0.1", Sensing("vsss", position_noise=0.1)),
        (Sensing(delay=0.1), Sensing(delay=0.1)),
        ("tests.simulators:missing", "tests.simulators:missing"),
        (BLIND, None),
    ],
)
def test_what_files_hold(source: object, recorded: Sensing | str | None) -> None:
    assert sensing_text.recordable(source) == recorded


@pytest.mark.parametrize(
    ("sensing", "words"),
    [
        (Sensing("rc2021"), "rc2021"),
        (Sensing("rc2021", delay=0.2), "rc2021, delay=0.2"),
        (Sensing(delay=0.1, frame_loss=0.5), "delay=0.1, frame_loss=0.5"),
        (Sensing(), "none"),
        ("module:name", "module:name"),
    ],
)
def test_senses_in_a_few_words(sensing: Sensing | str, words: str) -> None:
    assert sensing_text.describe(sensing) == words
    assert isinstance(sensing, str) or Sensing(words) == sensing

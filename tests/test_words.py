"""One word for one thing: words that the project has replaced do not come back."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
FOLDERS = ("python", "crates", "tests", "tools", "benches", "examples", "docs")
PAGES = (
    "README.md",
    "ARCHITECTURE.md",
    "CONTRIBUTING.md",
    "CHANGELOG.md",
    "Makefile",
    "pyproject.toml",
)
ENDINGS = (".py", ".pyi", ".rs", ".md", ".toml", ".sh", ".js", ".css", ".html")

REPLACED = {
    "foes?": "opponent",
    "mates?": "teammate",
    "seers?": "observer",
    "seats?": "slot",
    "crews?": "policy group",
    "doors?": "interface, entry point",
    "physique": "body parameters",
    "appoint(s|ed)?": "assign",
    "likewise": "the same noun again",
    "put_back": "reposition",
    "told": "commanded, reported",
    "whoever": "the agent, the caller",
}
"""Patterns of replaced words, an underscore being a boundary, and the word in their place."""

BRITISH = {
    "(off|half)?cent(re[sd]?|ring)": "center",
    "(centi|milli|kilo)?metres?": "meter",
    "(un)?(col|fav|neighb|behavi|hon)ou(r[a-z]*)": "color, favor, neighbor, behavior, honor",
    "tyres?": "tire",
    "towards": "toward",
    "(de|of)fences?": "defense, offense",
    "licence[sd]?": "license",
    "grey(s|er|ish)?": "gray",
    "judgements?": "judgment",
    "[a-z]*(travell|labell|modell|cancell|signall|tunnell)(ed|ing|er)": "one l",
    "(ana|cata|para)lys(e[sd]?|ing)": "-yze",
    "[a-z]{3,}(al|im|or|om|er|ar|an|in|it|ogn|et|nt)is(e[sd]?|ing|ation|er)": "-ize",
}
"""Patterns of British spellings, and the American one that users of Gymnasium search for."""


def sources() -> list[Path]:
    found = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*")]
    kept = [path for path in found if path.suffix in ENDINGS and "__pycache__" not in path.parts]
    return [path for path in [*kept, *(ROOT / page for page in PAGES)] if path != Path(__file__)]


def uses(pattern: str, text: str) -> list[str]:
    return [match[0] for match in re.finditer(rf"(?i)(?<![A-Za-z])({pattern})(?![A-Za-z])", text)]


@pytest.mark.parametrize("pattern", [*REPLACED, *BRITISH])
def test_replaced_words_are_not_used(pattern: str) -> None:
    using = [str(p.relative_to(ROOT)) for p in sources() if uses(pattern, p.read_text())]
    assert not using, f"write {(REPLACED | BRITISH)[pattern]!r}"


@pytest.mark.parametrize(
    "word",
    [
        *("centre", "off_centre", "Metres", "colours", "neighbouring", "behaviour", "tyre"),
        *("towards", "defence", "licence", "grey", "judgement", "travelled", "analysed"),
        *("normalised", "randomisation", "vectorise", "serialiser"),
    ],
)
def test_british_spellings_are_found(word: str) -> None:
    assert any(uses(pattern, word) for pattern in BRITISH)


def test_uses_are_found() -> None:
    assert uses("mates?", "n_mates and MATE, but no teammates") == ["mates", "MATE"]
    assert len(sources()) > 300

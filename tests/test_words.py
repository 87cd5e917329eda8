"""One word for one thing: words that the project has replaced do not come back."""

import re
from functools import cache
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
ENDINGS = (".py", ".pyi", ".proto", ".rs", ".md", ".toml", ".sh", ".js", ".css", ".html")

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
    r"turn(ing)?[\s_#/*-]+rates?": "angular velocity",
    "(turning|rotation(al)?|angular)[ _](speed|rate)s?": "angular velocity",
    "(max|top)_(spin|v_theta)": "angular velocity",
    r"(motion|body|robots?|ego|own|target)\.spin": "angular velocity, as spin is the ball's",
    "robot's spins?|spins? of (a|the|all) robots?": "angular velocity, as spin is the ball's",
    r"\w*params\w*": "parameters",
    r"(self|scene|world)\.factors": "parameters",
    "(defense|penalty)[ _]areas?": "goal area",
}
"""Patterns of replaced words, an underscore being a boundary, and the word in their place."""

OF_OTHERS = {
    "get_field_params": "the old simulator",
    "`botParamsDatabase`": "a team's software",
    ".tick_params(": "Matplotlib",
    '"setparams=': "FFmpeg",
    "fixture(params=": "pytest",
    'scope="module", params=': "pytest",
    "share_params=True": "TorchRL",
    "share_params=False": "TorchRL",
    ".share_params": "TorchRL",
    " params=loss.critic_network_params": "TorchRL",
    "target_params=loss.target_critic_network_params": "TorchRL",
    "(SSL: defense area)": "the rules of the SSL",
    "Opponent Defense Area": "the rules of the SSL",
    "ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA": "the game controller",
    "ATTACKER_TOO_CLOSE_TO_DEFENSE_AREA": "the game controller",
    "DEFENDER_IN_DEFENSE_AREA": "the game controller",
    "attacker_touched_ball_in_defense_area": "the game controller",
    "attacker_too_close_to_defense_area": "the game controller",
    "defender_in_defense_area": "the game controller",
    "ATTACKER_TOUCHED_OPPONENT_IN_DEFENSE_AREA": "the game controller",
    "attacker_touched_opponent_in_defense_area": "the game controller",
    "penalty_area_depth": "SSL-Vision",
    "penalty_area_width": "SSL-Vision",
}
"""Phrases with a replaced word in a name that is not the project's, and whose name it is."""

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


@cache
def sources() -> list[Path]:
    found = [path for folder in FOLDERS for path in (ROOT / folder).rglob("*")]
    kept = [path for path in found if path.suffix in ENDINGS and "__pycache__" not in path.parts]
    kept = [path for path in kept if "_pb2" not in path.name]  # made from schemas, which are read
    return [path for path in [*kept, *(ROOT / page for page in PAGES)] if path != Path(__file__)]


@cache
def own_words(path: Path) -> str:
    """Name and text of a file, without the names of others."""
    return without_names_of_others(f"{path.relative_to(ROOT)}\n{path.read_text()}")


def without_names_of_others(text: str) -> str:
    for phrase in OF_OTHERS:
        text = text.replace(phrase, "")
    return text


def uses(pattern: str, text: str) -> list[str]:
    return [match[0] for match in re.finditer(rf"(?i)(?<![A-Za-z])({pattern})(?![A-Za-z])", text)]


@pytest.mark.parametrize("pattern", [*REPLACED, *BRITISH])
def test_replaced_words_are_not_used(pattern: str) -> None:
    using = [str(path.relative_to(ROOT)) for path in sources() if uses(pattern, own_words(path))]
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


@pytest.mark.parametrize(
    "text",
    [
        *("turn rate", "max_turn_rate", "MAX_TURN_RATE", "top turn\n    rates", "turning rate"),
        *("max_v_theta", "top_spin", "motion.spin", "the robot's spin", "rotational speed"),
        *("params=None", "BodyParams", "field_params", "crates/rsim-core/src/body_params.rs"),
        *("set_params(", "params = loss.critic_network_params", "fixture(scope, params=["),
        *("scene.factors", "penalty area", "defense area"),
    ],
)
def test_replaced_names_are_found(text: str) -> None:
    assert any(uses(pattern, without_names_of_others(text)) for pattern in REPLACED)


@pytest.mark.parametrize("text", ["return rate", "ball.spin", "MAX_PLACED_SPIN", *OF_OTHERS])
def test_other_names_are_not_found(text: str) -> None:
    assert not any(uses(pattern, without_names_of_others(text)) for pattern in REPLACED)


@pytest.mark.parametrize("phrase", OF_OTHERS)
def test_names_of_others_are_in_use(phrase: str) -> None:
    assert any(phrase in path.read_text() for path in sources())


def test_uses_are_found() -> None:
    assert uses("mates?", "n_mates and MATE, but no teammates") == ["mates", "MATE"]
    assert len(sources()) > 300

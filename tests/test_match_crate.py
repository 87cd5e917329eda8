"""Numbers and texts of `crates/rsim-match` that are the package's, too: it has no Python to ask.

The sources are read, as the crate's numbers are private. `make check-wasm` compares how matches
play.
"""

import re
from functools import cache
from pathlib import Path

import pytest

import rsoccer
from rsoccer.human import driver
from rsoccer.policies import policy_file
from rsoccer.policies.shield import SHIELDS
from rsoccer.rules.referee_config import PRESETS, RefereeConfig
from rsoccer.tasks import ssl
from rsoccer.tasks.match import GAME_BLOCK, GAME_LIMIT
from rsoccer.tasks.soccer import OBSERVATION_LIMITS
from tools.playground.page import HALF_SECONDS

SOURCES = Path(__file__).parent.parent / "crates" / "rsim-match" / "src"


@cache
def source(name: str) -> str:
    """Text of a file, with texts over several lines as one."""
    return re.sub(r"\\\n\s*", "", (SOURCES / name).read_text(encoding="utf-8"))


def constant(file: str, name: str) -> str:
    """Value of a constant, as it is written."""
    found = re.findall(rf"^const {name}: [^=]+ = ([^;]+);$", source(file), re.MULTILINE)
    assert len(found) == 1, (file, name)
    return str(found[0])


@pytest.mark.parametrize(
    ("file", "name", "expected"),
    [
        ("actions.rs", "MAX_ANGULAR_VELOCITY", ssl.MAX_ANGULAR_VELOCITY),
        ("actions.rs", "MAX_LEGAL_KICK_SPEED", ssl.MAX_LEGAL_KICK_SPEED),
        ("person.rs", "WHEEL_TURN", driver.WHEEL_TURN),
        ("person.rs", "TURN", driver.TURN),
        ("person.rs", "SLOW", driver.SLOW),
        ("network.rs", "MAX_ACTION_REPEAT", policy_file.MAX_ACTION_REPEAT),
    ],
)
def test_numbers_are_those_of_the_package(file: str, name: str, expected: float) -> None:
    assert float(constant(file, name)) == expected


def test_policy_files_have_the_same_format() -> None:
    assert constant("network.rs", "FORMAT") == f'"{policy_file.FORMAT}"'
    assert re.findall(r'"(\w+)"', constant("network.rs", "SHIELDS")) == list(SHIELDS)


def test_bounds_of_observations_are_those_of_the_tasks() -> None:
    pairs = re.findall(r'\("(\w+)", ([\d.]+)\)', constant("observations.rs", "LIMITS"))
    limits = {name: float(limit) for name, limit in pairs}
    assert len(limits) == len(pairs)
    assert limits == {**OBSERVATION_LIMITS, GAME_BLOCK: GAME_LIMIT}


def test_halves_are_as_long_as_those_of_the_rules() -> None:
    found = re.search(r"fn half_seconds\(\) -> f32 \{\s*([\d.]+)\s*\}", source("setup.rs"))
    assert found
    assert float(found[1]) == HALF_SECONDS
    played = {name for name in PRESETS if f'"{name}"' in source("setup.rs")}
    assert len(played) == 4
    assert {RefereeConfig(name).half_seconds for name in played} == {HALF_SECONDS}


def test_layouts_are_those_of_the_tasks() -> None:
    # A test of the crate asserts these texts, in this order.
    body = source("observations.rs").partition("fn texts_are_those_of_the_tasks")[2]
    asserted = re.findall(r'"(ball [^"]+)"', body.partition("#[test]")[0])
    three = {"n_blue": 3, "n_yellow": 3}
    tasks = [
        *(rsoccer.make_task(name) for name in ("VSSSelfPlay-v0", "VSSMatch-v0")),
        *(
            rsoccer.make_task(name, chip_kick=chip_kick, **three)
            for chip_kick in (False, True)
            for name in ("SSLSelfPlay-v0", "SSLMatch-v0")
        ),
    ]
    assert asserted == [task.layout.text for task in tasks]
    assert len(set(asserted)) == 6

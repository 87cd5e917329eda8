"""The pages' tables of rules name functions and tests that exist."""

import re
from pathlib import Path

import pytest

from rsoccer._core import referee_rules
from tools.paths import ROOT
from tools.referee_scenes import FOLDER, SSL, VSSS, ssl_scenes, vsss_scenes
from tools.referee_tables import ssl_rules, vsss_rules

LEAGUES = {"ssl": SSL, "vsss": VSSS}


def functions(path: Path, attribute: str = "") -> set[str]:
    """Return the names of the functions of a Rust file that follow an attribute."""
    return set(re.findall(rf"{re.escape(attribute)}\s*\n(?:pub )?fn (\w+)\(", path.read_text()))


@pytest.mark.parametrize("league", LEAGUES)
def test_each_rule_has_its_function(league: str) -> None:
    rules = referee_rules(league)
    assert len(rules) > 5
    for name, _, _, function in rules:
        module, called = function.replace(" ", "").split("::")
        path = ROOT / "crates" / "rsim-referee" / "src" / "rules" / league / f"{module}.rs"
        assert called in functions(path), f"{name}: no {called} in {path}"


@pytest.mark.parametrize("league", LEAGUES)
def test_each_rule_has_three_scenes_that_are_tests(league: str) -> None:
    scenes = LEAGUES[league]
    assert list(scenes) == [name for name, *_ in referee_rules(league)]
    for name, tests in scenes.items():
        assert len(set(tests)) == 3, name
        for test in tests:
            module, function = test.split("::")
            path = ROOT / FOLDER / league / f"{module}.rs"
            assert function in functions(path, "#[test]"), f"{name}: no test {function} in {path}"


def test_no_scene_stands_for_many_rules() -> None:
    for scenes in LEAGUES.values():
        judged = [tests[0] for tests in scenes.values()]
        assert len(set(judged)) == len(judged), "a test that shows two rules shows neither alone"


def test_tables_have_a_row_for_each_rule() -> None:
    for league, rules, scenes in (
        ("ssl", ssl_rules(), ssl_scenes()),
        ("vsss", vsss_rules(), vsss_scenes()),
    ):
        for text in (rules, scenes):
            rows = [line.split("`")[1] for line in text.splitlines()[2:]]
            assert rows == [name for name, *_ in referee_rules(league)]

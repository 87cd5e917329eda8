"""Numbers and switches of the rules: presets, changes, errors by name."""

import copy
import json
import math
import pickle
from typing import Any

import pytest

from rsoccer import make_task
from rsoccer._core import Referee, SimConfig, referee_preset, referee_rules, referee_values
from rsoccer.rules.referee_config import CHOICES, PRESETS, RefereeConfig

FIELDS = {
    "ssl_2026_a": "ssl_a",
    "ssl_2026_b": "ssl_b",
    "vsss_3v3": "vss_3v3",
    "vsss_5v5": "vss_5v5",
}


@pytest.mark.parametrize("preset", PRESETS)
def test_presets_are_those_of_the_core(preset: str) -> None:
    config = RefereeConfig(preset)
    assert dict(config) == json.loads(referee_preset(preset))
    assert config.league == preset.split("_")[0]
    assert repr(config) == f"RefereeConfig({preset!r})"
    Referee(SimConfig(FIELDS[preset], 2, 2), config.to_json())


def test_divisions_and_leagues_differ_where_their_rules_do() -> None:
    a, b = RefereeConfig("ssl_2026_a"), RefereeConfig("ssl_2026_b")
    assert {name for name in a if a[name] != b[name]} == {
        "aimless_kick",
        "failed_placement_passes",
        "free_kick_seconds",
        "held_ball_seconds",
        "no_progress_seconds",
    }
    assert RefereeConfig("vsss_5v5").large_area_defenders > 0.0
    assert RefereeConfig("vsss_3v3").large_area_defenders == 0.0
    assert list(a) == list(RefereeConfig("vsss_3v3")), "all presets have the same names"


def test_values_are_replaced_and_others_kept() -> None:
    config = RefereeConfig("ssl_2026_b", half_seconds=60, off=["BOT_PUSHED_BOT"])
    assert config.half_seconds == config["half_seconds"] == 60.0
    assert isinstance(config.half_seconds, float)
    assert config.off == ["BOT_PUSHED_BOT"]
    assert config.dribble_distance == RefereeConfig("ssl_2026_b").dribble_distance
    further = config.replaced(clock="running", half_seconds=90)
    assert (further.clock, further.half_seconds, further.off) == ("running", 90.0, config.off)
    assert config.clock == "stopped"
    assert repr(config) == (
        "RefereeConfig('ssl_2026_b', off=['BOT_PUSHED_BOT'], half_seconds=60.0)"
    )


def test_configurations_are_values() -> None:
    config = RefereeConfig("ssl_2026_b", ball_speed=8.0)
    same = RefereeConfig("ssl_2026_b", ball_speed=8)
    assert config == same and hash(config) == hash(same)
    assert config != RefereeConfig("ssl_2026_b")
    for twin in (copy.deepcopy(config), pickle.loads(pickle.dumps(config))):
        assert twin == config
        assert twin.preset == "ssl_2026_b"


@pytest.mark.parametrize(
    ("values", "error", "message"),
    [
        ({"half_second": 3}, ValueError, "referee: expected one of league, .*, got 'half_second'"),
        ({"half_seconds": "long"}, TypeError, "half_seconds: expected a number, got 'long'"),
        ({"half_seconds": True}, TypeError, "half_seconds: expected a number, got True"),
        ({"aimless_kick": 1}, TypeError, "aimless_kick: expected True or False, got 1"),
        ({"off": "GOAL"}, TypeError, "off: expected a list of names of rules, got 'GOAL'"),
        ({"off": [3]}, ValueError, "off: expected names of .*, GOAL, .*, got 3"),
        ({"off": ["OFFSIDE"]}, ValueError, "off: expected names of .*, GOAL, .*, got 'OFFSIDE'"),
        ({"clock": 3}, ValueError, r"clock: expected one of \('stopped', 'running'\), got 3"),
        ({"placement": "hand"}, ValueError, "placement: expected one of .*teleport.*, got 'hand'"),
        ({"half_end": "late"}, ValueError, "half_end: expected one of .*at_once.*, got 'late'"),
        ({"league": "vsss"}, ValueError, r"league: expected one of \('ssl',\), got 'vsss'"),
        ({"ball_speed": -1}, ValueError, "ball_speed: expected a finite number, .* 0, got -1"),
        ({"ball_speed": math.inf}, ValueError, "ball_speed: expected a finite .*, got inf"),
        ({"ball_speed": math.nan}, ValueError, "ball_speed: expected a finite .*, got nan"),
        ({"ball_speed": 10**400}, ValueError, "ball_speed: expected a finite .*, got 1000"),
        ({"halves": 0}, ValueError, "^halves: expected 1 or 2, got 0"),
        ({"halves": 1.5}, ValueError, "^halves: expected a whole number, got 1.5"),
        ({"halves": 3}, ValueError, "^halves: expected 1 or 2, got 3"),
        ({"fouls_per_card": 1.5}, ValueError, "^fouls_per_card: expected a whole number, got 1.5"),
        ({"area_robots": 2}, ValueError, "^referee: expected one of .*, got 'area_robots'"),
        ({"placement_error": 0.1}, ValueError, "^referee: expected one of .*'placement_error'"),
    ],
)
def test_a_wrong_value_is_named(values: dict[str, Any], error: type, message: str) -> None:
    with pytest.raises(error, match=message):
        RefereeConfig("ssl_2026_b", **values)


@pytest.mark.parametrize("preset", PRESETS)
def test_every_preset_can_have_its_own_values_and_an_early_end(preset: str) -> None:
    config = RefereeConfig(preset)
    assert config.replaced(**config) == config
    assert config.replaced(early_end_goals=3).early_end_goals == 3.0


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"ball_speed": -1.0}, "ball_speed: expected a finite number, at least 0, got -1"),
        ({"off": ["OFFSIDE"]}, 'off: expected names of .*GOAL.*, got "OFFSIDE"'),
        ({"clock": "slow"}, "rules: unknown variant `slow`"),
        ({"speed": 1.0}, "rules: unknown field `speed`"),
    ],
)
def test_the_core_refuses_what_the_rules_do_not_have(values: dict[str, Any], message: str) -> None:
    rules = json.dumps({**RefereeConfig("ssl_2026_b"), **values})
    with pytest.raises(ValueError, match=message):
        Referee(SimConfig("ssl_b", 2, 2), rules)
    with pytest.raises(ValueError, match="rules: missing field"):
        Referee(SimConfig("ssl_b", 2, 2), "{}")


@pytest.mark.parametrize("name", CHOICES)
def test_the_core_knows_every_choice(name: str) -> None:
    for choice in CHOICES[name]:
        config = RefereeConfig("ssl_2026_b", **{name: choice})
        assert config[name] == choice
        Referee(SimConfig("ssl_b", 2, 2), config.to_json())


def test_every_value_has_a_meaning() -> None:
    values = referee_values()
    assert [name for name, *_ in values] == list(RefereeConfig("ssl_2026_b"))
    numbers = {name for name, unit, _ in values if unit}
    assert numbers == {k for k, v in RefereeConfig("vsss_3v3").items() if isinstance(v, float)}
    assert {unit for _, unit, _ in values} == {"", "1", "s", "m", "m/s"}
    assert all(meaning.endswith(".") for *_, meaning in values)


def test_unknown_presets_and_names_are_refused() -> None:
    with pytest.raises(ValueError, match=r"preset: expected one of \('ssl_2026_a', .*, got 'fifa'"):
        RefereeConfig("fifa")
    with pytest.raises(KeyError, match=r"name: expected one of ssl_2026_a, .*, got .*fifa"):
        referee_preset("fifa")
    with pytest.raises(ValueError, match="league: expected 'ssl' or 'vsss', got \"fifa\""):
        referee_rules("fifa")
    with pytest.raises(AttributeError, match="RefereeConfig has no 'half_second'"):
        _ = RefereeConfig("ssl_2026_b").half_second


@pytest.mark.parametrize("league", ["ssl", "vsss"])
def test_every_rule_can_be_switched_off(league: str) -> None:
    preset, field = {"ssl": ("ssl_2026_b", "ssl_b"), "vsss": ("vsss_5v5", "vss_5v5")}[league]
    names = [name for name, *_ in referee_rules(league)]
    assert len(set(names)) == len(names) > 3
    for off in ([name] for name in names):
        Referee(SimConfig(field, 1, 1), RefereeConfig(preset, off=off).to_json())
    assert all(source and text.endswith(".") for _, source, text, _ in referee_rules(league))


@pytest.mark.parametrize("name", ["preset", "self", "halfs"])
def test_names_that_the_rules_do_not_have_are_refused_by_name(name: str) -> None:
    values: dict[str, Any] = {name: "ssl_2026_a"}
    with pytest.raises(ValueError, match=f"referee: expected one of .*, got '{name}'"):
        RefereeConfig("ssl_2026_b", **values)
    with pytest.raises(ValueError, match=f"referee: expected one of .*, got '{name}'"):
        make_task("SSLMatch-v0", referee=values)

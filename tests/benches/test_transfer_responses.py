"""The same commands in other simulators and in likenesses: what is measured, kept and printed."""

import json
import math
from pathlib import Path

import pytest

from benches import transfer_responses
from benches.transfer_places import PLACES
from benches.transfer_responses import RESPONSES, responses


@pytest.mark.parametrize("name", PLACES)
def test_every_command_moves_its_body_in_the_likeness(name: str) -> None:
    place = PLACES[name]
    found = responses(place)
    assert set(found) == {each.name for each in RESPONSES[place.league]}
    for each in RESPONSES[place.league]:
        ways = found[each.name]
        assert len(ways) == len(each.times)
        if each.body == "mouth":
            continue
        assert all(math.isfinite(way) and way > 0.01 for way in ways), (each.name, ways)
        assert ways[1] > 1.4 * ways[0], "bodies go on"


@pytest.mark.parametrize(
    ("name", "holds"), [(n, n != "er-force") for n in PLACES if n != "firasim"]
)
def test_the_dribbler_holds_the_ball_as_it_does_there(name: str, holds: bool) -> None:
    place = PLACES[name]
    found = responses(place)
    held = [each for each in RESPONSES[place.league] if each.body == "mouth"]
    assert len(held) == 5
    for each in held:
        assert (max(found[each.name]) < 0.001) == holds, each.name


def test_kicks_have_the_commanded_speed() -> None:
    ways = responses(PLACES["grsim"])
    # A ball that slides at 10.3 m/s^2 for .1 s.
    for speed in (2.0, 4.0, 6.0):
        slid = speed * 0.1 - 0.5 * 10.3 * 0.1**2
        assert ways[f"kick {speed:g} m/s"][0] == pytest.approx(slid, abs=0.03)


def test_the_table_has_both_sides_of_the_places_that_were_measured(tmp_path: Path) -> None:
    likeness = responses(PLACES["firasim"])
    content = {name: [float("nan"), *ways[1:]] for name, ways in likeness.items()}
    (tmp_path / "firasim.json").write_text(json.dumps(content))
    rows = transfer_responses.report(tmp_path).splitlines()
    assert len(rows) == 2 + len(RESPONSES["vsss"])
    assert all(row.startswith("| FIRASim |") and "| - / " in row for row in rows[2:])

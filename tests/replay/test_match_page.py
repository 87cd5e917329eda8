"""Additions of the page of a match: in Python, and in a browser."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from rsoccer.render.referee_state import COLUMNS, RefereeState
from rsoccer.render.scoreboard import clock_text
from rsoccer.render.words import command_words, side_of, stage_text
from rsoccer.replay import Replay, page
from rsoccer.replay.match_page import match
from rsoccer.replay.page import to_html
from rsoccer.replay.recorded import Recorded
from rsoccer.view import SIDES
from tests.replay.browser import show
from tests.replay.conftest import ssl_match, vss, vss_match


def values_of(replay: Recorded) -> dict[str, Any]:
    found = match(replay)
    assert found is not None
    return found


def states_of(replay: Recorded) -> tuple[RefereeState, ...]:
    found = replay.referee_states
    assert found is not None
    return found


def at(changes: list[list[Any]], frame: int) -> list[Any]:
    """Values of a list by frame that hold at a frame."""
    return next(values for start, *values in reversed(changes) if start <= frame)


@pytest.mark.parametrize("recorded", [vss_match, ssl_match], ids=["VSSS", "SSL"])
def test_words_by_frame_are_those_of_pictures(recorded: Callable[[], Replay]) -> None:
    replay = recorded()
    values, states = values_of(replay), states_of(replay)
    announcements = replay.announcements
    for frame in range(0, len(replay), 7):
        words = command_words(states[frame])
        assert at(values["commands"], frame) == [words.text, side_of(words.team)]
        assert at(values["stages"], frame)[0] == stage_text(states[frame])
        assert at(values["announcements"], frame)[0] == announcements[frame].text
    assert len(values["commands"]) < 0.05 * len(replay)
    assert any(words.text for words in announcements)


def test_only_the_page_of_a_match_has_its_parts() -> None:
    assert match(vss()) is None
    other, of_match = to_html(vss()), to_html(vss_match())
    for name in (*page.MATCH_SCRIPTS, "match.css"):
        assert page.web_part(name) in of_match
        assert page.web_part(name) not in other
    assert '<script type="application/json" id="match">null</script>' in other


@pytest.mark.parametrize("recorded", [vss_match, ssl_match], ids=["VSSS", "SSL"])
def test_the_page_shows_what_python_knows(recorded: Callable[[], Replay], tmp_path: Path) -> None:
    replay = recorded()
    frames = list(range(0, len(replay), 61))
    script = f"""
      const text = (selector) => document.querySelector(selector).textContent;
      return {frames}.map((frame) => {{
        player.pause();
        player.seek(frame);
        player.draw();
        return {{
          command: text(".ticker span:first-child"),
          announcement: text(".ticker span:last-child"),
          stage: text(".stage"),
          goals: [text("#goals-blue"), text("#goals-yellow")],
          absent: document.querySelectorAll(".pips .absent").length,
          cards: player.match.pair("yellow_cards", frame),
          clock: text("#clock"),
        }};
      }});
    """
    shown = show(to_html(replay), script, tmp_path)
    assert shown.console == []
    states, absent = states_of(replay), replay.frame.robots.absent > 0
    for frame, found in zip(frames, shown.result, strict=True):
        state = states[frame]
        assert found["command"] == command_words(state).text
        assert found["announcement"] == replay.announcements[frame].text
        assert found["stage"] == stage_text(state)
        assert found["goals"] == [str(goals) for goals in state.score]
        assert found["cards"] == list(state.yellow_cards)
        assert found["absent"] == absent[frame].sum()
        left = clock_text(math.ceil(state.seconds_left - 1e-3))
        assert found["clock"] == ("Full time" if state.is_over else left)


STATISTICS = """
  const rows = (frame) => Object.fromEntries(player.match.statisticsAt(frame).rows.map(
    ([blue, name, yellow]) => [name, [blue, yellow]]));
  return [rows(0), rows(player.last)];
"""


def test_fouls_and_cards_follow_the_match(tmp_path: Path) -> None:
    replay = ssl_match()
    values = values_of(replay)
    first, last = show(to_html(replay), STATISTICS, tmp_path).result
    fouls = [event for event in replay.events if event.kind in values["fouls"]]

    def by_team(kinds: set[str]) -> list[str]:
        found = [event.detail for event in fouls if event.kind in kinds]
        return [str(found.count(team) + found.count("")) for team in SIDES]

    kinds = {event.kind for event in fouls}
    assert len(kinds) > 1
    assert last["fouls"] == by_team(kinds)
    for kind in kinds:
        name = values["texts"][kind].lower()
        assert last[name] == by_team({kind})
        assert first[name] == ["0", "0"]
    cards = states_of(replay)[-1].yellow_cards
    assert last["yellow cards"] == [str(count) for count in cards]
    assert last.keys() - first.keys() <= {name for name in last if name.startswith("ball in play")}


def test_statistics_are_those_of_the_second_match_in_a_replay_of_two(tmp_path: Path) -> None:
    replay = vss_match()
    referee = replay.referee
    assert referee is not None
    first, last = show(to_html(replay), STATISTICS, tmp_path).result
    columns = dict(zip(COLUMNS, referee[-1], strict=False))
    in_play = columns["in_play_steps"] * replay.config.time_step
    tenths = math.floor(10 * in_play + 1e-6)
    assert 0.0 < in_play < replay.seconds - replay.clock[replay.episodes[1].start]
    assert any(name.startswith(f"ball in play 0:0{tenths // 10}.{tenths % 10} (") for name in last)
    assert "ball in play 0:00.0 (0%)" in first
    assert last["distance"] == [f"{columns[f'distance_{team}']:.0f} m" for team in SIDES]
    assert last["shots"] == [f"{columns[f'shots_{team}']:.0f}" for team in SIDES]
    assert "red cards" not in last


def test_events_have_readable_names_and_goals_and_cards_stand_out(tmp_path: Path) -> None:
    script = """
      const items = (all) => {
        document.getElementById("touches").checked = all;
        player.fillEvents();
        return [...document.querySelectorAll("#events button")].map((button) => ({
          text: button.querySelector("span").textContent, kind: button.className}));
      };
      return {few: items(false), all: items(true)};
    """
    vsss = show(to_html(vss_match()), script, tmp_path)
    league = show(to_html(ssl_match()), script, tmp_path)
    assert vsss.console == league.console == []
    texts = {item["text"]: item["kind"] for item in vsss.result["few"] + league.result["few"]}
    goals = [kind for text, kind in texts.items() if text.startswith("Goal for")]
    cards = [kind for text, kind in texts.items() if text.startswith("Yellow card for")]
    assert goals
    assert cards
    assert all("prominent" in kind for kind in goals + cards)
    assert texts["2nd half"] == "part-of-match"
    assert not any("_" in text for text in texts)
    assert not any(text.startswith("Touch") for text in texts)
    assert any(item["text"].startswith("Touch") for item in vsss.result["all"])


def test_the_floor_shows_areas_distances_and_who_may_touch(tmp_path: Path) -> None:
    """Calls of the canvas by frame: a stadium has two arcs of the distance, a disc too."""
    replay = ssl_match()
    kinds = [event[1] for event in values_of(replay)["marks"]]
    assert {"stadium", "disc", ""} <= set(kinds)
    frames = {kind: values_of(replay)["marks"][kinds.index(kind)][0] for kind in kinds}
    script = f"""
      const seen = {{}};
      const {{context}} = player.view;
      const {{arc}} = Object.getPrototypeOf(context);
      for (const [kind, frame] of Object.entries({frames})) {{
        const radii = [];
        context.arc = function (x, y, radius, ...rest) {{
          radii.push(radius);
          return arc.call(this, x, y, radius, ...rest);
        }};
        player.view.draw(frame);
        seen[kind] = radii.filter((radius) => Math.abs(radius - 0.5) < 1e-6).length;
      }}
      return seen;
    """
    shown = show(to_html(replay), script, tmp_path)
    assert shown.console == []
    assert shown.result == {"stadium": 2, "disc": 2, "": 0}


def test_a_narrow_page_is_no_wider_than_the_screen(tmp_path: Path) -> None:
    script = """
      player.draw();
      return document.scrollingElement.scrollWidth - window.innerWidth;
    """
    for replay in (vss_match(), ssl_match()):
        assert show(to_html(replay), script, tmp_path, 500, 900).result <= 0

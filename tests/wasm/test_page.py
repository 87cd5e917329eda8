"""The playground in a headless Chromium, and the golden hashes there."""

import base64
import gzip
import json
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import rsoccer
from rsoccer.policies import make_policy
from rsoccer.policies.trained import FOLDER
from rsoccer.replay import Replay
from tests.replay.browser import Shown, show
from tests.wasm.engine import MODULE
from tests.wasm.test_bits import GOLDEN
from tools.playground.page import LEAGUES, to_html

LARGEST = 3e6
"""Bytes of the page with policies."""
READY = "<script>window.rsoccerPlayer = window.rsoccerPlayground;</script></body>"


@cache
def page() -> str:
    """The page of the module."""
    packed = base64.b64encode(gzip.compress(MODULE.read_bytes(), 9, mtime=0)).decode()
    return to_html(packed)


def shown(script: str, folder: Path, **size: int) -> Any:  # noqa: ANN401  (any JSON)
    """Result of a script that has the playground as `player`; the console stays empty."""
    result: Shown = show(page().replace("</body>", READY), script, folder, **size)
    assert result.console == []
    return result.result


def test_the_page_is_small() -> None:
    assert 5e5 < len(page().encode()) < LARGEST


def test_golden_hashes_in_a_browser_are_those_of_native_code(tmp_path: Path) -> None:
    hashes = shown("return player.engine.golden();", tmp_path)
    assert sorted(hashes) == sorted(GOLDEN.read_text().splitlines()[1:])


def test_each_league_plays_with_each_side(tmp_path: Path) -> None:
    played = shown(
        """
        const played = [];
        const select = (id, value) => {
          const element = document.getElementById(id);
          element.value = value;
          element.dispatchEvent(new Event("change"));
        };
        for (const league of player.data.leagues) {
          select("league", league.id);
          const { options } = document.getElementById("side-0");
          const sides = [...options].map((option) => option.value);
          for (const side of sides) {
            select("side-0", side);
            for (let step = 0; step < 400; step++) player.step();
            const message = document.getElementById("message");
            const text = message.hidden ? "" : message.textContent;
            played.push([league.id, side, player.report.steps, text]);
          }
        }
        return played;
        """,
        tmp_path,
    )
    wanted = {
        (league.id, side)
        for league in LEAGUES
        for side in (
            *(["scripted"] if league.field.startswith("ssl") else []),
            *(policy.id for policy in league.policies),
            "idle",
        )
    }
    assert {(league, side) for league, side, _, _ in played} == wanted
    assert all(steps >= 400 and not text for _, _, steps, text in played)


def test_a_task_goes_on_from_goal_to_goal_and_from_a_link(tmp_path: Path) -> None:
    result = shown(
        """
        const element = document.getElementById("league");
        element.value = "vss_self_play";
        element.dispatchEvent(new Event("change"));
        for (let step = 0; step < 4000; step++) player.step();
        player.showState();
        const text = (id) => document.getElementById(id).textContent;
        const { score, in_play, stage } = player.report;
        const words = [text("stage"), text("command")];
        const link = player.link();
        player.restore(link);
        const choices = player.choices.league;
        return { score, in_play, stage, words, choices, left: player.match.report().seconds_left };
        """,
        tmp_path,
    )
    assert sum(result["score"]) >= 3
    assert result["in_play"]
    assert result["words"] == ["until a goal", ""]
    assert result["choices"] == "vss_self_play"
    assert 0.0 < result["left"] <= 30.0


@pytest.mark.parametrize(("width", "height"), [(1280, 900), (420, 860)])
def test_a_person_plays_and_pulls_the_ball(tmp_path: Path, width: int, height: int) -> None:
    result = shown(
        """
        const press = (key) => window.dispatchEvent(new KeyboardEvent("keydown", {key}));
        document.getElementById("side-0").value = "idle";
        document.getElementById("side-0").dispatchEvent(new Event("change"));
        for (let step = 0; step < 120; step++) player.step();
        const before = [...player.live.newest];
        const name = document.getElementById("name-blue").textContent;
        press("d");
        for (let step = 0; step < 40; step++) player.step();
        const robot = player.driven;
        const at = player.live.ballSize + robot * player.live.robotSize;
        const moved = player.live.newest[at] - before[at];
        const pull = player.match.move(0, 1, 0.5);
        const ball = [...player.match.row("state")].slice(0, 2);
        player.panel.set({ delay: 100, rolling: 2 });
        player.changeConditions();
        for (let step = 0; step < 20; step++) player.step();
        await wait(300);
        const wide = document.documentElement.scrollWidth <= window.innerWidth;
        const sensed = player.live.sensedNumbers !== null;
        return { robot, moved, pull, ball, wide, name, sensed };
        """,
        tmp_path,
        width=width,
        height=height,
    )
    assert result["name"] == "nobody"
    assert 0 <= result["robot"] < LEAGUES[0].robots
    assert result["moved"] > 0.3
    assert result["pull"]
    assert result["ball"] == pytest.approx([1.0, 0.5], abs=1e-6)
    assert result["sensed"]
    assert result["wide"]


def test_the_narrow_board_shows_whole_names(tmp_path: Path) -> None:
    names = [policy.name for league in LEAGUES for policy in league.policies]
    cut = shown(
        f"""
        const cut = [];
        for (const width of ["360px", "420px", "590px"]) {{
          document.querySelector(".board").style.width = width;
          for (const name of {json.dumps(names)}) {{
            for (const id of ["name-blue", "name-yellow"]) {{
              const element = document.getElementById(id);
              element.textContent = name;
              const fits = element.scrollWidth <= element.clientWidth;
              if (!fits || element.scrollHeight > element.clientHeight) cut.push([width, name]);
            }}
          }}
        }}
        return [cut, window.innerWidth];
        """,
        tmp_path,
        width=420,
        height=860,
    )
    assert len(names) >= 3
    assert cut[0] == []
    assert cut[1] <= 600  # the rules of narrow pages hold


def test_the_keyboard_drives_after_choices_by_pointer(tmp_path: Path) -> None:
    result = shown(
        """
        const press = (key) => document.activeElement.dispatchEvent(
          new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
        const choose = (id, kind, pointed) => {
          const element = document.getElementById(id);
          if (pointed) element.dispatchEvent(new PointerEvent("pointerdown", { bubbles: true }));
          element.focus();
          const focused = document.activeElement === element;
          element.dispatchEvent(new Event(kind, { bubbles: true }));
          return focused;
        };
        const focused = [], driven = [];
        const choices = { league: "change", "side-0": "change", speed: "change",
          "skill-1": "change", "slider-delay": "change", ideal: "click", restart: "click" };
        for (const [id, kind] of Object.entries(choices)) {
          focused.push(choose(id, kind, true));
          player.drive(-1);
          press("ArrowUp");
          player.step();
          player.inputs.releaseAll();
          driven.push(player.driven >= 0);
        }
        player.drive(-1);
        press("x");
        choose("slider-delay", "change", false);
        press("ArrowUp");
        player.step();
        const keyed = [player.driven, document.activeElement.id];
        press("Escape");
        return { focused, driven, keyed, after: document.activeElement.tagName };
        """,
        tmp_path,
    )
    assert result["focused"] == [True] * 7
    assert result["driven"] == [True] * 7
    assert result["keyed"] == [-1, "slider-delay"]  # keys that move a slider go on with it
    assert result["after"] == "BODY"


def test_only_sliders_of_vision_bring_cameras(tmp_path: Path) -> None:
    result = shown(
        """
        const results = [];
        for (const id of ["command", "radio", "delay", "noise", "loss"]) {
          player.panel.set({ [id]: 10 });
          player.changeConditions();
          for (let step = 0; step < 40; step++) player.step();
          const [state, known] = ["state", "blue"].map((name) => [...player.match.row(name)]);
          const { sensing } = JSON.parse(player.match.configuration());
          const same = state.join() === known.join();
          results.push([id, same, player.hasSenses, sensing.frame_rate, sensing.tracker]);
        }
        return results;
        """,
        tmp_path,
    )
    assert result == [
        ["command", False, False, 0, 0],  # a scripted team forecasts
        ["radio", True, False, 0, 0],
        ["delay", False, True, 60, 1],
        ["noise", False, True, 60, 1],
        ["loss", False, True, 60, 1],
    ]


def test_a_held_key_acts_once(tmp_path: Path) -> None:
    result = shown(
        """
        const press = (key, repeat) => window.dispatchEvent(
          new KeyboardEvent("keydown", { key, repeat, cancelable: true }));
        const { inputs } = player;
        const state = () => [inputs.dribbles, player.paused, player.choices.seed, player.driven];
        const states = [];
        player.drive(0);
        for (const key of ["v", "p", "Tab", "r"]) {
          const before = state().join();
          press(key, false);
          const once = state().join();
          const stopped = !press(key, true);
          states.push([before !== once, once === state().join(), stopped]);
        }
        return states;
        """,
        tmp_path,
    )
    assert result == [[True, True, True]] * 4


def test_a_link_is_taken_by_an_open_page(tmp_path: Path) -> None:
    result = shown(
        """
        const league = document.getElementById("league");
        league.value = "vss";
        league.dispatchEvent(new Event("change", { bubbles: true }));
        player.panel.set({ command: 100 });
        player.changeConditions();
        for (let step = 0; step < 100; step++) player.step();
        player.togglePause();
        const wanted = [...player.match.row("state")];
        const link = player.link();
        league.value = "ssl_b";
        league.dispatchEvent(new Event("change", { bubbles: true }));
        location.hash = link;
        await wait(300);
        const got = [...player.match.row("state")];
        const message = document.getElementById("message");
        const { choices } = player;
        return { wanted, got, choices, hidden: message.hidden, shown: league.value };
        """,
        tmp_path,
    )
    assert result["hidden"]
    assert result["shown"] == "vss"
    assert result["choices"]["league"] == "vss"
    assert result["choices"]["conditions"] == {"command": 100}
    assert len(result["got"]) == len(result["wanted"])
    assert result["got"][:2] == pytest.approx(result["wanted"][:2], abs=1e-5)


@pytest.mark.parametrize(
    ("choices", "words"),
    [
        ({"league": "mars"}, ["league", "mars"]),
        ({"league": "ssl_b", "sides": ["file:mine", "idle"]}, ["blue", "file:mine"]),
        ({"league": "vss", "sides": ["scripted", "best"]}, ["blue", "scripted"]),
        ({"conditions": {"rolling": "x", "moon": 1, "delay": 1e9}}, ["rolling", "moon", "delay"]),
        ({"skills": [2, 0.5], "seed": -1}, ["skill of blue", "seed"]),
        ({"league": "ssl_b"}, ["situation"]),
        ([1], ["situation"]),
        (3, ["situation"]),
    ],
)
def test_a_wrong_link_is_named_and_a_match_begins(
    tmp_path: Path, choices: object, words: list[str]
) -> None:
    result = shown(
        f"""
        player.match.situation = () => new Float32Array(3);
        player.choices = {json.dumps(choices)};
        const link = player.link();
        const message = document.getElementById("message");
        player.restore(link);
        player.step();
        await wait(100);
        const first = [message.hidden, message.textContent, player.report.steps];
        player.restore("#damaged");
        return [first, [message.hidden, message.textContent, player.report.steps], player.choices];
        """,
        tmp_path,
    )
    (hidden, text, steps), (second_hidden, second, more), valid = result
    assert not hidden
    assert all(word in text for word in words), text
    assert steps > 0
    assert not second_hidden
    assert "not complete" in second
    assert more >= steps
    assert valid["league"] in {league.id for league in LEAGUES}
    assert valid["skills"][1] in {0.5, 0.7}


def test_a_dropped_policy_plays_and_a_wrong_one_is_refused(tmp_path: Path) -> None:
    file = base64.b64encode((FOLDER / "VSSSelfPlay-v0.safetensors").read_bytes()).decode()
    result = shown(
        f"""
        const bytes = Uint8Array.from(atob({json.dumps(file)}), (letter) => letter.charCodeAt(0));
        const message = () => document.getElementById("message");
        player.addPolicy("mine", bytes);
        const values = [...document.getElementById("side-0").options].map(({{ value }}) => value);
        const refused = [message().textContent, player.choices.sides[0], values];
        const {{ match }} = player;
        player.choices.sides[1] = "file:none";
        const begun = player.attempt(() => player.begin());
        player.choices.sides[1] = "scripted";
        player.step();
        refused.push(begun, player.match === match);
        document.getElementById("league").value = "vss";
        document.getElementById("league").dispatchEvent(new Event("change"));
        player.addPolicy("mine", bytes);
        for (let step = 0; step < 100; step++) player.step();
        const replay = await player.replayFile();
        const side = player.choices.sides[0], hidden = message().hidden;
        document.getElementById("league").value = "ssl_3";
        document.getElementById("league").dispatchEvent(new Event("change"));
        player.chooseSide(1, "idle");
        const base64 = btoa(String.fromCharCode(...await player.replayFile()));
        return {{ refused, side, hidden, size: replay.length, base64 }};
        """,
        tmp_path,
    )
    assert "VSSSelfPlay-v0" in result["refused"][0]
    assert result["refused"][1:] == ["scripted", ["scripted", "best", "idle"], False, True]
    assert result["side"] == "file:mine"
    assert result["hidden"]
    assert result["size"] > 1000
    (tmp_path / "match.rsr").write_bytes(base64.b64decode(result["base64"]))
    controllers = Replay.load(tmp_path / "match.rsr").controllers
    assert controllers == {
        **{f"blue_{robot}": "scripted:1" for robot in range(3)},
        **{f"yellow_{robot}": "zero" for robot in range(3)},
    }
    task = rsoccer.make_task("SSLMatch-v0")
    assert [make_policy(name, task) for name in controllers.values() if name]

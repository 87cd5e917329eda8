"""The page of a replay in a real browser: it draws, plays and scrubs without an error."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from rsoccer import make_task
from rsoccer.frame import Frame
from rsoccer.lineup import lineup
from rsoccer.replay import Replay, record_replay
from rsoccer.replay.page import to_frame, to_html
from tests.replay.browser import show
from tests.replay.conftest import sensed_vss, ssl, vss


@cache
def eleven() -> Replay:
    """SSL robots, eleven a side."""
    task = make_task("SSLSelfPlay-v0", field="ssl_a", n_blue=11, n_yellow=11)
    return record_replay(task, lineup(task, "zero", "ou"), seconds=1.0)


LOOK = """
  const pixels = () => {
    const {width, height} = player.view.canvas;
    const data = player.view.context.getImageData(0, 0, width, height).data;
    const near = (i, color) => color.every((c, k) => Math.abs(data[i + k] - c) < 12);
    const count = (color) => {
      let sum = 0;
      for (let i = 0; i < data.length; i += 4) sum += near(i, color);
      return sum;
    };
    return [[47, 111, 228], [242, 194, 48], [255, 112, 32]].map(count);  // teams and ball
  };
"""


@pytest.mark.parametrize("recorded", [vss, eleven], ids=["VSSS", "SSL 11 v 11"])
def test_the_page_draws_and_plays(recorded: Callable[[], Replay], tmp_path: Path) -> None:
    replay = recorded()
    script = f"""{LOOK}
      const started = player.playing;
      player.seek(0);
      player.setSpeed(0.1);  // at most a frame per picture, so the end is far away
      const before = player.drawn;
      while (player.time === 0 || player.drawn < before + 5) await wait(10);
      const time = player.time;
      player.pause();
      player.draw();
      const colors = pixels();
      return {{started, time, colors, robots: player.robots,
        message: document.getElementById("message").hidden}};
    """
    shown = show(to_html(replay), script, tmp_path)
    assert shown.console == []
    found = shown.result
    assert found["started"]
    assert found["message"]
    assert 0 < found["time"] < len(replay) - 1
    assert found["robots"] == list(replay.robots)
    assert all(count > 20 for count in found["colors"])


@pytest.mark.parametrize("recorded", [vss, ssl], ids=["VSSS", "SSL"])
def test_the_page_reads_what_python_reads(recorded: Callable[[], Replay], tmp_path: Path) -> None:
    replay = Replay.from_bytes(recorded().to_bytes(snapshots=False))
    frames = list(range(0, len(replay), 37))
    script = f"""
      const {{replay, scene}} = player;
      const all = (count, read) => Array.from({{length: count}}, (_, i) => read(i));
      return {frames}.map((f) => ({{
        ball: ["x", "y", "z"].map((name) => replay.ball(name, f)),
        robots: all(replay.robotCount, (i) => ["x", "y"].map((name) => replay.robot(i, name, f))),
        headings: all(replay.robotCount, (i) => replay.robot(i, "heading", f)),
        commands: all(replay.robotCount, (i) =>
          replay.commandColumns.map((_, column) => replay.command(i, column, f))),
        rewards: replay.header.observers.map((_, i) => replay.termNames.reduce(
          (sum, name) => sum + replay.term(name, i, f), 0)),
        clock: replay.clock(f, scene.timeStep), score: replay.score(f),
      }}));
    """
    shown = show(to_html(replay), script, tmp_path)
    assert shown.console == []
    frame = Frame(replay.rows, replay.config.n_blue, replay.config.n_yellow)
    for index, found in zip(frames, shown.result, strict=True):
        position, height = frame.ball.position[index], frame.ball.height[index]
        assert found["ball"] == pytest.approx([*position, height], abs=1e-6)
        np.testing.assert_allclose(found["robots"], frame.robots.position[index], atol=1e-6)
        angles = np.array(found["headings"])
        heading = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        np.testing.assert_allclose(heading, frame.robots.heading[index], atol=1e-5)
        np.testing.assert_allclose(found["commands"], replay.commands[index], atol=1e-5)
        np.testing.assert_allclose(found["rewards"], replay.rewards[index], atol=1e-5)
        assert found["clock"] == pytest.approx(replay.clock[index])
        assert [found["score"]["blue"], found["score"]["yellow"]] == replay.score[index].tolist()


def test_keys_move_through_time(tmp_path: Path) -> None:
    script = """
      const seen = [];
      const after = (name, more) => { key(name, more); seen.push(player.time); };
      player.pause();
      player.seek(10);
      after("ArrowRight"); after("ArrowLeft"); after("ArrowRight", {shiftKey: true});
      after("End"); after("ArrowRight"); after("Home"); after("ArrowLeft");
      after("n"); after("p");
      key("+"); key("+"); const fast = player.speed;
      for (let i = 0; i < 9; i++) key("-");
      const slow = player.speed;
      key(" "); const playing = player.playing; key(" ");
      const zooms = [1, 2, 3].map(() => { key("z"); return player.view.camera.zoom; });
      key("t");
      const {trails} = player.view;
      return {seen, fast, slow, playing, paused: !player.playing, zooms, trails};
    """
    shown = show(to_html(vss()), script, tmp_path)
    assert shown.console == []
    last, goal = len(vss()) - 1, next(e.frame for e in vss().events if e.kind == "goal")
    assert shown.result == {
        "seen": [11, 10, 50, last, last, 0, 0, goal, 0],
        "fast": 4,
        "slow": 0.1,
        "playing": True,
        "paused": True,
        "zooms": [2, 4, 1],
        "trails": False,
    }


def test_ghosts_are_drawn_where_the_robots_believe_the_bodies(tmp_path: Path) -> None:
    replay = Replay.from_bytes(sensed_vss().to_bytes(snapshots=False))
    assert replay.sensed is not None
    off = np.linalg.norm(replay.sensed.robots - replay.frame.robots.position, axis=-1)
    frame, robot = np.unravel_index(off.argmax(), off.shape)
    script = f"""
      const [frame, robot] = [{frame}, {robot}];
      const picture = () => {{
        player.draw();
        return player.view.canvas.toDataURL();
      }};
      player.pause();
      player.seek(frame);
      const sensed = player.view.draw(frame).sensed;
      const shown = picture();
      key("s");
      const hidden = picture();
      const pressed = document.getElementById("sensed").getAttribute("aria-pressed");
      document.getElementById("sensed").click();
      const again = picture();
      return {{
        ball: [sensed.ball.x, sensed.ball.y],
        robots: sensed.robots.map((body) => [body.x, body.y]),
        headings: sensed.robots.map((body) => body.heading),
        differ: shown !== hidden, same: shown === again, pressed,
        number: player.numbersOf(robot, frame).find(([name]) => name === "sensed")[1],
        visible: !document.getElementById("sensed").hidden,
        about: document.getElementById("about").textContent,
      }};
    """
    shown = show(to_html(replay), script, tmp_path)
    assert shown.console == []
    found = shown.result
    assert found["ball"] == pytest.approx(replay.sensed.ball[frame].tolist(), abs=1e-6)
    np.testing.assert_allclose(found["robots"], replay.sensed.robots[frame], atol=1e-6)
    angles = np.array(found["headings"])
    headings = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    np.testing.assert_allclose(headings, replay.sensed.headings[frame], atol=1e-5)
    assert (found["differ"], found["same"], found["pressed"]) == (True, True, "false")
    assert found["number"] == f"{1000 * off.max():.0f} mm off"
    assert found["visible"]
    assert "sensing vsss" in found["about"]
    assert "robot.mass 0.8 to 1.2" in found["about"]


def test_a_page_without_senses_has_no_switch_for_them(tmp_path: Path) -> None:
    script = """
      const hidden = ["sensed", "sensed-key"].map((id) => document.getElementById(id).hidden);
      return {hidden, sensed: player.view.draw(3).sensed,
        names: player.numbersOf(0, 3).map(([name]) => name)};
    """
    shown = show(to_html(vss()), script, tmp_path)
    assert shown.console == []
    assert (shown.result["hidden"], shown.result["sensed"]) == ([True, True], None)
    assert "sensed" not in shown.result["names"]


def test_space_presses_a_button_that_was_reached_by_tab_and_not_one_that_was_clicked(
    tmp_path: Path,
) -> None:
    script = """
      player.pause();
      const button = document.getElementById("zoom");
      const space = () => document.activeElement.dispatchEvent(
        new KeyboardEvent("keydown", {key: " ", bubbles: true, cancelable: true}));
      button.focus();
      const left = space();  // true: the browser goes on to press the button
      const playing = player.playing;
      button.dispatchEvent(new MouseEvent("click", {bubbles: true, detail: 1}));
      const focus = document.activeElement.tagName;
      const taken = !space();
      return {left, playing, focus, taken, plays: player.playing};
    """
    shown = show(to_html(vss()), script, tmp_path)
    assert shown.console == []
    assert shown.result == {
        "left": True,
        "playing": False,
        "focus": "BODY",
        "taken": True,
        "plays": True,
    }


def test_a_finger_on_the_field_scrolls_a_narrow_page(tmp_path: Path) -> None:
    script = """
      player.pause();
      return ["field", "timeline", "chart"].map(
        (id) => getComputedStyle(document.getElementById(id)).touchAction);
    """
    assert show(to_html(vss()), script, tmp_path).result == ["auto", "pan-y", "auto"]


def test_a_canceled_touch_of_the_timeline_goes_on_playing(tmp_path: Path) -> None:
    script = """
      const canvas = document.getElementById("timeline");
      canvas.setPointerCapture = () => {};
      player.play();
      pointer("timeline", "pointerdown", 0.2, 0.5);
      const held = !player.playing;
      pointer("timeline", "pointercancel", 0.2, 0.5);
      return [held, player.playing];
    """
    assert show(to_html(vss()), script, tmp_path).result == [True, True]


def test_no_zero_has_a_sign(tmp_path: Path) -> None:
    script = """
      player.pause();
      const numbers = [];
      let negative = 0;
      for (let frame = 0; frame < player.replay.frames; frame++) {
        for (let robot = 0; robot < player.robots.length; robot++) {
          const texts = player.numbersOf(robot, frame).map(([, text]) => text);
          negative += texts.filter((text) => /^-/.test(text)).length;
          numbers.push(...texts.filter((text) => /^-0(\\.0*)?( |$)/.test(text)));
        }
      }
      return {numbers, negative: negative > 0};
    """
    shown = show(to_html(eleven()), script, tmp_path)
    assert shown.result == {"numbers": [], "negative": True}


def test_the_pointer_scrubs_and_shows_a_robot(tmp_path: Path) -> None:
    script = """
      player.pause();
      const canvas = document.getElementById("timeline");
      canvas.setPointerCapture = () => {};
      canvas.hasPointerCapture = () => true;
      pointer("timeline", "pointerdown", 0.5, 0.5);
      const middle = player.time;
      pointer("timeline", "pointermove", 2, 0.5);
      const end = player.time;
      pointer("timeline", "pointerup", 1, 0.5);
      player.seek(30);
      player.draw();
      const robot = player.replay;
      const [x, y] = player.view.camera.toScreen(robot.robot(4, "x", 30), robot.robot(4, "y", 30));
      const {width, height} = player.view.canvas;
      pointer("field", "pointermove", x / width, y / height);
      player.draw();
      const tip = document.getElementById("tip").textContent;
      pointer("field", "pointerdown", x / width, y / height);
      player.draw();
      const selected = document.getElementById("robot").value;
      pointer("field", "pointerleave", 0, 0);
      player.draw();
      document.querySelector("#events button").click();
      const jumped = player.time;
      return {middle, end, tip, selected, hidden: document.getElementById("tip").hidden, jumped};
    """
    shown = show(to_html(vss()), script, tmp_path)
    assert shown.console == []
    found, last = shown.result, len(vss()) - 1
    assert found["middle"] == pytest.approx(last / 2, abs=1)
    assert found["end"] == last
    assert found["tip"].startswith("yellow_1")
    for word in ("speed: ", "left: ", "reward: "):
        assert word in found["tip"]
    assert (found["selected"], found["hidden"]) == ("4", True)
    assert found["jumped"] == next(e.frame for e in vss().events if e.kind != "touch")


def test_a_goal_holds_the_picture_and_counts(tmp_path: Path) -> None:
    goal = next(event for event in vss().events if event.kind == "goal")
    script = f"""
      const text = (id) => document.getElementById(id).textContent;
      const GOAL = {goal.frame};
      player.seek(GOAL - 2);
      player.play();
      while (player.time < GOAL) await wait(10);
      player.draw();
      const at = {{time: player.time, caption: text("caption"), blue: text("goals-blue")}};
      while (player.time < GOAL + 1) await wait(10);
      player.draw();
      return {{at, after: player.time > GOAL, caption: text("caption"),
        sum: text("reward-sum")}};
    """
    shown = show(to_html(vss()), script, tmp_path)
    assert shown.console == []
    assert shown.result["at"] == {"time": goal.frame, "caption": "GOAL", "blue": "1"}
    assert shown.result["after"]
    assert shown.result["caption"] == ""


def test_light_and_dark(tmp_path: Path) -> None:
    script = """
      const color = () => getComputedStyle(document.body).backgroundColor;
      const first = color();
      key("d");
      const second = color();
      key("d");
      return [first, second, color()];
    """
    first, second, third = show(to_html(vss()), script, tmp_path).result
    assert first == third != second
    assert {first, second} == {"rgb(244, 246, 248)", "rgb(14, 17, 22)"}


@pytest.mark.parametrize("recorded", [vss, eleven], ids=["VSSS", "SSL 11 v 11"])
def test_a_narrow_screen_turns_the_field_upright(
    recorded: Callable[[], Replay], tmp_path: Path
) -> None:
    frame = to_frame(recorded()).replace('width="100%"', 'width="380"')
    script = """
      const inner = document.querySelector("iframe").contentWindow;
      const found = await inner.rsoccerPlayer;
      found.draw();
      const wide = inner.document.scrollingElement.scrollWidth;
      return {wide, inside: inner.innerWidth, upright: found.view.camera.upright,
        playing: found.playing};
    """
    loaded = "rsoccerPlayer = new Promise((done) => { onload = done })"
    page = f"<!doctype html><body><script>{loaded}</script>{frame}</body>"
    shown = show(page, script, tmp_path)
    assert shown.console == []
    assert shown.result == {"wide": 380, "inside": 380, "upright": True, "playing": False}


def test_a_damaged_replay_is_reported_on_the_page(tmp_path: Path) -> None:
    html = to_html(vss()).replace('id="replay">iVJT', 'id="replay">AAAA')
    script = 'return "played";'
    shown = show(html, script, tmp_path)
    assert shown.result == "Error: this is no replay file"

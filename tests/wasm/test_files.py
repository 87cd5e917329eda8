"""Replays and links that the page of the playground writes."""

import base64
import json
from pathlib import Path

import numpy as np

from rsoccer.replay import Replay
from tests.wasm.engine import numbers, run
from tools.playground.page import data

RECORD = """
const data = %s;
const match = engine.newMatch({field: "ssl_b", blue: 2, yellow: 2, seed: 5});
match.setScripted(0, 1);
match.setScripted(1, 0);
const live = new LiveRows(engine.names, 4, match.report());
live.begin(match.row("state"), null, match.report());
const recorder = new Recorder(engine.names, data.steps, 4);
const rows = [];
for (let step = 0; step < 400; step++) {
  if (step) match.step();
  live.add(match.row("state"), null, match.report());
  rows.push(base64(live.newest));
  const headings = live.headings[live.frames - 1];
  recorder.add(live.newest, headings, match.row("commands"), step === 200 ? ["blue"] : []);
}
const about = {
  package: data.version, physics: engine.exports.physics_version(), task: "SSLMatch-v0",
  controllers: { blue_0: "scripted" }, names: ["BLUE", "YELLOW"], config: match.configuration(),
  commandColumns: data.commandColumns.omni,
};
return { rows, file: base64(await recorder.file(about)) };
"""


def test_a_saved_replay_is_one_of_the_package(tmp_path: Path) -> None:
    shown = {name: data()[name] for name in ("steps", "version", "commandColumns")}
    recorded = run(RECORD % json.dumps(shown))
    path = tmp_path / "match.rsr"
    path.write_bytes(base64.b64decode(recorded["file"]))
    replay = Replay.load(path)
    rows = numbers(recorded["rows"])
    assert replay.task == "SSLMatch-v0"
    assert np.abs(replay.rows[:, :6] - rows[:, :6]).max() < 2e-3
    robots = replay.frame.robots
    assert np.abs(np.linalg.norm(robots.heading, axis=-1) - 1.0).max() < 1e-5
    assert np.abs(replay.commands).max() > 0.1
    assert [(event.kind, event.detail) for event in replay.events if event.kind == "goal"] == [
        ("goal", "blue")
    ]
    replay.save_html(tmp_path / "match.html")


def test_a_link_goes_on_from_the_same_situation() -> None:
    played = run(
        """
        const setup = {field: "ssl_b", blue: 3, yellow: 3, seed: 2};
        const first = engine.newMatch(setup);
        first.setScripted(0, 1);
        for (let step = 0; step < 300; step++) first.step();
        const link = situationText({ league: "ssl_b" }, first.situation());
        const { choices, numbers } = readSituation(link);
        const second = engine.newMatch(setup);
        second.resume(numbers);
        return {
          choices, length: link.length, wrong: readSituation("#a.b!"),
          rows: [first, second].map((match) => base64(match.situation())),
        };
        """
    )
    first, second = numbers(played["rows"])
    assert played["choices"] == {"league": "ssl_b"}
    assert played["wrong"] is None
    assert played["length"] < 4000
    assert np.abs(first - second)[:6].max() < 1e-6
    assert np.array_equal(first[-20:], second[-20:])


def test_wrong_input_is_refused_by_name() -> None:
    errors = run(
        """
        const errors = [];
        const tried = (action) => {
          try { action(); } catch (error) { errors.push(error.message); }
        };
        tried(() => engine.newMatch({field: "moon", blue: 1, yellow: 1}));
        tried(() => engine.newMatch({field: "ssl_b", blue: 0, yellow: 1}));
        const match = engine.newMatch({field: "vss_3v3", blue: 3, yellow: 3});
        tried(() => match.setScripted(0, 1));
        tried(() => match.setPolicy(0, new Uint8Array([1, 2, 3])));
        tried(() => match.change({sensing: {frame_loss: 2}}));
        tried(() => match.resume(new Float32Array(3)));
        tried(() => match.control(9, null));
        const row = match.row("state");
        const kept = [match.move(0, 50, 50), match.move(1, row[0] + 9, 0)];
        return { errors, kept, same: base64(row) === base64(match.row("state")) };
        """
    )
    wanted = ["moon", "blue", "league", "policy", "frame_loss", "situation", "robot"]
    assert len(errors["errors"]) == len(wanted)
    for error, word in zip(errors["errors"], wanted, strict=True):
        assert word in error
    assert errors["kept"] == [False, False]
    assert errors["same"]

"""Equal bits of the WebAssembly module and the native code, in Node."""

import json
from pathlib import Path

import numpy as np
import pytest

from rsoccer import Sensing
from rsoccer.policies.evolved import Evolved
from rsoccer.policies.trained import FOLDER
from tests.wasm.engine import numbers, run
from tools.playground.native import NativeMatch

GOLDEN = Path(__file__).parents[2] / "crates" / "rsim-core" / "tests" / "golden.txt"
SEED = 7
STEPS = 1200
SENSES = {
    "frame_rate": 60.0,
    "delay": 0.05,
    "ball_position_noise": 0.003,
    "tracker": 1.0,
    "command_delay": 0.03,
    "kick_speed_noise": 0.05,
}
PLAY = """
const match = engine.newMatch(%s);
const file = %s;
if (file) match.setPolicy(0, read(file));
else match.setScripted(0, 1);
match.setScripted(1, 0.6);
const kept = { rows: [], known: [], games: [], commands: [] };
for (let step = 0; step <= %d; step++) {
  if (step) match.step();
  kept.rows.push(base64(match.row("state")));
  kept.known.push(base64(match.row("blue")));
  kept.games.push(base64(match.row("game")));
  kept.commands.push(base64(match.row("commands")));
}
return kept;
"""


def test_golden_hashes_are_those_of_native_code() -> None:
    version, *hashes = GOLDEN.read_text().splitlines()
    got = run("return [engine.exports.physics_version(), ...engine.golden()];")
    assert version == f"PHYSICS_VERSION {got[0]}"
    assert sorted(got[1:]) == sorted(hashes)
    assert len(hashes) == 28


@pytest.mark.parametrize(
    ("field", "robots", "senses", "policy"),
    [
        ("ssl_b", 6, {}, None),
        ("ssl_b", 6, {}, "SSLMatch-v0.safetensors"),
        ("ssl_a", 11, {}, None),
        ("ssl_challenge", 3, SENSES, None),
    ],
)
def test_matches_have_the_bytes_of_native_matches(
    field: str, robots: int, senses: dict[str, float], policy: str | None
) -> None:
    """Native physics, referee and teams, driven from Python, give what the module gives."""
    setup = {"field": field, "blue": robots, "yellow": robots, "seed": SEED}
    setup["conditions"] = {"sensing": senses}
    path = None if policy is None else FOLDER / policy
    played = run(PLAY % (json.dumps(setup), json.dumps(path and str(path)), STEPS))
    rows, known = numbers(played["rows"]), numbers(played["known"])
    games, commands = numbers(played["games"]), numbers(played["commands"])

    sensing = Sensing("none", **senses) if senses else None
    tactics = None if path is None else Evolved.load(path).tactics
    native = NativeMatch(field, robots, (1.0, 0.6), SEED, sensing, tactics)
    for step in range(STEPS + 1):
        if step:
            native.step()
            assert native.commands.tobytes() == commands[step].tobytes(), f"commands of {step}"
        assert native.row.tobytes() == rows[step].tobytes(), f"row of step {step}"
        assert native.known.tobytes() == known[step].tobytes(), f"what blue knows in step {step}"
        assert native.game.tobytes() == games[step].tobytes(), f"referee of step {step}"
    moved = (np.abs(np.diff(rows[:, :2], axis=0)) > 1e-4).any(axis=1)  # along x or y
    # 22 robots keep the ball in play for half a minute.
    assert native.restarts >= 1 or field == "ssl_a"
    assert moved.mean() > 0.3
    assert (rows != known).any() == bool(senses)

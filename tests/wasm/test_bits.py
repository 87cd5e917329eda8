"""Equal bits of the WebAssembly module and the native code, in Node."""

import json
from pathlib import Path

import numpy as np
import pytest

from rsoccer import Sensing, _core
from rsoccer._core import Simulator
from rsoccer.arrays import Floats
from rsoccer.rules.referee_config import RefereeConfig
from tests.wasm.engine import numbers, run

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
match.setScripted(0, 1);
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


def split_mix(seed: int, nth: int) -> int:
    """The n-th word of a stream, as `crates/rsim-core/src/streams.rs` defines it."""
    mask = 2**64 - 1
    word = (seed + (nth + 1) * 0x9E3779B97F4A7C15) & mask
    word = ((word ^ (word >> 30)) * 0xBF58476D1CE4E5B9) & mask
    word = ((word ^ (word >> 27)) * 0x94D049BB133111EB) & mask
    return word ^ (word >> 31)


def test_golden_hashes_are_those_of_native_code() -> None:
    version, *hashes = GOLDEN.read_text().splitlines()
    got = run("return [engine.exports.physics_version(), ...engine.golden()];")
    assert version == f"PHYSICS_VERSION {got[0]}"
    assert sorted(got[1:]) == sorted(hashes)
    assert len(hashes) == 28


@pytest.mark.parametrize(
    ("field", "robots", "senses"),
    [("ssl_b", 6, {}), ("ssl_a", 11, {}), ("ssl_challenge", 3, SENSES)],
)
def test_matches_have_the_bytes_of_native_matches(
    field: str, robots: int, senses: dict[str, float]
) -> None:
    """Native physics, referee and teams, driven from Python, give what the module gives."""
    setup = {"field": field, "blue": robots, "yellow": robots, "seed": SEED}
    setup["conditions"] = {"sensing": senses}
    played = run(PLAY % (json.dumps(setup), STEPS))
    rows, known = numbers(played["rows"]), numbers(played["known"])
    games, commands = numbers(played["games"]), numbers(played["commands"])

    sensing = Sensing(**senses) if senses else None
    config = _core.SimConfig(field, robots, robots, sensing=sensing)
    simulator = Simulator(config)
    preset = "ssl_2026_a" if field == "ssl_a" else "ssl_2026_b"
    rules = RefereeConfig(preset, extra_half_seconds=0.0, shootout_kicks=0.0)
    referee = _core.Referee(config, rules.to_json())
    teams = [_core.ScriptedTeam(config, skill) for skill in (1.0, 0.6)]
    memories = [np.zeros((1, team.memory_size), np.float32) for team in teams]
    for nth, (team, memory) in enumerate(zip(teams, memories, strict=True)):
        team.begin(memory, [split_mix(SEED, 1 + nth) & 0xFFFFFFFF])

    worlds = np.ones(1, np.bool_)
    row, sensed = rows[:1].copy(), np.empty_like(rows[:1])
    simulator.place(worlds, rows[:1].copy(), row)
    simulator.begin_senses(worlds, np.array([split_mix(SEED, 5)], np.uint64))
    simulator.sense(sensed)
    matches = match_arrays(split_mix(SEED, 0) & 1, 2 * robots)
    referee.begin(row, matches)
    assert np.array_equal(row[0], rows[0])
    restart, restarts = np.empty_like(row), 0
    for step in range(1, STEPS + 1):
        acted = [
            team.commands(sensed, matches[0], memory, nth)
            for nth, (team, memory) in enumerate(zip(teams, memories, strict=True))
        ]
        given = np.concatenate(acted, axis=1)
        assert given.tobytes() == commands[step].tobytes(), f"commands of step {step}"
        before = row.copy()
        simulator.step(given, row)
        put, _ = referee.judge(before, row, matches, restart)
        if put is not None:
            simulator.restart(worlds, restart.copy(), row)
            referee.begin(row, matches)
            restarts += 1
        simulator.sense(sensed)
        assert row.tobytes() == rows[step].tobytes(), f"row of step {step}"
        assert sensed.tobytes() == known[step].tobytes(), f"what blue knows in step {step}"
        assert matches[0].tobytes() == games[step].tobytes(), f"referee of step {step}"
    moved = np.abs(np.diff(rows[:, 0])) > 1e-4
    assert restarts >= 1 or field == "ssl_a"  # 22 robots keep the ball in play for half a minute
    assert moved.mean() > 0.3
    assert (rows != known).any() == bool(senses)


def match_arrays(kickoff: int, robots: int) -> tuple[Floats, ...]:
    """State of a match that begins, as the referee takes it."""
    return (
        _core.Referee.new_game(kickoff)[None].copy(),
        np.zeros((1, len(_core.STATISTICS_COLUMNS)), np.float32),
        np.zeros((1, 2), np.int64),
        np.zeros(1, np.float32),
        np.zeros((1, robots), np.bool_),
    )

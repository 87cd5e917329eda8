"""Observations and networks of the WebAssembly module against Python's."""

import json
from pathlib import Path

import numpy as np
import pytest

import rsoccer
from rsoccer.history import ObservationStack
from rsoccer.matches import Matches
from rsoccer.policies.network import Network
from rsoccer.policies.trained import FOLDER, load_best_network
from rsoccer.train.network.initial_policy import widened_layers, widened_normalization
from tests.wasm.engine import numbers, run

STEPS = 700
"""17.5 s: a kick-off of SSL begins after 10 s where nobody takes his place."""
PLAY = """
const match = engine.newMatch(%s);
const file = read(%s);
for (const team of [0, 1]) match.setPolicy(team, file);
const robots = %d;
const kept = { rows: [match.row("state")].map(base64), decisions: [] };
for (let step = 0; step < %d; step++) {
  for (let robot = 0; robot < robots; robot++) kept.decisions.push(base64(match.decision(robot)));
  match.step();
  kept.rows.push(base64(match.row("state")));
}
return kept;
"""


def with_history(task: str, path: Path) -> Path:
    """The file of `best` with weights for observations and actions of the past."""
    made = rsoccer.make_task(task)
    best, stack = load_best_network(made), ObservationStack.of(made, 5)
    (weight, bias), *others = widened_layers(best, stack)
    weight += np.random.default_rng(0).normal(size=weight.shape).astype(np.float32) / 50
    mean, std = widened_normalization(best, stack)
    network = Network.from_layers(
        made,
        [(weight, bias), *others],
        best.action_std,
        history=5,
        action_repeat=best.action_repeat,
        mean=mean,
        std=std,
    )
    network.save(path)
    return path


@pytest.mark.parametrize(
    ("task", "field", "name"),
    [
        ("VSSSelfPlay-v0", "vss_3v3", "VSSSelfPlay-v0.safetensors"),
        ("VSSSelfPlay-v0", "vss_3v3", "history"),
        ("SSLSelfPlay-v0", "ssl_challenge", "SSLSelfPlay-v0.safetensors"),
    ],
)
def test_observations_are_equal_and_networks_within_1e_5(
    task: str, field: str, name: str, tmp_path: Path
) -> None:
    robots = 6
    setup = {"field": field, "blue": 3, "yellow": 3, "seed": 3}
    path = with_history(task, tmp_path / name) if name == "history" else FOLDER / name
    played = run(PLAY % (json.dumps(setup), json.dumps(str(path)), robots, STEPS))
    rows, decisions = numbers(played["rows"]), numbers(played["decisions"])
    network = Network.load(path)
    size = network.observation_size
    decisions = decisions.reshape(STEPS, robots, size + network.action_size)
    stacked, means = decisions[..., :size], decisions[..., size:]

    matches = Matches(task)
    matches.reset()
    layout = matches.task.layout
    plain = stacked[..., : layout.size]
    last = plain[..., layout.blocks["action"].columns]
    for step in range(STEPS):
        play = matches.play
        play.frame.rows[:], play.actions[:] = rows[step], last[step]
        play.expire_views()
        expected = layout.observe(play)
        assert np.array_equal(expected[0], plain[step]), f"observations of step {step}"
    stack = ObservationStack(network.history, layout.size, network.action_size)
    assert stack.size == size
    if network.history > 1:
        older = stacked[1:, :, layout.size : 2 * layout.size]
        assert np.array_equal(older, plain[:-1])
    expected_means = network.outputs(stacked)
    assert np.abs(expected_means - means).max() < 1e-5
    assert np.abs(np.diff(means, axis=0)).max() > 0.1
    assert np.abs(np.diff(rows[:, 0])).sum() > 0.2


def test_a_policy_of_another_match_is_refused_with_both_layouts() -> None:
    file = json.dumps(str(FOLDER / "VSSSelfPlay-v0.safetensors"))
    error = run(
        f"""
        const match = engine.newMatch({{field: "ssl_b", blue: 6, yellow: 6}});
        try {{ match.setPolicy(0, read({file})); }} catch (error) {{ return error.message; }}
        """
    )
    assert "VSSSelfPlay-v0" in error
    assert "teammates 2x7" in error
    assert "teammates 5x8" in error

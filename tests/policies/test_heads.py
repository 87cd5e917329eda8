from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer.policies.heads import Deviation, Head
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import FORMAT, HEAD_FORMAT
from rsoccer.registry import make_task
from rsoccer.rng import WorldRng
from tests.policies.networks import random_network, task_observations

TABLE = np.array([[0.0, 0.0], [1.0, -1.0], [-0.5, 0.5]], np.float32)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("exp -1 2", [np.exp(-1.0), 1.0, np.exp(2.0)]),
        ("tanh -5 2", [np.exp(-5 + 3.5 * (np.tanh(-3.0) + 1)), np.exp(-1.5), np.exp(2.0)]),
        ("softplus 0.5 0.01 0.2", [0.2, np.log1p(np.exp(0.5)) + 0.01, 40.51]),
    ],
)
def test_deviations_follow_their_formulas(text: str, expected: list[float]) -> None:
    deviation = Deviation.from_text(text)
    assert Deviation.from_text(deviation.text) == deviation
    outputs = np.array([-3.0, 0.0, 40.0], np.float32)
    np.testing.assert_allclose(deviation.of(outputs), expected, rtol=1e-5)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "expected one of"),
        ("log 1 2", "got 'log'"),
        ("exp 1", "expected 2 finite numbers after 'exp'"),
        ("exp 1 x", "expected numbers after the kind"),
        ("exp 2 1", "a low number below the high one"),
        ("softplus 0 -1 0", "at least 0"),
        ("tanh nan 1", "finite"),
    ],
)
def test_other_deviations_are_refused(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Deviation.from_text(text)


def test_deviations_of_numbers_of_numpy_have_a_text_that_can_be_read() -> None:
    deviation = Deviation("exp", (np.float64(-20.0), np.float64(2.0)))
    assert deviation.text == "exp -20 2"
    assert Deviation.from_text(deviation.text) == deviation
    numbers: Any = (np.int64(1), 0, np.float32(0.25))
    assert Deviation("softplus", numbers).text == "softplus 1 0 0.25"


def test_gaussians_are_clipped_and_squashed_ones_are_not() -> None:
    outputs = np.array([[[3.0, -0.5]]], np.float32)
    assert Head("gaussian", 2).mean_actions(outputs.copy()).tolist() == [[[1.0, -0.5]]]
    squashed = Head("squashed", 2).mean_actions(outputs.copy())
    np.testing.assert_allclose(squashed, np.tanh(outputs))
    head = Head("squashed", 4, deviation=Deviation("exp", (-20.0, 2.0)))
    assert (head.action_size, head.can_sample) == (2, True)


def test_draws_have_the_mean_and_the_deviation_of_the_outputs() -> None:
    n = 40_000
    outputs = np.tile(np.array([0.2, -0.4, np.log(0.1), np.log(0.3)], np.float32), (n, 1, 1))
    gaussian = Head("gaussian", 4, deviation=Deviation("exp", (-20.0, 2.0)))
    drawn = gaussian.drawn_actions(outputs.copy(), WorldRng.seeded(0, n))[:, 0]
    np.testing.assert_allclose(drawn.mean(axis=0), [0.2, -0.4], atol=0.01)
    np.testing.assert_allclose(drawn.std(axis=0), [0.1, 0.3], rtol=0.05)
    squashed = Head("squashed", 4, deviation=gaussian.deviation)
    moved = squashed.drawn_actions(outputs.copy(), WorldRng.seeded(0, n))[:, 0]
    inside = np.abs(drawn) < 1.0
    assert inside.mean() > 0.9
    np.testing.assert_allclose(moved[inside], np.tanh(drawn[inside]), atol=1e-6)


def test_choices_are_drawn_by_their_probabilities() -> None:
    n, probabilities = 40_000, np.array([0.2, 0.5, 0.3])
    logits = np.tile(np.log(probabilities).astype(np.float32) + 7.0, (n, 1, 1))
    head = Head("categorical", 3, table=TABLE)
    drawn = head.drawn_actions(logits, WorldRng.seeded(0, n))[:, 0]
    shares = [(drawn == row).all(axis=1).mean() for row in TABLE]
    np.testing.assert_allclose(shares, probabilities, atol=0.01)
    assert np.array_equal(head.mean_actions(logits[:1]), TABLE[None, None, 1])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"kind": "beta", "outputs": 2}, "head: expected one of"),
        ({"kind": "greedy", "outputs": 3}, "expected an array"),
        ({"kind": "gaussian", "outputs": 2, "table": TABLE}, "expected no array"),
        ({"kind": "categorical", "outputs": 2, "table": TABLE}, "a last layer of 3 outputs"),
        (
            {"kind": "gaussian", "outputs": 3, "deviation": Deviation("exp", (-1.0, 1.0))},
            "as many outputs for means as for deviations",
        ),
        (
            {"kind": "greedy", "outputs": 3, "table": TABLE, "action_std": np.ones(2, np.float32)},
            "expected none for the head 'greedy'",
        ),
    ],
)
def test_parts_that_do_not_belong_together_are_refused(
    arguments: dict[str, object], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        Head(**arguments)  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", ["gaussian", "squashed", "exp", "categorical", "greedy"])
def test_files_keep_the_head(kind: str, tmp_path: object) -> None:
    network = random_network(kind)
    network.save(f"{tmp_path}/a.safetensors")
    again = Network.load(f"{tmp_path}/a.safetensors")
    plain = kind == "gaussian"
    assert again.metadata["format"] == (FORMAT if plain else HEAD_FORMAT)
    observations = task_observations(network)
    for mode in ("mean", again.mode):
        network.mode = again.mode = mode
        actions = [
            each.choose(observations, WorldRng.seeded(3, len(observations)))
            for each in (network, again)
        ]
        assert np.array_equal(actions[0], actions[1])
        assert actions[0].any()
        assert actions[0].shape == (*observations.shape[:-1], 2)
    with pytest.raises(ValueError, match="format"):
        Network(network.arrays(), {**network.metadata, "format": "rsoccer-policy-1"})


def test_greedy_choices_have_no_noise() -> None:
    network = random_network("greedy")
    assert network.mode == "mean"
    with pytest.raises(ValueError, match="expected 'mean'"):
        Network(network.arrays(), network.metadata, "sample")


def test_choices_play_in_their_task() -> None:
    task = make_task("VSS-v0", discrete=True)
    result = rsoccer.evaluate(random_network("categorical"), "zero", task=task, matches=2)
    assert (result.matches, result.metric) == (2, "goal_score")

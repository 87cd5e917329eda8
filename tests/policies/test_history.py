"""Networks with a history: they keep the past themselves, and play as learners that see it."""

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches
from rsoccer.arrays import Floats
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import read_file
from rsoccer.rng import WorldRng
from tests.helpers import same
from tests.policies.networks import network_input

TASK, WORLDS, LIMIT, HISTORY = "VSSMulti-v0", 4, 8, 3


def network(
    history: int = HISTORY,
    action_repeat: int = 1,
    action_std: list[float] | None = None,
    **given: Any,  # noqa: ANN401
) -> Network:
    """A network with random weights, whose actions depend on all that it reads."""
    task, rng = rsoccer.make_task(TASK), np.random.default_rng(5)
    o, a = task.layout.size, task.action_size
    sizes = [history * o + (history - 1) * a, 8, a]
    layers = [(rng.normal(size=(y, x)) / np.sqrt(x), np.zeros(y)) for x, y in pairwise(sizes)]
    given = {"action_repeat": action_repeat, "history": history, **given}
    return Network.from_layers(task, layers, action_std, **given)


def test_the_file_holds_the_history(tmp_path: Path) -> None:
    path = tmp_path / "policy.safetensors"
    network().save(path)
    loaded = Network.load(path)
    assert loaded.history == HISTORY
    assert read_file(path)[1]["history"] == str(HISTORY)
    assert loaded.observation_size == Matches(TASK, history=HISTORY).observation_size
    network(1).save(path)
    assert Network.load(path).history == 1
    assert "history" not in read_file(path)[1]


@pytest.mark.parametrize("autoreset", ["same_step", "next_step"])
@pytest.mark.parametrize("action_repeat", [1, 2])
def test_it_plays_as_a_learner_with_the_history(action_repeat: int, autoreset: str) -> None:
    policy = network(action_repeat=action_repeat)
    options: dict[str, Any] = {"max_steps": LIMIT, "autoreset": autoreset}
    played = Matches(TASK, WORLDS, 3, controllers={"blue": policy}, **options)
    learned = Matches(TASK, WORLDS, 3, history=HISTORY, **options)
    played.reset()
    observations, ends = learned.reset(), 0
    age = np.zeros(WORLDS, np.int64)
    actions = np.zeros((WORLDS, 3, 2), np.float32)
    for _ in range(3 * LIMIT):
        due = age % action_repeat == 0
        actions[due] = policy.mean_actions(observations[due])
        waits = learned.done
        outcome = learned.step(actions)
        played.step(np.zeros((WORLDS, 0, 2), np.float32))
        assert same(played.frame.rows, learned.frame.rows)
        assert same(played.play.actions[~waits], learned.play.actions[~waits])
        observations = outcome.observations
        begins = waits if autoreset == "next_step" else outcome.ended
        age = np.where(begins, 0, age + 1)
        ends += int(outcome.ended.sum())
    assert ends >= 2 * WORLDS
    assert np.abs(actions).max() < 1.0, "clipped actions hide differences"
    assert np.ptp(actions) > 0.05


def test_the_past_decides() -> None:
    """The plain observation alone does not give the actions."""
    policy, rng = network(), WorldRng.seeded(0, 1)
    o = policy.stack.observation_size if policy.stack else 0
    observations = np.random.default_rng(0).normal(size=(3, 1, 1, o)).astype(np.float32)
    last = []
    for first in observations[:2]:
        memory = policy.new_memory((1, 1, 2), rng)
        policy.act(network_input(first), rng, memory)
        last.append(policy.act(network_input(observations[2]), rng, memory))
    assert np.abs(last[0] - last[1]).max() > 0.01


def test_past_actions_are_those_that_were_drawn() -> None:
    policy, rng = network(action_std=[0.5, 0.5], action_repeat=2), WorldRng.seeded(0, 3)
    stack = policy.stack
    assert stack is not None
    memory = policy.new_memory((3, 2, 2), rng)
    observations = np.zeros((3, 2, stack.observation_size), np.float32)
    drawn = [policy.act(network_input(observations + i), rng, memory) for i in range(4)]
    assert same(drawn[0], drawn[1]) and same(drawn[2], drawn[3])
    assert same(memory["past_actions"], np.stack(drawn[:1:-1], axis=2))
    assert memory["past_observations"][..., 0].tolist() == [[[3.0, 2.0]] * 2] * 3


def test_saved_matches_continue_with_its_past() -> None:
    controllers = {"blue": network(), "yellow": network(2, action_repeat=3)}
    ours, resumed = (Matches(TASK, 2, seed, controllers=controllers) for seed in (3, 9))
    nothing: Floats = np.zeros((2, 0, 2), np.float32)
    for matches in (ours, resumed):
        matches.reset()
    for _ in range(5):
        ours.step(nothing)
    resumed.load_state_dict(ours.state_dict())
    for _ in range(5):
        ours.step(nothing)
        resumed.step(nothing)
        assert same(ours.frame.rows, resumed.frame.rows)


def test_it_is_evaluated_and_rated_without_further_arguments(tmp_path: Path) -> None:
    path = tmp_path / "policy.safetensors"
    network(task_options={"max_steps": 10}).save(path)
    assert rsoccer.evaluate(path, matches=4, seed=1, threads=1).matches == 4


def test_another_history_does_not_fit_the_weights() -> None:
    for history, message in (
        (2, "has observation_size 244, but task 'VSSMulti-v0' with a history of 2 has 162"),
        (1, "has observation_size 244, but task 'VSSMulti-v0' has 80"),
    ):
        arrays, metadata = network().arrays(), network().metadata
        layers = [(arrays[f"layers.{i}.weight"], arrays[f"layers.{i}.bias"]) for i in range(2)]
        with pytest.raises(ValueError, match=message):
            Network.from_layers(TASK, layers, history=history)
        assert metadata["history"] == str(HISTORY)


@pytest.mark.parametrize(
    ("history", "message"),
    [
        ("0", "'history' should be a finite number above 0, got '0'"),
        ("1.5", r"'history' should be a whole number, got 1\.5"),
        ("three", "'history' should be a finite number above 0, got 'three'"),
        ("4", "'history' should fit the layers, which take 244 numbers: .* a history of 4 have"),
        ("200", "'history' should fit the layers, which take 244 numbers"),
    ],
)
def test_a_file_with_a_wrong_history_is_refused(history: str, message: str) -> None:
    made = network()
    with pytest.raises(ValueError, match=message):
        Network(made.arrays(), {**made.metadata, "history": history})


def test_weights_with_a_wrong_history_are_refused() -> None:
    for history, error in ((0, ValueError), (1.5, TypeError)):
        layers = [(np.zeros((2, 244)), np.zeros(2))]
        with pytest.raises(error, match=r"^history: expected"):
            Network.from_layers(TASK, layers, history=history)  # type: ignore[arg-type]


def test_a_layout_that_differs_is_refused_with_a_history_too() -> None:
    made = network()
    other = Network(made.arrays(), {**made.metadata, "layout": "ego 80"})
    with pytest.raises(ValueError, match="observes ego 80, but"):
        Matches(TASK, controllers={"blue": other})

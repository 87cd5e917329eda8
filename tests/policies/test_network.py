import pickle
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import torch
from torch import nn

import rsoccer
from rsoccer.arrays import Floats
from rsoccer.play import Play
from rsoccer.policies.base import PolicyInput
from rsoccer.policies.network import SINGLE_THREAD_SIZE, Network
from rsoccer.registry import make_task, names
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.tasks.vss_single import VssSingle
from tests.policies.networks import (
    ACTION,
    Arrays,
    network_for,
    network_input,
    network_parts,
    random_observations,
)


def reference_action(arrays: Arrays, observation: np.ndarray, clip: float = 10.0) -> np.ndarray:
    """The formula of the file format, for one robot, in double precision."""
    hidden = (observation.astype(float) - arrays["mean"]) / arrays["std"]
    hidden = np.minimum(np.maximum(hidden, -clip), clip)
    for index in range(3):
        hidden = arrays[f"layers.{index}.weight"] @ hidden + arrays[f"layers.{index}.bias"]
        hidden = np.tanh(hidden) if index < 2 else hidden
    return np.minimum(np.maximum(hidden, -1.0), 1.0)


def test_actions_follow_the_formula() -> None:
    arrays, metadata = network_parts()
    observations = random_observations()
    rng = WorldRng.seeded(0, len(observations))
    actions = Network(arrays, metadata).act(network_input(observations), rng, {})
    expected = np.array(
        [[reference_action(arrays, robot) for robot in world] for world in observations]
    )
    assert actions.shape == (4, 3, ACTION)
    assert actions.dtype == np.float32
    np.testing.assert_allclose(actions, expected, atol=1e-5)
    assert (np.abs(expected) < 1.0).any(), "all actions at a bound: the formula was not compared"
    assert (np.abs(expected) == 1.0).any(), "no action at a bound: the clip was not compared"


def test_large_observations_are_clipped() -> None:
    arrays, metadata = network_parts(clip="2")
    large = random_observations() * np.float32(1000.0)
    network = Network(arrays, metadata)
    expected = np.array(
        [[reference_action(arrays, robot, clip=2.0) for robot in world] for world in large]
    )
    assert network.mean_actions(large) == pytest.approx(expected, abs=1e-5)
    other_clip = Network(*network_parts())
    assert not np.allclose(network.mean_actions(large), other_clip.mean_actions(large))


def test_batches_agree_with_single_worlds() -> None:
    network, observations = Network(*network_parts()), random_observations(n=33)
    single = np.concatenate([network.mean_actions(world[None]) for world in observations])
    np.testing.assert_allclose(network.mean_actions(observations), single, atol=1e-5)


@pytest.mark.parametrize("hidden", [8, 224, 500])
def test_no_product_is_large_enough_for_further_threads(
    hidden: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """They spin: on a busy machine matches of a wide network took minutes in place of seconds."""
    task = make_task("VSS-v0")
    sizes = (task.layout.size, hidden, hidden, task.action_size)
    shapes = zip(sizes[1:], sizes[:-1], strict=True)
    layers = [(np.zeros(shape, np.float32), np.ones(shape[0], np.float32)) for shape in shapes]
    network, rows = Network.from_layers(task, layers), list[int]()
    forward = network._forward

    def noting(layers: Any, observations: Floats) -> Floats:  # noqa: ANN401
        rows.append(len(observations))
        return forward(layers, observations)

    monkeypatch.setattr(network, "_forward", noting)
    actions = network.mean_actions(np.zeros((50, 3, task.layout.size), np.float32))
    assert (actions == 1.0).all()
    assert sum(rows) == 150
    widest = max(weight.size for weight, _ in layers)
    assert max(rows) * widest <= SINGLE_THREAD_SIZE


def test_a_decision_is_held_for_the_repeat() -> None:
    network = Network(*network_parts(action_repeat="3"))
    rng = WorldRng.seeded(0, 4)
    memory = network.new_memory((4, 3, ACTION), rng)
    memory["age"][0] = 1  # this world began two steps later than a decision
    steps = [random_observations(seed=seed) for seed in range(6)]
    acted = np.array([network.act(network_input(each), rng, memory) for each in steps])
    decided = np.array([network.mean_actions(each) for each in steps])
    assert np.array_equal(acted[0, 1:], acted[2, 1:])
    np.testing.assert_allclose(acted[0:3, 1:], decided[[0, 0, 0], 1:], atol=1e-5)
    np.testing.assert_allclose(acted[3:6, 1:], decided[[3, 3, 3], 1:], atol=1e-5)
    np.testing.assert_allclose(acted[2:5, 0], decided[[2, 2, 2], 0], atol=1e-5)
    assert not np.allclose(decided[0], decided[3]), "the decisions do not differ"


def test_a_network_pickles() -> None:
    network, observations = Network(*network_parts()), random_observations()
    copy = pickle.loads(pickle.dumps(network))
    assert np.array_equal(copy.mean_actions(observations), network.mean_actions(observations))


def test_a_network_owns_its_arrays() -> None:
    arrays, metadata = network_parts()
    network, observations = Network(arrays, metadata), random_observations()
    before = network.mean_actions(observations)
    for array in [*arrays.values(), *network.arrays().values()]:
        array[:] = 0.0
    assert np.array_equal(network.mean_actions(observations), before)


def test_missing_or_wrong_observations_are_refused() -> None:
    network = Network(*network_parts())
    rng = WorldRng.seeded(0, 4)
    with pytest.raises(ValueError, match="needs observations"):
        network.act(PolicyInput((4, 3, ACTION), None, None), rng, {})
    with pytest.raises(ValueError, match="of 5 numbers, got 6"):
        network.mean_actions(np.zeros((4, 3, 6), np.float32))


def test_weights_of_another_program_become_a_policy() -> None:
    task, rng = make_task("VSS-v0"), np.random.default_rng(0)
    sizes = [task.layout.size, 8, task.action_size]
    layers = [(rng.normal(size=(b, a)), rng.normal(size=b)) for a, b in pairwise(sizes)]
    network = Network.from_layers(task, layers, [0.5, 0.5], action_repeat=3)
    layers[0][0][:] = 0.0  # a copy is kept
    observations = rng.uniform(-1, 1, (4, task.layout.size)).astype(np.float32)
    hidden = np.tanh(observations @ network.layers[0][0].T + network.layers[0][1])
    expected = np.clip(hidden @ layers[1][0].T + layers[1][1], -1, 1)
    np.testing.assert_allclose(network.mean_actions(observations), expected, atol=1e-5)
    assert (network.mode, network.action_repeat, network.task_name) == ("sample", 3, "VSS-v0")
    assert Network.from_layers(task, layers).mode == "mean"
    network.check_fits(task, task.layout.size)


@dataclass(frozen=True)
class Backward(VssSingle):
    """A task whose robots drive backward; it is not registered."""

    way: object = None

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        return super().get_commands(play, -actions)


def zero_layers(task: Task) -> list[tuple[Floats, Floats]]:
    size = (task.action_size, task.layout.size)
    return [(np.zeros(size, np.float32), np.zeros(size[0], np.float32))]


def test_a_policy_names_no_other_task_than_its_own() -> None:
    """It once named the registered parent, and was then evaluated with the parent's dynamics."""
    task = Backward()
    expected = (
        r"task: expected a registered task, as a policy file keeps its name and options, got "
        r"Backward; register it first with rsoccer\.register\('Backward-v0', Backward\)"
    )
    given: tuple[dict[str, object] | None, ...] = (None, {})
    for options in given:
        with pytest.raises(ValueError, match=expected):
            Network.from_layers(task, zero_layers(task), task_options=options)
    network = Network.from_layers(task, zero_layers(task), task_name="Backward-v0")
    assert (network.task_name, network.task_options) == ("Backward-v0", {})


def test_options_that_no_file_can_keep_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """They were once left out with all others, as if the task had its defaults."""
    monkeypatch.setattr(names, "_TASKS", dict(names._TASKS))
    monkeypatch.setattr(Backward, "name", "Backward")  # `register` changes it
    rsoccer.register("Backward-v0", Backward)
    task = Backward(max_steps=7, way=object())
    with pytest.raises(ValueError, match=r"task: expected options that a policy file can keep"):
        Network.from_layers(task, zero_layers(task))
    kept = Network.from_layers(task, zero_layers(task), task_options={"max_steps": 7})
    assert (kept.task_name, kept.task_options) == ("Backward-v0", {"max_steps": 7})


def test_modules_of_torch_become_a_policy() -> None:
    task = make_task("VSS-v0")
    modules = nn.Sequential(
        nn.Linear(task.layout.size, 8), nn.Tanh(), nn.Linear(8, task.action_size)
    )
    network = Network.from_layers(task, modules)
    observations = torch.rand(4, task.layout.size)
    expected = modules(observations).clamp(-1, 1).detach()
    np.testing.assert_allclose(network.mean_actions(observations.numpy()), expected, atol=1e-5)


@pytest.mark.parametrize(
    "modules",
    [
        [nn.Linear(3, 2), nn.GELU(), nn.Linear(2, 2)],
        [nn.Linear(3, 2), nn.ELU(alpha=0.5), nn.Linear(2, 2)],
        [nn.Linear(3, 2), nn.LayerNorm(2), nn.Tanh(), nn.Linear(2, 2)],
        [nn.Linear(3, 2), nn.Tanh(), nn.Linear(2, 2), nn.Tanh()],
        [nn.Linear(3, 2), nn.Linear(2, 2)],
        [nn.Linear(3, 2, bias=False)],
    ],
)
def test_other_modules_are_refused(modules: list[nn.Module]) -> None:
    message = "Linear with bias and one of Tanh, ReLU, .* in turn, got Linear"
    with pytest.raises(ValueError, match=message):
        Network.from_layers(make_task("VSS-v0"), modules)


def test_weights_that_do_not_fit_are_refused() -> None:
    task = make_task("VSS-v0")
    with pytest.raises(ValueError, match="layers: expected one or more, got none"):
        Network.from_layers(task, [])
    with pytest.raises(ValueError, match="has observation_size 3"):
        Network.from_layers(task, [(np.ones((2, 3)), np.ones(2))])
    with pytest.raises(ValueError, match="action_std"):
        Network.from_layers(task, [(np.ones((2, task.layout.size)), np.ones(2))], [0.1])


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"randomization": {"x": 1}}, ValueError, "randomization: expected one of .*, got 'x'"),
        ({"randomization": 3}, TypeError, "randomization: expected distributions by name, got 3"),
        ({"clip": True}, TypeError, "clip: expected a number, got True"),
        ({"clip": 0.0}, ValueError, "clip: expected a positive number, got 0.0"),
        ({"action_repeat": True}, TypeError, "action_repeat: expected a whole number, got True"),
        (
            {"mean": [1.0, 2.0]},
            ValueError,
            r"mean: expected a number or shape \(\d+,\), got \(2,\)",
        ),
        ({"std": np.ones((1, 3))}, ValueError, r"std: expected a number or shape .*got \(1, 3\)"),
        ({"mean": "x"}, TypeError, "mean: expected numbers, got 'x'"),
    ],
)
def test_other_arguments_that_do_not_fit_are_refused(
    arguments: dict[str, Any], error: type[Exception], message: str
) -> None:
    task = make_task("VSS-v0")
    layers = [(np.ones((2, task.layout.size)), np.ones(2))]
    with pytest.raises(error, match=f"^{message}"):
        Network.from_layers(task, layers, **arguments)


@pytest.mark.parametrize("module", [nn.Tanh, nn.ReLU, nn.LeakyReLU, nn.ELU, nn.SiLU])
def test_activations_are_those_of_torch(module: type[nn.Module]) -> None:
    task = make_task("VSS-v0")
    modules = nn.Sequential(
        nn.Sequential(nn.Linear(task.layout.size, 64), module(), nn.Linear(64, 64), module()),
        nn.Linear(64, task.action_size),
    )
    network = Network.from_layers(task, modules)
    observations = torch.rand(32, task.layout.size) * 8 - 4
    expected = modules(observations).clamp(-1, 1).detach()
    np.testing.assert_allclose(network.mean_actions(observations.numpy()), expected, atol=2e-6)
    with pytest.raises(ValueError, match="activation: expected"):
        Network.from_layers(task, modules, activation="gelu")


def test_two_kinds_of_activations_are_refused() -> None:
    modules = [nn.Linear(3, 2), nn.Tanh(), nn.Linear(2, 2), nn.ReLU(), nn.Linear(2, 2)]
    with pytest.raises(ValueError, match="expected one kind of activation, got relu, tanh"):
        Network.from_layers(make_task("VSS-v0"), modules)


def test_options_that_a_task_no_longer_has_refuse_no_network() -> None:
    task = make_task("VSS-v0")
    network = network_for(task)
    network.metadata["task_options"] = '{"option_of_yesterday": 1}'
    network.check_fits(task, task.layout.size)
    with pytest.raises(ValueError, match=r"it plays 'VSS-v0' with .*option_of_yesterday=1"):
        network.check_fits(make_task("VSS-v0", n_blue=5, n_yellow=5), 100)

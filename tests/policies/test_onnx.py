"""ONNX files: written from networks, and played."""

import copy
import json
import pickle
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import onnx
import onnxruntime
import pytest
from onnx import TensorProto, helper, numpy_helper

import rsoccer
from rsoccer import policies
from rsoccer.policies.labels import labels
from rsoccer.policies.network import Network
from rsoccer.policies.onnx_export import OPSET, onnx_bytes
from rsoccer.policies.onnx_policy import OnnxPolicy
from rsoccer.registry import make_task
from rsoccer.rng import WorldRng
from tests.policies.networks import random_network, task_observations

KINDS = ["gaussian", "squashed", "exp", "tanh", "softplus", "categorical", "greedy"]


def foreign_model(
    size: int, actions: Sequence[float], *, rows: int | str = "n", name: str = "out"
) -> bytes:
    """A model that adds the mean of an observation to constant actions."""
    given = np.array(actions)
    dtype = TensorProto.INT64 if given.dtype.kind == "i" else TensorProto.FLOAT
    constant = given if dtype == TensorProto.INT64 else given.astype(np.float32)
    nodes = [helper.make_node("ReduceMean", ["obs"], ["mean"], axes=[1], keepdims=1)]
    if dtype == TensorProto.INT64:
        nodes += [
            helper.make_node("Cast", ["mean"], ["whole"], to=TensorProto.INT64),
            helper.make_node("Sub", ["whole", "whole"], ["zero"]),
            helper.make_node("Add", ["zero", "actions"], [name]),
        ]
    else:
        nodes += [helper.make_node("Add", ["mean", "actions"], [name])]
    graph = helper.make_graph(
        nodes,
        "other",
        [helper.make_tensor_value_info("obs", TensorProto.FLOAT, [rows, size])],
        [helper.make_tensor_value_info(name, dtype, [rows, len(actions)])],
        [numpy_helper.from_array(constant, "actions")],
    )
    opset = helper.make_opsetid("", OPSET)
    content: bytes = helper.make_model(
        graph, opset_imports=[opset], ir_version=8
    ).SerializeToString()
    return content


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("activation", ["tanh", "relu", "leaky_relu", "elu", "silu"])
def test_the_file_computes_what_the_network_does(kind: str, activation: str) -> None:
    network = random_network(kind, activation)
    observations = task_observations(network, 50).reshape(-1, network.observation_size) * 3
    session = onnxruntime.InferenceSession(onnx_bytes(network))
    names = [output.name for output in session.get_outputs()]
    found = dict(zip(names, session.run(None, {"observation": observations}), strict=True))
    expected = network.mean_actions(observations)
    np.testing.assert_allclose(found["action"], expected, rtol=0, atol=1e-6)
    assert expected.std() > 0.05, "all actions are nearly equal"
    if kind == "categorical":
        np.testing.assert_allclose(found["logits"], network.outputs(observations), atol=3e-6)
    elif kind != "greedy":
        std = network.action_std
        if network.head.deviation is not None:
            std = network.head.deviation.of(network.outputs(observations)[:, 2:])
        assert std is not None
        np.testing.assert_allclose(found["std"], np.broadcast_to(std, expected.shape), rtol=1e-5)


@pytest.mark.parametrize("task", ["VSS-v0", "SSLGoToBall-v0"])
def test_shipped_policies_are_equal_as_onnx_files(task: str) -> None:
    network = policies.make_policy("best", task)
    assert isinstance(network, Network)
    policy = OnnxPolicy(onnx_bytes(network))
    observations = task_observations(network, 100)
    expected = network.mean_actions(observations)
    np.testing.assert_allclose(policy.mean_actions(observations), expected, rtol=0, atol=1e-6)
    assert (np.abs(expected) < 1).any()


def test_the_file_is_documented_and_reproducible() -> None:
    content = onnx_bytes(random_network())
    assert content == onnx_bytes(random_network())
    model = onnx.load_from_string(content)
    assert [(x.domain, x.version) for x in model.opset_import] == [("", OPSET)]
    assert [x.name for x in model.graph.input] == ["observation"]
    assert [x.name for x in model.graph.output] == ["action", "mean", "std"]
    metadata = {entry.key: entry.value for entry in model.metadata_props}
    assert (metadata["task"], metadata["action_repeat"]) == ("VSS-v0", "2")


@pytest.mark.parametrize("kind", KINDS)
def test_exported_policies_draw_as_the_network_does(kind: str, tmp_path: Path) -> None:
    network = random_network(kind, history=2)
    path = tmp_path / "a.onnx"
    network.save_onnx(path)
    policy = OnnxPolicy.load(path)
    kept = (policy.mode, policy.history, policy.action_repeat, policy.task_name)
    assert kept == (network.mode, 2, 2, "VSS-v0")
    observations = task_observations(network)
    actions = [p.choose(observations, WorldRng.seeded(3, 6)) for p in (network, policy)]
    np.testing.assert_allclose(actions[0], actions[1], rtol=0, atol=3e-6)
    assert (policy.mode == "mean") is (kind == "greedy")


def test_a_file_plays_wherever_a_policy_is_named(tmp_path: Path) -> None:
    network = policies.make_policy("best", "VSS-v0")
    assert isinstance(network, Network)
    network.save_onnx(tmp_path / "mine.onnx")
    network.save(tmp_path / "mine.safetensors")
    onnx_file, plain = f"{tmp_path}/mine.onnx:mean", f"{tmp_path}/mine.safetensors:mean"
    results = [rsoccer.evaluate(name, "zero", matches=4) for name in (onnx_file, plain)]
    assert min(result.score for result in results) > 0  # last bits differ, and matches with them
    assert [result.task for result in results] == ["VSS-v0", "VSS-v0"]
    env = rsoccer.parallel_env("VSS-v0", controllers={"yellow": onnx_file})
    env.reset(seed=0)
    env.step({agent: np.zeros(2, np.float32) for agent in env.agents})
    assert labels([onnx_file, plain])[0] == onnx_file


def test_copies_act_as_the_original() -> None:
    network = random_network()
    policy = OnnxPolicy(onnx_bytes(network))
    observations = task_observations(network)
    for other in (copy.deepcopy(policy), pickle.loads(pickle.dumps(policy))):
        assert np.array_equal(other.mean_actions(observations), policy.mean_actions(observations))


@pytest.mark.parametrize("rows", ["n", 1])
def test_models_of_other_programs_play(rows: int | str, tmp_path: Path) -> None:
    task = make_task("VSS-v0")
    (tmp_path / "a.onnx").write_bytes(foreign_model(task.layout.size, [0.5, -3.0], rows=rows))
    policy = policies.make_policy(tmp_path / "a.onnx", task)
    observations = np.zeros((4, 3, task.layout.size), np.float32)
    observations[1, 2] = 0.25
    actions = policy.choose(observations, WorldRng.seeded(0, 4))  # type: ignore[attr-defined]
    expected = np.tile(np.array([0.5, -1.0], np.float32), (4, 3, 1))
    expected[1, 2, 0] = 0.75
    np.testing.assert_allclose(actions, expected)
    assert policies.trained_on(tmp_path / "a.onnx") is None
    assert rsoccer.evaluate(tmp_path / "a.onnx", task=task, matches=2).matches == 2


def test_whole_numbers_choose_rows_of_a_discrete_task(tmp_path: Path) -> None:
    discrete, continuous = make_task("VSS-v0", discrete=True), make_task("VSS-v0")
    path = tmp_path / "a.onnx"
    path.write_bytes(foreign_model(discrete.layout.size, [3]))
    policy = policies.make_policy(path, discrete)
    observations = np.zeros((2, 1, discrete.layout.size), np.float32)
    actions = policy.choose(observations, WorldRng.seeded(0, 2))  # type: ignore[attr-defined]
    assert discrete.action_table is not None
    assert np.array_equal(actions, np.tile(discrete.action_table[3], (2, 1, 1)))
    with pytest.raises(ValueError, match="expected a discrete task, got 'VSS-v0'"):
        policies.make_policy(path, continuous)
    path.write_bytes(foreign_model(discrete.layout.size, [99]))
    with pytest.raises(ValueError, match="expected rows from 0 to"):
        policies.make_policy(path, discrete).choose(  # type: ignore[attr-defined]
            observations, WorldRng.seeded(0, 2)
        )


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"nothing", "a.onnx is not a usable policy: onnxruntime cannot load it"),
        (foreign_model(3, [0.0, 0.0]), "the ONNX model has observation_size 3, but task 'VSS-v0'"),
        (foreign_model(80, [0.0] * 3), "the ONNX model has action_size 3, but task 'VSS-v0'"),
        (foreign_model(80, [0.0, 0.0], rows=4), "with n of any size or 1, got obs"),
        (foreign_model(80, [1, 2]), "expected actions .* got int64"),
    ],
)
def test_other_models_are_refused(content: bytes, message: str, tmp_path: Path) -> None:
    (tmp_path / "a.onnx").write_bytes(content)
    with pytest.raises(ValueError, match=message):
        policies.make_policy(tmp_path / "a.onnx", "VSS-v0")


def test_errors_name_the_cause(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"none\.onnx does not exist"):
        policies.make_policy(tmp_path / "none.onnx", "VSS-v0")
    network = random_network()
    with pytest.raises(ValueError, match=r"a name ending in \.onnx"):
        network.save_onnx(tmp_path / "a.safetensors")
    network.save_onnx(tmp_path / "a.onnx")
    with pytest.raises(ValueError, match="trained on 'VSS-v0' has observation_size"):
        policies.make_policy(tmp_path / "a.onnx", "SSLGoToBall-v0")
    (tmp_path / "b.onnx").write_bytes(foreign_model(80, [0.0, np.nan]))
    policy = policies.make_policy(f"{tmp_path}/b.onnx:mean", "VSS-v0")
    with pytest.raises(ValueError, match="NaN or infinite"):
        policy.mean_actions(np.zeros((1, 80), np.float32))  # type: ignore[attr-defined]
    with pytest.raises(ValueError, match="has no distribution"):
        policies.make_policy(f"{tmp_path}/b.onnx:sample", "VSS-v0")
    assert json.loads(network.metadata.get("task_options", "{}")) == {}

"""Trained policies as ONNX files, which other programs run without this package.

The graph is float32, of opset 17, with a batch of any size n. Normalization and head are part of
it:

| name | shape | content |
| --- | --- | --- |
| input `observation` | (n, o) | observations of the task, stacked with a history |
| output `action` | (n, a) | the action of mode "mean", in [-1, 1] |
| output `mean` | (n, a) | mean before the clip or the tanh; only with a standard deviation |
| output `std` | (n, a) | standard deviation of the actions; only with one |
| output `logits` | (n, c) | logits of the choices; only with the head `categorical` |

Mode "sample" is `clip(mean + std N(0, 1), -1, 1)`, and `tanh(mean + std N(0, 1))` for the head
`squashed`. The metadata of the file are those of the policy file, and `action_table`, JSON, for
heads that choose a row. The program that plays holds each action for `action_repeat` control steps.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from rsoccer.files import write_atomically
from rsoccer.policies.policy_file import ONNX_SUFFIX

if TYPE_CHECKING:
    from rsoccer.arrays import Array
    from rsoccer.policies.heads import Deviation
    from rsoccer.policies.perceptron import Perceptron

OPSET: Final = 17
"""Version of ONNX's operators. Runtimes of 2022 and later know it."""
IR_VERSION: Final = 8
"""Version of the file format that belongs to the opset."""
INPUT: Final = "observation"
"""Name of the input."""
ACTION: Final = "action"
"""Name of the output with the actions of mode "mean"."""

_OPERATORS: Final = {
    "tanh": "Tanh",
    "relu": "Relu",
    "leaky_relu": "LeakyRelu",
    "elu": "Elu",
}


def onnx_bytes(network: Perceptron) -> bytes:
    """Return a network as an ONNX file; equal networks give equal bytes.

    Args:
        network: the network.

    Raises:
        ImportError: onnx is not installed.
    """
    graph = _Graph()
    outputs = _layers(graph, network)
    shapes = _head(graph, network, outputs)
    return graph.file(network, shapes)


def write_onnx(network: Perceptron, path: Path) -> None:
    """Write a network as an ONNX file, atomically.

    Args:
        network: the network.
        path: the file, `*.onnx`; an existing one is replaced.

    Raises:
        ImportError: onnx is not installed.
        ValueError: another name of a file.
    """
    if path.suffix != ONNX_SUFFIX:
        raise ValueError(f"path: expected a name ending in {ONNX_SUFFIX}, got {str(path)!r}")
    write_atomically(path, onnx_bytes(network))


class _Graph:
    """Nodes and constants of a graph, while it is made."""

    def __init__(self) -> None:
        try:
            import onnx
        except ImportError as error:
            raise ImportError(
                "writing ONNX files needs onnx: pip install 'rsoccer[onnx]'", name="onnx"
            ) from error
        self._onnx = onnx
        self._nodes: list[Any] = []
        self._constants: list[Any] = []

    def constant(self, name: str, values: Any) -> str:  # noqa: ANN401  (numbers of any kind)
        """Add numbers, float32 unless they are an integer array; return their name."""
        array: Array = np.asarray(values)
        if array.dtype != np.int64:
            array = array.astype(np.float32)
        self._constants.append(self._onnx.numpy_helper.from_array(array, name))
        return name

    def node(self, operator: str, inputs: list[str], output: str, **attributes: object) -> str:
        """Add an operation; return the name of its output."""
        self._nodes.append(
            self._onnx.helper.make_node(operator, inputs, [output], name=output, **attributes)
        )
        return output

    def file(self, network: Perceptron, shapes: Mapping[str, int]) -> bytes:
        """The bytes of the file with outputs of some sizes by name."""
        helper = self._onnx.helper

        def described(name: str, size: int) -> Any:  # noqa: ANN401
            return helper.make_tensor_value_info(name, self._onnx.TensorProto.FLOAT, ["n", size])

        graph = helper.make_graph(
            self._nodes,
            "policy",
            [described(INPUT, network.observation_size)],
            [described(name, size) for name, size in shapes.items()],
            self._constants,
        )
        model = helper.make_model(
            graph,
            opset_imports=[helper.make_opsetid("", OPSET)],
            ir_version=IR_VERSION,
            producer_name="rsoccer",
        )
        metadata = dict(network.metadata)
        if network.head.table is not None:
            metadata["action_table"] = json.dumps(network.head.table.tolist())
        helper.set_model_props(model, dict(sorted(metadata.items())))
        self._onnx.checker.check_model(model, full_check=True)
        content: bytes = model.SerializeToString(deterministic=True)
        return content


def _layers(graph: _Graph, network: Perceptron) -> str:
    """Add the normalization and the layers; return the name of the last layer's outputs."""
    centered = graph.node("Sub", [INPUT, graph.constant("offset", network.mean)], "centered")
    scaled = graph.node("Div", [centered, graph.constant("scale", network.std)], "scaled")
    bounds = [graph.constant("low", -network.clip), graph.constant("high", network.clip)]
    hidden = graph.node("Clip", [scaled, *bounds], "normalized")
    last = len(network.layers) - 1
    for index, (weight, bias) in enumerate(network.layers):
        names = [graph.constant(f"weight_{index}", weight), graph.constant(f"bias_{index}", bias)]
        outputs = "outputs" if index == last else f"layer_{index}"
        hidden = graph.node("Gemm", [hidden, *names], outputs, transB=1)
        if index < last:
            hidden = _activation(graph, network.activation, hidden, f"hidden_{index}")
    return hidden


def _activation(graph: _Graph, name: str, values: str, output: str) -> str:
    """Add an activation."""
    if name == "silu":
        return graph.node(
            "Mul", [values, graph.node("Sigmoid", [values], f"{output}_gate")], output
        )
    return graph.node(_OPERATORS[name], [values], output)


def _head(graph: _Graph, network: Perceptron, outputs: str) -> dict[str, int]:
    """Add the head; return the sizes of the graph's outputs by name."""
    head, size = network.head, network.action_size
    if head.table is not None:
        row = graph.node("ArgMax", [outputs], "row", axis=-1, keepdims=0)
        graph.node("Gather", [graph.constant("action_table", head.table), row], ACTION)
        if head.can_sample:
            graph.node("Identity", [outputs], "logits")
            return {ACTION: size, "logits": len(head.table)}
        return {ACTION: size}
    mean = "mean"
    if head.deviation is None:
        graph.node("Identity", [outputs], mean)
    else:
        _slice(graph, outputs, 0, size, mean)
        raw = _slice(graph, outputs, size, 2 * size, "raw")
        _deviation(graph, head.deviation, raw)
    if head.kind == "squashed":
        graph.node("Tanh", [mean], ACTION)
    else:
        bounds = [graph.constant("least", -1.0), graph.constant("most", 1.0)]
        graph.node("Clip", [mean, *bounds], ACTION)
    if head.action_std is not None:  # one row for each observation
        shape = graph.node("Shape", [mean], "shape")
        graph.node("Expand", [graph.constant("action_std", head.action_std), shape], "std")
    return {ACTION: size, mean: size, "std": size} if head.can_sample else {ACTION: size}


def _slice(graph: _Graph, values: str, first: int, end: int, output: str) -> str:
    """Add a selection of columns."""
    numbers = {"first": first, "end": end, "axis": 1}
    names = [
        graph.constant(f"{output}_{name}", np.array([number], np.int64))
        for name, number in numbers.items()
    ]
    return graph.node("Slice", [values, *names], output)


def _deviation(graph: _Graph, deviation: Deviation, raw: str) -> None:
    """Add the standard deviation as `Deviation.of` has it."""
    if deviation.kind == "softplus":
        shift, offset, least = deviation.numbers
        moved = graph.node("Add", [raw, graph.constant("shift", shift)], "shifted")
        soft = graph.node("Softplus", [moved], "soft")
        offset_soft = graph.node(
            "Add", [soft, graph.constant("soft_offset", offset)], "offset_soft"
        )
        graph.node("Max", [offset_soft, graph.constant("least_std", least)], "std")
        return
    low, high = deviation.numbers
    if deviation.kind == "exp":
        bounds = [graph.constant("low_log_std", low), graph.constant("high_log_std", high)]
        log_std = graph.node("Clip", [raw, *bounds], "log_std")
    else:
        curve = graph.node("Tanh", [raw], "curve")
        half = 0.5 * (high - low)
        scaled = graph.node("Mul", [curve, graph.constant("half_range", half)], "scaled_curve")
        log_std = graph.node("Add", [scaled, graph.constant("middle", low + half)], "log_std")
    graph.node("Exp", [log_std], "std")

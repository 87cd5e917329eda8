"""Perceptron with tanh layers, whose outputs and gradients are written out for speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import torch
from torch import Tensor, nn


class Perceptron(nn.Sequential):
    """Linear layers with tanh between them.

    Autograd works as for any module. Where gradients are off, outputs are those of a
    `PerceptronPass`.
    """

    def forward(self, inputs: Tensor) -> Tensor:
        """Return the outputs of the last layer, (..., outputs).

        Args:
            inputs: (..., inputs) of the first layer.
        """
        if torch.is_grad_enabled():
            outputs: Tensor = super().forward(inputs)  # type: ignore[no-untyped-call]
            return outputs
        outputs = PerceptronPass(self).outputs(inputs.reshape(-1, inputs.shape[-1]))
        return outputs.reshape(*inputs.shape[:-1], -1)

    def linear(self) -> list[nn.Linear]:
        """Return the layers without the tanh between them."""
        return [layer for layer in self if isinstance(layer, nn.Linear)]


class PassMemory:
    """Memory of passes that follow each other on one thread, in which each overwrites the last one.

    The less memory passes use, the more of it stays in a processor's cache.
    """

    def __init__(self) -> None:
        """Begin without memory; the largest pass sets its size."""
        self._parts: dict[str, Tensor] = {}
        self._last: dict[str, Tensor] = {}

    def matrix(self, name: str, rows: int, columns: int, like: Tensor) -> Tensor:
        """Return a part of the memory, (rows, columns), with arbitrary numbers.

        Args:
            name: name of the part.
            rows: number of rows.
            columns: number of columns.
            like: a tensor with the type and the device of the numbers.
        """
        last, kind = self._last.get(name), (like.dtype, like.device)
        if last is not None and last.shape == (rows, columns) and (last.dtype, last.device) == kind:
            return last  # as in most passes
        size, part = rows * columns, self._parts.get(name)
        if part is None or part.numel() < size or (part.dtype, part.device) != kind:
            part = self._parts[name] = like.new_empty(size)
        last = self._last[name] = part[:size].view(rows, columns)
        return last


class PerceptronPass:
    """Passes of rows through a perceptron and back, in memory that is used again.

    Without autograd the layers are a few operations: on a CPU, small networks learn almost twice
    as fast. With memory that stays, no pass asks the system for new pages; products of oneDNN have
    memory of their own.
    """

    def __init__(self, network: Perceptron, memory: PassMemory | None = None) -> None:
        """Begin without activations.

        Args:
            network: the perceptron; passes use its current parameters.
            memory: memory of this pass and of others that it does not overlap; None for its own.
        """
        self._layers = network.linear()
        self._memory = PassMemory() if memory is None else memory
        self._activations: list[Tensor] = []
        self._by_onednn = False

    @torch.no_grad()
    def outputs(self, inputs: Tensor) -> Tensor:
        """Return the outputs of the last layer, (n, outputs), valid until the memory's next pass.

        Args:
            inputs: (n, inputs) of the first layer.
        """
        self._activations, self._by_onednn = [inputs], uses_onednn(inputs)
        for index in range(len(self._layers)):
            self._activations.append(self._layer_outputs(index, self._activations[-1]))
        return self._activations[-1]

    @torch.no_grad()
    def gradients(self, gradient: Tensor, out: Sequence[Tensor]) -> None:
        """Write the gradients of the parameters for the rows of the last `outputs`.

        It may be called once after `outputs`, and before any other pass in the same memory: it
        overwrites the hidden units.

        Args:
            gradient: (n, outputs) gradient of the outputs of the last layer.
            out: a tensor for each parameter, in the order of `parameters`.
        """
        for index in reversed(range(len(self._layers))):
            self._write_weight_gradient(index, gradient, out[2 * index])
            torch.sum(gradient, 0, out=out[2 * index + 1])
            if index:
                gradient = self._gradient_below(index, gradient)
        self._activations = []

    def _layer_outputs(self, index: int, inputs: Tensor) -> Tensor:
        """Return the outputs of a layer, with tanh but for the last one."""
        layer, is_last = self._layers[index], index == len(self._layers) - 1
        if self._by_onednn:
            return _by_onednn(inputs, layer.weight, layer.bias, "none" if is_last else "tanh")
        out = self._memory.matrix(f"layer {index}", len(inputs), len(layer.bias), layer.bias)
        if is_last:
            torch.addmm(layer.bias, inputs, layer.weight.T, out=out)
        else:
            _tanh_layer(layer.bias, inputs, layer.weight.T, out)
        return out

    def _write_weight_gradient(self, index: int, gradient: Tensor, out: Tensor) -> None:
        """Write the gradient of a layer's weights from that of its outputs before the tanh."""
        inputs = self._activations[index]
        if self._by_onednn:
            out.copy_(_by_onednn(gradient.T, inputs.T))
        elif index:
            torch.mm(gradient.T, inputs, out=out)
        else:
            # Transposed: MKL takes twice as long for a product with a number of columns that is not
            # a multiple of 8, as that of most observations.
            shape = inputs.shape[1], gradient.shape[1]
            by_weight = self._memory.matrix("weight", *shape, gradient)
            torch.mm(inputs.T, gradient, out=by_weight)
            out.copy_(by_weight.T)

    def _gradient_below(self, index: int, gradient: Tensor) -> Tensor:
        """Return the gradient of the outputs of the layer below, before their tanh."""
        hidden, weight = self._activations[index], self._layers[index].weight
        if self._by_onednn:
            by_hidden = _by_onednn(gradient, weight.T)
        else:
            rows, units = hidden.shape
            by_hidden = self._memory.matrix("gradient", rows, units, hidden)
            torch.mm(gradient, weight, out=by_hidden)
        # Hidden units are of no more use: their memory gets the gradient of the layer below.
        torch.ops.aten.tanh_backward.grad_input(by_hidden, hidden, grad_input=hidden)
        return hidden


def uses_onednn(numbers: Tensor) -> bool:
    """Return whether products with these rows are computed by oneDNN.

    MKL, which torch takes for them otherwise, does without AVX-512 on processors of AMD: there
    oneDNN multiplies 4,096 rows by a matrix of 128 columns 2.3 times as fast. Its calls take 10 us
    longer, as much as 100 rows. On processors of Intel MKL has AVX-512, too: there oneDNN saves at
    most the passes of the tanh, which was not measured.

    Args:
        numbers: (n, columns) rows of a factor.
    """
    is_single = numbers.dtype == torch.float32 and numbers.device.type == "cpu"
    return _ONEDNN_IS_FASTER and is_single and len(numbers) >= MIN_ONEDNN_ROWS


def _by_onednn(
    rows: Tensor, weight: Tensor, bias: Tensor | None = None, kind: str = "none"
) -> Tensor:
    """Return rows weight^T + bias, or its tanh, by oneDNN."""
    # torch has no public function for it in single precision; torch.compile has this operator.
    product: Tensor = torch.ops.mkldnn._linear_pointwise(rows, weight, bias, kind, [], "")
    return product


MIN_ONEDNN_ROWS: Final = 128
"""Least number of rows of products by oneDNN."""

_ONEDNN_IS_FASTER: Final[bool] = (
    torch.backends.mkldnn.is_available()  # type: ignore[no-untyped-call]
    and torch.backends.cpu.get_cpu_capability() == "AVX512"
    and hasattr(torch.ops.mkldnn, "_linear_pointwise")
)


def _tanh_layer(bias: Tensor, inputs: Tensor, weight: Tensor, out: Tensor) -> None:
    """Write tanh(inputs weight + bias)."""
    if out.device.type != "cpu":
        torch.addmm(bias, inputs, weight, out=out)
        torch.tanh(out, out=out)
        return
    # tanh(x) = 2 sigmoid(2 x) - 1: on a CPU the sigmoid takes a third of the time of torch's tanh,
    # and less than half of NumPy's.
    torch.addmm(bias, inputs, weight, beta=2.0, alpha=2.0, out=out)
    torch.sigmoid(out, out=out)
    torch.add(_MINUS_ONE[out.dtype], out, alpha=2.0, out=out)


_MINUS_ONE = {kind: torch.tensor(-1.0, dtype=kind) for kind in (torch.float32, torch.float64)}

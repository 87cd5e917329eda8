"""Perceptron with tanh layers, whose outputs and gradients are written out for speed."""

from __future__ import annotations

from collections.abc import Sequence

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


class PerceptronPass:
    """Passes of rows through a perceptron and back, in memory that is used again.

    Without autograd the layers are a few operations: on a CPU, small networks learn almost twice
    as fast. With buffers that stay, no pass asks the system for new pages.
    """

    def __init__(self, network: Perceptron) -> None:
        """Begin without buffers; the first rows make them.

        Args:
            network: the perceptron; passes use its current parameters.
        """
        self._layers = network.linear()
        self._outputs: list[Tensor] = []
        self._input_gradients: list[Tensor] = []
        self._activations: list[Tensor] = []
        self._capacity = 0

    @torch.no_grad()
    def outputs(self, inputs: Tensor) -> Tensor:
        """Return the outputs of the last layer, (n, outputs), valid until the next rows.

        Args:
            inputs: (n, inputs) of the first layer.
        """
        n, last = len(inputs), self._layers[-1]
        if n > self._capacity or not self._outputs:
            self._outputs = _buffers(n, [layer.bias for layer in self._layers])
            self._input_gradients, self._capacity = [], n
        self._activations = [inputs]
        for layer, buffer in zip(self._layers, self._outputs, strict=True):
            hidden, weight, out = self._activations[-1], layer.weight.T, buffer[:n]
            if layer is last:
                torch.addmm(layer.bias, hidden, weight, out=out)
            else:
                _tanh_layer(layer.bias, hidden, weight, out)
            self._activations.append(out)
        return self._activations[-1]

    @torch.no_grad()
    def gradients(self, gradient: Tensor, out: Sequence[Tensor]) -> None:
        """Write the gradients of the parameters for the rows of the last `outputs`.

        Args:
            gradient: (n, outputs) gradient of the outputs of the last layer.
            out: a tensor for each parameter, in the order of `parameters`.
        """
        if not self._input_gradients:
            biases = [layer.bias for layer in self._layers[:-1]]
            self._input_gradients = _buffers(self._capacity, biases)
        for index in reversed(range(len(self._layers))):
            hidden = self._activations[index]
            torch.mm(gradient.T, hidden, out=out[2 * index])
            torch.sum(gradient, 0, out=out[2 * index + 1])
            if index > 0:
                by_hidden = self._input_gradients[index - 1][: len(gradient)]
                torch.mm(gradient, self._layers[index].weight, out=by_hidden)
                torch.ops.aten.tanh_backward.grad_input(by_hidden, hidden, grad_input=by_hidden)
                gradient = by_hidden


def _buffers(rows: int, biases: Sequence[Tensor]) -> list[Tensor]:
    """Tensors (rows, units) without values for the layers with some biases."""
    return [bias.new_empty((rows, len(bias))) for bias in biases]


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

"""Perceptron: outputs and gradients equal those of autograd."""

import copy
import itertools

import numpy as np
import pytest
import torch
from torch import nn

from rsoccer.train.network.perceptron import Perceptron, PerceptronPass, uses_onednn


def new_perceptron(*sizes: int, dtype: torch.dtype = torch.float64) -> Perceptron:
    generator = torch.Generator().manual_seed(len(sizes))
    layers: list[nn.Module] = []
    for inputs, outputs in itertools.pairwise(sizes):
        layers += [nn.Linear(inputs, outputs, dtype=dtype), nn.Tanh()]
    network = Perceptron(*layers[:-1])
    for parameter in network.parameters():
        parameter.data = torch.randn(parameter.shape, generator=generator, dtype=dtype)
    return network


@pytest.mark.parametrize("sizes", [(5, 2), (5, 7, 1), (5, 7, 6, 2), (5, 8, 8, 8, 3)])
def test_gradients_equal_those_of_autograd(sizes: tuple[int, ...]) -> None:
    network = new_perceptron(*sizes)
    inputs = torch.linspace(-2, 2, 55, dtype=torch.float64).reshape(11, 5)
    outputs = network(inputs)
    weights = torch.linspace(1, 3, outputs.numel(), dtype=torch.float64).reshape(outputs.shape)
    expected = torch.autograd.grad((outputs * weights).sum(), list(network.parameters()))
    ours = PerceptronPass(network)
    gradients = [torch.full_like(part, torch.nan) for part in expected]
    for rows in (slice(3), slice(11), slice(11)):  # buffers grow, and are used again
        torch.testing.assert_close(ours.outputs(inputs[rows]), outputs[rows].detach())
    ours.gradients(weights, gradients)
    for gradient, wanted in zip(gradients, expected, strict=True):
        torch.testing.assert_close(gradient, wanted)


@pytest.mark.parametrize("sizes", [(5, 2), (5, 7, 1), (51, 64, 96, 2)])
def test_gradients_in_single_precision_are_those_of_double(
    sizes: tuple[int, ...], onednn: bool
) -> None:
    network = new_perceptron(*sizes, dtype=torch.float32)
    for parameter in network.parameters():
        parameter.data *= 0.3
    generator = torch.Generator().manual_seed(0)
    inputs = torch.randn(300, sizes[0], generator=generator)
    weights = torch.randn(300, sizes[-1], generator=generator)
    exact = copy.deepcopy(network).double()
    outputs = exact(inputs.double())
    expected = torch.autograd.grad((outputs * weights).sum(), list(exact.parameters()))
    ours = PerceptronPass(network)
    gradients = [torch.full_like(part, torch.nan) for part in network.parameters()]
    assert uses_onednn(inputs) == onednn
    found = ours.outputs(inputs).clone()
    torch.testing.assert_close(found.double(), outputs.detach(), rtol=1e-5, atol=1e-5)
    ours.gradients(weights.clone(), gradients)
    for gradient, wanted in zip(gradients, expected, strict=True):
        torch.testing.assert_close(gradient.double(), wanted, rtol=1e-4, atol=2e-4)


@pytest.mark.usefixtures("onednn")
def test_no_rows_have_no_outputs_and_gradients_of_zero() -> None:
    network = new_perceptron(5, 7, 2, dtype=torch.float32)
    ours = PerceptronPass(network)
    gradients = [torch.full_like(part, torch.nan) for part in network.parameters()]
    assert ours.outputs(torch.empty(0, 5)).shape == (0, 2)
    ours.gradients(torch.empty(0, 2), gradients)
    assert not any(gradient.any() for gradient in gradients)


def test_outputs_are_equal_with_and_without_autograd() -> None:
    network = new_perceptron(5, 7, 6, 2)
    inputs = torch.linspace(-2, 2, 60, dtype=torch.float64).reshape(3, 4, 5)
    expected = network(inputs)
    assert expected.requires_grad and expected.shape == (3, 4, 2)
    with torch.no_grad():
        torch.testing.assert_close(network(inputs), expected.detach())
        torch.testing.assert_close(network(inputs[0, 0]), expected[0, 0].detach())


@pytest.mark.usefixtures("onednn")
def test_hidden_units_are_those_of_tanh_in_single_precision() -> None:
    """The policy file plays with NumPy's tanh."""
    network = Perceptron(nn.Linear(1, 1), nn.Tanh(), nn.Linear(1, 1))
    for parameter, value in zip(network.parameters(), (1.0, 0.0, 1.0, 0.0), strict=True):
        parameter.data.fill_(value)
    inputs = torch.cat([torch.linspace(-100, 100, 999), torch.linspace(-1e-3, 1e-3, 99)])[:, None]
    outputs = PerceptronPass(network).outputs(inputs)
    np.testing.assert_allclose(outputs.numpy(), np.tanh(inputs.numpy()), rtol=0, atol=2e-7)

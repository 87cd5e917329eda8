import numpy as np
import pytest
import torch

from rsoccer.rng import WorldRng
from tests.policies.networks import random_network, task_observations

KINDS = ["gaussian", "squashed", "exp", "tanh", "softplus", "categorical", "greedy"]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("activation", ["tanh", "relu", "leaky_relu", "elu", "silu"])
def test_the_module_acts_as_the_network(kind: str, activation: str) -> None:
    network = random_network(kind, activation)
    observations = task_observations(network)
    module = network.to_torch()
    actions = module(torch.from_numpy(observations)).detach().numpy()
    np.testing.assert_allclose(actions, network.mean_actions(observations), atol=2e-6)
    assert actions.std() > 0.05, "all actions are nearly equal"


@pytest.mark.parametrize("kind", KINDS[:-1])
def test_draws_have_the_distribution_of_the_module(kind: str) -> None:
    network = random_network(kind)
    one = task_observations(network)[:1, :1]
    distribution = network.to_torch().distribution(torch.from_numpy(one[0, 0]))
    n = 20_000
    drawn = network.choose(np.tile(one, (n, 1, 1)), WorldRng.seeded(0, n))[:, 0]
    torch.manual_seed(0)
    sample = distribution.sample(torch.Size([n]))
    if kind == "categorical":
        assert network.head.table is not None
        sample = torch.tensor(network.head.table)[sample]
    expected = sample.clamp(-1, 1).numpy()
    np.testing.assert_allclose(drawn.mean(axis=0), expected.mean(axis=0), atol=0.03)
    np.testing.assert_allclose(drawn.std(axis=0), expected.std(axis=0), atol=0.03)
    assert drawn.std() > 0.05, "nothing is drawn"


def test_a_deterministic_policy_has_no_distribution() -> None:
    module = random_network("greedy").to_torch()
    with pytest.raises(ValueError, match="no distribution"):
        module.distribution(torch.zeros(len(module.mean)))


def test_weights_can_be_trained_further() -> None:
    network = random_network("gaussian")
    module = network.to_torch()
    observations = torch.from_numpy(task_observations(network))
    before = module(observations).detach()
    optimizer = torch.optim.SGD(module.parameters(), 0.1)
    module.distribution(observations).log_prob(before + 0.5).sum().backward()  # type: ignore[no-untyped-call]
    optimizer.step()
    assert not torch.equal(module(observations), before)
    assert module.log_std is not None
    assert module.log_std.grad is not None

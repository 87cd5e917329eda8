"""Actors of TorchRL as policies, against the actors themselves."""

from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer.policies.libraries import from_torchrl
from rsoccer.registry import make_task
from rsoccer.rng import WorldRng

torch = pytest.importorskip("torch")
pytest.importorskip("torchrl")

from tensordict import TensorDict  # noqa: E402
from tensordict.nn import (  # noqa: E402
    AddStateIndependentNormalScale,
    NormalParamExtractor,
    TensorDictModule,
    TensorDictSequential,
)
from torch import nn  # noqa: E402
from torchrl.data import Bounded  # noqa: E402
from torchrl.envs import ObservationNorm, TransformedEnv  # noqa: E402
from torchrl.envs.utils import ExplorationType, set_exploration_type  # noqa: E402
from torchrl.modules import (  # noqa: E402
    MLP,
    AdditiveGaussianModule,
    EGreedyModule,
    IndependentNormal,
    MultiAgentMLP,
    ProbabilisticActor,
    QValueModule,
    TanhNormal,
)

from rsoccer.torchrl import SoccerEnv  # noqa: E402

TASK = "VSSMulti-v0"
ROBOTS = 3


def sizes() -> tuple[int, int]:
    task = make_task(TASK)
    return task.layout.size, task.action_size


def actor_of(
    body: nn.Module,
    distribution: Any = TanhNormal,  # noqa: ANN401
    keys: tuple[str, ...] = ("loc", "scale"),
) -> Any:  # noqa: ANN401
    """A probabilistic actor of robots of blue."""
    return ProbabilisticActor(
        TensorDictModule(body, [("blue", "observation")], [("blue", key) for key in keys]),
        in_keys={key: ("blue", key) for key in keys},
        out_keys=[("blue", "action")],
        distribution_class=distribution,
    )


def acted(actor: Any, observations: np.ndarray, mode: ExplorationType) -> np.ndarray:  # noqa: ANN401
    n = len(observations)
    given = {"blue": TensorDict({"observation": torch.from_numpy(observations)}, [n, ROBOTS])}
    with torch.no_grad(), set_exploration_type(mode):
        actions: np.ndarray = actor(TensorDict(given, [n]))["blue", "action"].numpy()
    return actions


def random_observations(n: int = 40) -> np.ndarray:
    rng = np.random.default_rng(0)
    return rng.uniform(-1.0, 1.0, (n, ROBOTS, sizes()[0])).astype(np.float32)


def multi_agent(share: bool = True, **settings: Any) -> Any:  # noqa: ANN401
    o, a = sizes()
    settings = {"centralized": False, "num_cells": [32, 16], **settings}
    if share:
        return MultiAgentMLP(o, 2 * a, ROBOTS, share_params=True, **settings)
    return MultiAgentMLP(o, 2 * a, ROBOTS, share_params=False, **settings)


@pytest.mark.parametrize(
    "mapping", ["biased_softplus_1.0", "biased_softplus_0.5_0.2", "softplus", "exp"]
)
@pytest.mark.parametrize("distribution", [TanhNormal, IndependentNormal])
def test_actions_are_those_of_the_actor(mapping: str, distribution: Any) -> None:  # noqa: ANN401
    torch.manual_seed(0)
    body = nn.Sequential(multi_agent(), NormalParamExtractor(mapping))
    actor, observations = actor_of(body, distribution), random_observations()
    network = from_torchrl(actor, TASK)
    expected = acted(actor, observations, ExplorationType.DETERMINISTIC).clip(-1, 1)
    np.testing.assert_allclose(network.mean_actions(observations), expected, rtol=0, atol=2e-6)
    assert expected.std() > 0.02
    n = 4000
    one = np.tile(observations[:1], (n, 1, 1))
    drawn = network.choose(one, WorldRng.seeded(0, n))
    sample = acted(actor, one, ExplorationType.RANDOM).clip(-1, 1)
    np.testing.assert_allclose(drawn.mean(axis=0), sample.mean(axis=0), atol=0.06)
    np.testing.assert_allclose(drawn.std(axis=0), sample.std(axis=0), atol=0.06)
    assert drawn.std(axis=0).min() > 0.1


def test_robots_with_own_parameters_have_own_policies() -> None:
    torch.manual_seed(0)
    actor = actor_of(nn.Sequential(multi_agent(False), NormalParamExtractor()))
    observations = random_observations()
    expected = acted(actor, observations, ExplorationType.DETERMINISTIC)
    for robot in range(ROBOTS):
        actions = from_torchrl(actor, TASK, agent=robot).mean_actions(observations)
        np.testing.assert_allclose(actions[:, robot], expected[:, robot], rtol=0, atol=2e-6)
        assert not np.allclose(actions[:, robot - 1], expected[:, robot - 1])
    with pytest.raises(ValueError, match="agent: expected 0 to 2, got 3"):
        from_torchrl(actor, TASK, agent=3)


@pytest.mark.parametrize("activation", [nn.Tanh, nn.ReLU, nn.ELU])
def test_perceptrons_with_a_constant_deviation(activation: type[nn.Module]) -> None:
    o, a = sizes()
    body = nn.Sequential(
        MLP(o, a, num_cells=[32], activation_class=activation),
        AddStateIndependentNormalScale(a, init_value=-1.0),
    )
    actor, observations = actor_of(body, IndependentNormal), random_observations()
    network = from_torchrl(actor, TASK)
    expected = acted(actor, observations, ExplorationType.DETERMINISTIC).clip(-1, 1)
    np.testing.assert_allclose(network.mean_actions(observations), expected, rtol=0, atol=2e-6)
    assert network.action_std == pytest.approx(np.exp([-1.0] * a))


def test_discrete_choices() -> None:
    task = make_task("VSS-v0", discrete=True)
    assert task.action_table is not None
    body = MLP(task.layout.size, len(task.action_table), num_cells=[32])
    actor = actor_of(body, torch.distributions.Categorical, ("logits",))
    network = from_torchrl(actor, task)
    observations = random_observations()
    with torch.no_grad():
        rows = body(torch.from_numpy(observations)).argmax(dim=-1).numpy()
    assert np.array_equal(network.mean_actions(observations), task.action_table[rows])
    assert network.mode == "sample"


@pytest.mark.parametrize("standard_normal", [True, False])
def test_observation_norm_is_part_of_the_policy(standard_normal: bool) -> None:
    o, _ = sizes()
    rng = torch.Generator().manual_seed(0)
    loc, scale = torch.rand(o, generator=rng), torch.rand(o, generator=rng) + 0.5
    key = ("blue", "observation")
    env = TransformedEnv(
        SoccerEnv(TASK, 4, seed=0),
        ObservationNorm(loc, scale, in_keys=[key], standard_normal=standard_normal),
    )
    actor = actor_of(nn.Sequential(multi_agent(), NormalParamExtractor()))
    network = from_torchrl(actor, env=env)
    normalized = env.reset()[key].numpy()
    plain = SoccerEnv(TASK, 4, seed=0).reset()[key].numpy()
    assert not np.allclose(normalized, plain)
    expected = acted(actor, normalized, ExplorationType.DETERMINISTIC)
    np.testing.assert_allclose(network.mean_actions(plain), expected, rtol=0, atol=2e-6)
    assert network.task_name == TASK


def test_observation_norms_of_nested_environments_apply_from_the_inside() -> None:
    o, _ = sizes()
    rng = torch.Generator().manual_seed(0)
    key = ("blue", "observation")
    env: Any = SoccerEnv(TASK, 4, seed=0)
    for _ in range(2):
        loc, scale = torch.rand(o, generator=rng), torch.rand(o, generator=rng) + 0.5
        norm = ObservationNorm(loc, scale, in_keys=[key], standard_normal=True)
        env = TransformedEnv(env, norm, auto_unwrap=False)
    assert isinstance(env.base_env, TransformedEnv)
    actor = actor_of(nn.Sequential(multi_agent(), NormalParamExtractor()))
    plain = SoccerEnv(TASK, 4, seed=0).reset()[key].numpy()
    expected = acted(actor, env.reset()[key].numpy(), ExplorationType.DETERMINISTIC)
    actions = from_torchrl(actor, env=env).mean_actions(plain)
    np.testing.assert_allclose(actions, expected, rtol=0, atol=2e-6)


def test_modules_of_exploration_and_choice_are_refused() -> None:
    o, a = sizes()
    body = TensorDictModule(MLP(o, a, num_cells=[8]), ["observation"], ["action"])
    spec = Bounded(-1.0, 1.0, (a,))
    for module in (EGreedyModule(spec), AdditiveGaussianModule(spec), QValueModule("categorical")):
        with pytest.raises(ValueError, match=type(module).__name__):
            from_torchrl(TensorDictSequential(body, module), TASK)


def test_an_actor_plays() -> None:
    actor = actor_of(nn.Sequential(multi_agent(), NormalParamExtractor()))
    result = rsoccer.evaluate(from_torchrl(actor, TASK), "zero", matches=2)
    assert (result.matches, result.task) == (2, TASK)


def test_other_actors_are_refused() -> None:
    central = actor_of(nn.Sequential(multi_agent(centralized=True), NormalParamExtractor()))
    with pytest.raises(ValueError, match="centralized=False"):
        from_torchrl(central, TASK)
    none = actor_of(nn.Sequential(multi_agent(), NormalParamExtractor("relu")))
    with pytest.raises(ValueError, match="expected scale_mapping softplus"):
        from_torchrl(none, TASK)
    with pytest.raises(ValueError, match="task: expected the task"):
        from_torchrl(none)
    plain = nn.Sequential(nn.Linear(3, 2), nn.Tanh(), nn.Linear(2, 2))
    with pytest.raises(ValueError, match="the model takes observations of 3 numbers"):
        from_torchrl(plain, TASK)
    beta = actor_of(
        nn.Sequential(multi_agent(), NormalParamExtractor()), torch.distributions.Laplace
    )
    with pytest.raises(ValueError, match=r"expected a distribution of .*, got Laplace"):
        from_torchrl(beta, TASK)

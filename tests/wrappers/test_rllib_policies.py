"""Modules of RLlib as policies, against the modules themselves."""

from typing import Any, ClassVar

import numpy as np
import pytest

import rsoccer
from rsoccer.match_evaluation import MatchEvaluation
from rsoccer.policies.libraries import from_rllib
from rsoccer.registry import make_task
from rsoccer.rng import WorldRng
from tests.ray_start import patiently

torch = pytest.importorskip("torch")
ray = pytest.importorskip("ray")
pytest.importorskip("ray.rllib")

from gymnasium.spaces import Box, Discrete  # noqa: E402
from ray.rllib.algorithms.ppo.torch.default_ppo_torch_rl_module import (  # noqa: E402
    DefaultPPOTorchRLModule,
)
from ray.rllib.algorithms.sac.sac_catalog import SACCatalog  # noqa: E402
from ray.rllib.algorithms.sac.torch.default_sac_torch_rl_module import (  # noqa: E402
    DefaultSACTorchRLModule,
)
from ray.rllib.core.columns import Columns  # noqa: E402
from ray.rllib.core.rl_module.default_model_config import DefaultModelConfig  # noqa: E402

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")

TASK = "VSS-v0"


def module_of(kind: Any = DefaultPPOTorchRLModule, discrete: bool = False, **config: Any) -> Any:  # noqa: ANN401
    """A module with random weights."""
    task = make_task(TASK, discrete=discrete)
    observed = Box(-2.0, 2.0, (task.layout.size,))
    acted: Any = Box(-1.0, 1.0, (task.action_size,))
    if task.action_table is not None:
        acted = Discrete(len(task.action_table))
    torch.manual_seed(0)
    extra = {"catalog_class": SACCatalog} if kind is DefaultSACTorchRLModule else {}
    config = {"fcnet_hiddens": [32, 16], **config}
    if extra:
        config["twin_q"] = False
    else:
        config = DefaultModelConfig(**config)
    return kind(observation_space=observed, action_space=acted, model_config=config, **extra)


def observations(n: int = 50) -> np.ndarray:
    size = make_task(TASK).layout.size
    return np.random.default_rng(0).uniform(-2.0, 2.0, (n, size)).astype(np.float32)


def distribution(module: Any, inputs: np.ndarray) -> Any:  # noqa: ANN401
    with torch.no_grad():
        outputs = module.forward_exploration({Columns.OBS: torch.from_numpy(inputs)}, t=0)
    return module.get_exploration_action_dist_cls().from_logits(outputs[Columns.ACTION_DIST_INPUTS])


@pytest.mark.parametrize(
    "config",
    [
        {},
        {"vf_share_layers": True},
        {"fcnet_activation": "relu"},
        {"fcnet_activation": "silu", "head_fcnet_hiddens": [8], "head_fcnet_activation": "silu"},
        {"free_log_std": True},
    ],
)
def test_gaussians_of_ppo(config: dict[str, Any]) -> None:
    module, inputs = module_of(**config), observations()
    network = from_rllib(module, TASK)
    expected = distribution(module, inputs).to_deterministic().sample().clamp(-1, 1)
    np.testing.assert_allclose(network.mean_actions(inputs), expected, rtol=0, atol=2e-6)
    assert expected.std() > 0.02
    check_draws(network, module)


def check_draws(network: Any, module: Any) -> None:  # noqa: ANN401
    n, one = 4000, observations(1)
    drawn = network.choose(np.tile(one, (n, 1, 1)), WorldRng.seeded(0, n))[:, 0]
    sample = distribution(module, np.tile(one, (n, 1))).sample().clamp(-1, 1).numpy()
    np.testing.assert_allclose(drawn.mean(axis=0), sample.mean(axis=0), atol=0.06)
    np.testing.assert_allclose(drawn.std(axis=0), sample.std(axis=0), atol=0.06)
    assert drawn.std() > 0.1


def test_squashed_gaussians_of_sac() -> None:
    module, inputs = module_of(DefaultSACTorchRLModule), observations()
    network = from_rllib(module, TASK)
    expected = torch.tanh(distribution(module, inputs).loc)
    np.testing.assert_allclose(network.mean_actions(inputs), expected, rtol=0, atol=2e-6)
    check_draws(network, module)


def test_discrete_choices() -> None:
    module, inputs = module_of(discrete=True), observations()
    task = make_task(TASK, discrete=True)
    assert task.action_table is not None
    network = from_rllib(module, task)
    rows = distribution(module, inputs).to_deterministic().sample()
    assert np.array_equal(network.mean_actions(inputs), task.action_table[rows])
    assert network.mode == "sample"


def test_an_algorithm_plays_with_its_normalization() -> None:
    from ray.rllib.algorithms.ppo import PPOConfig
    from ray.rllib.connectors.env_to_module import MeanStdFilter

    from rsoccer.rllib import EvaluationCallback, SoccerMultiAgentEnv

    def trained() -> Any:  # noqa: ANN401
        config = (
            PPOConfig()
            .environment(SoccerMultiAgentEnv, env_config={"task": TASK, "max_steps": 9})
            .env_runners(
                num_env_runners=0,
                rollout_fragment_length=20,
                env_to_module_connector=lambda env, spaces, device: MeanStdFilter(multi_agent=True),
            )
            .multi_agent(policies={"shared"}, policy_mapping_fn=lambda *_, **__: "shared")
            .rl_module(model_config=DefaultModelConfig(fcnet_hiddens=[16]))
            .training(train_batch_size_per_learner=20, minibatch_size=20, num_epochs=1)
            .callbacks(on_train_result=EvaluationCallback(measured))
            .debugging(seed=3)
        )
        return config.build_algo()

    measured = MatchEvaluation(("ou",), matches=2, every=20)
    algorithm = patiently(trained)
    try:
        result = algorithm.train()
        assert set(result["evaluation_matches"]) == {"goal_score_ou"}
        network = from_rllib(algorithm)
        (running,) = algorithm.env_runner._env_to_module.connectors[0]._filters.values()
        inputs = observations()
        normalized = np.stack([running(row, update=False) for row in inputs])
        module = algorithm.get_module("shared")
        expected = distribution(module, normalized).to_deterministic().sample().clamp(-1, 1)
    finally:
        algorithm.stop()
        ray.shutdown()
    np.testing.assert_allclose(network.mean_actions(inputs), expected, rtol=0, atol=1e-5)
    assert network.std.std() > 0.01
    assert (network.task_name, network.task_options["max_steps"]) == (TASK, 9)
    assert rsoccer.evaluate(network, "zero", matches=2).matches == 2


def test_other_modules_are_refused() -> None:
    with pytest.raises(ValueError, match="expected an encoder and a policy head"):
        from_rllib(torch.nn.Linear(3, 2), TASK)
    with pytest.raises(ValueError, match="the model takes observations of"):
        from_rllib(module_of(), "SSLGoToBall-v0")
    with pytest.raises(ValueError, match="Linear with bias"):
        from_rllib(module_of(fcnet_activation="linear"), TASK)


def test_an_alias_of_a_task_is_found() -> None:
    module = module_of()

    class Config:
        policies: ClassVar = {"shared": None}
        env_config: ClassVar = {"task": "VSSFIRA-v0", "max_steps": 9, "frozen": ["old"]}

    class Algorithm:
        config = Config()

        def get_module(self, name: str) -> Any:  # noqa: ANN401
            return module

    network = from_rllib(Algorithm())
    assert network.task_options["max_steps"] == 9

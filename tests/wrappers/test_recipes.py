"""Recipes of docs/libraries.md whose libraries need environments of their own."""

import importlib
import re
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rsoccer import Matches

PAGE = Path(__file__).parents[2] / "docs" / "libraries.md"


@pytest.fixture
def recipe(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], Any]:
    """Imports the block of a library: BenchMARL pickles its task."""

    def imported(library: str) -> Any:  # noqa: ANN401
        if find_spec(library) is None:  # one that is installed has to be importable
            pytest.skip(f"{library} is not installed")
        block = rf"^```python needs_{library}\n(.*?)^```$"
        (code,) = re.findall(block, PAGE.read_text(), re.DOTALL | re.MULTILINE)
        (tmp_path / f"{library}_recipe.py").write_text(code)
        monkeypatch.syspath_prepend(tmp_path)
        return importlib.import_module(f"{library}_recipe")

    return imported


@pytest.mark.filterwarnings("ignore")  # of other libraries' affairs
def test_benchmarl_trains(recipe: Callable[[str], Any], tmp_path: Path) -> None:
    task = recipe("benchmarl").task
    task.config["max_steps"] = 20
    from benchmarl.algorithms import MappoConfig
    from benchmarl.experiment import Experiment, ExperimentConfig
    from benchmarl.models.mlp import MlpConfig

    config = ExperimentConfig.get_from_yaml()
    config.max_n_iters, config.max_n_frames = 2, None
    config.on_policy_collected_frames_per_batch, config.on_policy_n_envs_per_worker = 200, 5
    config.on_policy_minibatch_size, config.on_policy_n_minibatch_iters = 100, 1
    config.evaluation_interval, config.evaluation_episodes = 200, 2
    config.loggers, config.create_json, config.render = [], False, False
    config.save_folder = str(tmp_path)
    network = MlpConfig.get_from_yaml()
    experiment = Experiment(task, MappoConfig.get_from_yaml(), network, 0, config, network)
    experiment.run()
    assert experiment.total_frames == 400
    assert np.isfinite(experiment.mean_return)


def test_pufferlib_plays_the_same_match(recipe: Callable[[str], Any]) -> None:
    envs = recipe("pufferlib").PufferSoccer(worlds=4)
    matches = Matches("VSSSelfPlay-v0", 4, 0)
    observations, _ = envs.reset(0)
    assert observations.shape == (24, matches.observation_size)
    assert (observations == matches.reset(0).reshape(24, -1)).all()
    ended, rng = 0, np.random.default_rng(0)
    for _ in range(1250):  # half a minute of play; the limit of a match is below
        actions = rng.uniform(-1, 1, (4, 6, 2)).astype(np.float32)
        observations, rewards, terminals, truncations, infos = envs.step(actions.reshape(24, 2))
        outcome = matches.step(actions)
        assert (rewards == outcome.rewards.reshape(-1)).all()
        assert (terminals | truncations == outcome.ended.repeat(6)).all()
        assert len(infos) == (outcome.episodes is not None)
        ended += len(infos)
    assert (observations == outcome.observations.reshape(24, -1)).all()
    assert ended


def test_tianshou_collects(recipe: Callable[[str], Any]) -> None:
    envs = recipe("tianshou").envs
    assert len(envs) == 8
    actions = np.stack([space.sample() for space in envs.action_space])
    observations, rewards, *_ = envs.step(actions)
    assert observations.shape == (8, Matches("VSS-v0", 1, 0).observation_size)
    assert rewards.shape == (8,)

"""TorchRL's wrappers of a PettingZoo match, a Gymnasium match, and many Gymnasium matches."""

from typing import Any

import gymnasium
import pytest

import rsoccer
from rsoccer.envs.parallel import parallel_env
from rsoccer.envs.vector import SoccerVectorEnv
from tests.parallel_matches import TASKS

pettingzoo_lib = pytest.importorskip("torchrl.envs.libs.pettingzoo")
gym_lib = pytest.importorskip("torchrl.envs.libs.gym")
utils = pytest.importorskip("torchrl.envs.utils")

gymnasium.register_envs(rsoccer)

MAX_CYCLES = 5
STEPS = 12  # two episodes and the beginning of a third

# TorchRL warns that it was tested with PettingZoo 1.24.3 only; ours is newer.
ignore_version_warning = pytest.mark.filterwarnings(
    "ignore:PettingZoo in TorchRL is tested using:UserWarning"
)


def ends(rollout: Any) -> list[int]:  # noqa: ANN401  (types only where it is installed)
    """Steps after which the time limit ended an episode; no other ends may occur."""
    assert not rollout["next", "terminated"].any()
    return [int(step) for step in rollout["next", "truncated"].squeeze(-1).nonzero()[..., -1]]


@ignore_version_warning
def test_a_match_has_its_teams_as_groups() -> None:
    match = parallel_env("VSSSelfPlay-v0", max_cycles=MAX_CYCLES)
    env = pettingzoo_lib.PettingZooWrapper(match, return_state=True, seed=0)
    utils.check_env_specs(env)
    assert env.group_map == {
        team: [f"{team}_{robot}" for robot in range(3)] for team in ("blue", "yellow")
    }
    rollout = env.rollout(STEPS, break_when_any_done=False)
    assert ends(rollout) == [4, 9]
    assert rollout["state"].shape == (STEPS, *match.state_space.shape)
    size = match.observation_space("blue_0").shape
    for team in ("blue", "yellow"):
        assert rollout[team, "observation"].shape == (STEPS, 3, *size)
        assert rollout["next", team, "reward"].shape == (STEPS, 3, 1)
        assert (rollout[team, "truncated"] == rollout["truncated"].unsqueeze(1)).all()


@ignore_version_warning
@pytest.mark.parametrize("name", TASKS)
def test_every_task_is_wrapped(name: str) -> None:
    env = pettingzoo_lib.PettingZooWrapper(parallel_env(name), return_state=True, seed=0)
    utils.check_env_specs(env)
    assert sum(map(len, env.group_map.values())) == len(rsoccer.make_task(name).agents)


@pytest.mark.parametrize("discrete", [False, True])
def test_a_single_learner_match_is_wrapped(discrete: bool) -> None:
    match = gymnasium.make("rsoccer/VSS-v0", max_steps=MAX_CYCLES, discrete=discrete)
    env = gym_lib.GymWrapper(match)
    utils.check_env_specs(env)
    assert ends(env.rollout(STEPS, break_when_any_done=False)) == [4, 9]


def test_gym_env_makes_a_match_by_id() -> None:
    """It asks for `frameskip` first and recognizes an unknown option by Python's own words."""
    env = gym_lib.GymEnv("rsoccer/VSS-v0", max_steps=MAX_CYCLES)
    utils.check_env_specs(env)
    assert ends(env.rollout(STEPS, break_when_any_done=False)) == [4, 9]


def test_many_matches_with_same_step_autoreset_are_wrapped() -> None:
    matches = gymnasium.make_vec(
        "rsoccer/VSS-v0", 3, max_steps=MAX_CYCLES, autoreset_mode="same_step"
    )
    assert isinstance(matches.unwrapped, SoccerVectorEnv)
    env = gym_lib.GymWrapper(matches)
    utils.check_env_specs(env)
    rollout = env.rollout(STEPS, break_when_any_done=False)
    assert rollout.batch_size == (3, STEPS)
    assert ends(rollout) == [4, 9] * 3

"""Ids of tasks in the registries of Gymnasium and PettingZoo."""

import subprocess
import sys
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import gymnasium
import numpy as np
import pettingzoo
import pytest
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from pettingzoo import AECEnv

import rsoccer
from rsoccer.envs.parallel import SoccerParallelEnv
from rsoccer.envs.robots_vector import RobotsVectorEnv
from rsoccer.envs.single import SoccerEnv
from rsoccer.envs.vector import SoccerVectorEnv
from rsoccer.registry import names as registry_names
from rsoccer.task import LEARN, Learn
from rsoccer.tasks import VssSelfPlay, VssSingle
from tests.helpers import comparable
from tests.single_learner import ONE_LEARNER, TASKS

N = 2
needs_zoo_registry = pytest.mark.skipif(
    not hasattr(pettingzoo, "register"), reason="PettingZoo before 1.27 has no registry"
)


@pytest.fixture(autouse=True)
def restored_registries(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Remove the names and ids that a test registers."""
    monkeypatch.setattr(registry_names, "_TASKS", dict(registry_names._TASKS))
    names = [name for name in ("parallel_registry", "aec_registry") if hasattr(pettingzoo, name)]
    kept: list[dict[str, Any]] = [getattr(pettingzoo, name) for name in names]
    kept.append(gymnasium.registry)
    before = [dict(each) for each in kept]
    yield
    for each, entries in zip(kept, before, strict=True):
        each.clear()
        each.update(entries)


def run(program: str) -> None:
    """Run a program in a new process, where nothing is imported yet and warnings are errors."""
    command = [sys.executable, "-W", "error", "-c", program]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


# -- Gymnasium --------------------------------------------------------------------------------


@pytest.mark.parametrize("name", TASKS)
def test_gymnasium_has_every_task(name: str) -> None:
    agents = rsoccer.make_task(name).agents
    options: dict[str, Any] = {} if name in ONE_LEARNER else {"learner": agents[-1]}
    env = gymnasium.make(f"rsoccer/{name}", max_steps=9, **options)
    assert isinstance(env.unwrapped, SoccerEnv)
    assert env.unwrapped.learner == options.get("learner", "blue_0")
    observation, _ = env.reset(seed=0)
    assert env.observation_space.contains(observation)
    envs = gymnasium.make_vec(f"rsoccer/{name}", 2 * len(agents))
    assert isinstance(envs.unwrapped, RobotsVectorEnv)
    assert (envs.num_envs, envs.unwrapped.worlds) == (2 * len(agents), 2)


def test_an_id_with_several_learners_asks_for_one() -> None:
    with pytest.raises(ValueError, match=r"exactly one learner, got \['blue_0'.*learner='blue_0'"):
        gymnasium.make("rsoccer/VSSMulti-v0")
    envs = gymnasium.make_vec("rsoccer/VSSMulti-v0", 4, learner="blue_1")
    assert (envs.num_envs, envs.unwrapped.robots) == (4, ("blue_1",))  # type: ignore[attr-defined]
    sync = gymnasium.make_vec("rsoccer/VSSMulti-v0", 4, "sync", learner="blue_1")
    assert comparable(envs.reset(seed=3)) == comparable(sync.reset(seed=3))


def test_an_id_may_include_the_package_to_import() -> None:
    run("import gymnasium; gymnasium.make('rsoccer:rsoccer/VSS-v0').reset(seed=0)")


def test_import_registers_without_output() -> None:
    run("import gymnasium, rsoccer; gymnasium.register_envs(rsoccer)")


def test_options_reach_the_task() -> None:
    env = gymnasium.make("rsoccer/VSS-v0", n_blue=1, max_steps=4, discrete=True)
    assert isinstance(env.unwrapped, SoccerEnv)
    assert (env.unwrapped.task.n_blue, env.unwrapped.task.max_steps) == (1, 4)
    assert isinstance(env.action_space, gymnasium.spaces.Discrete)
    with pytest.raises(TypeError, match=r"unexpected keyword argument .bal_speed."):
        gymnasium.make("rsoccer/VSS-v0", bal_speed=1.0)


def test_gymnasium_collects_images() -> None:
    pytest.importorskip("pygame")
    env = gymnasium.make("rsoccer/VSS-v0", render_mode="rgb_array_list")
    env.reset(seed=0)
    env.step(env.action_space.sample())
    images: Any = env.render()
    assert len(images) == 2


@pytest.mark.parametrize("name", ONE_LEARNER)
def test_all_vectorization_modes_play_the_same_matches(name: str) -> None:
    env_id = f"rsoccer/{name}"
    made = [
        gymnasium.make_vec(env_id, N, vectorization_mode=mode, max_steps=9)
        for mode in (None, "vector_entry_point", "sync")
    ]
    assert [type(envs) for envs in made] == [SoccerVectorEnv, SoccerVectorEnv, SyncVectorEnv]
    assert made[0].metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
    assert made[0].spec is not None
    assert made[0].spec.id == env_id
    assert (
        comparable(made[0].reset(seed=3))
        == comparable(made[1].reset(seed=3))
        == comparable(made[2].reset(seed=3))
    )
    rng = np.random.default_rng(0)
    for _ in range(12):
        actions = rng.uniform(-1.0, 1.0, made[0].action_space.shape or ()).astype(np.float32)
        given = [comparable(envs.step(actions)) for envs in made]
        assert given[0] == given[1] == given[2]


def test_max_episode_steps_sets_the_time_limit() -> None:
    for mode in ("sync", "vector_entry_point"):
        envs = gymnasium.make_vec("rsoccer/VSS-v0", 1, mode, max_episode_steps=2)
        envs.reset(seed=0)
        ends = [envs.step(envs.action_space.sample())[3][0] for _ in range(2)]
        assert ends == [False, True]


@pytest.mark.parametrize("name", ["VSS-v0", "SSLDribbling-v0"])  # one of each league
@pytest.mark.parametrize("context", ["fork", "spawn"])
def test_workers_play_the_same_matches(name: str, context: str) -> None:
    """In a script this needs `if __name__ == "__main__":`, like any program that spawns."""
    with warnings.catch_warnings():
        # Python 3.12 and later warn of forks; matches/test_fork.py shows ours to be safe.
        warnings.filterwarnings("ignore", ".*multi-threaded.*fork", DeprecationWarning)
        workers = gymnasium.make_vec(
            f"rsoccer/{name}", N, "async", vector_kwargs={"context": context}, max_steps=9
        )
    envs = gymnasium.make_vec(f"rsoccer/{name}", N, max_steps=9, threads=2)
    try:
        assert comparable(workers.reset(seed=3)) == comparable(envs.reset(seed=3))
        rng = np.random.default_rng(0)
        for _ in range(12):
            actions = rng.uniform(-1.0, 1.0, envs.action_space.shape or ()).astype(np.float32)
            assert comparable(workers.step(actions)) == comparable(envs.step(actions))
    finally:
        workers.close()


# -- PettingZoo -------------------------------------------------------------------------------


@needs_zoo_registry
@pytest.mark.parametrize("name", TASKS)
def test_pettingzoo_makes_every_task(name: str) -> None:
    match = pettingzoo.make("parallel", f"rsoccer/{name}", max_cycles=7)
    assert isinstance(match, SoccerParallelEnv)
    assert (match.task.name, match.max_cycles) == (name, 7)
    in_turn = pettingzoo.make("aec", f"rsoccer/{name}", max_cycles=7)
    assert isinstance(in_turn, AECEnv)
    match.reset(seed=2)
    in_turn.reset(seed=2)
    agent = match.agents[0]
    assert comparable(in_turn.observe(agent)) == comparable(match.reset(seed=2)[0][agent])


def test_pettingzoo_without_a_registry_is_supported(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("register", "parallel_registry", "aec_registry"):
        monkeypatch.delattr(pettingzoo, name, raising=False)

    class Mine(VssSingle):
        pass

    rsoccer.register("Mine-v0", Mine)
    assert "rsoccer/Mine-v0" in gymnasium.registry


# -- Tasks of users ---------------------------------------------------------------------------


@needs_zoo_registry
def test_a_new_task_gets_its_ids() -> None:
    class Mine(VssSingle):
        pass

    class Together(VssSelfPlay):
        pass

    rsoccer.register("Mine-v3", Mine)
    rsoccer.register("Mine-v3", Mine)  # like a module that is loaded twice
    rsoccer.register("Together-v0", Together)
    env: Any = gymnasium.make("rsoccer/Mine-v3").unwrapped
    assert type(env.task) is Mine
    assert gymnasium.make_vec("rsoccer/Together-v0", 6).num_envs == 6
    assert {"rsoccer/Mine-v3", "rsoccer/Together-v0"} <= pettingzoo.parallel_registry.keys()
    assert {"rsoccer/Mine-v3", "rsoccer/Together-v0"} <= pettingzoo.aec_registry.keys()


def test_a_task_that_needs_options_has_no_id() -> None:
    class Plain(VssSingle):
        def __init__(self, speed: float) -> None:
            super().__init__(ball_speed=speed)

    rsoccer.register("NeedsSpeed-v0", Plain)
    assert "rsoccer/NeedsSpeed-v0" not in gymnasium.registry
    assert rsoccer.single_env("NeedsSpeed-v0", speed=0.3).learner == "blue_0"


@needs_zoo_registry
def test_a_task_without_learners_has_no_id() -> None:
    @dataclass(frozen=True)
    class Show(VssSelfPlay):
        def default_controllers(self) -> dict[str, str | Learn]:
            return dict.fromkeys(self.robots, "chase")

    assert LEARN not in Show().default_controllers().values()
    rsoccer.register("Show-v0", Show)
    assert "rsoccer/Show-v0" not in gymnasium.registry
    assert "rsoccer/Show-v0" not in pettingzoo.parallel_registry

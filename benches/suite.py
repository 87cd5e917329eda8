"""The benchmark suite: every benchmark with its variants, and the pairs that are compared."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from importlib.util import find_spec
from itertools import product
from typing import Final, TypeVar

import rsoccer
from benches import interfaces, libraries, process_cost, thread_scaling
from benches.measuring import Benchmark, Measure, Variant, with_match_time
from benches.noop_envs import NoOpEnv, NoOpParallelEnv
from benches.scenarios import DEFAULT_ENGINE, ENGINES, SCENARIOS, Scenario
from benches.simulators import RobosimAdapter, SimulatorAdapter, timed_episodes
from benches.third_party import (
    PSIM_STEP,
    import_optional,
    name_with_version,
    psim_match,
    silent,
    vmas_football,
)
from benches.training import example, training
from rsoccer.compat import robosim as compat

MATCH_TASK: Final = "VSSSelfPlay-v0"
TEAM_TASK: Final = "VSSMulti-v0"
LEARNER_TASK: Final = "VSS-v0"
SINGLE_TASK: Final = "SSLGoToBall-v0"

T = TypeVar("T")
Start = Callable[[str, int], Measure]
"""Start of a measure of a task in a number of worlds."""


@dataclass(frozen=True)
class Sizes:
    """Numbers of worlds per benchmark; tests use smaller ones."""

    core: int = 64
    """Batch size of the physics benchmarks, which also run on rSim."""
    batched: tuple[int, ...] = (1024, 8192)
    """Batch sizes of `Matches`; the first is also the size of the vector environments."""
    threads: int = 1024
    """Batch size for the comparison of one thread with two."""
    scaling: tuple[int, ...] = (64, 256, 1024, 4096, 16384)
    football: tuple[int, ...] = (32, 1024, 8192)
    libraries: tuple[int, ...] = (8, 32, 64)
    """Batch sizes of matches through other libraries."""
    training: int = 256
    memory: int = 2048
    capacity: int = 100_000
    """Worlds in one process at once."""


def benchmarks(sizes: Sizes) -> Iterator[Benchmark]:
    """Yield all benchmarks in the order of the result table."""
    yield from (core(scenario, sizes.core) for scenario in SCENARIOS)
    yield threads(SCENARIOS[0], sizes.threads)
    yield scaling(SCENARIOS[0], sizes.scaling)
    yield batched(sizes)
    yield single_match()
    yield team()
    yield single_robot(sizes.batched[0])
    yield learner(sizes.batched[0])
    yield from through_libraries(sizes.libraries)
    if find_spec("torch"):
        yield from (trainer(task, sizes.training) for task in (MATCH_TASK, LEARNER_TASK))
    yield memory(SCENARIOS[0], sizes.memory)
    yield memory(SCENARIOS[4], sizes.memory // 4)
    yield capacity(SCENARIOS[0], sizes.capacity, 2)
    startup = Variant("fresh process", 1, 1, lambda: process_cost.startup, DEFAULT_ENGINE)
    yield Benchmark("startup", MATCH_TASK, (startup,))


def core(scenario: Scenario, batch: int) -> Benchmark:
    """Return the benchmark of physics alone, compared with rSim if that is installed.

    Variants that simulate one match at a time run the matches of the batch one after the other.
    """
    one = partial(timed_episodes, scenario, starts=batch)
    many = partial(timed_episodes, scenario, worlds=batch)
    variants = []
    for engine in ENGINES:
        mine = partial(SimulatorAdapter, replace(scenario, engine=engine))
        variants += [
            Variant("Simulator", 1, 1, partial(one, partial(mine, 1)), engine),
            Variant("Simulator", batch, 1, partial(many, partial(mine, batch)), engine),
        ]
    start = partial(one, partial(RobosimAdapter, scenario, compat))
    variants.append(Variant("compat.robosim", 1, 1, start, DEFAULT_ENGINE))
    pairs = engine_pairs(variants)
    if (robosim := import_optional("robosim")) is not None:
        pairs += [(index, len(variants)) for index in range(len(variants))]
        start = partial(quiet, partial(one, partial(RobosimAdapter, scenario, robosim)))
        variants.append(Variant(name_with_version("robosim"), 1, 1, start))
    return Benchmark("core", scenario.name, tuple(variants), tuple(pairs))


def engine_pairs(variants: Sequence[Variant]) -> list[tuple[int, int]]:
    """Return the pairs of variants that differ by their engine alone, compact before rapier."""
    keys = [(v.name, v.worlds, v.threads, v.engine) for v in variants]
    compact = [key for key in keys if key[3] == "compact"]
    pairs = [(key, (*key[:3], "rapier")) for key in compact]
    return [(keys.index(one), keys.index(other)) for one, other in pairs if other in keys]


def quiet(start: Callable[[], Measure]) -> Measure:
    """Start a variant and suppress its output."""
    return silent(start())


def threads(scenario: Scenario, worlds: int) -> Benchmark:
    """Return the benchmark of a second thread.

    The speed-up of one simulator with two threads is compared with two upper bounds: two
    simulators with one thread each, and hashing.
    """
    variants = []
    for number in (1, 2):
        step = partial(thread_scaling.one_simulator, scenario, worlds, number)
        separate = partial(thread_scaling.separate_simulators, scenario, worlds, number)
        hashing = partial(thread_scaling.hashing, number)
        variants += [
            Variant("Simulator", worlds, number, step, scenario.engine),
            Variant("Simulators, one per thread", worlds, number, separate, scenario.engine),
            Variant("hashing", 1, number, hashing),
        ]
    return Benchmark("threads", scenario.name, tuple(variants), ((3, 0), (4, 1), (5, 2)))


def scaling(scenario: Scenario, sizes: tuple[int, ...]) -> Benchmark:
    """Return the benchmark of speed over batch size, relative to the first size.

    The engine that is not the default is measured at the first and the last size.
    """
    variants: list[Variant] = []
    pairs: list[tuple[int, int]] = []
    for engine in ENGINES:
        step = partial(thread_scaling.one_simulator, replace(scenario, engine=engine))
        measured = sizes if engine == DEFAULT_ENGINE else (sizes[0], sizes[-1])
        first = len(variants)
        pairs += [(first + index, first) for index in range(1, len(measured))]
        variants += [Variant("Simulator", n, 1, partial(step, n, 1), engine) for n in measured]
    return Benchmark("scaling", scenario.name, tuple(variants), tuple(pairs))


def memory(scenario: Scenario, worlds: int) -> Benchmark:
    """Return the benchmark of the memory of a world, which is equal in every round."""
    variants = []
    for engine in ENGINES:
        start = partial(process_cost.memory, replace(scenario, engine=engine), worlds)
        variants.append(Variant("Simulator", worlds, 1, start, engine))
    return Benchmark("memory", scenario.teams, tuple(variants), repeats=False)


def capacity(scenario: Scenario, worlds: int, threads: int) -> Benchmark:
    """Return the benchmark of a very large batch in a process of its own."""
    start = partial(process_cost.capacity, scenario, worlds, threads)
    variants = (Variant("Simulator", worlds, threads, start, scenario.engine),)
    return Benchmark("capacity", scenario.name, variants)


def batched(sizes: Sizes) -> Benchmark:
    """Return the benchmark of `Matches`, compared with VMAS' football of equal team size."""
    variants = []
    for worlds, number, engine in product(sizes.batched, (1, 2), ENGINES):
        start = partial(interfaces.matches, MATCH_TASK, worlds, number, engine)
        variants.append(Variant("Matches", worlds, number, start, engine))
    pairs = engine_pairs(variants)
    on_two = [(index, v.worlds) for index, v in enumerate(variants) if v.threads == 2]
    if (vmas := import_optional("vmas")) is not None:
        # A second thread may slow torch down, so `Matches` on two is compared with both.
        for worlds, number in product(sizes.football, (1, 2)):
            pairs += [(index, len(variants)) for index, equal in on_two if equal == worlds]
            football = partial(vmas_football, vmas, worlds, number)
            variants.append(Variant(name_with_version("vmas"), worlds, number, football))
    return Benchmark("batched", MATCH_TASK, tuple(variants), tuple(pairs))


def single_match() -> Benchmark:
    """Return the benchmark of one match through PettingZoo, compared with a no-op environment."""
    env = partial(rsoccer.parallel_env, MATCH_TASK)
    variants = [
        Variant("ParallelEnv", 1, 1, partial(started, interfaces.parallel, env, engine), engine)
        for engine in ENGINES
    ]
    aec = partial(started, interfaces.aec, partial(rsoccer.env, MATCH_TASK), DEFAULT_ENGINE)
    variants += [
        Variant("AECEnv", 1, 1, aec, DEFAULT_ENGINE),
        Variant("no-op ParallelEnv", 1, 1, lambda: interfaces.parallel(NoOpParallelEnv(env()))),
    ]
    pairs = (*engine_pairs(variants), (0, len(variants) - 1))
    return Benchmark("single", MATCH_TASK, tuple(variants), pairs)


def started(
    measure: Callable[[T], Measure], create: Callable[..., T], engine: str, **options: int
) -> Measure:
    """Return the measure of an environment that is created with an engine and other options."""
    return measure(create(engine=engine, **options))


def team() -> Benchmark:
    """Return the benchmark of a team of three learners against noise, compared with pSim."""
    time_step = rsoccer.make_task(TEAM_TASK).config.time_step
    env = partial(rsoccer.parallel_env, TEAM_TASK)

    def timed(start: Callable[[], Measure], step: float = time_step) -> Callable[[], Measure]:
        return lambda: with_match_time(start(), step)

    parallel = partial(started, interfaces.parallel, env, DEFAULT_ENGINE)
    alone = partial(interfaces.matches, TEAM_TASK, 1, 1)
    variants = [
        Variant("ParallelEnv", 1, 1, timed(parallel), DEFAULT_ENGINE),
        Variant("Matches", 1, 1, timed(alone), DEFAULT_ENGINE),
    ]
    if (psim := import_optional("pSim")) is None:
        return Benchmark("single", TEAM_TASK, tuple(variants))
    start = timed(partial(psim_match, psim), PSIM_STEP)
    variants.append(Variant(name_with_version("pSim"), 1, 1, start))
    return Benchmark("single", TEAM_TASK, tuple(variants), ((0, 2), (1, 2)))


def single_robot(envs: int) -> Benchmark:
    """Return the benchmark of one robot through Gymnasium, single and vectorized."""
    env, vector = partial(rsoccer.single_env, SINGLE_TASK), partial(rsoccer.vector_env, SINGLE_TASK)
    single = partial(started, interfaces.single, env, DEFAULT_ENGINE)
    many = partial(started, interfaces.vector, partial(vector, envs), DEFAULT_ENGINE)
    variants = (
        Variant("Env", 1, 1, single, DEFAULT_ENGINE),
        Variant("no-op Env", 1, 1, lambda: interfaces.single(NoOpEnv(env()))),
        Variant("VectorEnv", envs, 1, many, DEFAULT_ENGINE),
        Variant("VectorEnv", envs, 2, partial(many, threads=2), DEFAULT_ENGINE),
    )
    return Benchmark("single", SINGLE_TASK, variants, ((0, 1),))


def learner(envs: int) -> Benchmark:
    """Return the benchmark of the vector environment with one learner in a match of six robots."""
    vector = partial(rsoccer.vector_env, LEARNER_TASK, envs)
    many = partial(started, interfaces.vector, vector, threads=2)
    variants = [Variant("VectorEnv", envs, 2, partial(many, engine), engine) for engine in ENGINES]
    return Benchmark("single", LEARNER_TASK, tuple(variants), tuple(engine_pairs(variants)))


def through_libraries(sizes: tuple[int, ...]) -> Iterator[Benchmark]:
    """Yield the benchmarks of other libraries' environments, compared with `Matches`.

    Those of a library that is absent are skipped.
    """
    robots: dict[str, Start] = {"Gymnasium robots_vector_env": libraries.robots}
    for task in (MATCH_TASK, TEAM_TASK):
        yield through_library(task, sizes, robots)
    rows: dict[str, Start] = {
        "SB3 SoccerVecEnv": libraries.sb3,
        **{
            f"SB3 SoccerVecEnv, VecMonitor, {name}": partial(libraries.sb3, normalizer=name)
            for name in ("SoccerVecNormalize", "VecNormalize")
        },
    }
    loop: dict[str, Start] = {"SB3 DummyVecEnv": libraries.sb3_dummy}
    yield through_library(TEAM_TASK, sizes, rows)
    for task in (LEARNER_TASK, SINGLE_TASK):
        yield through_library(task, sizes, rows | loop)
    tensors: dict[str, Start] = {"TorchRL SoccerEnv": libraries.torchrl}
    yield through_library(
        MATCH_TASK,
        sizes,
        tensors | {"TorchRL PettingZooWrapper": libraries.torchrl_pettingzoo},
    )
    yield through_library(
        LEARNER_TASK, sizes, tensors | {"TorchRL GymWrapper": libraries.torchrl_vector}
    )
    runners: dict[str, Start] = {
        "RLlib MatchesEnvRunner": partial(libraries.rllib, stock=False),
        "RLlib MultiAgentEnvRunner": partial(libraries.rllib, stock=True),
    }
    yield through_library(MATCH_TASK, sizes, runners)
    yield through_library(TEAM_TASK, sizes, {"SuperSuit concat_vec_envs_v1": libraries.supersuit})


def through_library(task: str, sizes: tuple[int, ...], ways: Mapping[str, Start]) -> Benchmark:
    """Return the benchmark of one library's environments by name, compared with `Matches`."""
    variants: list[Variant] = []
    pairs: list[tuple[int, int]] = []
    for worlds in sizes:
        reference = len(variants)
        alone = partial(interfaces.matches, task, worlds, 1)
        variants.append(Variant("Matches", worlds, 1, alone, DEFAULT_ENGINE))
        for name, start in ways.items():
            pairs.append((len(variants), reference))
            variants.append(Variant(name, worlds, 1, partial(start, task, worlds), DEFAULT_ENGINE))
    return Benchmark("libraries", task, tuple(variants), tuple(pairs))


def trainer(task: str, worlds: int) -> Benchmark:
    """Return the benchmark of rollouts and updates of the trainer, and of the example's PPO.

    Only with one learner do both play the same matches: in others the trainer has opponents.
    """
    variants = [
        Variant("trainer", worlds, 2, partial(training, task, engine, worlds, 2), engine)
        for engine in ENGINES
    ]
    pairs = engine_pairs(variants)
    if task == LEARNER_TASK:
        alike = next(i for i, variant in enumerate(variants) if variant.engine == DEFAULT_ENGINE)
        pairs.append((len(variants), alike))
        start = partial(example, task, worlds, 2)
        variants.append(Variant("examples/13_ppo.py", worlds, 2, start, DEFAULT_ENGINE))
    return Benchmark("training", task, tuple(variants), tuple(pairs))

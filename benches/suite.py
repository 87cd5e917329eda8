"""The benchmark suite: every benchmark with its variants, and the pairs that are compared."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from importlib.util import find_spec
from itertools import product

import rsoccer
from benches import interfaces, process_cost, thread_scaling
from benches.measuring import Benchmark, Measure, Variant
from benches.noop_envs import NoOpEnv, NoOpParallelEnv
from benches.scenarios import SCENARIOS, Scenario
from benches.simulators import RobosimAdapter, SimulatorAdapter, timed_episodes
from benches.third_party import import_optional, name_with_version, silent, vmas_football
from benches.training import training
from rsoccer.compat import robosim as compat

MATCH_TASK = "VSSSelfPlay-v0"
SINGLE_TASK = "SSLGoToBall-v0"


@dataclass(frozen=True)
class Sizes:
    """Numbers of worlds per benchmark; tests use smaller ones."""

    core: int = 64
    """Batch size of the physics benchmarks, which also run on rSim."""
    batched: tuple[int, ...] = (1024, 8192)
    """Batch sizes of `Matches`; the first is also the size of the vector environment."""
    threads: int = 1024
    """Batch size for the comparison of one thread with two."""
    scaling: tuple[int, ...] = (64, 256, 1024, 4096, 16384)
    football: tuple[int, ...] = (32, 1024, 8192)
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
    yield single_robot(sizes.batched[0])
    if find_spec("torch"):
        train = partial(training, MATCH_TASK, sizes.training, 2)
        yield Benchmark("training", MATCH_TASK, (Variant("trainer", sizes.training, 2, train),))
    for scenario, worlds in ((SCENARIOS[0], sizes.memory), (SCENARIOS[4], sizes.memory // 4)):
        memory = partial(process_cost.memory, scenario, worlds)
        yield Benchmark("memory", scenario.teams, (Variant("Simulator", worlds, 1, memory),))
    yield capacity(SCENARIOS[0], sizes.capacity, 2)
    startup = Variant("fresh process", 1, 1, lambda: process_cost.startup)
    yield Benchmark("startup", MATCH_TASK, (startup,))


def core(scenario: Scenario, batch: int) -> Benchmark:
    """Return the benchmark of physics alone, compared with rSim if that is installed.

    Variants that simulate one match at a time run the matches of the batch one after the other.
    """
    one = partial(timed_episodes, scenario, starts=batch)
    many = partial(timed_episodes, scenario, worlds=batch)
    variants = [
        Variant("Simulator", 1, 1, partial(one, partial(SimulatorAdapter, scenario, 1))),
        Variant("Simulator", batch, 1, partial(many, partial(SimulatorAdapter, scenario, batch))),
        Variant("compat.robosim", 1, 1, partial(one, partial(RobosimAdapter, scenario, compat))),
    ]
    if (robosim := import_optional("robosim")) is None:
        return Benchmark("core", scenario.name, tuple(variants))
    rsoccer_variants, reference = range(len(variants)), len(variants)
    start = partial(quiet, partial(one, partial(RobosimAdapter, scenario, robosim)))
    variants.append(Variant(name_with_version("robosim"), 1, 1, start))
    pairs = tuple((index, reference) for index in rsoccer_variants)
    return Benchmark("core", scenario.name, tuple(variants), pairs)


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
            Variant("Simulator", worlds, number, step),
            Variant("Simulators, one per thread", worlds, number, separate),
            Variant("hashing", 1, number, hashing),
        ]
    return Benchmark("threads", scenario.name, tuple(variants), ((3, 0), (4, 1), (5, 2)))


def scaling(scenario: Scenario, sizes: tuple[int, ...]) -> Benchmark:
    """Return the benchmark of speed over batch size, relative to the first size."""
    step = partial(thread_scaling.one_simulator, scenario)
    variants = tuple(Variant("Simulator", n, 1, partial(step, n, 1)) for n in sizes)
    pairs = tuple((index, 0) for index in range(1, len(sizes)))
    return Benchmark("scaling", scenario.name, variants, pairs)


def capacity(scenario: Scenario, worlds: int, threads: int) -> Benchmark:
    """Return the benchmark of a very large batch in a process of its own."""
    start = partial(process_cost.capacity, scenario, worlds, threads)
    variants = (Variant("Simulator", worlds, threads, start),)
    return Benchmark("capacity", scenario.name, variants)


def batched(sizes: Sizes) -> Benchmark:
    """Return the benchmark of `Matches`, compared with VMAS' football of equal team size."""
    variants = [
        Variant("Matches", worlds, number, partial(interfaces.matches, MATCH_TASK, worlds, number))
        for worlds, number in product(sizes.batched, (1, 2))
    ]
    indices, pairs = {(v.worlds, v.threads): i for i, v in enumerate(variants)}, []
    if (vmas := import_optional("vmas")) is not None:
        # A second thread may slow torch down, so `Matches` on two is compared with both.
        for worlds, number in product(sizes.football, (1, 2)):
            if (worlds, 2) in indices:
                pairs.append((indices[worlds, 2], len(variants)))
            start = partial(vmas_football, vmas, worlds, number)
            variants.append(Variant(name_with_version("vmas"), worlds, number, start))
    return Benchmark("batched", MATCH_TASK, tuple(variants), tuple(pairs))


def single_match() -> Benchmark:
    """Return the benchmark of one match through PettingZoo, compared with a no-op environment."""
    env = partial(rsoccer.parallel_env, MATCH_TASK)
    variants = (
        Variant("ParallelEnv", 1, 1, lambda: interfaces.parallel(env())),
        Variant("AECEnv", 1, 1, lambda: interfaces.aec(rsoccer.env(MATCH_TASK))),
        Variant("no-op ParallelEnv", 1, 1, lambda: interfaces.parallel(NoOpParallelEnv(env()))),
    )
    return Benchmark("single", MATCH_TASK, variants, ((0, 2),))


def single_robot(envs: int) -> Benchmark:
    """Return the benchmark of one robot through Gymnasium, single and vectorized."""
    env, vector = partial(rsoccer.single_env, SINGLE_TASK), partial(rsoccer.vector_env, SINGLE_TASK)
    variants = (
        Variant("Env", 1, 1, lambda: interfaces.single(env())),
        Variant("no-op Env", 1, 1, lambda: interfaces.single(NoOpEnv(env()))),
        Variant("VectorEnv", envs, 1, lambda: interfaces.vector(vector(envs))),
        Variant("VectorEnv", envs, 2, lambda: interfaces.vector(vector(envs, threads=2))),
    )
    return Benchmark("single", SINGLE_TASK, variants, ((0, 1),))

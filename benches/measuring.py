"""Measurement in rounds: each round measures every variant once, compared variants in turn.

A busy moment of the machine then affects all variants alike. Absolute figures are medians over the
rounds. Ratios are taken within each round first, so that a change of the machine's speed during the
run does not affect them.
"""

import statistics
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

from benches.result_files import Figure


class Quantity(NamedTuple):
    """Name and unit of a measured number."""

    name: str
    unit: str


SPEED: Final = Quantity("speed", "world-steps/s")
RATIO: Final = Quantity("ratio", "x")
MATCH_TIME: Final = Quantity("match time", "s of play per s")

Values = dict[Quantity, float]  # ratios are taken of the first quantity
Measure = Callable[[float], Values]  # measures for about that many seconds; 0 is a warm-up


@dataclass(frozen=True)
class Variant:
    """One implementation or configuration of a benchmark's work."""

    name: str
    worlds: int
    threads: int
    start: Callable[[], Measure]
    engine: str = ""
    """Contact engine, if the variant has one."""


@dataclass(frozen=True)
class Benchmark:
    """Workload with its variants, and pairs of indices (numerator, denominator) to compare."""

    group: str
    scenario: str
    variants: tuple[Variant, ...]
    pairs: tuple[tuple[int, int], ...] = ()
    repeats: bool = True
    """False if every round would give the same values: then the first one suffices."""

    @property
    def title(self) -> str:
        """Title for selection by `--only`."""
        return f"{self.group}: {self.scenario}"


class UnavailableError(Exception):
    """Raised if this machine cannot run a benchmark; the message gives the reason."""


Rounds = list[list[Values]]  # (rounds, variants)


def measure(
    benchmarks: Sequence[Benchmark], rounds: int, seconds: float, log: Callable[[str], None]
) -> list[Figure]:
    """Run all benchmarks and return their figures.

    Args:
        benchmarks: Benchmarks to run.
        rounds: Number of rounds.
        seconds: Approximate duration of one measurement.
        log: Receives progress messages.

    Returns:
        Figures of the benchmarks that this machine can run.
    """
    prepared = list(prepare(benchmarks, log))
    results: list[Rounds] = [[] for _ in prepared]
    for n in range(rounds):
        for (benchmark, measures), values in zip(prepared, results, strict=True):
            if n and not benchmark.repeats:
                continue
            log(f"round {n + 1} of {rounds}, {benchmark.title}")
            values.append(measure_round(measures, seconds, backward=n % 2 == 1))
    pairs = zip(prepared, results, strict=True)
    return [figure for (benchmark, _), values in pairs for figure in summarize(benchmark, values)]


def prepare(
    benchmarks: Sequence[Benchmark], log: Callable[[str], None]
) -> Iterator[tuple[Benchmark, list[Measure]]]:
    """Start and warm up the variants; yield the benchmarks that this machine can run."""
    for benchmark in benchmarks:
        log(f"preparing, {benchmark.title}")
        try:
            measures = [variant.start() for variant in benchmark.variants]
        except UnavailableError as reason:
            log(f"skipped, {benchmark.title}: {reason}")
            continue
        for warm_up in measures:
            warm_up(0.0)
        yield benchmark, measures


def measure_round(measures: Sequence[Measure], seconds: float, *, backward: bool) -> list[Values]:
    """Run each measure once, last to first if `backward`; return values in the order given."""
    order = range(len(measures))
    values = {i: measures[i](seconds) for i in (reversed(order) if backward else order)}
    return [values[i] for i in order]


def summarize(benchmark: Benchmark, rounds: Rounds) -> Iterator[Figure]:
    """Yield a figure per measured quantity and per ratio."""
    for i, variant in enumerate(benchmark.variants):
        for quantity in rounds[0][i]:
            values = [values[i][quantity] for values in rounds]
            yield figure(benchmark, variant, variant.name, variant.engine, quantity, values)
    for numerator, denominator in benchmark.pairs:
        variant, reference = benchmark.variants[numerator], benchmark.variants[denominator]
        ratios = [_first(values[numerator]) / _first(values[denominator]) for values in rounds]
        name, engine = f"{variant.name} / {reference.name}", variant.engine
        if reference.engine and engine != reference.engine:
            engine = f"{engine} / {reference.engine}"
        yield figure(benchmark, variant, name, engine, RATIO, ratios)


def figure(
    benchmark: Benchmark,
    variant: Variant,
    name: str,
    engine: str,
    quantity: Quantity,
    values: Sequence[float],
) -> Figure:
    """Return median, minimum and maximum of the values of all rounds."""
    return Figure(
        group=benchmark.group,
        scenario=benchmark.scenario,
        variant=name,
        engine=engine,
        worlds=variant.worlds,
        threads=variant.threads,
        quantity=quantity.name,
        unit=quantity.unit,
        median=statistics.median(values),
        minimum=min(values),
        maximum=max(values),
        rounds=len(values),
    )


def calls_per_second(step: Callable[[], object], seconds: float) -> float:
    """Call `step` for some seconds, at least once, and return the rate."""
    calls, start, spent = 0, time.perf_counter(), 0.0
    while not calls or spent < seconds:
        step()
        calls += 1
        spent = time.perf_counter() - start
    return calls / spent


def world_steps_per_second(step: Callable[[], object], worlds: int) -> Measure:
    """Return a measure of the speed of `step`, which steps `worlds` worlds per call."""
    return lambda seconds: {SPEED: worlds * calls_per_second(step, seconds)}


def with_match_time(measure: Measure, step: float) -> Measure:
    """Return a measure that adds the simulated time, given the length of a step (s)."""

    def timed(seconds: float) -> Values:
        values = measure(seconds)
        return {**values, MATCH_TIME: values[SPEED] * step}

    return timed


def select(benchmarks: Iterable[Benchmark], pattern: str) -> list[Benchmark]:
    """Return the benchmarks whose title contains a pattern, ignoring case.

    Raises:
        ValueError: No title contains the pattern.
    """
    candidates = list(benchmarks)
    found = [benchmark for benchmark in candidates if pattern.lower() in benchmark.title.lower()]
    if not found:
        titles = "\n  ".join(benchmark.title for benchmark in candidates)
        raise ValueError(f"no benchmark has {pattern!r} in its title; titles are:\n  {titles}")
    return found


def _first(values: Values) -> float:
    return next(iter(values.values()))

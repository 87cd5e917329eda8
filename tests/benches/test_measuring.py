import dataclasses

import pytest

from benches.measuring import (
    MATCH_TIME,
    RATIO,
    SPEED,
    Benchmark,
    Measure,
    Quantity,
    UnavailableError,
    Values,
    Variant,
    calls_per_second,
    measure,
    select,
    summarize,
    with_match_time,
)

LOAD = Quantity("load", "share")


class ScriptedMeasure:
    """Reorder given values, one per round, and records the order of calls."""

    def __init__(self, name: str, values: list[float], order: list[str]) -> None:
        self.name, self.values, self.order = name, values, order

    def __call__(self, seconds: float) -> Values:
        if seconds:
            self.order.append(self.name)
            return {SPEED: self.values.pop(0), LOAD: 0.5}
        return {}

    def start(self) -> Measure:
        return self


def benchmark(order: list[str]) -> Benchmark:
    fast, slow = (
        ScriptedMeasure("fast", [10, 40, 60], order),
        ScriptedMeasure("slow", [5, 10, 20], order),
    )
    variants = (Variant("fast", 4, 1, fast.start), Variant("slow", 1, 1, slow.start))
    return Benchmark("core", "play", variants, ((0, 1),))


def test_ratios_are_taken_within_a_round() -> None:
    figures = measure([benchmark([])], 3, 0.1, lambda _: None)
    found = {(f.variant, f.quantity): (f.median, f.minimum, f.maximum) for f in figures}
    assert found == {
        ("fast", SPEED.name): (40, 10, 60),
        ("fast", LOAD.name): (0.5, 0.5, 0.5),
        ("slow", SPEED.name): (10, 5, 20),
        ("slow", LOAD.name): (0.5, 0.5, 0.5),
        ("fast / slow", RATIO.name): (3, 2, 4),
    }
    [ratio] = [figure for figure in figures if figure.unit == "x"]
    assert (ratio.group, ratio.scenario, ratio.worlds, ratio.rounds) == ("core", "play", 4, 3)


def test_every_second_round_goes_backward() -> None:
    order: list[str] = []
    measure([benchmark(order)], 3, 0.1, lambda _: None)
    assert order == ["fast", "slow", "slow", "fast", "fast", "slow"]


def test_progress_is_logged() -> None:
    messages: list[str] = []
    measure([benchmark([])], 2, 0.1, messages.append)
    assert messages == [
        *("preparing, core: play", "round 1 of 2, core: play", "round 2 of 2, core: play"),
    ]


def test_unavailable_benchmarks_are_skipped() -> None:
    def start() -> Measure:
        raise UnavailableError("too little memory")

    messages: list[str] = []
    huge = Benchmark("capacity", "play", (Variant("huge", 9, 1, start),))
    figures = measure([huge, benchmark([])], 1, 0.1, messages.append)
    assert {figure.group for figure in figures} == {"core"}
    assert "skipped, capacity: play: too little memory" in messages


def test_benchmarks_are_selected_by_title() -> None:
    one, other = benchmark([]), Benchmark("memory", "Play", ())
    assert select([one, other], "CORE") == [one]
    assert select([one, other], "play") == [one, other]
    with pytest.raises(ValueError, match=r"(?s)'nobody' in its title.*core: play.*memory: Play"):
        select([one, other], "nobody")


def test_at_least_one_call_is_measured() -> None:
    called: list[int] = []
    assert calls_per_second(lambda: called.append(1), 0.0) > 0
    assert len(called) == 1


def test_a_benchmark_without_repeats_is_measured_in_the_first_round() -> None:
    order: list[str] = []
    once = dataclasses.replace(benchmark(order), repeats=False)
    figures = measure([once], 3, 0.1, lambda _: None)
    assert order == ["fast", "slow"]
    assert {figure.rounds for figure in figures} == {1}


def test_a_ratio_of_two_engines_has_both_names() -> None:
    fast, slow = benchmark([]).variants
    pairs = {"compact": "compact", "rapier": "compact / rapier", "": "compact"}
    for engine, expected in pairs.items():
        variants = (
            dataclasses.replace(fast, engine="compact"),
            dataclasses.replace(slow, engine=engine),
        )
        made = dataclasses.replace(benchmark([]), variants=variants)
        rounds = [[{SPEED: 4.0}, {SPEED: 2.0}]]
        *speeds, ratio = summarize(made, rounds)
        assert [figure.engine for figure in speeds] == ["compact", engine]
        assert (ratio.engine, ratio.median) == (expected, 2.0)


def test_the_simulated_time_is_added() -> None:
    values = with_match_time(lambda _: {SPEED: 400.0}, 0.025)(1.0)
    assert values == {SPEED: 400.0, MATCH_TIME: 10.0}

"""Results of the speed measurements that need no table."""

from collections.abc import Callable, Sequence
from itertools import groupby

from benches.process_cost import BUILD_TIME, PROCESS_MEMORY
from benches.result_files import Figure, format_number
from benches.scenarios import DEFAULT_ENGINE, ENGINES
from benches.thread_scaling import TIMED
from tools.speed.figures import OTHER_ENGINE, SPEED, ratio


def remarks(figures: Sequence[Figure]) -> str:
    """Return results that need no table, as a list."""
    groups: dict[str, Callable[[list[Figure]], str]] = {
        "threads": _threads,
        "scaling": _scaling,
        "memory": _memory,
        "capacity": _capacity,
        "startup": _startup,
    }
    found = []
    for group, describe in groups.items():
        if mine := [figure for figure in figures if figure.group == group]:
            found.append(f"- {describe(mine)}")
    return "\n".join(found)


def _threads(figures: list[Figure]) -> str:
    ratios = {f.variant.split(" / ")[0]: f for f in figures if f.quantity == "ratio"}
    shared, separate, hashing = (
        ratio(ratios[name]) for name in ("Simulator", "Simulators, one per thread", "hashing")
    )
    worlds = ratios["Simulator"].worlds
    return (
        f"Speed-up by a second thread with {worlds:,} worlds ({_timed_steps(figures)}): {shared}. "
        f"Upper bounds on this machine: {separate} for two simulators that share nothing, "
        f"{hashing} for hashing."
    )


def _scaling(figures: list[Figure]) -> str:
    base = min(figure.worlds for figure in figures)
    listed = {
        engine: ", ".join(
            f"{f.median:.2f}x at {f.worlds:,}"
            for f in figures
            if (f.quantity, f.engine) == ("ratio", engine)
        )
        for engine in ENGINES
    }
    text = (
        f"Speed of a batch relative to {base} worlds ({_timed_steps(figures)}): "
        f"{listed[DEFAULT_ENGINE]} worlds"
    )
    if listed[OTHER_ENGINE]:
        text += f"; with `{OTHER_ENGINE}` {listed[OTHER_ENGINE]}"
    return f"{text}."


def _timed_steps(figures: Sequence[Figure]) -> str:
    """Return scenario and timed steps, for batches too large for complete episodes."""
    return f"{figures[0].scenario}, steps {TIMED.start} to {TIMED.stop}"


def _memory(figures: list[Figure]) -> str:
    parts = []
    for scenario, group in groupby(figures, key=lambda figure: figure.scenario):
        by_engine = {f.engine: format_number(f.median, 2) for f in group}
        if DEFAULT_ENGINE not in by_engine:
            continue
        text = f"{by_engine[DEFAULT_ENGINE]} KiB for {scenario}"
        if OTHER_ENGINE in by_engine:
            text += f" ({by_engine[OTHER_ENGINE]} KiB with `{OTHER_ENGINE}`)"
        parts.append(text)
    return f"Memory of a world that has had contacts: {' and '.join(parts)}."


def _capacity(figures: list[Figure]) -> str:
    by_quantity = {figure.quantity: figure for figure in figures}
    speed = by_quantity[SPEED]
    build = format_number(by_quantity[BUILD_TIME.name].median, 2)
    memory = format_number(by_quantity[PROCESS_MEMORY.name].median, 2)
    return (
        f"{speed.worlds:,} worlds ({speed.scenario}) in one process on {speed.threads} threads: "
        f"build time {build} s, process memory {memory} GiB after first contacts, "
        f"{format_number(speed.median)} steps per second."
    )


def _startup(figures: list[Figure]) -> str:
    listed = ", ".join(f"{f.quantity} {format_number(f.median, 2)} s" for f in figures)
    return f"Start-up in a fresh process: {listed}."

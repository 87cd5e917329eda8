"""Speed in README.md and docs/speed.md, generated from the tables of `make bench`."""

from collections.abc import Callable, Sequence
from itertools import groupby

from benches.process_cost import BUILD_TIME, PROCESS_MEMORY
from benches.result_files import RESULTS, Figure, Machine, format_number, format_ratio, load
from benches.thread_scaling import TIMED
from tools.markdown import table
from tools.paths import ROOT

SPEED = "speed"
MEANING = (
    "A step is 25 ms of a match in five physics ticks. In random play commands change every ten "
    "steps; in a crowd all robots drive at the ball. Speed-ups are relative to rSim, the "
    "simulator of robocin's rSoccer, run in turn in the same process (slowest and fastest round in "
    "brackets)."
)
MORE = (
    "[Speed](docs/speed.md) has the measurements of complete environments, threads, memory and "
    "VMAS, and the advice that follows from them. `make bench` measures your machine."
)
FEATURE = "**Speed.**"
"""Start of the sentence on speed in docs/index.md."""
FEATURE_SCENARIO = "VSSS 3 v 3 random"
INTERFACES = {
    "Matches": "`Matches`",
    "ParallelEnv": "PettingZoo, `parallel_env`",
    "AECEnv": "PettingZoo, `env`",
    "no-op ParallelEnv": "no-op ParallelEnv of equal shape",
    "Env": "Gymnasium, `single_env`",
    "no-op Env": "no-op Env of equal shape",
    "VectorEnv": "Gymnasium, `vector_env`",
    "trainer": "trainer, decisions",
}


def speed() -> str:
    """Return the results of every measured machine."""
    return "\n\n".join(
        machine_speed(path.stem, *load(path)) for path in sorted(RESULTS.glob("*.csv"))
    )


def summary() -> str:
    """Return the physics speed of every measured machine, and a link to the rest."""
    parts = []
    for path in sorted(RESULTS.glob("*.csv")):
        machine, figures = load(path)
        parts.append(f"{_source(machine, figures)} {MEANING}\n\n{physics_table(figures)}")
    return "\n\n".join([*parts, MORE])


def feature() -> str:
    """Return the speed of a VSSS match in one sentence, from the first measured machine."""
    more = "[Speed](speed.md) explains the cost of a step."
    for path in sorted(RESULTS.glob("*.csv")):
        machine, figures = load(path)
        core = [f for f in figures if (f.group, f.scenario) == ("core", FEATURE_SCENARIO)]
        single = {f.variant: f for f in core if f.worlds == 1 and f.quantity in (SPEED, "ratio")}
        if "Simulator" not in single:
            continue
        rate = format_number(single["Simulator"].median, 2)
        text = (
            f"A VSSS match of three against three runs at {rate} steps a second on one thread of "
            f"{machine.machine}"
        )
        if (reference := _reference(core)) and f"Simulator / {reference}" in single:
            times = format_number(single[f"Simulator / {reference}"].median, 2)
            text += (
                f", {times} times as fast as rSim (rc-{reference}), the simulator of rsoccer-gym"
            )
        return f"{FEATURE} {text}. {more}"
    return f"{FEATURE} {more}"


def machine_speed(name: str, machine: Machine, figures: Sequence[Figure]) -> str:
    """Return tables and remarks for one machine; missing measurements are omitted."""
    picture = RESULTS / f"{name}.png"
    image = f"![Speed on this machine](../{picture.relative_to(ROOT)})" if picture.exists() else ""
    intro = _source(machine, figures)
    parts = (intro, image, physics(figures), interfaces(figures), remarks(figures))
    return "\n\n".join(part for part in parts if part)


def _source(machine: Machine, figures: Sequence[Figure]) -> str:
    """Return machine, date and build of the measurements."""
    build = f"{machine.machine}, {machine.cores} cores, {machine.date}, {machine.profile} build"
    rounds = max(figure.rounds for figure in figures)
    return f"{build} of commit {machine.commit}; medians of {rounds} rounds."


def physics(figures: Sequence[Figure]) -> str:
    """Return the table of physics speed, and the description of the comparison with rSim."""
    core = [figure for figure in figures if figure.group == "core"]
    reference = _reference(core)
    return physics_table(figures) + (f"\n\n{comparison(reference, core)}" if reference else "")


def _reference(core: Sequence[Figure]) -> str | None:
    """Return name and version of rSim, if it was measured."""
    return next((f.variant.split(" / ")[1] for f in core if f.quantity == "ratio"), None)


def physics_table(figures: Sequence[Figure]) -> str:
    """Return the table of physics speed by scenario, compared with rSim if that was measured."""
    core = [figure for figure in figures if figure.group == "core"]
    if not core:
        return ""
    reference = _reference(core)
    sizes = sorted({figure.worlds for figure in core})
    header = ["steps per second on one thread"]
    if reference:
        header.append("rSim")
    for worlds in sizes:
        header.append(f"{worlds} worlds" if worlds > 1 else "1 world")
        header += ["speed-up"] if reference else []
    rows = []
    for scenario, group in groupby(core, key=lambda figure: figure.scenario):
        mine = list(group)
        cells = [scenario, *([_cell(mine, reference, 1)] if reference else [])]
        for worlds in sizes:
            cells.append(_cell(mine, "Simulator", worlds))
            cells += [_cell(mine, f"Simulator / {reference}", worlds)] if reference else []
        rows.append(tuple(cells))
    return table(tuple(header), rows)


def comparison(reference: str, core: Sequence[Figure]) -> str:
    """Return the description of the comparison with rSim."""
    interface = [f for f in core if f.variant == f"compat.robosim / {reference}"]
    slowest = min((figure.median for figure in interface), default=0.0)
    text = (
        f"rSim (rc-{reference}) is the simulator of robocin's rSoccer, built here in its own "
        "release mode. Both simulators run in turn in the same process, with the same "
        "teams, fields, starts and kinds of command, and steps of 25 ms in five ticks. "
        "A simulator with one world runs the starts of the larger batch one after the other, as "
        "far as time permits. Ratios are medians over rounds, with the slowest and the fastest "
        "round in brackets. Every round has different starts, and this machine is small and shared."
    )
    if not interface:
        return text
    gain = f"at least {format_number(slowest, 2)}x as fast"
    return f"{text} Code that only replaces its import by `compat.robosim` runs {gain}."


def interfaces(figures: Sequence[Figure]) -> str:
    """Return the table of complete environments."""
    rates = [
        f for f in figures if f.group in ("batched", "single", "training") and f.quantity == SPEED
    ]
    if not rates:
        return ""
    rows = [_interface_row(figure, figures) for figure in rates]
    header = (
        "environment",
        "task",
        "worlds",
        "threads",
        "steps per second",
        "time outside physics",
    )
    return table(header, rows) + football(figures)


def football(figures: Sequence[Figure]) -> str:
    """Return the comparison of `Matches` with VMAS at its faster number of threads, if measured."""
    ratios = [f for f in figures if f.variant.startswith("Matches / vmas")]
    if not ratios:
        return ""
    sizes = sorted({figure.worlds for figure in ratios})
    closest = [min((f for f in ratios if f.worlds == n), key=lambda f: f.median) for n in sizes]
    listed = ", ".join(f"{ratio(f)} at {f.worlds:,} worlds" for f in closest)
    vmas = ratios[0].variant.split(" / ")[1]
    return (
        f"\n\nSpeed of `Matches` on two threads relative to {vmas}'s football on one or two "
        f"threads (the faster one), with three robots a side, all controlled: {listed}. A step of "
        "football is 0.1 s in two ticks."
    )


def _interface_row(figure: Figure, figures: Sequence[Figure]) -> tuple[str, ...]:
    task = "football" if figure.variant.startswith("vmas") else f"`{figure.scenario}`"
    key = (figure.group, figure.scenario, figure.variant, figure.worlds, figure.threads)
    outside = [
        f"{format_number(f.median, 2)} us per world-step"
        for f in figures
        if (f.group, f.scenario, f.variant, f.worlds, f.threads) == key
        and f.quantity == "time outside physics"
    ]
    return (
        INTERFACES.get(figure.variant, figure.variant),
        task,
        f"{figure.worlds:,}",
        str(figure.threads),
        format_number(figure.median),
        *(outside or [""]),
    )


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
    ratios = [f for f in figures if f.quantity == "ratio"]
    base = min(figure.worlds for figure in figures)
    listed = ", ".join(f"{f.median:.2f}x at {f.worlds:,}" for f in ratios)
    return f"Speed of a batch relative to {base} worlds ({_timed_steps(figures)}): {listed} worlds."


def _timed_steps(figures: Sequence[Figure]) -> str:
    """Return scenario and timed steps, for batches too large for complete episodes."""
    return f"{figures[0].scenario}, steps {TIMED.start} to {TIMED.stop}"


def _memory(figures: list[Figure]) -> str:
    listed = " and ".join(f"{format_number(f.median, 2)} KiB for {f.scenario}" for f in figures)
    return f"Memory of a world that has had contacts: {listed}."


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


def ratio(figure: Figure) -> str:
    """Format a ratio with minimum and maximum."""
    minimum, maximum = format_ratio(figure.minimum), format_ratio(figure.maximum)
    return f"{format_ratio(figure.median)} ({minimum} to {maximum})"


def _cell(figures: Sequence[Figure], variant: str | None, worlds: int) -> str:
    """Return a speed or ratio for a table cell; empty if not measured."""
    for figure in figures:
        if (figure.variant, figure.worlds) != (variant, worlds):
            continue
        if figure.quantity in (SPEED, "ratio"):
            return ratio(figure) if figure.quantity == "ratio" else format_number(figure.median)
    return ""

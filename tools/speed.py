"""Speed in README.md and docs/speed.md, generated from the tables of `make bench`."""

from collections.abc import Callable, Sequence
from itertools import groupby

from benches.instructions import STORED
from benches.interfaces import OUTSIDE
from benches.markdown import table
from benches.measuring import MATCH_TIME
from benches.process_cost import BUILD_TIME, PROCESS_MEMORY
from benches.result_files import RESULTS, Figure, Machine, format_number, format_ratio, load
from benches.scenarios import DEFAULT_ENGINE, ENGINES
from benches.thread_scaling import TIMED
from benches.whole_matches import STORED as WHOLE_MATCHES
from tools.paths import ROOT

SPEED = "speed"
OTHER_ENGINE = ENGINES[1]
BY_ENGINE = "compact / rapier"
"""Engine of a ratio of both."""
MEANING = (
    "A step is 25 ms of a match in five physics ticks. In random play commands change every ten "
    "steps; in a crowd all robots drive at the ball. Speed-ups are relative to rSim, the "
    "simulator of robocin's rSoccer, run in turn in the same process (slowest and fastest round in "
    "brackets). The contact engine is the default, `{}`."
)
MORE = (
    "[Speed](docs/speed.md) has the measurements of complete environments, threads, memory, VMAS "
    "and pSim, and the advice that follows from them. `make bench` measures your machine."
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
    "examples/13_ppo.py": "`examples/13_ppo.py`, decisions",
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
        intro = f"{_source(machine, figures)} {MEANING.format(DEFAULT_ENGINE)}"
        parts.append(f"{intro}\n\n{physics_table(figures)}")
    return "\n\n".join([*parts, MORE])


def instructions() -> str:
    """Return the table of instructions per tick; empty if they were not counted."""
    return STORED.read_text() if STORED.exists() else ""


def whole_matches() -> str:
    """Return the tables of whole matches under a referee; empty if they were not measured."""
    return WHOLE_MATCHES.read_text() if WHOLE_MATCHES.exists() else ""


def feature() -> str:
    """Return the speed of a VSSS match in one sentence, from the first measured machine."""
    more = "[Speed](speed.md) explains the cost of a step."
    for path in sorted(RESULTS.glob("*.csv")):
        machine, figures = load(path)
        core = [f for f in of_default(figures, "core") if f.scenario == FEATURE_SCENARIO]
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
    core = of_default(figures, "core")
    reference = _reference(core)
    parts = (
        physics_table(figures),
        comparison(reference, core) if reference else "",
        other_engine(figures),
    )
    return "\n\n".join(part for part in parts if part)


def of_default(figures: Sequence[Figure], group: str) -> list[Figure]:
    """Return the figures of a group without those of the engine that is not the default."""
    return [f for f in figures if f.group == group and f.engine in ("", DEFAULT_ENGINE)]


def _reference(core: Sequence[Figure]) -> str | None:
    """Return name and version of rSim, if it was measured."""
    return next((f.variant.split(" / ")[1] for f in core if f.quantity == "ratio"), None)


def physics_table(figures: Sequence[Figure]) -> str:
    """Return the table of physics speed by scenario, compared with rSim if that was measured."""
    core = of_default(figures, "core")
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


def other_engine(figures: Sequence[Figure]) -> str:
    """Return the table of the engine that is not the default, if it was measured."""
    core = [f for f in figures if f.group == "core" and f.engine in (OTHER_ENGINE, BY_ENGINE)]
    if not core:
        return ""
    reference = _reference([f for f in core if f.engine == OTHER_ENGINE])
    sizes = sorted({figure.worlds for figure in core})
    header = ["steps per second on one thread"]
    for worlds in sizes:
        header.append(f"`{OTHER_ENGINE}`, {worlds} worlds" if worlds > 1 else f"`{OTHER_ENGINE}`")
        header += ["relative to rSim"] if reference else []
        header.append("`compact` / `rapier`")
    rows = []
    for scenario, group in groupby(core, key=lambda figure: figure.scenario):
        mine = list(group)
        cells = [scenario]
        for worlds in sizes:
            cells.append(_cell(mine, "Simulator", worlds))
            cells += [_cell(mine, f"Simulator / {reference}", worlds)] if reference else []
            cells.append(_cell(mine, "Simulator / Simulator", worlds))
        rows.append(tuple(cells))
    text = (
        f"The table above is for the default contact engine, `{DEFAULT_ENGINE}`. The other one, "
        f"`{OTHER_ENGINE}`, was measured in the same rounds:"
    )
    return f"{text}\n\n{table(tuple(header), rows)}"


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
    rows = [_interface_row(figure, figures) for figure in rates if figure.engine != OTHER_ENGINE]
    header = (
        "environment",
        "task",
        "worlds",
        "threads",
        "steps per second",
        f"with `{OTHER_ENGINE}`",
        "`compact` / `rapier`",
        "time outside physics",
    )
    return "\n\n".join(
        part for part in (table(header, rows), football(figures), psim(figures)) if part
    )


def football(figures: Sequence[Figure]) -> str:
    """Return the comparison of `Matches` with VMAS at its faster number of threads, if measured."""
    ratios = [f for f in figures if f.variant.startswith("Matches / vmas")]
    listed = {}
    for engine in ENGINES:
        mine = [figure for figure in ratios if figure.engine == engine]
        sizes = sorted({figure.worlds for figure in mine})
        closest = [min((f for f in mine if f.worlds == n), key=lambda f: f.median) for n in sizes]
        listed[engine] = ", ".join(f"{ratio(f)} at {f.worlds:,} worlds" for f in closest)
    if not listed[DEFAULT_ENGINE]:
        return ""
    vmas = ratios[0].variant.split(" / ")[1]
    text = (
        f"Speed of `Matches` on two threads relative to {vmas}'s football on one or two "
        f"threads (the faster one), with three robots a side, all controlled: "
        f"{listed[DEFAULT_ENGINE]}"
    )
    if listed[OTHER_ENGINE]:
        text += f"; with `{OTHER_ENGINE}` {listed[OTHER_ENGINE]}"
    return f"{text}. A step of football is 0.1 s in two ticks."


def psim(figures: Sequence[Figure]) -> str:
    """Return the comparison of one match with pSim, if that was measured."""
    ratios = {f.variant.split(" / ")[0]: f for f in figures if " / pSim" in f.variant}
    if not ratios:
        return ""
    [scenario] = {figure.scenario for figure in ratios.values()}
    name = ratios["ParallelEnv"].variant.split(" / ")[1]
    times = {
        f.variant: format_number(f.median)
        for f in figures
        if f.scenario == scenario and f.quantity == MATCH_TIME.name
    }
    return (
        f"{name} simulates VSSS on Box2D for PettingZoo, here with three learners against three "
        f"robots of noise, as in `{scenario}`. Its step is one tick of 16.7 ms, a step here "
        f"25 ms in five ticks. `parallel_env` takes {ratio(ratios['ParallelEnv'])} as many steps "
        f"a second, `Matches` with one world {ratio(ratios['Matches'])}. Seconds of play "
        f"simulated per second: {times['ParallelEnv']} in `parallel_env`, {times['Matches']} in "
        f"`Matches`, {times[name]} in pSim."
    )


def _interface_row(figure: Figure, figures: Sequence[Figure]) -> tuple[str, ...]:
    """Return the cells of an environment: figures of the default engine, then of the other."""
    name = figure.variant
    case = [f for f in figures if _case(f) == _case(figure)]
    mine = [f for f in case if (f.variant, f.engine) == (name, figure.engine)]
    other = [f for f in case if (f.variant, f.engine) == (name, OTHER_ENGINE)]
    both = [f for f in case if (f.variant, f.engine) == (f"{name} / {name}", BY_ENGINE)]
    outside = [f for f in mine if f.quantity == OUTSIDE.name]
    return (
        INTERFACES.get(name, name),
        _task(figure),
        f"{figure.worlds:,}",
        str(figure.threads),
        format_number(figure.median),
        next((format_number(f.median) for f in other if f.quantity == SPEED), ""),
        next((ratio(f) for f in both), ""),
        next((f"{format_number(f.median, 2)} us per world-step" for f in outside), ""),
    )


def _task(figure: Figure) -> str:
    """Return the id of the task; the name of a third-party simulator's own."""
    theirs = {"vmas": "football", "pSim": "VSSS 3 v 3"}
    return theirs.get(figure.variant.split(" ")[0], f"`{figure.scenario}`")


def _case(figure: Figure) -> tuple[str, str, int, int]:
    return figure.group, figure.scenario, figure.worlds, figure.threads


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

"""Speed of the physics: the table by scenario, of both engines, and its comparison with rSim."""

from collections.abc import Sequence
from itertools import groupby

from benches.markdown import table
from benches.result_files import Figure, format_number
from benches.scenarios import DEFAULT_ENGINE
from tools.speed.figures import BY_ENGINE, OTHER_ENGINE, cell, of_default


def physics(figures: Sequence[Figure]) -> str:
    """Return the table of physics speed, and the description of the comparison with rSim."""
    core = of_default(figures, "core")
    reference = reference_of(core)
    parts = (
        physics_table(figures),
        comparison(reference, core) if reference else "",
        other_engine(figures),
    )
    return "\n\n".join(part for part in parts if part)


def reference_of(core: Sequence[Figure]) -> str | None:
    """Return name and version of rSim, if it was measured."""
    return next((f.variant.split(" / ")[1] for f in core if f.quantity == "ratio"), None)


def physics_table(figures: Sequence[Figure]) -> str:
    """Return the table of physics speed by scenario, compared with rSim if that was measured."""
    core = of_default(figures, "core")
    if not core:
        return ""
    reference = reference_of(core)
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
        cells = [scenario, *([cell(mine, reference, 1)] if reference else [])]
        for worlds in sizes:
            cells.append(cell(mine, "Simulator", worlds))
            cells += [cell(mine, f"Simulator / {reference}", worlds)] if reference else []
        rows.append(tuple(cells))
    return table(tuple(header), rows)


def other_engine(figures: Sequence[Figure]) -> str:
    """Return the table of the engine that is not the default, if it was measured."""
    core = [f for f in figures if f.group == "core" and f.engine in (OTHER_ENGINE, BY_ENGINE)]
    if not core:
        return ""
    reference = reference_of([f for f in core if f.engine == OTHER_ENGINE])
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
            cells.append(cell(mine, "Simulator", worlds))
            cells += [cell(mine, f"Simulator / {reference}", worlds)] if reference else []
            cells.append(cell(mine, "Simulator / Simulator", worlds))
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

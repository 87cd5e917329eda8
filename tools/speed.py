"""The README's part on speed, from the tables that `make bench` left."""

from collections.abc import Callable, Sequence
from itertools import groupby

from benches.fresh import BUILT, HOSTED
from benches.sharing import TIMED
from benches.table import RESULTS, ROOT, Figure, Machine, digits, load, times
from tools.parts import table

SPEED = "speed"
DOORS = {
    "Matches": "`Matches`",
    "ParallelEnv": "PettingZoo, `parallel_env`",
    "AECEnv": "PettingZoo, `env`",
    "empty ParallelEnv": "an empty ParallelEnv of that shape",
    "Env": "Gymnasium, `single_env`",
    "empty Env": "an empty Env of that shape",
    "VectorEnv": "Gymnasium, `vector_env`",
    "trainer": "the trainer, in decisions",
}


def speed() -> str:
    """What each measured machine does."""
    return "\n\n".join(
        machine_speed(path.stem, *load(path)) for path in sorted(RESULTS.glob("*.csv"))
    )


def machine_speed(name: str, machine: Machine, figures: Sequence[Figure]) -> str:
    """Tables and facts of one machine; what was not measured is left out."""
    place = f"{machine.machine}, {machine.cores} cores, {machine.date}, {machine.profile} build"
    rounds = max(figure.rounds for figure in figures)
    picture = RESULTS / f"{name}.png"
    shown = f"![Speed on this machine]({picture.relative_to(ROOT)})" if picture.exists() else ""
    intro = f"{place} of commit {machine.commit}; medians of {rounds} rounds."
    parts = (intro, shown, physics(figures), doors(figures), facts(figures))
    return "\n\n".join(part for part in parts if part)


def physics(figures: Sequence[Figure]) -> str:
    """The simulator alone, by game, beside the old one where that was measured."""
    core = [figure for figure in figures if figure.group == "core"]
    if not core:
        return ""
    old = next((f.who.split(" / ")[1] for f in core if f.quantity == "ratio"), None)
    sizes = sorted({figure.worlds for figure in core})
    header = ["steps a second on one thread"]
    if old:
        header.append(old)
    for worlds in sizes:
        header.append(f"{worlds} at once" if worlds > 1 else "one match")
        header += ["times as fast"] if old else []
    rows = []
    for game, group in groupby(core, key=lambda figure: figure.game):
        mine = list(group)
        cells = [game, *([_cell(mine, old, 1)] if old else [])]
        for worlds in sizes:
            cells.append(_cell(mine, "Simulator", worlds))
            cells += [_cell(mine, f"Simulator / {old}", worlds)] if old else []
        rows.append(tuple(cells))
    return table(tuple(header), rows) + (f"\n\n{beside(old, core)}" if old else "")


def beside(old: str, core: Sequence[Figure]) -> str:
    """How the comparison was made."""
    interface = [f for f in core if f.who == f"compat.robosim / {old}"]
    slowest = min((figure.median for figure in interface), default=0.0)
    text = (
        f"{old} is the simulator of robocin's rSoccer (package rc-robosim), built here in its own "
        "release mode and stepped in the same process, round about with ours: the same teams and "
        "fields, starts (who plays one match at a time plays those of the many one after the "
        "other, as far as the time goes) and kinds of command, 25 ms a step in five ticks. Ratios "
        "are medians over rounds (slowest and fastest round in brackets): every round has other "
        "starts, and this machine is small and does other things besides."
    )
    if not interface:
        return text
    gain = f"{digits(slowest, 2)}x or more"
    return f"{text} Code that only changes its import to `compat.robosim` runs {gain} as fast."


def doors(figures: Sequence[Figure]) -> str:
    """Whole environments."""
    rates = [f for f in figures if f.group in ("many", "one", "training") and f.quantity == SPEED]
    if not rates:
        return ""
    rows = [_door(figure, figures) for figure in rates]
    header = ("whole environments", "task", "at once", "threads", "steps a second", "not physics")
    return table(header, rows) + football(figures)


def football(figures: Sequence[Figure]) -> str:
    """`Matches` beside VMAS at its better number of threads, where that was measured."""
    ratios = [f for f in figures if f.who.startswith("Matches / vmas")]
    if not ratios:
        return ""
    sizes = sorted({figure.worlds for figure in ratios})
    closest = [min((f for f in ratios if f.worlds == n), key=lambda f: f.median) for n in sizes]
    told = ", ".join(f"{ratio(f)} at {f.worlds:,}" for f in closest)
    peer = ratios[0].who.split(" / ")[1]
    return (
        f"\n\nSteps of `Matches` on two threads by those of {peer}'s football on one or two, "
        f"whichever is faster, three a side, all six robots controlled: {told}. A step of football "
        "is 0.1 s in two ticks."
    )


def _door(figure: Figure, figures: Sequence[Figure]) -> tuple[str, ...]:
    task = "football" if figure.who.startswith("vmas") else f"`{figure.game}`"
    key = (figure.group, figure.game, figure.who, figure.worlds, figure.threads)
    outside = [
        f"{digits(f.median, 2)} us a world-step"
        for f in figures
        if (f.group, f.game, f.who, f.worlds, f.threads) == key and f.quantity == "outside physics"
    ]
    return (
        DOORS.get(figure.who, figure.who),
        task,
        f"{figure.worlds:,}",
        str(figure.threads),
        digits(figure.median),
        *(outside or [""]),
    )


def facts(figures: Sequence[Figure]) -> str:
    """What needs no table, as a list."""
    groups: dict[str, Callable[[list[Figure]], str]] = {
        "threads": _threads,
        "growth": _growth,
        "memory": _memory,
        "hosting": _hosting,
        "start": _start,
    }
    found = []
    for group, told in groups.items():
        if mine := [figure for figure in figures if figure.group == group]:
            found.append(f"- {told(mine)}")
    return "\n".join(found)


def _threads(figures: list[Figure]) -> str:
    ratios = {f.who.split(" / ")[0]: f for f in figures if f.quantity == "ratio"}
    ours, beside, hashing = (
        ratio(ratios[who]) for who in ("Simulator", "Simulators, one a thread", "hashing")
    )
    worlds = ratios["Simulator"].worlds
    return (
        f"Two threads step {worlds:,} worlds ({_opening(figures)}) {ours} as fast as one. This "
        f"machine's own ceiling: {beside} for two simulators that share nothing, {hashing} for "
        "hashing."
    )


def _growth(figures: list[Figure]) -> str:
    ratios = [f for f in figures if f.quantity == "ratio"]
    base = min(figure.worlds for figure in figures)
    told = ", ".join(f"{f.median:.2f}x at {f.worlds:,}" for f in ratios)
    return f"Steps a second of a batch, by those at {base} worlds ({_opening(figures)}): {told}."


def _opening(figures: Sequence[Figure]) -> str:
    """What is played where many worlds are: too many for whole episodes."""
    return f"{figures[0].game}, steps {TIMED.start} to {TIMED.stop} of it"


def _memory(figures: list[Figure]) -> str:
    told = " and ".join(f"{digits(f.median, 2)} KiB for {f.game}" for f in figures)
    return f"Memory of a world that has seen contacts: {told}."


def _hosting(figures: list[Figure]) -> str:
    told = {figure.quantity: figure for figure in figures}
    one = told[SPEED]
    return (
        f"{one.worlds:,} worlds ({one.game}) in one process, on {one.threads} threads: built in "
        f"{digits(told[BUILT.name].median, 2)} s, {digits(told[HOSTED.name].median, 2)} GiB of "
        f"memory in all once some touch, {digits(one.median)} steps a second."
    )


def _start(figures: list[Figure]) -> str:
    told = ", ".join(f"{f.quantity} {digits(f.median, 2)} s" for f in figures)
    return f"Start, in a fresh process: {told}."


def ratio(figure: Figure) -> str:
    """A ratio with its extremes."""
    return f"{times(figure.median)} ({times(figure.least)} to {times(figure.most)})"


def _cell(figures: Sequence[Figure], who: str | None, worlds: int) -> str:
    """Speed or ratio in a table; empty where not measured."""
    for figure in figures:
        if (figure.who, figure.worlds) == (who, worlds) and figure.quantity in (SPEED, "ratio"):
            return ratio(figure) if figure.quantity == "ratio" else digits(figure.median)
    return ""

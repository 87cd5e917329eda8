"""Speed in README.md and docs/speed.md, generated from the tables of `make bench`."""

from collections.abc import Sequence

from benches.instructions import STORED
from benches.result_files import RESULTS, Figure, Machine, format_number, load
from benches.scenarios import DEFAULT_ENGINE
from benches.training_speed import STORED as TRAINING_SPEED
from benches.whole_matches import STORED as WHOLE_MATCHES
from tools.paths import ROOT
from tools.speed.environments import interfaces
from tools.speed.figures import SPEED, of_default
from tools.speed.physics import physics, physics_table, reference_of
from tools.speed.remarks import remarks

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


def training_speed() -> str:
    """Return the table of the trainer's speed; empty if it was not measured."""
    return TRAINING_SPEED.read_text() if TRAINING_SPEED.exists() else ""


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
        if (reference := reference_of(core)) and f"Simulator / {reference}" in single:
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

"""Speed of complete environments, and their comparison with VMAS and pSim."""

from collections.abc import Sequence

from benches.interfaces import OUTSIDE
from benches.markdown import table
from benches.measuring import MATCH_TIME
from benches.result_files import Figure, format_number
from benches.scenarios import DEFAULT_ENGINE, ENGINES
from tools.speed.figures import BY_ENGINE, OTHER_ENGINE, SPEED, ratio

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

"""Speed through other libraries in docs/libraries.md, generated from the tables of `make bench`."""

from collections.abc import Sequence

from benches.markdown import table
from benches.result_files import RESULTS, Figure, format_number, load
from tools.speed.figures import SPEED, ratio

NOT_MEASURED = "`make bench` measures the libraries that are installed."
HEADER = ("through", "task", "worlds", "world-steps per second", "relative to `Matches`")


def libraries() -> str:
    """Return a table for each measured machine; without measurements a sentence."""
    parts = []
    for path in sorted(RESULTS.glob("*.csv")):
        machine, figures = load(path)
        if rows := library_rows(figures):
            intro = f"{machine.machine}, one thread, {machine.date}, commit {machine.commit}:"
            parts.append(f"{intro}\n\n{table(HEADER, rows)}")
    return "\n\n".join(parts) or NOT_MEASURED


def library_rows(figures: Sequence[Figure]) -> list[tuple[str, ...]]:
    """Return a row for each ratio to `Matches`."""
    mine = [figure for figure in figures if figure.group == "libraries"]
    speeds = {(f.variant, f.scenario, f.worlds): f for f in mine if f.quantity == SPEED}
    rows: list[tuple[str, ...]] = []
    for figure in mine:
        if figure.quantity == "ratio":
            name = figure.variant.split(" / ")[0]
            rate = speeds[name, figure.scenario, figure.worlds].median
            worlds = str(figure.worlds)
            rows.append((name, f"`{figure.scenario}`", worlds, format_number(rate), ratio(figure)))
    return rows

"""Bar charts of a table: speed relative to rSim, and speed of every interface.

Bars are figures of the default contact engine, diamonds of the other.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from benches.result_files import Figure, Machine, format_number, format_ratio
from benches.scenarios import DEFAULT_ENGINE, ENGINES

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SINGLE, BATCH, THIRD_PARTY, NOOP = "#1f6f8b", "#7fb7c9", "#c8553d", "#b8bcc2"
OTHER: Final = "#d9a441"  # marker of the engine that is not the default
BAR: Final = 0.38  # width of a bar, relative to the distance of two scenarios
ROW: Final = 0.26  # inches per bar
WORLDS: Final = "world-steps/s"


def draw(figures: Sequence[Figure], machine: Machine, path: Path) -> Path | None:
    """Write the PNG file and return its path; None without matplotlib or without figures."""
    try:
        from matplotlib.figure import Figure as Canvas
    except ImportError:
        return None
    default, other = ENGINES
    charts = []
    for draw_chart, select in ((_ratios, core_ratios), (_rates, environment_rates)):
        if shown := select(figures, default):
            charts.append((draw_chart, shown, select(figures, other)))
    if not charts:
        return None
    sizes = [1.1 + ROW * rows(shown) for _, shown, _ in charts]
    canvas = Canvas(figsize=(8.0, sum(sizes) + 0.4), dpi=110, layout="constrained")
    grid = canvas.add_gridspec(len(charts), 1, height_ratios=sizes)
    for number, (draw_chart, shown, others) in enumerate(charts):
        draw_chart(canvas.add_subplot(grid[number]), shown, others)
    caption = f"{machine.machine}, {machine.cores} cores, {machine.date}, commit {machine.commit}"
    canvas.supxlabel(caption, fontsize=8, color="#555555")
    canvas.savefig(path)
    return path


def rows(shown: Sequence[Figure]) -> float:
    """Return the height of a chart in bars."""
    return len({(f.scenario, f.variant, f.worlds, f.threads) for f in shown})


def core_ratios(figures: Sequence[Figure], engine: str = DEFAULT_ENGINE) -> list[Figure]:
    """Return the ratios of `Simulator` with an engine to rSim."""
    return [
        figure
        for figure in figures
        if (figure.group, figure.quantity, figure.engine) == ("core", "ratio", engine)
        and figure.variant.startswith("Simulator /")
    ]


def environment_rates(figures: Sequence[Figure], engine: str = DEFAULT_ENGINE) -> list[Figure]:
    """Return the speeds of complete environments with an engine.

    Environments without an engine, third-party ones included, are with those of the default.
    """
    engines = (engine, "") if engine == DEFAULT_ENGINE else (engine,)
    groups = ("single", "batched")
    return [f for f in figures if f.group in groups and f.unit == WORLDS and f.engine in engines]


def _ratios(axes: "Axes", ratios: list[Figure], others: list[Figure]) -> None:
    scenarios = list(dict.fromkeys(figure.scenario for figure in ratios))
    for position, worlds in enumerate(sorted({figure.worlds for figure in ratios})):
        shown = [figure for figure in ratios if figure.worlds == worlds]
        heights = [scenarios.index(figure.scenario) + (position - 0.5) * BAR for figure in shown]
        marks = {f.scenario: f.median for f in others if f.worlds == worlds}
        label = "1 world" if worlds == 1 else f"{worlds} worlds"
        widths = [figure.median for figure in shown]
        axes.barh(heights, widths, BAR, color=(SINGLE, BATCH)[position % 2], label=label)
        _mark(axes, [marks.get(figure.scenario) for figure in shown], heights, first=not position)
        for figure, height in zip(shown, heights, strict=True):
            axes.plot(
                [figure.minimum, figure.maximum], [height, height], color="#333333", linewidth=1
            )
            axes.text(
                figure.maximum * 1.06, height, format_ratio(figure.median), va="center", fontsize=8
            )
    reference = ratios[0].variant.split(" / ")[1]
    axes.set(xscale="log", xlim=(1, 10 * max(figure.maximum for figure in ratios)))
    axes.set_yticks(range(len(scenarios)), scenarios)
    axes.invert_yaxis()
    axes.set_title(f"Physics on one thread: speed relative to {reference}", fontsize=11)
    axes.set_xlabel("ratio of steps per second (lines: slowest and fastest round)")
    axes.legend(frameon=False, fontsize=8, loc="upper right")
    _plain(axes)


def _rates(axes: "Axes", rates: list[Figure], others: list[Figure]) -> None:
    heights = range(len(rates))
    marks = {(f.scenario, f.variant, f.worlds, f.threads): f.median for f in others}
    cases = [(f.scenario, f.variant, f.worlds, f.threads) for f in rates]
    _mark(axes, [marks.get(case) for case in cases], heights, first=True)
    colors = [_color(figure.variant) for figure in rates]
    axes.barh(heights, [figure.median for figure in rates], 0.7, color=colors)
    for figure, height in zip(rates, heights, strict=True):
        axes.plot([figure.minimum, figure.maximum], [height, height], color="#333333", linewidth=1)
        axes.text(
            figure.maximum * 1.06, height, format_number(figure.median), va="center", fontsize=8
        )
    axes.set_yticks(heights, [_label(figure) for figure in rates])
    slowest, fastest = min(f.minimum for f in rates), max(f.maximum for f in rates)
    axes.set(xscale="log", xlim=(min(slowest / 2, 100), 4 * fastest))
    axes.invert_yaxis()
    axes.set_title("Complete environments: world-steps per second", fontsize=11)
    axes.set_xlabel("world-steps per second (lines: slowest and fastest round)")
    if others:
        axes.legend(frameon=False, fontsize=8, loc="lower right")
    _plain(axes)


def _mark(
    axes: "Axes", medians: Sequence[float | None], heights: Sequence[float], *, first: bool
) -> None:
    """Mark medians of the engine that is not the default; only the first marks get a label."""
    marked = [(x, height) for x, height in zip(medians, heights, strict=True) if x is not None]
    if marked:
        label = f"engine {ENGINES[1]}" if first else None
        axes.plot(
            *zip(*marked, strict=True),
            "D",
            color=OTHER,
            markersize=4,
            markeredgewidth=0.5,
            markeredgecolor="black",
            label=label,
            zorder=3,
        )


def _label(figure: Figure) -> str:
    """Return variant, scenario, batch size and threads."""
    worlds = f", {figure.worlds:,} worlds" if figure.worlds > 1 else ""
    threads = f", {figure.threads} threads" if figure.threads > 1 else ""
    theirs = {"vmas": "football", "pSim": "VSSS 3 v 3"}
    scenario = theirs.get(figure.variant.split(" ")[0], figure.scenario)
    return f"{figure.variant}, {scenario}{worlds}{threads}"


def _color(variant: str) -> str:
    if variant.startswith("no-op"):
        return NOOP
    return THIRD_PARTY if variant.startswith(("vmas", "pSim")) else SINGLE


def _plain(axes: "Axes") -> None:
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:,.0f}")
    axes.grid(axis="x", alpha=0.25)
    axes.set_axisbelow(True)
    axes.tick_params(axis="y", length=0, labelsize=8)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)

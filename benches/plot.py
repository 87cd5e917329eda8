"""Bar charts of a table: speed relative to rSim, and speed of every interface."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from benches.result_files import Figure, Machine, format_number, format_ratio

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SINGLE, BATCH, THIRD_PARTY, NOOP = "#1f6f8b", "#7fb7c9", "#c8553d", "#b8bcc2"
BAR: Final = 0.38  # width of a bar, relative to the distance of two scenarios
ROW: Final = 0.26  # inches per bar
WORLDS: Final = "world-steps/s"


def draw(figures: Sequence[Figure], machine: Machine, path: Path) -> Path | None:
    """Write the PNG file and return its path; None without matplotlib or without figures."""
    try:
        from matplotlib.figure import Figure as Canvas
    except ImportError:
        return None
    ratios, rates = core_ratios(figures), environment_rates(figures)
    charts = [part for part in ((_ratios, ratios), (_rates, rates)) if part[1]]
    if not charts:
        return None
    sizes = [1.1 + ROW * rows(shown) for _, shown in charts]
    canvas = Canvas(figsize=(8.0, sum(sizes) + 0.4), dpi=110, layout="constrained")
    grid = canvas.add_gridspec(len(charts), 1, height_ratios=sizes)
    for number, (draw_chart, shown) in enumerate(charts):
        draw_chart(canvas.add_subplot(grid[number]), shown)
    caption = f"{machine.machine}, {machine.cores} cores, {machine.date}, commit {machine.commit}"
    canvas.supxlabel(caption, fontsize=8, color="#555555")
    canvas.savefig(path)
    return path


def rows(shown: Sequence[Figure]) -> float:
    """Return the height of a chart in bars."""
    return len({(f.scenario, f.variant, f.worlds, f.threads) for f in shown})


def core_ratios(figures: Sequence[Figure]) -> list[Figure]:
    """Return the ratios of `Simulator` to rSim."""
    return [
        figure
        for figure in figures
        if (figure.group, figure.quantity) == ("core", "ratio")
        and figure.variant.startswith("Simulator /")
    ]


def environment_rates(figures: Sequence[Figure]) -> list[Figure]:
    """Return the speeds of complete environments, third-party ones included."""
    return [f for f in figures if f.group in ("single", "batched") and f.unit == WORLDS]


def _ratios(axes: "Axes", ratios: list[Figure]) -> None:
    scenarios = list(dict.fromkeys(figure.scenario for figure in ratios))
    for position, worlds in enumerate(sorted({figure.worlds for figure in ratios})):
        shown = [figure for figure in ratios if figure.worlds == worlds]
        heights = [scenarios.index(figure.scenario) + (position - 0.5) * BAR for figure in shown]
        label = "1 world" if worlds == 1 else f"{worlds} worlds"
        widths = [figure.median for figure in shown]
        axes.barh(heights, widths, BAR, color=(SINGLE, BATCH)[position % 2], label=label)
        for figure, height in zip(shown, heights, strict=True):
            axes.plot(
                [figure.minimum, figure.maximum], [height, height], color="#333333", linewidth=1
            )
            axes.text(
                figure.maximum * 1.06, height, format_ratio(figure.median), va="center", fontsize=8
            )
    reference = ratios[0].variant.split(" / ")[1]
    axes.set(xscale="log", xlim=(1, 6 * max(figure.maximum for figure in ratios)))
    axes.set_yticks(range(len(scenarios)), scenarios)
    axes.invert_yaxis()
    axes.set_title(f"Physics on one thread: speed relative to {reference}", fontsize=11)
    axes.set_xlabel("ratio of steps per second (lines: slowest and fastest round)")
    axes.legend(frameon=False, fontsize=8, loc="upper right")
    _plain(axes)


def _rates(axes: "Axes", rates: list[Figure]) -> None:
    heights = range(len(rates))
    colours = [_colour(figure.variant) for figure in rates]
    axes.barh(heights, [figure.median for figure in rates], 0.7, color=colours)
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
    _plain(axes)


def _label(figure: Figure) -> str:
    """Return variant, scenario, batch size and threads."""
    worlds = f", {figure.worlds:,} worlds" if figure.worlds > 1 else ""
    threads = f", {figure.threads} threads" if figure.threads > 1 else ""
    scenario = "football" if figure.variant.startswith("vmas") else figure.scenario
    return f"{figure.variant}, {scenario}{worlds}{threads}"


def _colour(variant: str) -> str:
    if variant.startswith("no-op"):
        return NOOP
    return THIRD_PARTY if variant.startswith("vmas") else SINGLE


def _plain(axes: "Axes") -> None:
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:,.0f}")
    axes.grid(axis="x", alpha=0.25)
    axes.set_axisbelow(True)
    axes.tick_params(axis="y", length=0, labelsize=8)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)

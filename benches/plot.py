"""The picture of a table: how many times the old simulator's speed, and what each door gives."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from benches.table import Figure, Machine, digits, times

if TYPE_CHECKING:
    from matplotlib.axes import Axes

OURS, BATCH, OTHERS, EMPTY = "#1f6f8b", "#7fb7c9", "#c8553d", "#b8bcc2"
BAR: Final = 0.38  # of the room between two games
ROW: Final = 0.26  # inches that a bar takes
WORLDS: Final = "world-steps/s"


def draw(figures: Sequence[Figure], machine: Machine, path: Path) -> Path | None:
    """Write the PNG file; nothing where there is nothing to draw, or nothing to draw with."""
    try:
        from matplotlib.figure import Figure as Canvas
    except ImportError:
        return None
    ratios, doors = core_ratios(figures), front_doors(figures)
    sides = [part for part in ((_ratios, ratios), (_doors, doors)) if part[1]]
    if not sides:
        return None
    sizes = [1.1 + ROW * rows(shown) for _, shown in sides]
    canvas = Canvas(figsize=(8.0, sum(sizes) + 0.4), dpi=110, layout="constrained")
    grid = canvas.add_gridspec(len(sides), 1, height_ratios=sizes)
    for number, (side, shown) in enumerate(sides):
        side(canvas.add_subplot(grid[number]), shown)
    where = f"{machine.machine}, {machine.cores} cores, {machine.date}, commit {machine.commit}"
    canvas.supxlabel(where, fontsize=8, color="#555555")
    canvas.savefig(path)
    return path


def rows(shown: Sequence[Figure]) -> float:
    """How many bars high a part of the picture is."""
    return len({(f.game, f.who, f.worlds, f.threads) for f in shown})


def core_ratios(figures: Sequence[Figure]) -> list[Figure]:
    """Ratios of our simulator to the old one."""
    return [
        figure
        for figure in figures
        if (figure.group, figure.quantity) == ("core", "ratio")
        and figure.who.startswith("Simulator /")
    ]


def front_doors(figures: Sequence[Figure]) -> list[Figure]:
    """World-steps per second of whatever plays a whole task, and of its peers."""
    return [f for f in figures if f.group in ("one", "many") and f.unit == WORLDS]


def _ratios(axes: "Axes", ratios: list[Figure]) -> None:
    games = list(dict.fromkeys(figure.game for figure in ratios))
    for place, worlds in enumerate(sorted({figure.worlds for figure in ratios})):
        shown = [figure for figure in ratios if figure.worlds == worlds]
        heights = [games.index(figure.game) + (place - 0.5) * BAR for figure in shown]
        label = "one match" if worlds == 1 else f"{worlds} matches at once"
        widths = [figure.median for figure in shown]
        axes.barh(heights, widths, BAR, color=(OURS, BATCH)[place % 2], label=label)
        for figure, height in zip(shown, heights, strict=True):
            axes.plot([figure.least, figure.most], [height, height], color="#333333", linewidth=1)
            axes.text(figure.most * 1.06, height, times(figure.median), va="center", fontsize=8)
    old = ratios[0].who.split(" / ")[1]
    axes.set(xscale="log", xlim=(1, 6 * max(figure.most for figure in ratios)))
    axes.set_yticks(range(len(games)), games)
    axes.invert_yaxis()
    axes.set_title(f"Physics on one thread: times the speed of {old}", fontsize=11)
    axes.set_xlabel("times as many steps a second (lines: slowest and fastest round)")
    axes.legend(frameon=False, fontsize=8, loc="upper right")
    _plain(axes)


def _doors(axes: "Axes", doors: list[Figure]) -> None:
    heights = range(len(doors))
    colours = [_colour(figure.who) for figure in doors]
    axes.barh(heights, [figure.median for figure in doors], 0.7, color=colours)
    for figure, height in zip(doors, heights, strict=True):
        axes.plot([figure.least, figure.most], [height, height], color="#333333", linewidth=1)
        axes.text(figure.most * 1.06, height, digits(figure.median), va="center", fontsize=8)
    axes.set_yticks(heights, [_label(figure) for figure in doors])
    slowest, fastest = min(f.least for f in doors), max(f.most for f in doors)
    axes.set(xscale="log", xlim=(min(slowest / 2, 100), 4 * fastest))
    axes.invert_yaxis()
    axes.set_title("Whole environments: world-steps a second", fontsize=11)
    axes.set_xlabel("world-steps a second (lines: slowest and fastest round)")
    _plain(axes)


def _label(figure: Figure) -> str:
    """Who, playing what, how many at once."""
    many = f", {figure.worlds:,} at once" if figure.worlds > 1 else ""
    threads = f", {figure.threads} threads" if figure.threads > 1 else ""
    game = "football" if figure.who.startswith("vmas") else figure.game
    return f"{figure.who}, {game}{many}{threads}"


def _colour(who: str) -> str:
    if who.startswith("empty"):
        return EMPTY
    return OTHERS if who.startswith("vmas") else OURS


def _plain(axes: "Axes") -> None:
    axes.xaxis.set_major_formatter(lambda value, _: f"{value:,.0f}")
    axes.grid(axis="x", alpha=0.25)
    axes.set_axisbelow(True)
    axes.tick_params(axis="y", length=0, labelsize=8)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)

"""Measure the speed of rSoccer on this machine: `make bench`, or `python -m benches.throughput`.

The suite covers physics, every interface, training, memory, capacity and start-up time, compared
with the third-party simulators that are installed. Both contact engines are measured in the same
rounds. It writes a table and a picture. A debug build is refused.
"""

import argparse
import sys
from pathlib import Path

from benches.criterion import core_figures
from benches.measuring import measure, select
from benches.plot import draw
from benches.result_files import (
    RESULTS,
    ROOT,
    Figure,
    file_name,
    format_number,
    store,
    this_machine,
)
from benches.suite import Sizes, benchmarks
from benches.third_party import PACKAGES, import_optional

PARTIAL = ROOT / "out" / "bench"


def main(arguments: list[str] | None = None, sizes: Sizes | None = None) -> Path:
    """Measure, print, store and draw; return the path of the table.

    Args:
        arguments: Command line without the program name; default: that of the process.
        sizes: Numbers of worlds per benchmark; default: those of `Sizes`.

    Returns:
        Path of the CSV table.
    """
    options = parse_arguments(arguments)
    machine = this_machine()
    if machine.profile != "release":
        sys.exit(f"this is a {machine.profile} build; expected a release build")
    try:
        selected = select(benchmarks(sizes or Sizes()), options.only or "")
    except ValueError as error:
        sys.exit(str(error))
    for name, package in PACKAGES.items():
        state = "not installed" if import_optional(name) is None else "installed"
        log(f"{package}, for comparison: {state}")
    figures = measure(selected, options.rounds, options.seconds, log)
    if not options.only:
        figures += core_figures()
    if not figures:
        sys.exit("no benchmark was measured")
    folder = options.out or (PARTIAL if options.only else RESULTS)
    path = store(figures, machine, folder)
    draw(figures, machine, folder / f"{file_name(machine)}.png")
    sys.stdout.write("".join(format_line(figure) for figure in figures) + f"{path}\n")
    return path


def parse_arguments(arguments: list[str] | None) -> argparse.Namespace:
    """Return the parsed command line."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument(
        "--only", metavar="TEXT", help="run only benchmarks with this text in their title"
    )
    parser.add_argument("--rounds", type=int, default=5, help="number of rounds")
    parser.add_argument("--seconds", type=float, default=0.4, help="duration of one measurement")
    out = "output folder; default: benches/results, with --only out/bench"
    parser.add_argument("--out", type=Path, help=out)
    options = parser.parse_args(arguments)
    if options.rounds < 1 or options.seconds <= 0:
        parser.error(
            f"rounds and seconds must be above 0, got {options.rounds} and {options.seconds}"
        )
    return options


def format_line(figure: Figure) -> str:
    """Return a figure as one line of text."""
    title = f"{figure.group}: {figure.scenario}, {figure.variant}"
    engine = f", {figure.engine}" if figure.engine else ""
    case = f"{title}{engine}, {figure.worlds} worlds, {figure.threads} threads"
    interval = f"({format_number(figure.minimum)} to {format_number(figure.maximum)})"
    return (
        f"{case:<96} {format_number(figure.median):>9} {figure.unit} {figure.quantity} {interval}\n"
    )


def log(text: str) -> None:
    """Write a progress message to the error stream."""
    sys.stderr.write(f"{text}\n")


if __name__ == "__main__":
    main()

"""How fast this machine plays: `make bench`, or `python -m benches.throughput`.

Physics, every front door, training, memory, very many worlds and start, beside whatever peers are
installed. Leaves a table and a picture. A debug build is refused.
"""

import argparse
import sys
from pathlib import Path

from benches.contests import Sizes, contests
from benches.criterion import physics_alone
from benches.measuring import chosen, measure
from benches.peers import PACKAGES, peer
from benches.plot import draw
from benches.table import RESULTS, ROOT, Figure, digits, file_name, store, this_machine

PART = ROOT / "out" / "bench"


def main(arguments: list[str] | None = None, sizes: Sizes | None = None) -> Path:
    """Measure, print, store and draw; the path of the table."""
    options = parsed(arguments)
    machine = this_machine()
    if machine.profile != "release":
        sys.exit(f"this is a {machine.profile} build; its speed says nothing: build in release")
    try:
        picked = chosen(contests(sizes or Sizes()), options.only or "")
    except ValueError as error:
        sys.exit(str(error))
    for name, package in PACKAGES.items():
        tell(f"{package} is {'not ' if peer(name) is None else ''}there to be measured beside")
    figures = measure(picked, options.rounds, options.seconds, tell)
    if not options.only:
        figures += physics_alone()
    if not figures:
        sys.exit("nothing was measured")
    folder = options.out or (PART if options.only else RESULTS)
    path = store(figures, machine, folder)
    draw(figures, machine, folder / f"{file_name(machine)}.png")
    sys.stdout.write("".join(line(figure) for figure in figures) + f"{path}\n")
    return path


def parsed(arguments: list[str] | None) -> argparse.Namespace:
    """What the command line says."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--only", metavar="TEXT", help="measure what has this in its title")
    parser.add_argument("--rounds", type=int, default=5, help="times that all is measured")
    parser.add_argument("--seconds", type=float, default=0.4, help="length of a measurement")
    out = "folder of table and picture: benches/results, or, with --only, out/bench"
    parser.add_argument("--out", type=Path, help=out)
    options = parser.parse_args(arguments)
    if options.rounds < 1 or options.seconds <= 0:
        parser.error("rounds and seconds have to be above 0")
    return options


def line(figure: Figure) -> str:
    """A figure for people."""
    title = f"{figure.group}: {figure.game}, {figure.who}"
    case = f"{title}, {figure.worlds} worlds, {figure.threads} threads"
    spread = f"({digits(figure.least)} to {digits(figure.most)})"
    return f"{case:<84} {digits(figure.median):>9} {figure.unit} {figure.quantity} {spread}\n"


def tell(text: str) -> None:
    """Say what is going on."""
    sys.stderr.write(f"{text}\n")


if __name__ == "__main__":
    main()

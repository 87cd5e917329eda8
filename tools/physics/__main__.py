"""Measures the physics through Python and writes docs/physics.md: `make physics`.

The prose of that page is written by hand; its tables are measured here, and its pictures are drawn.
"""

import argparse
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING

from tools.physics import drive_pictures, pictures
from tools.physics.page import PAGE, alike, failing, written
from tools.physics.topics import TOPICS, checks

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURES: dict[str, Callable[[], "Figure"]] = {
    "roll": pictures.draw_roll,
    "chip": pictures.draw_chip,
    "bounce": pictures.draw_bounce,
    "steps": drive_pictures.draw_steps,
    "dribble": drive_pictures.draw_dribble,
}


def main() -> None:
    """Write page and pictures; with `--check` or `--list` only say how things are."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--check", action="store_true", help="change nothing; 1 if it is stale")
    parser.add_argument("--list", action="store_true", help="print every check, change nothing")
    asked = parser.parse_args()
    page = PAGE.read_text()
    if asked.list:
        print("\n".join(str(check) for topic in TOPICS for check in checks(topic)))
    elif not asked.check:
        PAGE.write_text(written(page))
        pictures.draw_all(PAGE.parent, PICTURES)
    elif not alike(page, written(page)):
        sys.exit(f"{PAGE.name} is stale: run `make physics`")
    if faults := [str(check) for check in failing()]:
        sys.exit("\n".join(["does not hold:", *faults]))


if __name__ == "__main__":
    main()

"""Measure the physics through Python and write docs/physics.md: `make physics`.

The prose of the page is written by hand. This module generates its tables and pictures.
"""

import argparse
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING

from tools.physics import ball_pictures, drive_pictures, kick_page
from tools.physics.page import PAGE, describe, failed_checks, pages_equal, render_page
from tools.physics.topics import all_checks

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURES: dict[str, Callable[[], "Figure"]] = {
    "roll": ball_pictures.draw_roll,
    "kicks": kick_page.draw_kicks,
    "chip": ball_pictures.draw_chip,
    "bounce": ball_pictures.draw_bounce,
    "steps": drive_pictures.draw_steps,
    "dribble": drive_pictures.draw_dribble,
}


def main() -> None:
    """Write the page and its pictures; `--check` and `--list` change nothing."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument(
        "--check",
        action="store_true",
        help="change nothing; exit with status 1 if the page is stale",
    )
    parser.add_argument("--list", action="store_true", help="print every check under every engine")
    arguments = parser.parse_args()
    page = PAGE.read_text()
    if arguments.list:
        print("\n".join(describe(engine, check) for engine, check in all_checks()))
    elif not arguments.check:
        PAGE.write_text(render_page(page))
        ball_pictures.draw_all(PAGE.parent, PICTURES)
    elif not pages_equal(page, render_page(page)):
        sys.exit(f"{PAGE.name} is stale: run `make physics`")
    if failures := failed_checks():
        sys.exit("\n".join(["failed checks:", *failures]))


if __name__ == "__main__":
    main()

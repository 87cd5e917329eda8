"""The playground on the site: shown where `make playground` has built it."""

import shutil
from pathlib import Path
from typing import Final

from tools.paths import ROOT

PAGE: Final = ROOT / "out" / "playground" / "index.html"
"""The page, where `make playground` writes it."""
PLACE: Final = "playground.run.html"
"""Name of the page on the site, beside the page that shows it."""
MARK: Final = "<!-- playground -->"
"""Place in `docs/playground.md` at which it is shown."""
HEIGHT: Final = 860
"""Height of the playground within the page, pixels."""


def shown(text: str, built: bool) -> str:
    """Return `docs/playground.md` with the playground, or with a note that this site has none.

    Args:
        text: the page as it is in the repository.
        built: whether the playground was built.
    """
    frame = (
        f'<a href="{PLACE}">On a page of its own</a> it is larger.\n\n'
        f'<iframe src="{PLACE}" title="Playground" loading="lazy" width="100%" '
        f'height="{HEIGHT}" style="border: 0"></iframe>'
    )
    note = "This site was built without the playground: run `make playground` first."
    return text.replace(MARK, frame if built else note)


def copy(out: Path) -> None:
    """Copy the playground into the site, if it was built.

    Args:
        out: folder of the site.
    """
    if PAGE.is_file():
        shutil.copyfile(PAGE, out / PLACE)

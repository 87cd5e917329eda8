"""Lays out the pages that Sphinx reads, in one folder.

Pages keep the relative links that they have in the repository. `TOP` moves pages of the root
folder beside those of `docs/`; links between them are rewritten to match.
"""

import re
import shutil
from pathlib import Path
from typing import Final

import rsoccer
from benches.table import RESULTS, ROOT
from tools.site import api, tasks

DOCS: Final = ROOT / "docs"
TOP: Final = {
    "ARCHITECTURE.md": "architecture.md",
    "CHANGELOG.md": "changelog.md",
    "CONTRIBUTING.md": "contributing.md",
}
"""Pages of the repository's root, and their names on the site."""

_LINK: Final = re.compile(r"(\]\()([^)#\s]+)(#[^)]*)?\)")


def lay_out(folder: Path, rust: bool = True) -> None:
    """Write every page and picture of the site into a folder, replacing its contents.

    Args:
        folder: Folder that Sphinx will read.
        rust: Whether pages may link to the reference of the crates.
    """
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(DOCS, folder)
    for page in folder.rglob("*.md"):
        page.write_text(linked(page.read_text(), page.relative_to(folder)))
    for name, target in TOP.items():
        (folder / target).write_text(linked((ROOT / name).read_text(), Path(name)))
    shutil.copytree(RESULTS, folder / "results", ignore=shutil.ignore_patterns("*.csv", "*.json"))
    write_examples(folder / "examples.md")
    write_tasks(folder / "tasks")
    api.write(folder / "api", rust)


def linked(text: str, page: Path) -> str:
    """Return a page whose links lead to pages of the site.

    Args:
        text: The page as it is in the repository.
        page: Its path on the site, or in the repository's root if it comes from there.

    Returns:
        The page with links to `TOP`, to `docs/` and to examples rewritten. A link to another file
        of the repository becomes code, as the site does not hold that file.
    """
    up = "../" * (len(page.parts) - 1)
    root = page.name in TOP and len(page.parts) == 1

    def replaced(match: re.Match[str]) -> str:
        link, anchor = match[2], match[3] or ""
        if "://" in link:
            return match[0]
        path = _in_repository(link, page, root)
        if path in TOP:
            return f"{match[1]}{up}{TOP[path]}{anchor})"
        if path == "README.md":
            return f"{match[1]}{up}index.md)"
        if path.startswith("examples"):
            return f"{match[1]}{up}examples.md)"
        if path.startswith("docs/"):
            return f"{match[1]}{up}{path.removeprefix('docs/')}{anchor})"
        if path.startswith("benches/results/"):
            return f"{match[1]}{up}{path.removeprefix('benches/')})"
        return match[0]

    return _LINK.sub(replaced, text)


def _in_repository(link: str, page: Path, root: bool) -> str:
    """Path of a link's target in the repository."""
    base = ROOT if root else (DOCS / page).parent
    target = (base / link).resolve()
    return target.relative_to(ROOT.resolve()).as_posix()


def write_examples(page: Path) -> None:
    """Write the page with all examples."""
    parts = ["# Examples", "", "Every file runs by itself and is in the folder `examples`.", ""]
    for path in sorted((ROOT / "examples").glob("*.py")):
        code = path.read_text()
        title = code.split('"""')[1].split("\n")[0].rstrip(".")
        parts += [f"## {path.stem}", "", f"{title}.", "", f"```python\n{code.strip()}\n```", ""]
    page.write_text("\n".join(parts))


def write_tasks(folder: Path) -> None:
    """Write the index of tasks and a page for each; `folder` holds their pictures."""
    names = rsoccer.list_tasks()
    (folder / "index.md").write_text(tasks.index(names))
    for name in names:
        (folder / f"{name}.md").write_text(tasks.page(name))

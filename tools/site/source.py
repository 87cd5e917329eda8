"""Lays out the pages that Sphinx reads, in one folder.

Links in the repository's pages lead to its files, so that they work there too. Here they are
rewritten to lead to the pages of the site.
"""

import re
import shutil
from pathlib import Path
from typing import Final

import rsoccer
from benches.result_files import RESULTS
from tools.paths import DOCS, ROOT
from tools.site import api, notebooks, playground, tasks

TOP: Final = {
    "ARCHITECTURE.md": "architecture.md",
    "CHANGELOG.md": "changelog.md",
    "CONTRIBUTING.md": "contributing.md",
}
"""Pages of the repository's root, and their names on the site."""

FOLDERS: Final = {
    "README.md": "index.md",
    "benchmarks": "leaderboard.md",
    "examples": "examples.md",
    "notebooks": notebooks.INDEX,
    "python/rsoccer": "api/index.md",
}
"""Files and folders of the repository, and the pages that stand for them."""

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
    shown = folder / "playground.md"
    shown.write_text(playground.shown(shown.read_text(), playground.PAGE.is_file()))
    for name, target in TOP.items():
        (folder / target).write_text(linked((ROOT / name).read_text(), Path(name)))
    pictures_only = shutil.ignore_patterns("*.csv", "*.json", "*.md")
    shutil.copytree(RESULTS, folder / "results", ignore=pictures_only)
    write_examples(folder / "examples.md")
    write_tasks(folder / "tasks")
    notebooks.write(folder / notebooks.FOLDER)
    api.write(folder / "api", rust)


def linked(text: str, page: Path) -> str:
    """Return a page whose links lead to pages of the site.

    Args:
        text: The page as it is in the repository.
        page: Its path on the site, or in the repository's root if it comes from there.

    Returns:
        The page with links to the pages that stand for files of the repository; see `on_site`.
    """
    up = "../" * (len(page.parts) - 1)
    root = page.name in TOP and len(page.parts) == 1

    def replaced(match: re.Match[str]) -> str:
        link, anchor = match[2], match[3] or ""
        if "://" in link:
            return match[0]
        target = on_site(_in_repository(link, page, root), anchor)
        return f"{match[1]}{up}{target})" if target else match[0]

    return _LINK.sub(replaced, text)


def on_site(path: str, anchor: str) -> str:
    """Return the place on the site of a file of the repository.

    Args:
        path: Path in the repository.
        anchor: Anchor with its "#", or empty. For the folder of tasks it is the name of a task.

    Returns:
        The page with its anchor, from the top of the site; empty if the site has no such page.
    """
    module = path.removeprefix("python/").rpartition(".")[0].replace("/", ".")
    if path in TOP:
        return TOP[path] + anchor
    if path == "docs/tasks":
        return f"tasks/{anchor[1:] or 'index'}.md"
    if path.startswith("docs/"):
        return path.removeprefix("docs/") + anchor
    if module in api.modules():
        return f"api/{module}.md"
    if path.startswith("benches/results/"):
        return path.removeprefix("benches/")
    return next((page for start, page in FOLDERS.items() if path.startswith(start)), "")


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

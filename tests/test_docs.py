import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
DOCS = sorted(page.relative_to(ROOT).as_posix() for page in (ROOT / "docs").rglob("*.md"))
PAGES = ("README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", *DOCS)
# Paths that exist only after building or running.
MADE = ("out/", "target/", ".venv/", "args.json", "progress.csv", "tensorboard/")


def named_paths(text: str) -> Iterator[str]:
    """Words in backticks that can only be paths: with a slash or the ending of a file."""
    for word in re.findall(r"`([\w.-]+(?:/[\w.*-]+)*/?)`", text):
        if "/" in word or re.search(r"\.(rs|py|pyi|toml|md|txt|csv|json|sh)$", word):
            yield word


def mapped_paths(text: str) -> Iterator[str]:
    """Paths in the map of ARCHITECTURE.md: folders at the margin, what they hold indented."""
    folder = ""
    for line in text.split("## Map")[1].split("```")[1].splitlines():
        names = re.split(r"\s{2,}", line.strip())[0].split()
        if line.startswith("  ") and not line.startswith("   "):
            yield from (folder + name for name in names)
        elif line and not line.startswith(" "):
            folder = names[0]
            yield folder


def exists(path: str) -> bool:
    """Whether a path is in the repository, in the core or in the package; a name, anywhere."""
    folders = (ROOT, ROOT / "crates/rsim-core/src", ROOT / "python/rsoccer")
    named = "/" not in path and any(ROOT.glob(f"*/**/{path}"))
    return named or any(any(folder.glob(path)) for folder in folders)


@pytest.mark.parametrize("page", PAGES)
def test_named_paths_exist(page: str) -> None:
    paths = [path for path in named_paths((ROOT / page).read_text()) if not path.startswith(MADE)]
    missing = [path for path in paths if not exists(path)]
    assert not missing


def test_a_path_that_is_gone_would_be_noticed() -> None:
    found = list(named_paths("see `python/rsoccer/gone.py`, `frame.py`, `Matches` and `1/d`"))
    assert found == ["python/rsoccer/gone.py", "frame.py", "1/d"]
    assert not exists("python/rsoccer/gone.py")
    assert exists("frame.py")


def test_mapped_paths_exist() -> None:
    paths = list(mapped_paths((ROOT / "ARCHITECTURE.md").read_text()))
    assert len(paths) > 30
    assert not [path for path in paths if not (ROOT / path).exists()]


@pytest.mark.parametrize("page", PAGES)
def test_links_inside_the_repository_lead_somewhere(page: str) -> None:
    links = re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", (ROOT / page).read_text())
    folder = (ROOT / page).parent
    missing = [link for link in links if "://" not in link and not (folder / link).exists()]
    assert not missing


@pytest.mark.parametrize("folder", ["crates/rsim-core/src", "crates/rsim-py/src", "python/rsoccer"])
def test_the_map_shows_every_file_and_folder(folder: str) -> None:
    text = (ROOT / "ARCHITECTURE.md").read_text()
    entries = [entry for entry in (ROOT / folder).iterdir() if shown(entry)]
    assert len(entries) > 3
    missing = [entry.name for entry in entries if not re.search(rf"\b{entry.stem}\b", text)]
    assert not missing


def shown(entry: Path) -> bool:
    """Whether a map should name it: sources and folders of sources, not what is made."""
    hidden = entry.name.startswith("__") or entry.suffix in (".so", ".pyd", ".typed")
    return not hidden and (entry.is_dir() or entry.suffix in (".py", ".pyi", ".rs"))

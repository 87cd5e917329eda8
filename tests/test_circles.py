"""Imports without circles, those inside functions and for type checkers included."""

import ast
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PARTS = {"rsoccer.evaluate": "python", "rsoccer.train": "python", "benches": "", "tools": ""}
"""Packages whose modules are in no circle, and the folder above each."""


def modules() -> dict[str, Path]:
    """Return the files of these packages by the names of their modules."""
    found = {}
    for package, above in PARTS.items():
        base = ROOT / above
        for path in (base / package.replace(".", "/")).rglob("*.py"):
            parts = path.relative_to(base).with_suffix("").parts
            found[".".join(parts).removesuffix(".__init__")] = path
    return found


def imported(tree: ast.AST) -> Iterator[tuple[str, str]]:
    """Yield what a file imports: a module and a name in it, which is empty for a whole module."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((alias.name, "") for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield from ((node.module, alias.name) for alias in node.names)


def graph() -> dict[str, set[str]]:
    """Return the modules that each module imports."""
    files = modules()
    edges: dict[str, set[str]] = {}
    for module, path in files.items():
        pairs = imported(ast.parse(path.read_text()))
        names = (
            f"{start}.{name}" if f"{start}.{name}" in files else start for start, name in pairs
        )
        edges[module] = {name for name in names if name in files and name != module}
    return edges


def test_no_module_is_in_a_circle() -> None:
    edges = graph()
    assert sum(map(len, edges.values())) > 300, "imports are found"
    list(TopologicalSorter(edges).static_order())  # raises CycleError, which names one


def test_a_circle_would_be_noticed() -> None:
    edges = graph()
    edges["rsoccer.train.args"].add("rsoccer.train.run.training")
    with pytest.raises(CycleError, match=r"rsoccer\.train\.args"):
        list(TopologicalSorter(edges).static_order())


def test_benchmarks_do_not_import_tools() -> None:
    users = [name for name, used in graph().items() if any(u.startswith("tools") for u in used)]
    assert users and all(name.startswith("tools") for name in users)


def test_running_a_study_and_reporting_it_are_apart() -> None:
    running, reporting = "benches.learning.running", "benches.learning.reporting"
    for name, used in graph().items():
        for own, other in ((running, reporting), (reporting, running)):
            assert not name.startswith(own) or not any(each.startswith(other) for each in used)

"""Modules import only from the layers before theirs: the order in which to read them."""

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import rsoccer

ROOT = Path(rsoccer.__file__).parent

# A package stands for all that is in it. Modules of one layer do not import each other.
LAYERS = [
    {"_core"},
    {"files", "frame", "markers", "whole"},
    {"rng", "state", "view", "entities"},
    {"checks", "play"},
    {"task", "outcome", "simulator", "compat"},
    {"spaces", "ids"},
    {"by_agent", "registry", "spawn", "rewards", "policies"},
    {"controllers", "reposition"},
    {"saved", "standing"},
    {"matches"},
    {"stage"},
    {"parallel", "single", "vector", "evaluate", "tasks"},
    {"__init__"},
    {"pressing", "render", "train"},
    {"testing"},
    {"commands", "demo"},
    {"cli"},
    {"__main__"},
]

# A door draws, but only when asked to: what draws is imported then and there.
LATE = {("stage", "render")}


def module_of(path: Path) -> str:
    return path.relative_to(ROOT).with_suffix("").parts[0]


def rank(module: str) -> int:
    return next(i for i, layer in enumerate(LAYERS) if module in layer)


def imported(node: ast.AST) -> list[str]:
    """Modules of ours that a statement imports."""
    if isinstance(node, ast.Import):
        names = [alias.name for alias in node.names]
    elif isinstance(node, ast.ImportFrom) and node.module:
        names = [f"{node.module}.{alias.name}" for alias in node.names]
    else:
        return []
    ours = [name.split(".") for name in names if name.split(".")[0] == "rsoccer"]
    known = set().union(*LAYERS)
    return [parts[1] if len(parts) > 1 and parts[1] in known else "__init__" for parts in ours]


def imports() -> Iterator[tuple[str, str, bool]]:
    """Who imports whom, and whether at once."""
    for path in ROOT.rglob("*.py"):
        tree = ast.parse(path.read_text())
        at_once = set(map(id, tree.body))
        for node in ast.walk(tree):
            for name in imported(node):
                yield module_of(path), name, id(node) in at_once


def test_every_module_has_a_layer() -> None:
    modules = {module_of(path) for path in ROOT.rglob("*.py")} | {"_core"}
    assert modules == set().union(*LAYERS)


def test_modules_import_only_from_earlier_layers() -> None:
    found = list(imports())
    backward = {
        f"{importer} imports {name}"
        for importer, name, at_once in found
        if importer != name
        and rank(name) >= rank(importer)
        and (at_once or (importer, name) not in LATE)
    }
    assert not backward
    assert len(found) > 100, "imports were found at all"
    assert {(importer, name) for importer, name, _ in found} >= LATE, "every exception is needed"


def test_importing_the_package_loads_no_heavy_library() -> None:
    heavy = ["torch", "pygame", "imageio", "matplotlib", "safetensors", "tyro", "tqdm"]
    program = f"import sys, rsoccer; sys.exit(str([m for m in {heavy} if m in sys.modules] or ''))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.stderr.strip() == ""

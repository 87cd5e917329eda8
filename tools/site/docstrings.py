"""Prepares objects, docstrings and signatures for Sphinx's autodoc."""

import importlib
import re
import sys
from itertools import groupby
from typing import Any, Final

from tools.site import api, stub

_ARRAY: Final = re.compile(
    r"~?(?:numpy\.)?ndarray\[tuple\[~?(?:typing\.)?Any, \.\.\.\], "
    r"~?(?:numpy\.)?dtype\[~?(?:numpy\.|typing\.)?(\w+)\]\]"
)


def connect(app: Any) -> None:  # noqa: ANN401  (Sphinx is no dependency of the checks)
    """Connect the functions below to Sphinx's events."""
    for module in api.loadable():
        importlib.import_module(module)  # with the compiled module, before the stub replaces it
    sys.modules[stub.NAME] = stub.load()
    from sphinx.pycode import ModuleAnalyzer

    # Sphinx reads the order of members and the docstrings of constants from *.py files only.
    ModuleAnalyzer.cache["module", stub.NAME] = ModuleAnalyzer.for_file(stub.PATH, stub.NAME)
    app.connect("autodoc-process-signature", signature)
    app.connect("autodoc-process-docstring", keep_colons, priority=900)
    app.connect("autodoc-process-docstring", docstring)
    app.connect("doctree-resolved", polish)


def private() -> str:
    """Return a pattern of references that the site does not have: private names and modules."""
    hidden = sorted(set(api.found()) - set(api.modules()))
    modules = "|".join(re.escape(module) for module in hidden)
    return rf"({modules})\.\w+|rsoccer\.(\w+\.)*_(?!core\.)\w+"


def signature(
    app: object, kind: str, name: str, obj: object, options: object, text: str, returns: str
) -> tuple[str, str]:
    """Return a signature with short names of arrays."""
    return short(text), short(returns)


def short(text: str) -> str:
    """Return text in which types of arrays are written as the source writes them."""
    return _ARRAY.sub(r"NDArray[\1]", text) if text else text


def polish(app: object, doctree: Any, page: str) -> None:  # noqa: ANN401  (a node of docutils)
    """Shorten the types of properties, drop bare bases, and name attributes by that word."""
    from docutils import nodes
    from sphinx import addnodes

    for node in list(doctree.findall(addnodes.desc_annotation)):
        text = node.astext()
        if short(text) != text:
            node.children = [nodes.Text(short(text))]
    for node in list(doctree.findall(nodes.paragraph)):
        if node.astext() == "Bases: object":
            node.parent.remove(node)
    for node in list(doctree.findall(nodes.field_name)):
        if node.astext() == "Variables":
            node.children = [nodes.Text("Attributes")]


def docstring(
    app: object, kind: str, name: str, obj: object, options: object, lines: list[str]
) -> None:
    """Change the parts of a docstring that reStructuredText would misread."""
    lines[:] = [*restructured(lines), ""]


def keep_colons(
    app: object, kind: str, name: str, obj: object, options: object, lines: list[str]
) -> None:
    """Undo that Google's style takes the text before a colon for the type of a property."""
    types = [line for line in lines if line.startswith(":type: ")]
    if kind in ("attribute", "data", "property") and types:
        text = " ".join(line for line in lines if line not in types).strip()
        lines[:] = [f"{types[0].removeprefix(':type: ')}: {text}", ""]


def restructured(lines: list[str]) -> list[str]:
    """Return lines as reStructuredText: stars of shapes are no markup, Markdown's tables are lists.

    Args:
        lines: A docstring.

    Returns:
        The docstring with tables of Markdown as directives, and stars before a name escaped.
    """
    found: list[str] = []
    for is_row, group in groupby(lines, lambda line: line.lstrip().startswith("|")):
        block = list(group)
        found += _table(block) if is_row and len(block) > 2 else [_starred(line) for line in block]
    return found


def _starred(line: str) -> str:
    """A line in which a star before a name, as in "(n, *shape)", does not begin emphasis."""
    return re.sub(r"(?<![\\*\w`])(\*{1,2})(?=\w)(?!.*\w\1)", r"\\\1", line)


def _table(rows: list[str]) -> list[str]:
    """A table of Markdown as a directive."""
    indent = rows[0][: len(rows[0]) - len(rows[0].lstrip())]
    lines = ["", ".. list-table::", "   :header-rows: 1", ""]
    for row in [rows[0], *rows[2:]]:
        cells = [cell.strip() for cell in row.strip().strip("|").split("|")]
        starts = ["   * - ", *["     - "] * (len(cells) - 1)]
        lines += [start + cell for start, cell in zip(starts, cells, strict=True)]
    return [indent + line for line in [*lines, ""]]

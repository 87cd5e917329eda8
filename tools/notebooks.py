"""Runs the notebooks, and stores what their cells show: `python -m tools.notebooks`.

A notebook is JSON, so the standard library reads and runs its cells: Jupyter's own programs would
bring some fifty packages for it. The last expression of a cell is shown by its `_repr_html_` or
`_repr_png_`, as notebooks do. Lines for IPython, such as `%pip`, are left out.
"""

import argparse
import ast
import base64
import contextlib
import copy
import io
import json
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

from tools.paths import ROOT

FOLDER: Final = ROOT / "notebooks"
LARGEST: Final = 40_000
"""Most characters of HTML that are stored; pages of matches have more."""
PAGE: Final = "A page that plays the match: run the notebook to see it."
"""Text that is stored in the place of such a page."""

Notebook = dict[str, Any]
Output = dict[str, Any]


def main() -> None:
    """Run the notebooks and store their outputs."""
    parser = argparse.ArgumentParser(description="Run the notebooks and store what they show.")
    parser.add_argument("names", nargs="*", help="names without .ipynb; by default all")
    names = parser.parse_args().names
    for path in files():
        if not names or path.stem in names:
            path.write_text(text_of(executed(read(path))))
            print(f"stored {path}")


def files() -> list[Path]:
    """Return all notebooks."""
    return sorted(FOLDER.glob("*.ipynb"))


def read(path: Path) -> Notebook:
    """Return a notebook.

    Args:
        path: Its file.
    """
    notebook: Notebook = json.loads(path.read_text())
    return notebook


def text_of(notebook: Notebook) -> str:
    """Return the text of a notebook's file."""
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


def code_of(cell: Mapping[str, Any]) -> str:
    """Return the code of a cell without lines for IPython; empty for cells of text."""
    if cell["cell_type"] != "code":
        return ""
    lines = "".join(cell["source"]).splitlines()
    return "\n".join(line for line in lines if not line.lstrip().startswith(("%", "!")))


def executed(notebook: Notebook, numbers: Mapping[str, float] | None = None) -> Notebook:
    """Run the cells of a notebook one after the other, in a folder of their own.

    Args:
        notebook: The notebook.
        numbers: Values of constants by name, in place of those that cells assign, for quick runs.

    Returns:
        A copy with the outputs of all cells.

    Raises:
        Exception: What a cell raises.
    """
    ran, names = copy.deepcopy(notebook), {"__name__": "__main__"}
    count = 0
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        for cell in ran["cells"]:
            code = code_of(cell)
            if cell["cell_type"] != "code":
                continue
            count += 1
            cell["execution_count"] = count
            cell["outputs"] = _run(code, names, numbers or {})
    return ran


def _run(code: str, names: dict[str, Any], numbers: Mapping[str, float]) -> list[Output]:
    """Run the code of a cell in a namespace; what it printed and showed."""
    tree = ast.parse(code)
    tree.body = [_with_numbers(statement, numbers) for statement in tree.body]
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    printed = io.StringIO()
    shown = None
    with (
        open(os.devnull, "w") as null,
        contextlib.redirect_stdout(printed),
        contextlib.redirect_stderr(null),  # progress bars
    ):
        exec(compile(tree, "cell", "exec"), names)
        if isinstance(last, ast.Expr):
            shown = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
    outputs: list[Output] = []
    if printed.getvalue():
        outputs.append({"name": "stdout", "output_type": "stream", "text": printed.getvalue()})
    if shown is not None:
        outputs.append(
            {"output_type": "display_data", "metadata": {}, "data": _representations(shown)}
        )
    return outputs


def _with_numbers(statement: ast.stmt, numbers: Mapping[str, float]) -> ast.stmt:
    """An assignment of a constant with its other value; any other statement as it is."""
    if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name):
        name = statement.targets[0].id
        if name in numbers:
            statement.value = ast.copy_location(ast.Constant(numbers[name]), statement.value)
    return statement


def _representations(shown: object) -> dict[str, str]:
    """What a notebook shows of an object, by MIME type."""
    found = {"text/plain": repr(shown)}
    if callable(html := getattr(shown, "_repr_html_", None)):
        text = html()
        found["text/html"] = text if len(text) <= LARGEST else f"<p><em>{PAGE}</em></p>"
    if callable(png := getattr(shown, "_repr_png_", None)) and (picture := png()) is not None:
        found["image/png"] = base64.b64encode(picture).decode()
    return found


if __name__ == "__main__":
    main()

"""Table of docs/protocols.md: the stable codes of errors."""

from __future__ import annotations

import ast
import inspect

from benches.markdown import table
from rsoccer.protocols import errors


def table_of_codes() -> str:
    """Return the table of the codes and their meanings, which are those in the source."""
    tree = ast.parse(inspect.getsource(errors.Code)).body[0]
    assert isinstance(tree, ast.ClassDef)
    names = [each.value for each in errors.Code]
    texts = [
        each.value.value
        for each in tree.body[1:]
        if isinstance(each, ast.Expr) and isinstance(each.value, ast.Constant)
    ]
    rows = [(f"`{name}`", str(text)) for name, text in zip(names, texts, strict=True)]
    return table(("code", "meaning"), rows)

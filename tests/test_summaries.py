"""Summaries begin with a noun or a verb, in all docstrings and doc comments of the project.

`tests/test_docstrings.py` checks those of public objects more closely.
"""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
FOLDERS = ("python", "tests", "tools", "benches", "examples")
CLAUSES = {"how", "what", "whatever", "when", "where", "which", "who", "whom", "whose", "why"}
"""First words of clauses. "Whether" is fine: it says that something is true or false."""
EXAMPLES = {ROOT / "tests" / "test_docstrings.py"}
"""Files with faulty docstrings, for tests of the rules themselves."""


def docstrings(text: str) -> Iterator[str]:
    """Yield docstrings of a Python file, and texts below fields."""
    for node in ast.walk(ast.parse(text)):
        body = getattr(node, "body", None)
        for part in body if isinstance(body, list) else []:
            value = part.value if isinstance(part, ast.Expr) else None
            if isinstance(value, ast.Constant) and isinstance(value.value, str):
                yield value.value


def doc_comments(text: str) -> Iterator[str]:
    """Yield paragraphs of doc comments of a Rust file that begin one."""
    before = ""
    for line in map(str.strip, text.splitlines()):
        if line.startswith(("/// ", "//! ")) and not before.startswith(line[:3]):
            yield line[4:]
        before = line


def begins_with_clause(summary: str) -> bool:
    first = re.match(r"[A-Za-z]+", summary.strip())
    return first is not None and first[0].lower() in CLAUSES


def test_no_summary_begins_with_a_clause() -> None:
    python = {p for folder in FOLDERS for p in (ROOT / folder).rglob("*.py*") if p.suffix != ".pyc"}
    found = [(path, each) for path in python - EXAMPLES for each in docstrings(path.read_text())]
    rust = (ROOT / "crates").rglob("*.rs")
    found += [(path, each) for path in rust for each in doc_comments(path.read_text())]
    assert len(found) > 5000
    clauses = [
        f"{path.relative_to(ROOT)}: {each[:60]}" for path, each in found if begins_with_clause(each)
    ]
    assert not clauses


@pytest.mark.parametrize(
    ("text", "summaries"),
    [
        ('def f() -> None:\n    """How."""\n', ["How."]),
        ('class A:\n    """A."""\n    x: int\n    """what x is"""\n', ["A.", "what x is"]),
    ],
)
def test_docstrings_are_found(text: str, summaries: list[str]) -> None:
    assert list(docstrings(text)) == summaries


def test_doc_comments_are_found() -> None:
    text = "//! One.\n//! two\n\n/// Which\n/// more\nfn f() {}\n    // no\n    /// Two.\n"
    assert list(doc_comments(text)) == ["One.", "Which", "Two."]
    assert [begins_with_clause(each) for each in ("Which", "whole", "Whether", "-")] == [
        True,
        False,
        False,
        False,
    ]

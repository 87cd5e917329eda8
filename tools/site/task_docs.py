"""Content of the docstrings of tasks: paragraphs, tables of rewards, options.

The docstring of a task has paragraphs that start with a label, such as "Initial state:", and a
table of its reward terms. A subclass inherits a paragraph that it lacks, or in which it only names
its base class.
"""

import ast
import inspect
import re
import textwrap
from typing import Final

from rsoccer import Task

_INHERITED: Final = re.compile(r"^(that|those) of `\w+`")


def summary(task: Task) -> str:
    """Return the first line of the docstring of a task's class."""
    return (inspect.getdoc(type(task)) or "").split("\n")[0]


def paragraph(task: Task, *labels: str) -> str:
    """Return the paragraph of a task's docstring that starts with a label and a colon.

    Args:
        task: A task.
        *labels: Labels of which the docstring has one, such as "Metric" and "Metrics".

    Returns:
        The paragraph without its label, in one line; empty if the task has none.
    """
    for text in _paragraphs(type(task)):
        label, colon, rest = text.partition(": ")
        if colon and label in labels and not _INHERITED.match(rest):
            return rest
    return ""


def exceptions(task: Task) -> str:
    """Return the sentence in which a task excepts something from its base class; or ""."""
    for text in _texts(type(task)):
        _, word, rest = text.partition(", except ")
        if word:
            return f"Except {rest}"
    return ""


def events(task: Task) -> list[str]:
    """Return the events that terminate an episode."""
    text = paragraph(task, "Termination").partition(" Truncation:")[0]
    return [event.strip() for event in text.rstrip(".").split(";") if event.strip()]


def metrics(task: Task) -> dict[str, str]:
    """Return the meanings of a task's metrics by name."""
    text = paragraph(task, "Metric", "Metrics").rstrip(".")
    found = re.split(r"(?:^|; )`(\w+)`, ", text)[1:]
    return dict(zip(found[::2], found[1::2], strict=True))


def reward_terms(task: Task) -> dict[str, tuple[str, str]]:
    """Return meaning and unit of a task's reward terms by name, from the table of its docstring."""
    for cls in type(task).__mro__:
        lines = inspect.cleandoc(vars(cls).get("__doc__") or "").split("\n")
        heads = [number for number, line in enumerate(lines) if line.startswith("Term ")]
        if heads:
            return _rows(lines[heads[0] - 1], lines[heads[0] + 2 :])
    return {}


def _rows(rule: str, lines: list[str]) -> dict[str, tuple[str, str]]:
    """Rows of a table below a rule of equal signs, which marks the columns."""
    starts = [match.start() for match in re.finditer("=+", rule)]
    spans = list(zip(starts, [*starts[1:], None], strict=True))
    rows: dict[str, tuple[str, str]] = {}
    term = ""
    for line in lines:
        if line.startswith("=="):
            break
        name, meaning, unit = (line[start:end].strip() for start, end in spans)
        term = name or term
        last_meaning, last_unit = rows.get(term, ("", ""))
        rows[term] = f"{last_meaning} {meaning}".strip(), f"{last_unit} {unit}".strip()
    return rows


def options(task: Task) -> dict[str, str]:
    """Return the docstrings of a task's fields by name, those of subclasses first."""
    found: dict[str, str] = {}
    for cls in type(task).__mro__:
        if cls is Task or not issubclass(cls, Task):
            continue
        (body,) = ast.parse(textwrap.dedent(inspect.getsource(cls))).body
        assert isinstance(body, ast.ClassDef)
        for field, text in zip(body.body, body.body[1:], strict=False):
            if isinstance(field, ast.AnnAssign) and isinstance(field.target, ast.Name):
                found.setdefault(field.target.id, _text(text))
    return {name: text for name, text in found.items() if text}


def _text(node: ast.stmt) -> str:
    """The text of a statement that is only a string; else empty."""
    if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
        return " ".join(str(node.value.value).split())
    return ""


def _paragraphs(cls: type) -> list[str]:
    """Paragraphs of the docstrings of a class and of its base classes, each in one line."""
    return [text for base in cls.__mro__ for text in _texts(base)]


def _texts(cls: type) -> list[str]:
    """Paragraphs of a class's own docstring, each in one line."""
    text = inspect.cleandoc(vars(cls).get("__doc__") or "")
    return [" ".join(part.split()) for part in text.split("\n\n")]

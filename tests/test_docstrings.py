"""Docstrings of public objects: plain summaries, and sections for arguments, results, errors."""

import ast
import importlib
import inspect
import pkgutil
import re
import textwrap
from collections.abc import Callable, Iterator
from functools import cached_property
from typing import Any

import pytest

import rsoccer

CLAUSES = (
    "What",
    "Who",
    "Whom",
    "Whose",
    "How",
    "Where",
    "Which",
    "When",
    "Whether",
    "Why",
    "That",
)
"""First words of clauses; a summary names its subject or begins with a verb."""


def module_names() -> Iterator[str]:
    yield "rsoccer"
    for module in pkgutil.walk_packages(rsoccer.__path__, "rsoccer."):
        if not module.name.rsplit(".", 1)[1].startswith("_"):
            yield module.name


def objects_of(module_name: str) -> Iterator[tuple[str, Any, type | None]]:
    """Public classes, functions and methods that a module defines, with the methods' classes."""
    module = MODULES[module_name]
    for name, value in vars(module).items():
        if name.startswith("_") or getattr(value, "__module__", None) != module_name:
            continue
        if inspect.isfunction(value):
            yield f"{module_name}.{name}", value, None
        elif inspect.isclass(value):
            yield f"{module_name}.{name}", value, None
            for member, attribute in vars(value).items():
                yield from _member(f"{module_name}.{name}.{member}", member, attribute, value)


def _member(path: str, name: str, attribute: Any, owner: type) -> Iterator[tuple[str, Any, type]]:  # noqa: ANN401
    if isinstance(attribute, staticmethod | classmethod):
        attribute = attribute.__func__
    if isinstance(attribute, property):
        attribute = attribute.fget
    if isinstance(attribute, cached_property):
        attribute = attribute.func
    public = name == "__init__" or not name.startswith("_")
    own = getattr(attribute, "__module__", None) == owner.__module__
    if inspect.isfunction(attribute) and public and own and attribute.__doc__:
        yield path, attribute, owner


MODULES = {name: importlib.import_module(name) for name in module_names()}
OBJECTS = [found for name in MODULES for found in objects_of(name)]
FUNCTIONS = [(path, value, owner) for path, value, owner in OBJECTS if inspect.isfunction(value)]


def is_attribute(owner: type | None, function: Any) -> bool:  # noqa: ANN401
    """Whether a function is a property."""
    value = None if owner is None else vars(owner).get(function.__name__)
    return isinstance(value, property | cached_property)


def is_inherited(owner: type | None, function: Any) -> bool:  # noqa: ANN401
    """Whether a base class describes the arguments of a method."""
    bases = () if owner is None else owner.__mro__[1:]
    return function.__name__ != "__init__" and any(
        function.__name__ in vars(base) for base in bases
    )


def described(section: str, doc: str) -> str:
    """The text of one section of a docstring."""
    found = re.search(rf"^{section}:\n((?:[ \t]+.*\n|\n)*)", inspect.cleandoc(doc) + "\n", re.M)
    return found[1] if found else ""


def raised(function: Any) -> set[str]:  # noqa: ANN401
    """Names of the exceptions that a function's own body raises."""
    names = set()
    for node in ast.walk(ast.parse(textwrap.dedent(inspect.getsource(function)))):
        if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
            callee = node.exc.func
            if isinstance(callee, ast.Name | ast.Attribute):
                names.add(callee.id if isinstance(callee, ast.Name) else callee.attr)
    return names


def clauses() -> Iterator[str]:
    for path, value in [*((path, value) for path, value, _ in OBJECTS), *MODULES.items()]:
        if value.__doc__ and value.__doc__.split()[0].strip(",.:") in CLAUSES:
            yield f"{path}: the summary begins with {value.__doc__.split()[0]!r}"


def missing_arguments() -> Iterator[str]:
    for path, function, owner in FUNCTIONS:
        if is_attribute(owner, function) or is_inherited(owner, function):
            continue
        text = described("Args", function.__doc__ or "")
        for name in inspect.signature(function).parameters:
            if name not in ("self", "cls") and not re.search(
                rf"^\s+\*{{0,2}}{name}\b.*:", text, re.M
            ):
                yield f"{path}: no line for {name} under Args"


def missing_results() -> Iterator[str]:
    for path, function, owner in FUNCTIONS:
        if is_attribute(owner, function) or is_inherited(owner, function):
            continue
        doc, result = function.__doc__ or "", inspect.signature(function).return_annotation
        sections = described("Returns", doc) or described("Yields", doc)
        if result not in (None, "None") and not (sections or re.match(r"(Return|Yield)\b", doc)):
            yield f"{path}: no Returns, and the summary does not begin with Return"


def missing_errors() -> Iterator[str]:
    for path, function, owner in FUNCTIONS:
        if not is_inherited(owner, function):
            text = described("Raises", function.__doc__ or "")
            for name in sorted(raised(function)):
                if name not in text:
                    yield f"{path}: no {name} under Raises"


@pytest.mark.parametrize("rule", [clauses, missing_arguments, missing_results, missing_errors])
def test_docstrings_are_complete(rule: Callable[[], Iterator[str]]) -> None:
    assert not list(rule())


def test_objects_are_found() -> None:
    assert len(OBJECTS) > 500
    assert len(FUNCTIONS) > 350
    assert sum(bool(raised(function)) for _, function, _ in FUNCTIONS) > 50


def test_sections_are_read_whole() -> None:
    doc = "Do it.\n\nArgs:\n    a: one.\n    b: two,\n        or three.\n\nReturns:\n    c."
    assert described("Args", doc).rstrip().endswith("or three.")
    assert described("Raises", doc) == ""

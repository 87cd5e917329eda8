"""Docstrings of public objects: plain summaries, and true sections for arguments and errors."""

import ast
import builtins
import doctest
import importlib
import inspect
import pkgutil
import re
import textwrap
from collections.abc import Callable, Iterator
from dataclasses import dataclass, is_dataclass
from functools import cache, cached_property
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

import rsoccer
from tools.site.api import library_of

CLAUSES = {
    "How",
    "If",
    "That",
    "What",
    "When",
    "Where",
    "Whether",
    "Which",
    "Who",
    "Whom",
    "Whose",
    "Why",
}
"""First words of clauses; a summary names its subject or begins with a verb."""

ARTICLES = {"A", "An", "The"}
"""First words of noun phrases; the summary of a function begins with a verb."""


def module_names() -> Iterator[str]:
    yield "rsoccer"
    for module in pkgutil.walk_packages(rsoccer.__path__, "rsoccer."):
        needed = library_of(module.name)
        if needed is not None and find_spec(needed) is None:
            continue
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
CLASSES = [(path, value) for path, value, _ in OBJECTS if inspect.isclass(value)]
WITH_EXAMPLES = [
    name for name, module in MODULES.items() if ">>> " in Path(str(module.__file__)).read_text()
]


def is_attribute(owner: type | None, function: Any) -> bool:  # noqa: ANN401
    """Whether a function is a property."""
    value = None if owner is None else vars(owner).get(function.__name__)
    return isinstance(value, property | cached_property)


def is_inherited(owner: type | None, function: Any) -> bool:  # noqa: ANN401
    """Whether a base class describes a method."""
    bases = () if owner is None else owner.__mro__[1:]
    return function.__name__ != "__init__" and any(
        getattr(vars(base).get(function.__name__), "__doc__", None) for base in bases
    )


def described(section: str, doc: str) -> str:
    """The text of one section of a docstring."""
    found = re.search(rf"^{section}:\n((?:[ \t]+.*\n|\n)*)", inspect.cleandoc(doc) + "\n", re.M)
    return found[1] if found else ""


def entries(section: str, doc: str) -> list[str]:
    """Names that one section of a docstring describes, as in "name: text" or "a, b: text"."""
    names: list[str] = []
    for line in re.findall(r"^ {4}([^ ][^:\n]*):(?:\s|$)", described(section, doc), re.M):
        names += re.findall(r"[\w.]+", re.sub(r"\(.*?\)", "", line))
    return names


@cache
def tree_of(value: Any) -> ast.AST:  # noqa: ANN401
    """Syntax tree of a function or class."""
    return ast.parse(textwrap.dedent(inspect.getsource(value)))


def raised(function: Any) -> set[str]:  # noqa: ANN401
    """Names of the exceptions that a function's own body raises."""
    names = set()
    for node in ast.walk(tree_of(function)):
        if isinstance(node, ast.Raise) and node.exc:
            callee = node.exc.func if isinstance(node.exc, ast.Call) else node.exc
            name = getattr(callee, "id", getattr(callee, "attr", ""))
            names |= {name} if name[:1].isupper() else set()  # a variable may be raised too
    return names


def attributes(cls: type) -> set[str]:
    """Names of a class's attributes: of the class, in annotations, and set on self."""
    names = set(dir(cls)).union(*(inspect.get_annotations(base) for base in cls.__mro__))
    for base in cls.__mro__:
        if base.__module__ in MODULES:
            nodes = ast.walk(tree_of(base))
            names |= {node.attr for node in nodes if isinstance(node, ast.Attribute)}
    return names


def parameters(function: Any) -> set[str]:  # noqa: ANN401
    names = inspect.signature(function).parameters.keys() - {"self", "cls"}
    return {name for name in names if not name.startswith("_")}  # Ray adds private ones to actors


# -- Rules: each yields its violations ---------------------------------------------------------


def clauses() -> Iterator[str]:
    for path, value in [*((path, value) for path, value, _ in OBJECTS), *MODULES.items()]:
        if value.__doc__ and value.__doc__.split()[0].strip(",.:") in CLAUSES:
            yield f"{path}: the summary begins with {value.__doc__.split()[0]!r}"


def noun_phrases() -> Iterator[str]:
    for path, function, owner in FUNCTIONS:
        first = (function.__doc__ or "-").split()[0]
        if first in ARTICLES and not is_attribute(owner, function):
            yield f"{path}: the summary of a function begins with {first!r}, not with a verb"


def missing_arguments() -> Iterator[str]:
    for path, function, owner in FUNCTIONS:
        if is_attribute(owner, function) or is_inherited(owner, function):
            continue
        for name in sorted(parameters(function) - {*entries("Args", function.__doc__ or "")}):
            yield f"{path}: no line for {name} under Args"


def unknown_arguments() -> Iterator[str]:
    for path, function, _ in FUNCTIONS:
        for name in entries("Args", function.__doc__ or ""):
            if name not in parameters(function):
                yield f"{path}: {name} under Args is no argument"


def unknown_attributes() -> Iterator[str]:
    for path, cls in CLASSES:
        for name in entries("Attributes", cls.__doc__ or ""):
            if name not in attributes(cls):
                yield f"{path}: {name} under Attributes is no attribute"


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
            for name in sorted(raised(function) - {*entries("Raises", function.__doc__ or "")}):
                yield f"{path}: no {name} under Raises"


def unknown_errors() -> Iterator[str]:
    for path, value, _ in OBJECTS:
        scope = vars(builtins) | vars(MODULES[value.__module__])
        for name in entries("Raises", value.__doc__ or ""):
            error = scope.get(name)
            known = name in IMPORTED_ERRORS or (
                inspect.isclass(error) and issubclass(error, BaseException)
            )
            if not known:
                yield f"{path}: {name} under Raises is no exception"


IMPORTED_ERRORS = {"ClosedEnvironmentError", "Interrupted", "ReplayError", "TaskError"}
"""Exceptions of called functions, from modules that the caller need not import."""


def missing_fields() -> Iterator[str]:
    """A field is described below it, beside it, above its group, or under Attributes."""
    for path, cls in CLASSES:
        if is_dataclass(cls):
            listed = {*entries("Attributes", cls.__doc__ or "")}
            inherited = {name for base in cls.__mro__[1:] for name in inspect.get_annotations(base)}
            for name in undescribed_fields(cls):
                if not name.startswith("_") and name not in listed | inherited:
                    yield f"{path}.{name}: a field without a description"


def undescribed_fields(cls: type) -> Iterator[str]:
    """Fields without a string below, a comment beside, or a comment above their group."""
    lines = textwrap.dedent(inspect.getsource(cls)).splitlines()
    body = tree_of(cls).body[0].body  # type: ignore[attr-defined]
    group_end, group_comment = 0, False
    for node, following in zip(body, [*body[1:], None], strict=True):
        if not isinstance(node, ast.AnnAssign):
            continue
        if node.lineno != group_end + 1:
            group_comment = lines[node.lineno - 2].lstrip().startswith("#")
        group_end = node.end_lineno or node.lineno
        below = isinstance(following, ast.Expr) and isinstance(following.value, ast.Constant)
        beside = "#" in lines[group_end - 1][node.end_col_offset :]
        if not (below or beside or group_comment):
            yield ast.unparse(node.target)


RULES = [
    clauses,
    noun_phrases,
    missing_arguments,
    unknown_arguments,
    unknown_attributes,
    missing_results,
    missing_errors,
    unknown_errors,
    missing_fields,
]


@pytest.mark.parametrize("rule", RULES)
def test_docstrings_are_complete(rule: Callable[[], Iterator[str]]) -> None:
    assert not list(rule())


@pytest.mark.parametrize("name", WITH_EXAMPLES)
def test_examples_run(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert doctest.testmod(MODULES[name]).failed == 0


# -- The rules themselves ----------------------------------------------------------------------


class Base:
    def described(self, by: int) -> int:
        """Return a number.

        Args:
            by: a number.
        """
        return by

    def undescribed(self, by: int) -> None: ...


class Faulty(Base):
    """A class with every fault.

    Attributes:
        kept: it is set.
        gone: nothing sets it.
    """

    def __init__(self) -> None:
        """Set an attribute."""
        self.kept = 1

    def described(self, by: int) -> int:
        """Return the same number."""
        raise NotImplementedError

    def undescribed(self, by: int) -> None:
        """Do nothing."""

    def misses(self, first: int, second: int, *rest: int, **options: int) -> int:
        """Add numbers.

        Args:
            first: a number; not
                second: a continuation.
            *rest: more numbers.
            third: not an argument.

        Raises:
            TypeError: never.
            NoSuchError: never.
        """
        if first < 0:
            raise ValueError("negative")
        raise LookupError

    def noun(self) -> int:
        """A number."""
        return 1

    def clause(self) -> int:
        """What is a number."""
        return 1


@dataclass
class Fields:
    """Some fields.

    Attributes:
        listed: one.
    """

    listed: int
    missing: int
    beside: int  # one
    below: int = 0
    """One."""
    # One.
    above: int = 0
    _private: int = 0


def test_rules_find_faults(monkeypatch: pytest.MonkeyPatch) -> None:
    functions = [
        (f"Faulty.{name}", value, Faulty)
        for name, value in vars(Faulty).items()
        if inspect.isfunction(value)
    ]
    monkeypatch.setitem(globals(), "MODULES", {__name__: inspect.getmodule(Faulty)})
    monkeypatch.setitem(globals(), "FUNCTIONS", functions)
    monkeypatch.setitem(globals(), "CLASSES", [("Faulty", Faulty)])
    monkeypatch.setitem(globals(), "OBJECTS", [*functions, ("Faulty", Faulty, None)])
    assert {rule.__name__: [line.split(":")[0] for line in rule()] for rule in RULES} == {
        "clauses": ["Faulty.clause"],
        "noun_phrases": ["Faulty.noun"],
        "missing_arguments": ["Faulty.undescribed", "Faulty.misses", "Faulty.misses"],
        "unknown_arguments": ["Faulty.misses"],
        "unknown_attributes": ["Faulty"],
        "missing_results": ["Faulty.misses", "Faulty.noun", "Faulty.clause"],
        "missing_errors": ["Faulty.misses", "Faulty.misses"],
        "unknown_errors": ["Faulty.misses"],
        "missing_fields": [],
    }
    assert list(unknown_attributes()) == ["Faulty: gone under Attributes is no attribute"]
    assert [line.split()[4] for line in missing_arguments()] == ["by", "options", "second"]


def test_fields_without_a_description_are_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(globals(), "CLASSES", [("Fields", Fields)])
    assert [line.split(":")[0] for line in missing_fields()] == ["Fields.missing"]


def test_objects_are_found() -> None:
    assert len(OBJECTS) > 500
    assert len(FUNCTIONS) > 350
    assert sum(bool(raised(function)) for _, function, _ in FUNCTIONS) > 50
    assert sum(len(entries("Attributes", cls.__doc__ or "")) for _, cls in CLASSES) > 20
    assert len(WITH_EXAMPLES) > 3


def test_sections_are_read_whole() -> None:
    args = "Args:\n    a, *b: one.\n    c (int): two,\n        or: three."
    doc = f"Do it.\n\n{args}\n\nReturns:\n    d."
    assert described("Args", doc).rstrip().endswith("or: three.")
    assert described("Raises", doc) == ""
    assert entries("Args", doc) == ["a", "b", "c"]

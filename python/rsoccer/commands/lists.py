"""Options with several words on the command line, of which at least one is given."""

from __future__ import annotations

from collections.abc import Sequence

from tyro.conf import Positional, UseAppendAction
from tyro.constructors import ConstructorRegistry, PrimitiveConstructorSpec, PrimitiveTypeInfo


def add_lists(registry: ConstructorRegistry) -> None:
    """Add the rule by which tyro parses options of several words, such as `--opponents A B`.

    Args:
        registry: rules of the parser; changed in place.
    """

    @registry.primitive_rule
    def _rule(info: PrimitiveTypeInfo) -> PrimitiveConstructorSpec[tuple[str, ...]] | None:
        is_option = not {Positional, UseAppendAction} & set(info.markers)
        if info.type != tuple[str, ...] or not is_option:
            return None
        return PrimitiveConstructorSpec(
            nargs="*",
            metavar="[STR [STR ...]]",
            instance_from_str=lambda words: tuple(some(words)),
            is_instance=lambda value: isinstance(value, tuple),
            str_from_instance=list,
        )


def some(words: Sequence[str]) -> Sequence[str]:
    """Return the words behind an option.

    Args:
        words: the words.

    Raises:
        ValueError: there are none, as if the option were absent.
    """
    if not words:
        raise ValueError("expected at least one value behind the option, got none")
    return words

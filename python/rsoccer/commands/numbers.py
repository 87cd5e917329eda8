"""Whole numbers on the command line: 1000000, 1_000_000 or 1e6."""

from __future__ import annotations

from decimal import Decimal, InvalidOperation

from tyro.constructors import ConstructorRegistry, PrimitiveConstructorSpec, PrimitiveTypeInfo


def whole_numbers() -> ConstructorRegistry:
    """Return the rule by which tyro parses all options of the type int."""
    registry = ConstructorRegistry()

    @registry.primitive_rule
    def _rule(info: PrimitiveTypeInfo) -> PrimitiveConstructorSpec[int] | None:
        if info.type is not int:
            return None
        return PrimitiveConstructorSpec(
            nargs=1,
            metavar="INT",
            instance_from_str=lambda words: parse(words[0]),
            is_instance=lambda value: isinstance(value, int) and not isinstance(value, bool),
            str_from_instance=lambda value: [str(value)],
        )

    return registry


def parse(word: str) -> int:
    """Return the whole number of a word.

    Args:
        word: digits, which underscores may separate, or a number with an exponent, as in 1e6.

    Raises:
        ValueError: another text, a fraction, or a number of more than 18 digits.
    """
    try:
        number = Decimal(word)
    except InvalidOperation:
        number = Decimal("NaN")
    if not number.is_finite() or number != number.to_integral_value() or abs(number) >= 10**18:
        raise ValueError(f"expected a whole number, such as 100 or 1e6, got {word!r}")
    return int(number)

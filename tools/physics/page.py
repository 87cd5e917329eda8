"""The parts of docs/physics.md that are measured or read from the presets."""

import re
from collections import defaultdict
from collections.abc import Callable, Iterable
from functools import partial
from math import ceil, log10
from pathlib import Path

from tools.parts import filled, table
from tools.physics import floor, parameters, presets
from tools.physics.check import Check, Tolerance
from tools.physics.cited import BALLS
from tools.physics.topics import TOPICS, checks

PAGE = Path(__file__).parents[2] / "docs" / "physics.md"
HEADER = ("what", "cases", "tightest case", "expected", "measured", "allowed", "expected from")


def written(page: str) -> str:
    """The page with every part as it should be now."""
    return filled(page, PARTS, PAGE.name)


def topic_table(topic: str) -> str:
    """A line of the acceptance a row: the case that comes nearest to its tolerance."""
    lines: defaultdict[str, list[Check]] = defaultdict(list)
    for check in checks(topic):
        lines[check.what].append(check)
    return table(HEADER, map(_row, lines.values()))


def _row(cases: list[Check]) -> tuple[str, ...]:
    # Rounded, so that rounding errors do not choose among cases that all fit.
    check = max(cases, key=lambda check: round(check.used, 2))
    numbers = (shown(value, check.tolerance) for value in (check.reference, check.measured))
    expected, measured = (f"{number} {check.unit}".strip() for number in numbers)
    allowed = "" if check.tolerance.value == 0.0 else "±"
    return (
        check.what,
        str(len(cases)),
        check.case,
        expected,
        measured,
        f"{allowed}{check.tolerance}",
        check.source,
    )


def shown(value: float, tolerance: Tolerance) -> str:
    """A number with as many digits as its tolerance makes worth reading."""
    if tolerance.relative or tolerance.value == 0.0:
        return f"{value:.4g}"
    text = f"{value:.{max(0, 1 + ceil(-log10(tolerance.value)))}f}"
    return text.removeprefix("-") if float(text) == 0.0 else text


def summary() -> str:
    """All topics: how much is measured, and how near it comes to what is allowed."""
    rows = []
    for topic in TOPICS:
        used = max(check.used for check in checks(topic))
        rows.append((topic, str(len(checks(topic))), f"{used:.0%}"))
    return table(("topic", "numbers", "most of a tolerance that one uses"), rows)


def roll_outs() -> str:
    """Where each kick is slow, fast and at rest."""
    found = {(check.case, check.what): check for check in checks(floor.TOPIC)}
    lines = (floor.SLIDE_TIME, floor.SLIDE_WAY, floor.SPEED_AT_3, floor.SPEED_AT_6, floor.STOP)
    rows = []
    for case in (f"`{name}`, {kick:g} m/s" for name in BALLS for kick in floor.KICKS):
        cells = (found.get((case, line.what)) for line in lines)
        rows.append((case, *("-" if cell is None else _pair(cell) for cell in cells)))
    return table(("kick", *(f"{line.what} ({line.unit})" for line in lines)), rows)


def _pair(check: Check) -> str:
    return f"{check.measured:.3g} ({check.reference:.3g})"


PARTS: dict[str, Callable[[], str]] = {
    **{topic: partial(topic_table, topic) for topic in TOPICS},
    "summary": summary,
    "roll_outs": roll_outs,
    "fields": presets.field_table,
    "balls": presets.ball_table,
    "ssl_robots": presets.ssl_table,
    "ssl_shared": presets.shared_table,
    "vss_robots": presets.vss_table,
    "parameter_names": parameters.table_of_names,
}

NUMBER = re.compile(r"(-?\d+\.\d+)")


def alike(old: str, new: str) -> bool:
    """Whether two pages say the same. Another processor may round a last digit differently."""
    a, b = NUMBER.split(old), NUMBER.split(new)
    if len(a) != len(b) or a[::2] != b[::2]:
        return False
    return all(map(_alike, a[1::2], b[1::2]))


def _alike(old: str, new: str) -> bool:
    digits = len(old.split(".")[1])
    # Presets are short numbers, and exact.
    long = len(old.strip("-0.").replace(".", "")) >= 4
    return old == new or (long and abs(float(old) - float(new)) < 1.5 * 10.0**-digits)


def failing() -> Iterable[Check]:
    """Checks that do not hold."""
    return (check for topic in TOPICS for check in checks(topic) if not check.holds)

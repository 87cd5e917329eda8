"""Generated parts of docs/physics.md: measured tables and preset tables."""

import re
from collections import defaultdict
from collections.abc import Callable
from functools import partial
from math import ceil, log10

from benches.markdown import filled, table
from benches.scenarios import ENGINES
from tools import engine_agreement
from tools.paths import DOCS
from tools.physics import ball_rolling, kick_page, parameters, presets, single_contacts
from tools.physics.check import Check, Tolerance
from tools.physics.cited import BALLS
from tools.physics.topics import TOPICS, all_checks, checks, engines_of

PAGE = DOCS / "physics.md"
HEADER = (
    "quantity",
    "cases",
    "tightest case",
    "expected",
    "measured",
    "tolerance",
    "source of expected value",
)


def render_page(page: str) -> str:
    """Return the page with all generated parts up to date."""
    return filled(page, PARTS, PAGE.name)


def topic_table(topic: str) -> str:
    """Return a table with one row per criterion: the case that uses most of its tolerance."""
    criteria: defaultdict[str, list[Check]] = defaultdict(list)
    for check in checks(topic):
        criteria[check.quantity].append(check)
    return table(HEADER, map(_row, criteria.values()))


def _row(cases: list[Check]) -> tuple[str, ...]:
    # Rounded, so that rounding errors do not decide between cases with the same deviation.
    check = max(cases, key=lambda check: round(check.tolerance_used, 2))
    numbers = (format_value(value, check.tolerance) for value in (check.expected, check.measured))
    expected, measured = (f"{number} {check.unit}".strip() for number in numbers)
    allowed = "" if check.tolerance.value == 0.0 else "±"
    return (
        check.quantity,
        str(len(cases)),
        check.case,
        expected,
        measured,
        f"{allowed}{check.tolerance}",
        check.source,
    )


def format_value(value: float, tolerance: Tolerance) -> str:
    """Format a number with the digits that are significant for its tolerance."""
    if tolerance.relative or tolerance.value == 0.0:
        return f"{value:.4g}"
    text = f"{value:.{max(0, 1 + ceil(-log10(tolerance.value)))}f}"
    return text.removeprefix("-") if float(text) == 0.0 else text


def summary() -> str:
    """Return a table of all topics: number of checks, largest share of a tolerance by engine."""
    rows = []
    for topic in TOPICS:
        used = {
            engine: max(check.tolerance_used for check in checks(topic, engine))
            for engine in engines_of(topic)
        }
        shares = (f"{used[engine]:.0%}" if engine in used else "" for engine in ENGINES)
        rows.append((topic, str(len(checks(topic))), *shares))
    columns = (f"largest share of a tolerance, `{engine}`" for engine in ENGINES)
    return table(("topic", "checks", *columns), rows)


def kick_table() -> str:
    """Return a table of straight kicks: end of sliding, speeds and stopping distance."""
    found = {(check.case, check.quantity): check for check in checks(ball_rolling.TOPIC)}
    criteria = (
        ball_rolling.SLIDE_TIME,
        ball_rolling.SLIDE_DISTANCE,
        ball_rolling.SPEED_AT_3,
        ball_rolling.SPEED_AT_6,
        ball_rolling.STOP,
    )
    rows = []
    for case in (f"`{name}`, {kick:g} m/s" for name in BALLS for kick in ball_rolling.KICKS):
        cells = (found.get((case, criterion.quantity)) for criterion in criteria)
        rows.append((case, *("-" if cell is None else _pair(cell) for cell in cells)))
    return table(
        ("kick", *(f"{criterion.quantity} ({criterion.unit})" for criterion in criteria)), rows
    )


def contact_table() -> str:
    """Return a table of all quantities of single contacts under both engines."""
    rows = []
    for check in checks(single_contacts.TOPIC):
        values = (f"{value:.4g} {check.unit}" for value in (check.expected, check.measured))
        difference = check.measured / check.expected - 1
        rows.append(
            (check.case, check.quantity, *values, f"{difference:+.1%}".replace("-0.0", "+0.0"))
        )
    engines = (f"`{name}`" for name in (single_contacts.REFERENCE, single_contacts.COMPARED))
    return table(("contact", "quantity", *engines, "difference"), rows)


def _pair(check: Check) -> str:
    return f"{check.measured:.3g} ({check.expected:.3g})"


PARTS: dict[str, Callable[[], str]] = {
    **{topic: partial(topic_table, topic) for topic in TOPICS},
    single_contacts.TOPIC: contact_table,
    "engine_play": engine_agreement.play_table,
    "engine_policies": engine_agreement.policy_table,
    "summary": summary,
    "straight_kicks": kick_table,
    "fields": presets.field_table,
    "balls": presets.ball_table,
    "ssl_robots": presets.ssl_table,
    "ssl_shared": presets.shared_table,
    "vss_robots": presets.vss_table,
    "kicks": kick_page.kick_table,
    "parameter_names": parameters.parameter_table,
}

NUMBER = re.compile(r"(-?\d+\.\d+)")


def pages_equal(old: str, new: str) -> bool:
    """Return True if two pages are equal up to the last digit of measured numbers.

    Another processor may round the last digit differently.
    """
    a, b = NUMBER.split(old), NUMBER.split(new)
    if len(a) != len(b) or a[::2] != b[::2]:
        return False
    return all(map(_numbers_equal, a[1::2], b[1::2]))


def _numbers_equal(old: str, new: str) -> bool:
    digits = len(old.split(".")[1])
    # Preset numbers are short and must match exactly.
    long = len(old.strip("-0.").replace(".", "")) >= 4
    return old == new or (long and abs(float(old) - float(new)) < 1.5 * 10.0**-digits)


def failed_checks() -> list[str]:
    """Return the checks that fail under any contact engine, each as a line."""
    return [describe(engine, check) for engine, check in all_checks() if not check.passed]


def describe(engine: str, check: Check) -> str:
    """Return a check with its contact engine as a line of text."""
    return f"{engine}: {check}"

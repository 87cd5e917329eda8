"""Codes of errors."""

from rsoccer.protocols.errors import Code

# Programs rely on these: a code may be added, but none may change or vanish.
CODES = [
    *("UNREADABLE", "TOO_LARGE", "NOT_FINITE", "OUT_OF_RANGE", "UNKNOWN_TEAM", "UNKNOWN_ROBOT"),
    *("DUPLICATE_ROBOT", "INCOMPLETE", "INVALID_SPEC", "UNSUPPORTED_MOVE", "UNSUPPORTED_KICK"),
    *("UNSUPPORTED_DRIBBLER", "UNSUPPORTED_BY_FORCE", "UNSUPPORTED_GEOMETRY"),
    *("UNSUPPORTED_REALISM", "UNSUPPORTED_CUSTOM", "UNSUPPORTED_COMMAND", "UNSUPPORTED_EVENT"),
    *("BAD_LOG", "CUT_OFF", "MORE_PROBLEMS"),
]


def test_codes_are_stable() -> None:
    assert [str(code) for code in Code] == CODES
    assert all(code.name == code.value for code in Code)

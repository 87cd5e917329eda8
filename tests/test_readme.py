import subprocess
import sys

import pytest

from tools.write_readme import README, written

ROOT = README.parent
TEXT = README.read_text()


def test_parts_derived_from_code_are_current() -> None:
    # In a process of its own: other tests register tasks in this one.
    command = [sys.executable, "-m", "tools.write_readme", "--check"]
    ran = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr


def test_a_stale_part_is_written_anew() -> None:
    stale = TEXT.replace("| `VSSSelfPlay-v0` |", "| `VSSOther-v0` |")
    assert stale != TEXT
    assert written(stale) == TEXT


def test_a_part_that_nobody_writes_is_refused() -> None:
    with pytest.raises(ValueError, match="nobody_writes_this"):
        written("<!-- begin:nobody_writes_this -->\n<!-- end:nobody_writes_this -->")

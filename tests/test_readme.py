import subprocess
import sys

import pytest

from tools.paths import DOCS
from tools.write_readme import README, written

ROOT = README.parent


def test_parts_derived_from_code_are_current() -> None:
    # In a process of its own: other tests register tasks in this one.
    command = [sys.executable, "-m", "tools.write_readme", "--check"]
    ran = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr


def test_a_stale_part_is_renewed() -> None:
    text = (DOCS / "getting-started.md").read_text()
    stale = text.replace("| `VSSSelfPlay-v0` |", "| `VSSOther-v0` |")
    assert stale != text
    assert written(stale) == text


def test_an_unknown_part_is_refused() -> None:
    with pytest.raises(ValueError, match=r"unknown.*no_such_part"):
        written("<!-- begin:no_such_part -->\n<!-- end:no_such_part -->")

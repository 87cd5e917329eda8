import re
import subprocess
import sys
from pathlib import Path

import pytest

from rsoccer import cli
from tools.write_readme import README, written

ROOT = README.parent
TEXT = README.read_text()
PYTHON = re.findall(r"```python\n(.*?)```", TEXT, re.DOTALL)
SHELL = [
    line.split("#")[0].strip()
    for block in re.findall(r"```sh\n(.*?)```", TEXT, re.DOTALL)
    for line in block.splitlines()
    if line.split("#")[0].strip()
]
OURS = [line for line in SHELL if line.startswith("rsoccer ")]


def test_there_is_something_to_run() -> None:
    assert len(PYTHON) >= 3
    assert len(OURS) >= 3


@pytest.mark.parametrize("number", range(len(PYTHON)))
def test_python_blocks_run(number: int, tmp_path: Path) -> None:
    block = tmp_path / "block.py"
    block.write_text(PYTHON[number])
    command = [sys.executable, "-W", "error", str(block)]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, f"{PYTHON[number]}\n{ran.stderr}"


@pytest.mark.parametrize("line", OURS)
def test_commands_have_the_options_that_are_shown(
    line: str, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("tyro")
    words = line.split()
    with pytest.raises(SystemExit) as left:
        cli.main([words[1], "--help"])
    assert left.value.code == 0
    shown = capsys.readouterr().out
    for option in (word for word in words if word.startswith("--")):
        assert option in shown, f"`rsoccer {words[1]} --help` knows no {option}"


@pytest.mark.parametrize("line", [line for line in SHELL if line.startswith("make ")])
def test_make_targets_exist(line: str) -> None:
    target = line.split()[1]
    makefile = (ROOT / "Makefile").read_text()
    assert re.search(rf"^{re.escape(target)}:", makefile, re.MULTILINE), target


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

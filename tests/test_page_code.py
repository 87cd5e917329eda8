"""Code on the pages: Python blocks run, commands and targets exist."""

import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

from benches.markdown import FENCE
from rsoccer import cli
from tests.ray_start import patiently

ROOT = Path(__file__).parents[1]
WRITTEN = [*(ROOT / "docs").rglob("*.md"), ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
RUN = """
import sys, traceback
from pathlib import Path

names = {}
for path in sorted(Path.cwd().glob("*.py")):
    if "continued" not in path.name:
        names = {"__name__": "__main__"}
    exec(compile(path.read_text(), str(path), "exec"), names)
"""
NEEDS = "needs_"
"""Start of the kind of a block that runs only where a library is installed: `needs_ray`."""
PAGES = sorted(page for page in WRITTEN if FENCE.search(page.read_text()))
LIBRARY_BLOCKS = [
    (kind.removeprefix(NEEDS), code)
    for page in PAGES
    for kind, code in FENCE.findall(page.read_text())
    if kind.startswith(NEEDS)
]
LIBRARIES = sorted({library for library, _ in LIBRARY_BLOCKS})


def run(blocks: list[tuple[str, str]], folder: Path, *options: str) -> None:
    """Run blocks of code, given with their kinds, in a process of its own."""
    for number, (kind, code) in enumerate(blocks):
        (folder / f"block_{number:02}{kind}.py").write_text(code)
    command = [sys.executable, *options, "-c", RUN]
    ran = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr


def test_pages_with_code_are_found() -> None:
    assert len(PAGES) >= 9
    assert ROOT / "README.md" in PAGES
    assert {"ray", "stable_baselines3", "torchrl"} <= set(LIBRARIES)


@pytest.mark.parametrize("page", PAGES, ids=[str(page.relative_to(ROOT)) for page in PAGES])
def test_blocks_run(page: Path, tmp_path: Path) -> None:
    blocks = FENCE.findall(page.read_text())
    kinds = {kind for kind, _ in blocks if not kind.startswith(NEEDS)}
    assert kinds <= {"", "continued", "notest"}
    run([block for block in blocks if block[0] in ("", "continued")], tmp_path, "-W", "error")


@pytest.mark.parametrize("library", LIBRARIES)
def test_blocks_run_with_their_library(library: str, tmp_path: Path) -> None:
    """Warnings are no errors: other libraries warn of their own affairs."""
    if find_spec(library) is None:
        pytest.skip(f"{library} is not installed")
    blocks = [("", code) for name, code in LIBRARY_BLOCKS if name == library]
    patiently(lambda: run(blocks, tmp_path))


def test_blocks_that_do_not_run_are_python() -> None:
    skipped = [code for page in PAGES for kind, code in FENCE.findall(page.read_text()) if kind]
    assert len(skipped) >= 4
    for code in skipped:
        compile(code, "block", "exec")


COMMANDS = sorted(
    {
        line.split("#")[0].strip()
        for page in WRITTEN
        for block in re.findall(r"^```sh\n(.*?)^```$", page.read_text(), re.DOTALL | re.MULTILINE)
        for line in block.splitlines()
        if line.startswith(("rsoccer ", "make "))
    }
)


@pytest.mark.parametrize("line", [line for line in COMMANDS if line.startswith("rsoccer ")])
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
        assert option in shown, f"`rsoccer {words[1]} --help` has no {option}"


@pytest.mark.parametrize("line", [line for line in COMMANDS if line.startswith("make ")])
def test_make_targets_exist(line: str) -> None:
    makefile = (ROOT / "Makefile").read_text()
    assert re.search(rf"^{re.escape(line.split()[1])}:", makefile, re.MULTILINE), line


def test_a_target_runs_the_blocks_of_every_library() -> None:
    """Recipes have tests of their own; the other libraries are listed in the Makefile."""
    makefile = (ROOT / "Makefile").read_text()
    recipes = set(re.findall(r"^RECIPE_(\w+) :=", makefile, re.MULTILINE))
    listed = re.findall(r"\$\(foreach library,([\w ]+),|\$\(OF_LIBRARY\)\[(\w+)\]", makefile)
    named = {name for several, one in listed for name in f"{several} {one}".split()}
    assert named | recipes == set(LIBRARIES)

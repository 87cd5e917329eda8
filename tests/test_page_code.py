"""Code on the pages: Python blocks run, commands and targets exist."""

import re
import subprocess
import sys
from collections.abc import Iterator
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


BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
INLINE = re.compile(r"`((?:rsoccer|make) [^`\n]+)`")
OPTION = re.compile(r"(?<![\w-])--[a-z][\w-]*")


def commands(text: str) -> Iterator[str]:
    """Yield the commands of a page, from blocks of any kind and from within lines."""
    for _, block in BLOCK.findall(text):
        for line in block.replace("\\\n", " ").splitlines():
            if line.startswith(("rsoccer ", "make ")):
                yield line.split(" #")[0].strip()
    yield from INLINE.findall(BLOCK.sub("", text))


COMMANDS = sorted({line for page in WRITTEN for line in commands(page.read_text())})
SHELL_BLOCKS = sorted(
    {block for page in WRITTEN for kind, block in BLOCK.findall(page.read_text()) if kind == "sh"}
)


def test_commands_are_found_in_all_blocks_and_within_lines() -> None:
    text = "`rsoccer list`\n```\nrsoccer watch \\\n  chase  # a match\n```\n```sh\nmake demo\n```\n"
    assert list(commands(text)) == ["rsoccer watch    chase", "make demo", "rsoccer list"]
    assert len(COMMANDS) >= 100


@pytest.mark.parametrize("block", SHELL_BLOCKS)
def test_shell_blocks_have_no_syntax_error(block: str) -> None:
    ran = subprocess.run(["sh", "-n"], input=block, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr


@pytest.mark.parametrize("line", [line for line in COMMANDS if line.startswith("rsoccer ")])
def test_commands_have_the_options_that_are_shown(
    line: str, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("tyro")
    words = line.split()
    with pytest.raises(SystemExit) as left:
        cli.main([words[1], "--help"])
    assert left.value.code == 0
    shown = set(OPTION.findall(capsys.readouterr().out))
    assert shown, f"`rsoccer {words[1]} --help` shows no options"
    for option in OPTION.findall(line):
        assert option in shown, f"`rsoccer {words[1]} --help` has no {option}"


@pytest.mark.parametrize("line", [line for line in COMMANDS if line.startswith("make ")])
def test_make_targets_exist(line: str) -> None:
    makefile = (ROOT / "Makefile").read_text()
    for name, value in re.findall(r"^(\w+) := ([^\s$]+)", makefile, re.MULTILINE):
        makefile = makefile.replace(f"$({name})", value)
    assert re.search(rf"^{re.escape(line.split()[1])}:", makefile, re.MULTILINE), line


def test_a_target_runs_the_blocks_of_every_library() -> None:
    """Recipes have tests of their own; the other libraries are listed in the Makefile."""
    makefile = (ROOT / "Makefile").read_text()
    recipes = set(re.findall(r"^RECIPE_(\w+) :=", makefile, re.MULTILINE))
    listed = re.findall(r"\$\(foreach library,([\w ]+),|\$\(OF_LIBRARY\)\[(\w+)\]", makefile)
    named = {name for several, one in listed for name in f"{several} {one}".split()}
    assert named | recipes == set(LIBRARIES)

"""The tutorial on a folder of one's own, followed in an empty folder."""

import re
from pathlib import Path

import pytest

from tests.own_things import run_in, write_package

PAGE = (Path(__file__).parents[1] / "docs" / "tutorials" / "your-own-folder.md").read_text()
FILE = re.compile(r"<!-- file: ([\w.]+) -->\n```\w+\n(.*?)^```$", re.DOTALL | re.MULTILINE)
COMMANDS = [
    line for line in re.findall(r"^rsoccer (.*)$", PAGE, re.MULTILINE) if "--help" not in line
]
ENTRY_POINTS = re.compile(
    r'^\[project\.entry-points\."(.*)"\]\n"?([\w-]+)"? = "(.*)"$', re.MULTILINE
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with the files of the page alone."""
    files = dict(FILE.findall(PAGE))
    assert sorted(files) == ["duel.py", "heavy.json"]
    for name, content in files.items():
        (tmp_path / name).write_text(content)
    return tmp_path


def test_the_commands_run_in_their_order(folder: Path) -> None:
    pytest.importorskip("torch")
    assert len(COMMANDS) == 7
    outputs = []
    for command in COMMANDS:
        done = run_in(folder, *command.split())
        assert done.returncode == 0, f"{command}: {done.stderr}"
        outputs.append(done.stdout)
    assert "Duel-v0: One robot against one, for ten seconds." in outputs[0]
    assert "spin:0.3" in outputs[1]
    assert outputs[-1].startswith("Duel-v0\n")
    assert (folder / "match.html").is_file()


def test_the_package_is_known_without_an_import(folder: Path, tmp_path: Path) -> None:
    points = ENTRY_POINTS.findall(PAGE)
    assert [group for group, _, _ in points] == ["rsoccer.tasks", "rsoccer.policies"]
    write_package(
        folder, "".join(f"[{group}]\n{name} = {value}\n" for group, name, value in points)
    )
    words = ["evaluate", "spin", "--task", "Duel-v0", "--opponents", "ou", "--matches", "2"]
    done = run_in(Path("/"), *words, path=folder)
    assert done.returncode == 0, done.stderr

"""Tasks and policies of modules and of installed packages."""

from pathlib import Path

import pytest

from rsoccer import plugins
from tests.own_things import run_in, write_module, write_package

ENTRY_POINTS = """
[rsoccer.tasks]
Duel-v0 = mine:Duel
Lost-v0 = mine:Lost
Wrong-v0 = mine:np

[rsoccer.policies]
spin = mine:Spin
wrong = mine:MISSING
text = mine:__doc__
"""
USE = """
import rsoccer
task = rsoccer.make_task("Duel-v0")
matches = rsoccer.Matches(task, 2, controllers={"yellow": "spin:0.5"})
print(matches.agents, rsoccer.list_tasks().count("Duel-v0"))
"""
CHILD = """
import multiprocessing
import sys

from rsoccer.plugins import import_modules

def play(name):
    import rsoccer
    print(rsoccer.make_task(name).agents, flush=True)

if __name__ == "__main__":
    import_modules(["mine"])
    process = multiprocessing.get_context("spawn").Process(target=play, args=["Duel-v0"])
    process.start()
    process.join()
    sys.exit(process.exitcode)
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A folder of the search path with an installed package."""
    folder = tmp_path / "site"
    folder.mkdir()
    write_module(folder, registers=False)
    write_package(folder, ENTRY_POINTS)
    return folder


def test_entry_points_are_found_by_their_names(package: Path, tmp_path: Path) -> None:
    done = run_in(tmp_path, "-c", USE, path=package)
    assert done.stdout == "('blue_0',) 1\n", done.stderr


def test_entry_points_are_not_loaded_before_their_names_are_asked_for(
    package: Path, tmp_path: Path
) -> None:
    code = "import sys, rsoccer; rsoccer.make_task('VSS-v0'); print('mine' in sys.modules)"
    assert run_in(tmp_path, "-c", code, path=package).stdout == "False\n"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["watch", "Lost-v0"], "'Lost-v0': the entry point 'mine:Lost' of mine 1.0 in"),
        (["watch", "Wrong-v0"], "'Wrong-v0': the entry point in 'rsoccer.tasks' names no task: "),
        (["evaluate", "wrong"], "'wrong': the entry point 'mine:MISSING' of mine 1.0 in"),
        (["evaluate", "text"], "'text': the entry point in 'rsoccer.policies' names no policy: "),
    ],
)
def test_a_broken_entry_point_is_named(
    words: list[str], message: str, package: Path, tmp_path: Path
) -> None:
    done = run_in(tmp_path, *words, path=package)
    assert done.returncode == 2
    assert done.stderr.startswith(f"rsoccer: {message}")
    assert done.stderr.count("\n") == 1


def test_the_list_has_entry_points_and_broken_ones(package: Path, tmp_path: Path) -> None:
    done = run_in(tmp_path, "list", path=package)
    assert "Duel-v0: One robot against one that turns.\n    field=" in done.stdout
    assert "\n'Lost-v0': the entry point 'mine:Lost'" in done.stdout
    assert ", spin, strike, take, uniform," in done.stdout, "text and wrong are no policies"
    assert "\n'text': the entry point in 'rsoccer.policies' names no policy: " in done.stdout
    assert "\n'wrong': the entry point 'mine:MISSING' of mine 1.0 in" in done.stdout


def test_tasks_of_entry_points_are_listed_without_being_loaded(
    package: Path, tmp_path: Path
) -> None:
    code = "import sys, rsoccer; print('Duel-v0' in rsoccer.list_tasks(), 'mine' in sys.modules)"
    assert run_in(tmp_path, "-c", code, path=package).stdout == "True False\n"


def test_entry_points_with_taken_names_are_reported(tmp_path: Path) -> None:
    """Formerly they were dropped without a word."""
    taken = {"rsoccer.tasks": ["VSS-v0", "VSSMA-v0"], "rsoccer.policies": ["chase"]}
    lines = [f"[{group}]\n" + "".join(f"{n} = mine:It\n" for n in taken[group]) for group in taken]
    write_package(tmp_path, "\n".join(lines))
    done = run_in(tmp_path, "list", path=tmp_path)
    assert done.returncode == 0
    assert done.stdout.count("\nVSS-v0: ") == 1
    for group, names in taken.items():
        for name in names:
            message = f"{name!r}: the entry point 'mine:It' of mine 1.0 in {group!r} is ignored: "
            assert done.stderr.count(message) == 1


def test_child_processes_import_the_modules_too(tmp_path: Path) -> None:
    folder, script = tmp_path / "own", tmp_path / "script.py"
    folder.mkdir()
    write_module(folder)
    script.write_text(CHILD)
    done = run_in(folder, str(script))
    assert done.stdout == "('blue_0',)\n", done.stderr


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("tasks.py", "import: expected the name of a module, such as tasks, got 'tasks.py'"),
        ("my tasks", "import: expected the name of a module, got 'my tasks'"),
        ("", "import: expected the name of a module, got ''"),
        ("no_such_module", "import: expected a module of .* or an installed one, got 'no_such"),
        ("broken", "import: 'broken' raises NameError: name 'lost' is not defined"),
        ("needs", "import: 'needs' raises ModuleNotFoundError: No module named 'no_such'"),
    ],
)
def test_what_cannot_be_imported_is_named(
    name: str, message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "broken.py").write_text("lost")
    (tmp_path / "needs.py").write_text("import no_such")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises((ImportError, ValueError), match=message):
        plugins.import_modules([name])

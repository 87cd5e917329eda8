"""Ctrl-C while the package is imported for the command `rsoccer`."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from rsoccer import interrupts

SCRIPT = "/usr/local/bin/rsoccer"
# The process interrupts itself in the midst of the import: where `rsoccer._core` is looked for.
INTERRUPTING = """
import os, signal, sys
class Finder:
    def find_spec(self, name, path, target=None):
        if name == "rsoccer._core":
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Finder())
"""


@pytest.mark.parametrize(
    ("arguments", "started", "expected"),
    [
        (["-m", "list"], ["python", "-X", "utf8", "-m", "rsoccer", "list"], True),
        (["-m"], ["python", "-m", "rsoccer"], True),
        (["-m"], ["python", "-m", "rsoccer.drive.guard_process"], False),
        (["-m", "rsoccer"], ["python", "-m", "pytest", "rsoccer"], False),
        ([SCRIPT, "list"], ["python", SCRIPT, "list"], True),
        (["train.py", "list"], ["python", "train.py", "list"], False),
        (["-c"], ["python", "-c", "import rsoccer"], False),
        # A process that a command starts has the command's arguments.
        ([SCRIPT, "list"], ["python", "-c", "from multiprocessing.spawn import spawn_main"], False),
        ([SCRIPT, "a", "b", "c"], ["python", "-c"], False),
        ([], ["python"], False),
        ([""], ["python"], False),
    ],
)
def test_the_command_is_no_other_program(
    arguments: list[str], started: list[str], expected: bool
) -> None:
    assert interrupts.is_command(arguments, started) is expected


@pytest.mark.skipif(os.name != "posix", reason="sends a signal")
@pytest.mark.parametrize("is_ignored", [False, True])
def test_ctrl_c_in_an_import_ends_the_command_without_a_word(
    tmp_path: Path, is_ignored: bool
) -> None:
    handler = "SIG_IGN" if is_ignored else "default_int_handler"
    code = f"{INTERRUPTING}signal.signal(signal.SIGINT, signal.{handler})\n"
    (tmp_path / "sitecustomize.py").write_text(code)
    done = subprocess.run(
        [sys.executable, "-m", "rsoccer", "--version"],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": _path(tmp_path)},
        check=False,
    )
    assert done.stderr == ""
    assert done.returncode == (0 if is_ignored else interrupts.INTERRUPTED)


@pytest.mark.skipif(os.name != "posix", reason="sends a signal")
def test_other_programs_get_the_exception_of_ctrl_c(tmp_path: Path) -> None:
    (tmp_path / "sitecustomize.py").write_text(
        f"{INTERRUPTING}signal.signal(signal.SIGINT, signal.default_int_handler)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", "import rsoccer"],
        capture_output=True,
        text=True,
        env={**os.environ, "PYTHONPATH": _path(tmp_path)},
        check=False,
    )
    assert done.stderr.endswith("KeyboardInterrupt\n")


def test_commands_called_from_python_keep_the_handler_of_the_program() -> None:
    previous = signal.getsignal(signal.SIGINT)
    interrupts.handle()
    assert signal.getsignal(signal.SIGINT) is previous


def _path(folder: Path) -> str:
    """A search path with a folder before the others."""
    return os.pathsep.join(filter(None, [str(folder), os.environ.get("PYTHONPATH", "")]))

"""The program maturin of this environment."""

import os
import subprocess
import sys
from importlib.metadata import files
from pathlib import Path

from tools.paths import ROOT


def program() -> Path:
    """Return the program of the package maturin that this environment sees.

    Another one may come first in PATH: that of pyenv hides this environment's Python, and so zig.

    Raises:
        RuntimeError: the package has no program.
    """
    for file in files("maturin") or []:
        if file.name in ("maturin", "maturin.exe") and file.parent.name in ("bin", "Scripts"):
            return Path(str(file.locate())).resolve()
    raise RuntimeError("expected a program in the package maturin, found none")


def run(*arguments: str, **variables: str) -> None:
    """Run maturin with the Python and the zig of this environment.

    Args:
        arguments: Of the command line.
        variables: Environment variables that differ from those of this process.

    Raises:
        CalledProcessError: maturin has failed.
    """
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, **variables}
    subprocess.run([str(program()), *arguments], check=True, cwd=ROOT, env=environment)

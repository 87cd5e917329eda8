"""A wheel in an empty environment without cargo and compiler: `make wheels`.

python -m tools.wheels.tryout WHEEL [--folder FOLDER] [--light]

With the required packages alone the golden hashes of the physics are right, the README's ten lines
run, and `import rsoccer` loads nothing else. With all extras, a trained policy is evaluated, a
match is filmed, and robots train for a while.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Final

from benches.markdown import FENCE
from tools.paths import ROOT

LIGHT: Final = """
import sys
import rsoccer
from importlib.metadata import distributions
installed = {d.metadata["Name"].lower() for d in distributions()}
heavy = installed & {"torch", "pygame-ce", "tyro", "matplotlib", "pillow", "scipy", "protobuf"}
assert not heavy, f"rsoccer requires {heavy}"
assert not {"torch", "pygame", "tyro"} & sys.modules.keys()
"""
GOLDEN: Final = ROOT / "crates" / "rsim-core" / "tests" / "golden.txt"
COMMANDS: Final = (
    "rsoccer --version",
    "rsoccer evaluate best --task VSS-v0 --matches 20",
    "rsoccer watch VSSMatch-v0 --seconds 5 --video match.mp4 --html match.html --save match.rsr",
    "rsoccer watch match.rsr --html again.html",
    "rsoccer train --task SSLGoToBall-v0 --samples 200000 --out run",
    "rsoccer evaluate run/policy.safetensors --matches 20",
)
"""Commands of the README, shortened."""


def same_bits() -> str:
    """Return a program that fails if the physics give other states than the core's tests expect."""
    _, *lines = GOLDEN.read_text().splitlines()
    hashes = dict(line.split() for line in lines)
    return f"""
from rsoccer import _core
found, expected = _core.golden_hashes(), {hashes}
differ = sorted(name for name in found | expected if found.get(name) != expected.get(name))
assert not differ, f"other states in {{differ}}"
"""


def ten_lines() -> str:
    """Return the first program of the README."""
    code: str = FENCE.findall((ROOT / "README.md").read_text())[0][1]
    return code


class Environment:
    """A new virtual environment in which programs find its own commands alone."""

    def __init__(self, folder: Path) -> None:
        """Make it in a folder."""
        self._folder = folder
        subprocess.run([sys.executable, "-m", "venv", str(folder / "env")], check=True)
        self._bin = folder / "env" / ("Scripts" if sys.platform == "win32" else "bin")

    def install(self, *requirements: str) -> None:
        """Install packages from wheels only."""
        pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        self.run(str(self._bin / "python"), *pip, "--only-binary", ":all:", *requirements)

    def run(self, *command: str) -> None:
        """Run a command, without a compiler in its path."""
        environment = {
            "PATH": str(self._bin),
            "HOME": str(self._folder),
            "SDL_VIDEODRIVER": "dummy",
        }
        subprocess.run(command, check=True, cwd=self._folder, env=environment)

    def python(self, code: str) -> None:
        """Run a program."""
        self.run(str(self._bin / "python"), "-c", code)

    def command(self, line: str) -> None:
        """Run a command of the environment."""
        name, *arguments = line.split()
        self.run(str(self._bin / name), *arguments)


def try_wheel(wheel: Path, folder: Path, light: bool) -> None:
    """Install a wheel, and run what users run first.

    Args:
        wheel: Path of the wheel.
        folder: An empty folder.
        light: Whether to leave out the extras, which need some gigabytes.

    Raises:
        CalledProcessError: An installation or a program has failed.
    """
    environment = Environment(folder)
    environment.install(str(wheel))
    environment.python(LIGHT)
    environment.python(same_bits())
    environment.python(ten_lines())
    if light:
        return
    environment.install(f"rsoccer[all] @ {wheel.resolve().as_uri()}")
    for line in COMMANDS:
        print(f"$ {line}", flush=True)
        environment.command(line)


def main(arguments: list[str] | None = None) -> None:
    """Try a wheel.

    Args:
        arguments: Of the command line; None for those of this process.
    """
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("wheel", type=Path, help="a wheel, or a folder that holds one alone")
    parser.add_argument("--folder", type=Path, help="folder of the environment; a temporary one")
    parser.add_argument("--light", action="store_true", help="the required packages alone")
    options = parser.parse_args(arguments)
    wheel = options.wheel.resolve()
    if wheel.is_dir():
        [wheel] = wheel.glob("*.whl")
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        try_wheel(wheel, Path(folder).resolve(), options.light)
    print(f"works: {wheel.name}")


if __name__ == "__main__":
    main()

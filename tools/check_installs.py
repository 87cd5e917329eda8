"""Each documented install line, run as it is written in an empty environment.

`make check-installs`, or python -m tools.check_installs [--only TEXT] [--folder FOLDER]

The package itself is built once, and installed first where a line is for something beside it.
Then the program that the documentation shows for the line runs in the new environment.
"""

import argparse
import os
import re
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Final, NamedTuple

from benches.markdown import FENCE
from rsoccer.cli import EXTRAS
from tools.paths import DOCS, ROOT

LIBRARIES: Final = DOCS / "libraries.md"
HELLO: Final = "import rsoccer; print(rsoccer.parallel_env('VSSSelfPlay-v0').reset(seed=7)[1])"
COMMAND: Final = "import sys, rsoccer.cli; sys.exit(rsoccer.cli.main(['list']))"


class Install(NamedTuple):
    """Program that needs a line, and the environment that it begins from."""

    program: str
    """Code that needs the line, or the name of a library whose blocks in docs/libraries.md do."""
    beside: bool = True
    """Whether the package is installed before."""


INSTALLS: Final = {
    ".": Install(HELLO, beside=False),
    "'.[all]'": Install(COMMAND, beside=False),
    "'.[cli,network]'": Install(
        "import sys, rsoccer.cli; rsoccer.cli.main(['serve', '-h'])", beside=False
    ),
    "'.[data]'": Install("import minari, h5py, rsoccer.datasets", beside=False),
    "'rsoccer[render]'": Install(
        "import rsoccer; env = rsoccer.single_env('VSS-v0', 'rgb_array'); env.reset(); env.render()"
    ),
    "'rsoccer[train]'": Install("import rsoccer.train, safetensors, torch, tensorboard"),
    "'rsoccer[cli]'": Install(COMMAND),
    "'rsoccer[data]'": Install("import minari, h5py, rsoccer.datasets"),
    "'rsoccer[network]'": Install(
        "import websockets, rsoccer.bridge.server, rsoccer.protocols.vision"
    ),
    "'rsoccer[onnx]'": Install(
        "from rsoccer import policies; best = policies.make_policy('best', 'VSS-v0'); "
        "best.save_onnx('best.onnx'); print(policies.make_policy('best.onnx', 'VSS-v0'))"
    ),
    '"stable-baselines3>=2.4"': Install("import rsoccer.sb3; rsoccer.sb3.SoccerVecEnv('VSS-v0')"),
    '"stable-baselines3>=2.4" safetensors': Install("stable_baselines3"),
    '"torchrl>=0.14"': Install("torchrl"),
    "benchmarl==1.5.2": Install("benchmarl"),
    '"ray[rllib]>=2.60" torch': Install("ray"),
    "supersuit": Install("supersuit"),
    "tianshou==2.0.1": Install("tianshou"),
    "--no-deps pufferlib==2.0.2 gym==0.23.0": Install("pufferlib"),
}
"""Arguments of `pip install`, as they are written."""

ARGUMENT: Final = r"""(?:'[^'\n]+'|"[^"\n]+"|[\w.=-]+)"""
LINE: Final = re.compile(rf"pip install ({ARGUMENT}(?: {ARGUMENT})*)")


def documented() -> dict[str, set[str]]:
    """Return the arguments of all documented install lines, each with the files that have it."""
    found: dict[str, set[str]] = {}
    for path in _files():
        for line in _lines(path):
            found.setdefault(line, set()).add(path.relative_to(ROOT).as_posix())
    return found


def _files() -> Iterator[Path]:
    yield ROOT / "README.md"
    yield from sorted(DOCS.rglob("*.md"))
    yield from sorted((ROOT / "examples").glob("*.py"))
    yield from sorted((ROOT / "python").rglob("*.py"))


def _lines(path: Path) -> Iterator[str]:
    text = path.read_text()
    for line in LINE.findall(text):
        yield from [f"'rsoccer[{extra}]'" for extra in EXTRAS.values()] if "{" in line else [line]
    if path == LIBRARIES:
        table = text.split("| `pip install` |\n")[1].split("\n\n")[0]
        for row in table.splitlines()[1:]:
            yield from re.findall(r"`([^`]+)`", row.split("|")[-2])


def program_of(install: Install) -> str:
    """Return the code that runs after an installation."""
    if not install.program.isidentifier():
        return install.program
    blocks = FENCE.findall(LIBRARIES.read_text())
    return "\n".join(code for kind, code in blocks if kind == f"needs_{install.program}")


def try_line(arguments: str, folder: Path, wheel: Path) -> None:
    """Install in a new environment, and run the program.

    Args:
        arguments: a key of `INSTALLS`.
        folder: an empty folder for the environment.
        wheel: the built package.

    Raises:
        CalledProcessError: the installation or the program has failed.
    """
    install = INSTALLS[arguments]
    python = folder / "bin" / "python"
    subprocess.run([sys.executable, "-m", "venv", str(folder)], check=True)
    pip = [str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    # The package is in no index yet: `rsoccer[cli]` is found beside the wheel.
    environment = {**os.environ, "PIP_FIND_LINKS": str(wheel.parent)}
    if install.beside:
        subprocess.run([*pip, str(wheel)], check=True)
    subprocess.run([*pip, *shlex.split(arguments)], cwd=ROOT, env=environment, check=True)
    program = folder / "program.py"
    program.write_text(program_of(install))
    subprocess.run([str(python), str(program)], cwd=folder, check=True)


def build_wheel(folder: Path) -> Path:
    """Build the package.

    Args:
        folder: a folder for the wheel.

    Returns:
        Path of the wheel.
    """
    pip = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--no-build-isolation"]
    bin_folder = str(Path(sys.executable).parent)
    environment = {**os.environ, "PATH": f"{bin_folder}{os.pathsep}{os.environ['PATH']}"}
    subprocess.run([*pip, "--wheel-dir", str(folder), str(ROOT)], env=environment, check=True)
    return next(folder.glob("rsoccer-*.whl"))


def main(arguments: list[str] | None = None) -> int:
    """Try the lines, and print which ones work.

    Args:
        arguments: of the command line; None for those of this process.

    Returns:
        The number of lines that have failed.
    """
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="lines with this text")
    parser.add_argument("--folder", type=Path, help="folder of the environments; a temporary one")
    options = parser.parse_args(arguments)
    failed = 0
    with tempfile.TemporaryDirectory(dir=options.folder) as name:
        folder = Path(name).resolve()
        wheel = build_wheel(folder)
        for line in (line for line in INSTALLS if options.only in line):
            try:
                # One environment at a time: with torch it takes some gigabytes.
                with tempfile.TemporaryDirectory(dir=folder) as environment:
                    try_line(line, Path(environment), wheel)
            except subprocess.CalledProcessError as error:
                failed += 1
                print(f"FAILED  pip install {line}: {error}", flush=True)
            else:
                print(f"works   pip install {line}", flush=True)
    return failed


if __name__ == "__main__":
    sys.exit(main())

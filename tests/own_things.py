"""A folder with a task, policies and a robot of a user's own, and commands that run there."""

import os
import subprocess
import sys
from pathlib import Path

import rsoccer

PACKAGES = Path(rsoccer.__file__).parent.parent

MODULE = '''
"""A task and policies of one's own."""
from dataclasses import dataclass

import numpy as np

import rsoccer
from rsoccer.tasks import VssMulti, VssSelfPlay


class Spin(rsoccer.Policy):
    """Turns on the spot."""

    observes = "nothing"

    def __init__(self, task=None, skill=1.0):
        super().__init__(task)
        self.skill = skill

    def act(self, inputs, rng, memory):
        return np.full(inputs.action_shape, self.skill, np.float32) * np.array([-1, 1], np.float32)


@dataclass(frozen=True)
class Duel(VssSelfPlay):
    """One robot against one that turns."""

    n_blue: int = 1
    n_yellow: int = 1
    max_steps: int = 20

    def default_controllers(self):
        return {"blue_0": rsoccer.LEARN, "yellow_0": Spin()}
'''
REGISTERING = """
rsoccer.register("Duel-v0", Duel)
rsoccer.register_policy("spin", Spin)
"""


def write_module(folder: Path, name: str = "mine", *, registers: bool = True) -> None:
    """Write the module, and the file of a robot that is heavier than its preset."""
    (folder / f"{name}.py").write_text(MODULE + (REGISTERING if registers else ""))
    (folder / "heavy.json").write_text('{"preset": "vss_440rpm", "mass": 0.21}')


def write_package(folder: Path, entry_points: str) -> None:
    """Write the metadata of an installed package in a folder of the search path."""
    info = folder / "mine-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: mine\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(entry_points)


def run_in(folder: Path, *words: str, path: Path | None = None) -> subprocess.CompletedProcess[str]:
    """Run a command, a script or, after "-c", code in a folder that is not on the search path."""
    search = [str(PACKAGES), *([] if path is None else [str(path)])]
    code = "import sys; sys.path.remove(''); from rsoccer.cli import main; sys.exit(main())"
    is_python = words[0] == "-c" or words[0].endswith(".py")
    arguments = words if is_python else ("-c", code, *words)
    return subprocess.run(
        [sys.executable, *arguments],
        capture_output=True,
        text=True,
        timeout=120,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(search)},
        check=False,
    )

"""Optional third-party simulators for comparison: rSim (rc-robosim 1.2), VMAS and pSim.

Only this module imports them.
"""

import json
import os
import warnings
from collections.abc import Iterator
from contextlib import chdir, contextmanager, redirect_stderr, redirect_stdout
from functools import cache
from importlib import import_module, metadata
from pathlib import Path
from tempfile import TemporaryDirectory
from types import ModuleType
from typing import Final

from benches.interfaces import held_actions, parallel, random_actions
from benches.measuring import Measure, Values, world_steps_per_second

PACKAGES: Final = {"robosim": "rc-robosim", "vmas": "vmas", "pSim": "pSim"}
PSIM_STEP: Final = 1 / 60
"""Length of a step of pSim, s: a single tick of Box2D (`pSim/vsss_base_env.py`)."""


@cache
def import_optional(module: str) -> ModuleType | None:
    """Import a module by name; return None if that fails."""
    with silence(), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return import_module(module)
        except ImportError:
            return None


def name_with_version(module: str) -> str:
    """Return a module's name with the version of its package."""
    return f"{module} {metadata.version(PACKAGES[module])}"


@contextmanager
def silence() -> Iterator[None]:
    """Suppress output, also of compiled code: rSim prints while it steps, pSim at every reset."""
    saved = [(stream, os.dup(stream)) for stream in (1, 2)]
    with open(os.devnull, "w") as null, redirect_stdout(null), redirect_stderr(null):
        for stream, _ in saved:
            os.dup2(null.fileno(), stream)
        try:
            yield
        finally:
            for stream, copy in saved:
                os.dup2(copy, stream)
                os.close(copy)


def silent(measure: Measure) -> Measure:
    """Return the same measure with its output suppressed."""

    def quietly(seconds: float) -> Values:
        with silence():
            return measure(seconds)

    return quietly


def vmas_football(vmas: ModuleType, worlds: int, threads: int) -> Measure:
    """Return a measure of VMAS' football, three a side with all six robots controlled.

    A step of football is 0.1 s.
    """
    import torch

    # The number of torch's threads is global, and an earlier measurement may have changed it.
    torch.set_num_threads(threads)
    with silence(), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        env = vmas.make_env(
            scenario="football",
            num_envs=worlds,
            device="cpu",
            continuous_actions=True,
            seed=0,
            n_blue_agents=3,
            n_red_agents=3,
            ai_blue_agents=False,
            ai_red_agents=False,
        )
        env.reset()
    arrays = [torch.from_numpy(array) for array in random_actions((6, worlds, 2))]
    step = world_steps_per_second(held_actions([list(array) for array in arrays], env.step), worlds)

    def measure(seconds: float) -> Values:
        torch.set_num_threads(threads)
        return step(seconds)

    return measure


def psim_match(psim: ModuleType) -> Measure:
    """Return a measure of pSim's PettingZoo environment: three learners against three of noise.

    A step of pSim is `PSIM_STEP`, without sub-steps.
    """
    packaged = Path(str(psim.__file__)).parent / "config" / "game_config.json"
    settings = json.loads(packaged.read_text())
    # By default one robot of a team obeys actions, and the others follow noise.
    settings["scenarios"]["full_random"]["agent_robots"]["movement_types"] = ["action"] * 3
    # pSim reads its settings from the working directory, and prints at every reset.
    with TemporaryDirectory() as folder, chdir(folder), silence():
        Path("game_config.json").write_text(json.dumps(settings))
        env = psim.VSSSPettingZooEnv(
            render_mode=None, scenario="full_random", num_agent_robots=3, num_adversary_robots=3
        )
        measure = parallel(env)
    return silent(measure)

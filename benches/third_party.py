"""Optional third-party simulators for comparison: rSim (rc-robosim 1.2) and VMAS.

Only this module imports them.
"""

import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from importlib import import_module, metadata
from types import ModuleType
from typing import Final

from benches.interfaces import held_actions, random_actions
from benches.measuring import Measure, Values, world_steps_per_second

PACKAGES: Final = {"robosim": "rc-robosim", "vmas": "vmas"}


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
    """Suppress output, also of compiled code: rSim prints while it steps."""
    saved = [(stream, os.dup(stream)) for stream in (1, 2)]
    with open(os.devnull, "w") as null:
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

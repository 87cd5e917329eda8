"""Others to be measured beside, where they are installed. Nothing else imports them."""

import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from importlib import import_module, metadata
from types import ModuleType
from typing import Final

from benches.doors import drawn, held
from benches.measuring import Measure, Values, repeated

PACKAGES: Final = {"robosim": "rc-robosim", "vmas": "vmas"}


@cache
def peer(module: str) -> ModuleType | None:
    """A peer's module, or None where it cannot be imported."""
    with silence(), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return import_module(module)
        except ImportError:
            return None


def named(module: str) -> str:
    """A peer with its version."""
    return f"{module} {metadata.version(PACKAGES[module])}"


@contextmanager
def silence() -> Iterator[None]:
    """Let nothing be printed, by compiled code neither: the old simulator talks as it steps."""
    kept = [(stream, os.dup(stream)) for stream in (1, 2)]
    with open(os.devnull, "w") as nowhere:
        for stream, _ in kept:
            os.dup2(nowhere.fileno(), stream)
    try:
        yield
    finally:
        for stream, copy in kept:
            os.dup2(copy, stream)
            os.close(copy)


def silent(measure: Measure) -> Measure:
    """The same without a word."""

    def quietly(seconds: float) -> Values:
        with silence():
            return measure(seconds)

    return quietly


def vmas_football(vmas: ModuleType, worlds: int, threads: int) -> Measure:
    """Three a side, all six robots controlled. A step of it is 0.1 s."""
    import torch

    # Of torch's threads there is one setting for all, and whoever was measured before has set it.
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
    arrays = [torch.from_numpy(array) for array in drawn((6, worlds, 2))]
    step = repeated(held([list(array) for array in arrays], env.step), worlds)

    def measure(seconds: float) -> Values:
        torch.set_num_threads(threads)
        return step(seconds)

    return measure

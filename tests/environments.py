"""All kinds of environments, as a user makes them, for tests of what they have in common."""

from collections.abc import Callable
from typing import Any

import gymnasium
import pettingzoo

import rsoccer

NAME = "VSSSelfPlay-v0"
MAKERS: dict[str, Callable[..., Any]] = {
    "parallel": lambda **given: rsoccer.parallel_env(NAME, **given),
    "aec": lambda **given: rsoccer.env(NAME, **given),
    "single": lambda **given: rsoccer.single_env("VSS-v0", **given),
    "vector": lambda **given: rsoccer.vector_env("VSS-v0", 2, **given),
    "robots": lambda **given: rsoccer.robots_vector_env(NAME, worlds=2, **given),
    "gymnasium.make": lambda **given: gymnasium.make("rsoccer/VSS-v0", **given),
    "gymnasium.make_vec": lambda **given: gymnasium.make_vec(f"rsoccer/{NAME}", 12, **given),
}
if hasattr(pettingzoo, "register"):  # since 1.27
    MAKERS["pettingzoo.make"] = lambda **given: pettingzoo.make(
        "parallel", f"rsoccer/{NAME}", **given
    )
"""Makers by name, which take keyword arguments."""

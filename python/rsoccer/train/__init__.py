"""Learning to play: `Args` says how, `train` does it (needs torch)."""

from __future__ import annotations

import os
from pathlib import Path

from rsoccer.train.args import Args

# torch's idle threads would spin on the cores that the physics wants, which cost a quarter of the
# speed on two. Read when torch is first imported; a value that is set already stays.
os.environ.setdefault("OMP_WAIT_POLICY", "PASSIVE")

__all__ = ["Args", "train"]


def train(args: Args) -> Path:
    """Train a policy as `args` say; the path of the policy file."""
    from rsoccer.train.trainer import train as run

    return run(args)

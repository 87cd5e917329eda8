"""Learning to play: `Args` says how, `train` does it (needs torch)."""

from __future__ import annotations

from pathlib import Path

from rsoccer.train.args import Args

__all__ = ["Args", "train"]


def train(args: Args) -> Path:
    """Train a policy as `args` say; the path of the policy file."""
    from rsoccer.train.trainer import train as run

    return run(args)

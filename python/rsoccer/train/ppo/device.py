"""Device of the updates by its name in the settings."""

from __future__ import annotations

import torch


def find_device(name: str) -> torch.device:
    """Return the device on which the networks learn.

    Args:
        name: "cpu", "cuda", or "auto" for a GPU if torch finds one, else the CPU.

    Raises:
        ValueError: "cuda" where torch finds no GPU.
    """
    available = torch.cuda.is_available()
    if name == "cuda" and not available:
        raise ValueError(
            f"device must be cpu or auto, as torch {torch.__version__} finds no GPU, got 'cuda'"
        )
    return torch.device("cuda" if available and name != "cpu" else "cpu")

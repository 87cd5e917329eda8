"""Arithmetic that the scripts of both leagues share."""

from typing import Final

import numpy as np

from rsoccer.frame import Floats

TINY: Final = np.float32(1e-6)  # metres; not to divide by zero


def inverse(lengths: Floats, least: np.float32 = TINY) -> Floats:
    """Per metre, of lengths that count as `least` where they are less."""
    per: Floats = np.divide(np.float32(1.0), np.maximum(lengths, least))
    return per

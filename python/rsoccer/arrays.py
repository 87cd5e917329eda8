"""Types of NumPy arrays that the whole package uses."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
"""Array of any type."""
Doubles = NDArray[np.float64]
"""Array of double precision."""
Floats = NDArray[np.float32]
"""Array of single precision: states, observations, actions, rewards."""
Mask = NDArray[np.bool_]
"""Array of truth values."""

"""Types of NumPy arrays that the whole package uses, and views of them for those who only read."""

from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

_Scalar = TypeVar("_Scalar", bound=np.generic)

Array = NDArray[Any]
"""Array of any type."""
Doubles = NDArray[np.float64]
"""Array of double precision."""
Floats = NDArray[np.float32]
"""Array of single precision: states, observations, actions, rewards."""
Mask = NDArray[np.bool_]
"""Array of truth values."""


def read_only(array: NDArray[_Scalar]) -> NDArray[_Scalar]:
    """Return an array in the same memory that cannot be written.

    Args:
        array: the array, which stays as it is.
    """
    view = array.view()
    view.flags.writeable = False
    return view

"""Images as PNG, and images that notebooks show."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rsoccer.files import write_atomically

if TYPE_CHECKING:
    from rsoccer.arrays import Array


class Picture:
    """An image that a notebook shows, such as the result of an environment's `render`.

    Example:
        >>> import rsoccer
        >>> from rsoccer.render import Picture
        >>> env = rsoccer.single_env("VSS-v0", render_mode="rgb_array")
        >>> observation, info = env.reset(seed=0)
        >>> picture = Picture(env.render())

    Attributes:
        image: the image, (height, width, 3) uint8.
    """

    def __init__(self, image: Array) -> None:
        """Keep an image.

        Args:
            image: (height, width, 3), red, green and blue, uint8; not copied.

        Raises:
            ValueError: an array of another type or shape.
        """
        if image.dtype != np.uint8 or image.ndim != 3 or image.shape[2] != 3 or not image.size:
            raise ValueError(
                f"image: expected uint8 (height, width, 3), got {image.dtype} {image.shape}"
            )
        self.image = image

    def save(self, path: Path | str) -> Path:
        """Write the image as a PNG, in one step.

        Args:
            path: the file, ending in .png; its folder must exist.

        Returns:
            The path.

        Raises:
            ValueError: another suffix.
        """
        path = Path(path)
        if path.suffix != ".png":
            raise ValueError(f"path: expected a name ending in .png, got {str(path)!r}")
        write_atomically(path, self.to_png())
        return path

    def to_png(self) -> bytes:
        """Return the image as the content of a PNG file."""
        height, width, channels = self.image.shape
        lines = np.zeros((height, 1 + channels * width), np.uint8)  # 0: a line without a filter
        lines[:, 1:] = self.image.reshape(height, -1)
        head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
        chunks = ((b"IHDR", head), (b"IDAT", zlib.compress(lines.tobytes(), 6)), (b"IEND", b""))
        return b"\x89PNG\r\n\x1a\n" + b"".join(
            struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
            for kind, data in chunks
        )

    def _repr_png_(self) -> bytes:
        """The image, for notebooks."""
        return self.to_png()

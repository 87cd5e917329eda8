import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow

from rsoccer.render import Picture

IMAGE = np.random.default_rng(0).integers(0, 256, (7, 5, 3)).astype(np.uint8)


def test_a_picture_is_a_png_of_the_image() -> None:
    content = Picture(IMAGE)._repr_png_()
    with Pillow.open(io.BytesIO(content)) as read:
        read.verify()
    with Pillow.open(io.BytesIO(content)) as read:
        assert (read.format, read.mode) == ("PNG", "RGB")
        assert (np.asarray(read) == IMAGE).all()


def test_views_of_an_image_are_written_too() -> None:
    with Pillow.open(io.BytesIO(Picture(IMAGE[::2, ::-1]).to_png())) as read:
        assert (np.asarray(read) == IMAGE[::2, ::-1]).all()


def test_a_picture_is_saved(tmp_path: Path) -> None:
    path = Picture(IMAGE).save(tmp_path / "image.png")
    assert path.read_bytes() == Picture(IMAGE).to_png()
    with pytest.raises(ValueError, match=r"ending in \.png"):
        Picture(IMAGE).save(tmp_path / "image.jpg")


@pytest.mark.parametrize(
    "image", [IMAGE[..., 0], IMAGE[..., :2], IMAGE.astype(np.float32), IMAGE[:0]]
)
def test_other_arrays_are_refused(image: np.ndarray[tuple[int, ...], np.dtype[np.uint8]]) -> None:
    with pytest.raises(ValueError, match=r"image: expected uint8 \(height, width, 3\)"):
        Picture(image)

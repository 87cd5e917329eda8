from pathlib import Path

import numpy as np
import pytest
from PIL import Image as Pillow

import rsoccer
from tools.task_pictures import CONTROLLERS, FOLDER, MOMENTS, SEEDS, WIDTH, draw, path_of, save

TASKS = rsoccer.list_tasks()


@pytest.mark.parametrize("name", TASKS)
def test_each_task_has_a_small_picture(name: str) -> None:
    with Pillow.open(path_of(name)) as picture:
        assert picture.width == WIDTH, "run `make docs`"
    assert path_of(name).stat().st_size < 60_000


def test_no_picture_and_no_setting_is_left_over() -> None:
    assert {path.stem for path in FOLDER.iterdir()} == set(TASKS)
    assert {*CONTROLLERS, *MOMENTS, *SEEDS} <= set(TASKS)


def test_drawing_again_gives_the_same_pixels(tmp_path: Path) -> None:
    image = draw("SSLGoToBall-v0")
    save(tmp_path / "a.png", image)
    with Pillow.open(tmp_path / "a.png") as picture:
        assert np.array_equal(np.asarray(picture), image)
    assert np.array_equal(draw("SSLGoToBall-v0"), image)

import re
import subprocess
import sys
import weakref
from collections.abc import Iterator
from itertools import chain, repeat
from pathlib import Path

import imageio_ffmpeg
import numpy as np
import pytest
from PIL import Image as Pillow

from rsoccer.render import Image, video, write_video

BLUE, YELLOW = (47, 111, 228), (242, 194, 48)


def bar(i: int, height: int = 48, width: int = 64) -> Image:
    """Yellow left of an edge that moves with `i`, blue right of it."""
    image = np.full((height, width, 3), BLUE, np.uint8)
    image[:, : 8 + 4 * i] = YELLOW
    return image


def read_mp4(path: Path) -> tuple[list[Image], str]:
    """All frames, and ffmpeg's description of the stream."""
    ffmpeg = imageio_ffmpeg.get_ffmpeg_exe()
    command = [ffmpeg, "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    done = subprocess.run(command, capture_output=True, check=True)
    about = next(line for line in done.stderr.decode().splitlines() if "Video:" in line)
    size = re.search(r"(\d+)x(\d+)[, ]", about)
    assert size is not None
    width, height = map(int, size.groups())
    return list(np.frombuffer(done.stdout, np.uint8).reshape(-1, height, width, 3)), about


def read_gif(path: Path) -> tuple[list[Image], list[int]]:
    frames, durations = [], []
    with Pillow.open(path) as gif:
        for i in range(getattr(gif, "n_frames", 1)):
            gif.seek(i)
            frames.append(np.asarray(gif.convert("RGB")))
            durations.append(int(gif.info["duration"]))
    return frames, durations


def edge(image: Image) -> int:
    """Number of yellow columns."""
    middle = image[image.shape[0] // 2].astype(int)
    return int((middle[:, 0] > middle[:, 2]).sum())


def test_an_mp4_has_every_frame_with_its_colors(tmp_path: Path) -> None:
    path = write_video(tmp_path / "match.mp4", map(bar, range(12)), 40.0)
    assert path == tmp_path / "match.mp4"
    frames, about = read_mp4(path)
    assert all(word in about for word in ("h264", "yuv420p", "bt709", "40 fps"))
    assert [frame.shape for frame in frames] == [(48, 64, 3)] * 12
    assert [edge(frame) for frame in frames] == pytest.approx([8 + 4 * i for i in range(12)], abs=2)
    np.testing.assert_allclose(frames[0][24, 3], YELLOW, atol=8)
    np.testing.assert_allclose(frames[0][24, 60], BLUE, atol=8)


def test_an_mp4_of_odd_size_is_padded_to_even(tmp_path: Path) -> None:
    frames, _ = read_mp4(write_video(tmp_path / "a.mp4", [bar(0, 33, 51)] * 3, 25))
    assert [frame.shape for frame in frames] == [(34, 52, 3)] * 3


@pytest.mark.parametrize("fps", [10.0, 30.0, 40.0])
def test_a_gif_has_every_frame_and_plays_at_its_rate(tmp_path: Path, fps: float) -> None:
    path = write_video(tmp_path / "match.gif", map(bar, range(12)), fps)
    frames, durations = read_gif(path)
    assert [frame.shape for frame in frames] == [(48, 64, 3)] * 12
    assert [edge(frame) for frame in frames] == [8 + 4 * i for i in range(12)]
    np.testing.assert_allclose(frames[7][24, 60], BLUE, atol=2)
    assert sum(durations) == pytest.approx(12_000 / fps, abs=5)


@pytest.mark.parametrize("last", [[], [bar(3)]])
def test_equal_images_in_a_gif_take_the_time_of_all(tmp_path: Path, last: list[Image]) -> None:
    path = write_video(tmp_path / "a.gif", chain(repeat(bar(2), 5), last), 20)
    frames, durations = read_gif(path)
    assert durations == [250, 50][: 1 + len(last)]
    assert [edge(frame) for frame in frames] == [16, 20][: 1 + len(last)]


def test_equal_images_give_gifs_of_equal_bytes(tmp_path: Path) -> None:
    paths = [write_video(tmp_path / name, map(bar, range(12)), 40) for name in ("a.gif", "b.gif")]
    assert paths[0].read_bytes() == paths[1].read_bytes()


def test_a_gif_repeats_forever(tmp_path: Path) -> None:
    with Pillow.open(write_video(tmp_path / "a.gif", map(bar, range(3)), 40)) as gif:
        assert gif.info["loop"] == 0


def test_without_ffmpeg_an_mp4_becomes_a_gif(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.warns(UserWarning, match=r"writing .*match\.gif"):
        path = write_video(tmp_path / "match.mp4", map(bar, range(4)), 40.0)
    assert path == tmp_path / "match.gif"
    assert len(read_gif(path)[0]) == 4
    assert [file.name for file in tmp_path.iterdir()] == ["match.gif"]


@pytest.mark.parametrize("name", ["a.mp4", "a.gif"])
def test_images_are_released_once_written(tmp_path: Path, name: str) -> None:
    alive: weakref.WeakValueDictionary[int, Image] = weakref.WeakValueDictionary()
    max_alive = 0

    def images() -> Iterator[Image]:
        nonlocal max_alive
        for i in range(60):
            image = bar(i % 12)
            alive[i] = image
            max_alive = max(max_alive, len(alive))
            yield image

    write_video(tmp_path / name, images(), 20)
    assert 0 < max_alive <= 5


@pytest.mark.parametrize("name", ["a.mp4", "a.gif"])
def test_an_interrupted_video_leaves_the_old_one(tmp_path: Path, name: str) -> None:
    def images() -> Iterator[Image]:
        yield bar(0)
        yield bar(1)
        raise KeyboardInterrupt

    (tmp_path / name).write_bytes(b"old")
    with pytest.raises(KeyboardInterrupt):
        write_video(tmp_path / name, images(), 20)
    assert [file.name for file in tmp_path.iterdir()] == [name]
    assert (tmp_path / name).read_bytes() == b"old"


def test_ffmpegs_messages_are_in_the_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # Any program that refuses ffmpeg's options works.
    monkeypatch.setattr(video, "_find_ffmpeg", lambda: sys.executable)
    with pytest.raises(
        RuntimeError, match=r"(?s)ffmpeg could not write .*exit code \d+\): .*error"
    ):
        write_video(tmp_path / "a.mp4", map(bar, range(200)), 20)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["match", "match.avi", "match.MP3", "mp4"])
def test_another_suffix_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(ValueError, match=r"path: expected a name ending in \.mp4 or \.gif, got"):
        write_video(tmp_path / name, [bar(0)], 20)


@pytest.mark.parametrize("fps", [0.0, -1.0, float("nan"), float("inf")])
def test_a_rate_that_is_not_positive_is_refused(tmp_path: Path, fps: float) -> None:
    with pytest.raises(ValueError, match="fps: expected a positive number, got"):
        write_video(tmp_path / "a.mp4", [bar(0)], fps)


def test_a_rate_too_high_for_a_gif_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="fps: expected at most 50 for a gif, got 60"):
        write_video(tmp_path / "a.gif", [bar(0)], 60)


@pytest.mark.parametrize("name", ["a.mp4", "a.gif"])
def test_an_empty_video_is_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(ValueError, match="frames: expected at least one image, got none"):
        write_video(tmp_path / name, [], 20)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        (bar(0).astype(np.float32), r"frames\[1\]: expected uint8 .* got float32"),
        (bar(0)[..., :2], r"frames\[1\]: expected uint8 \(height, width, 3\), got"),
        (bar(0)[0], r"frames\[1\]: expected uint8 \(height, width, 3\), got"),
        (bar(0, 50), r"frames\[1\]: expected shape \(48, 64, 3\) as before"),
    ],
)
def test_a_bad_image_is_named(tmp_path: Path, bad: Image, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        write_video(tmp_path / "a.mp4", [bar(0), bad], 20)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_written_to_is_named(tmp_path: Path) -> None:
    def never() -> Iterator[Image]:
        raise AssertionError("images were drawn in vain")
        yield bar(0)

    with pytest.raises(FileNotFoundError, match=r"path: cannot write to .*absent"):
        write_video(tmp_path / "absent" / "a.mp4", never(), 20)
    (tmp_path / "file").touch()
    with pytest.raises(NotADirectoryError, match=r"path: cannot write to .*file"):
        write_video(tmp_path / "file" / "a.mp4", never(), 20)
    (tmp_path / "folder.gif").mkdir()
    with pytest.raises(IsADirectoryError, match=r"path: expected a file, got a folder.*gif"):
        write_video(tmp_path / "folder.gif", never(), 20)

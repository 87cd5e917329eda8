"""Video files: mp4 through ffmpeg, animated gif through Pillow."""

from __future__ import annotations

import math
import subprocess
import tempfile
import warnings
from collections.abc import Iterable, Iterator
from contextlib import suppress
from errno import EISDIR
from importlib.util import find_spec
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from PIL.Image import Image as PillowImage

    from rsoccer.render.image import Image

MIN_WIDTH = 720
"""Default width of a video, pixels; a large field has a wider one."""
VIDEO_SUFFIXES = (".mp4", ".gif")
"""Endings of the names of video files."""
MAX_GIF_FPS = 50.0
"""Largest frame rate of a gif: browsers show faster ones at 10 images per second."""


def write_video(path: Path | str, frames: Iterable[Image], fps: float) -> Path:
    """Write images to an .mp4 or .gif as they come.

    The file appears when it is complete; until then an older one of that name stays. An .mp4
    takes little memory; of a .gif all images are held until the end, one byte per pixel.

    Args:
        path: the file. Where imageio-ffmpeg is missing, an .mp4 becomes a .gif beside it, with a
            warning.
        frames: images (height, width, 3), uint8, all of one shape.
        fps: images per second; at most 50 for a .gif.

    Returns:
        The path of the file.

    Raises:
        ValueError: another suffix or rate, no images, or an image of another type or shape.
        ModuleNotFoundError: neither imageio-ffmpeg nor Pillow is installed.
        OSError: the folder cannot be written to, or `path` is a folder.
        RuntimeError: ffmpeg failed; the text has its messages.
    """
    path = Path(path)
    if path.suffix not in VIDEO_SUFFIXES:
        raise ValueError(
            f"path: expected a name ending in {' or '.join(VIDEO_SUFFIXES)}, got {str(path)!r}"
        )
    if not (math.isfinite(fps) and fps > 0):
        raise ValueError(f"fps: expected a positive number, got {fps}")
    ffmpeg = _find_ffmpeg() if path.suffix == ".mp4" else None
    if path.suffix == ".mp4" and ffmpeg is None:
        path = path.with_suffix(".gif")
        warnings.warn(f"no imageio-ffmpeg to write mp4 with: writing {path}", stacklevel=2)
    if ffmpeg is None and find_spec("PIL") is None:
        raise ModuleNotFoundError(
            "videos need imageio-ffmpeg or Pillow: pip install 'rsoccer[render]'"
        )
    if ffmpeg is None and fps > MAX_GIF_FPS:
        raise ValueError(f"fps: expected at most {MAX_GIF_FPS:g} for a gif, got {fps}")
    _write_atomically(path, frames, fps, ffmpeg)
    return path


def _write_atomically(path: Path, frames: Iterable[Image], fps: float, ffmpeg: str | None) -> None:
    """Write under another name first, so that `path` is never an incomplete video."""
    if path.is_dir():
        raise IsADirectoryError(EISDIR, "path: expected a file, got a folder", str(path))
    partial = path.with_name(f".{path.name}.partial")
    try:
        partial.touch()
    except OSError as error:
        raise type(error)(error.errno, f"path: cannot write to {path.parent}", str(path)) from error
    try:
        checked = _checked(frames)
        first = next(checked, None)
        if first is None:
            raise ValueError("frames: expected at least one image, got none")
        if ffmpeg is None:
            _write_gif(partial, first, checked, fps)
        else:
            _write_mp4(ffmpeg, partial, first, checked, fps)
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


def _checked(frames: Iterable[Image]) -> Iterator[Image]:
    """The same images; an error at the first of another type or shape."""
    shape: tuple[int, ...] | None = None
    for i, frame in enumerate(frames):
        shape = frame.shape if shape is None else shape
        is_rgb = frame.ndim == 3 and frame.shape[2] == 3 and frame.size > 0
        if frame.dtype != np.uint8 or not is_rgb:
            raise ValueError(
                f"frames[{i}]: expected uint8 (height, width, 3), got {frame.dtype} {frame.shape}"
            )
        if frame.shape != shape:
            raise ValueError(f"frames[{i}]: expected shape {shape} as before, got {frame.shape}")
        yield frame


# -- mp4 --


def _find_ffmpeg() -> str | None:
    """Path of the ffmpeg program in imageio-ffmpeg, or None."""
    try:
        import imageio_ffmpeg

        return str(imageio_ffmpeg.get_ffmpeg_exe())
    except (ImportError, RuntimeError):
        return None


def _write_mp4(ffmpeg: str, path: Path, first: Image, others: Iterator[Image], fps: float) -> None:
    """Feed images to ffmpeg as they come."""
    command = _ffmpeg_command(ffmpeg, path, first.shape, fps)
    with tempfile.TemporaryFile() as stderr:
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=stderr)
        assert process.stdin is not None
        try:
            # If ffmpeg stops early, the pipe breaks; its exit code and messages say why.
            with suppress(BrokenPipeError), process.stdin as pipe:
                for frame in chain([first], others):
                    pipe.write(np.ascontiguousarray(frame).data)
        except BaseException:
            process.kill()
            raise
        finally:
            code = process.wait()
        if code != 0:
            stderr.seek(0)
            text = stderr.read().decode(errors="replace").strip()
            raise RuntimeError(f"ffmpeg could not write the video (exit code {code}): {text}")


def _ffmpeg_command(ffmpeg: str, path: Path, shape: tuple[int, ...], fps: float) -> list[str]:
    """Raw images in, H.264 out: 4:2:0 color, even sizes, index first, as all players take it."""
    height, width = shape[:2]
    source = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(fps)]
    filters = (
        "pad=ceil(iw/2)*2:ceil(ih/2)*2,"
        # Without tags, players guess the color matrix by the image size, and half guess wrong.
        "scale=out_color_matrix=bt709:out_range=tv,"
        "setparams=color_primaries=bt709:color_trc=bt709:colorspace=bt709"
    )
    codec = ["-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-pix_fmt", "yuv420p"]
    return [
        *(ffmpeg, "-v", "error", "-y", *source, "-i", "-", "-vf", filters),
        *(*codec, "-movflags", "+faststart", "-f", "mp4", str(path)),
    ]


# -- gif --


def _write_gif(path: Path, first: Image, others: Iterator[Image], fps: float) -> None:
    """Write an animation that repeats forever; equal images in a row become one.

    Through Pillow itself: imageio's plugin makes the same call, but first holds all images with
    three bytes per pixel.
    """
    images = _pillow_images(chain([first], others), fps)
    with path.open("wb") as file:  # Pillow closes one of its own on an Exception only
        next(images).save(file, "GIF", save_all=True, append_images=images, loop=0)


def _pillow_images(frames: Iterable[Image], fps: float) -> Iterator[PillowImage]:
    """Images with the durations that Pillow's writer reads, whole hundredths of a second."""
    from PIL import Image as Pillow

    for i, frame in enumerate(frames):
        image = Pillow.fromarray(frame)
        image.info["duration"] = 10 * (round(100 * (i + 1) / fps) - round(100 * i / fps))  # ms
        yield image

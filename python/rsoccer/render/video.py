"""Images as a video file: mp4 by ffmpeg, or an animated gif."""

from __future__ import annotations

import math
import subprocess
import tempfile
import warnings
from collections.abc import Iterable, Iterator
from contextlib import suppress
from importlib.util import find_spec
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from rsoccer.render.image import Image

GIF_RATE = 50.0
"""Most frames a second of a gif: browsers show anything faster at 10."""


def write_video(path: Path | str, frames: Iterable[Image], fps: float) -> Path:
    """Write images (height, width, 3) as they come to an .mp4 or .gif; the path written.

    Where imageio-ffmpeg is missing an .mp4 becomes a .gif beside it, with a warning. The file
    appears when it is complete; until then one that was there before stays.
    """
    path = Path(path)
    if path.suffix not in (".mp4", ".gif"):
        raise ValueError(f"path: expected a name ending in .mp4 or .gif, got {str(path)!r}")
    if not (math.isfinite(fps) and fps > 0):
        raise ValueError(f"fps: expected a positive number, got {fps}")
    encoder = _find_ffmpeg() if path.suffix == ".mp4" else None
    if path.suffix == ".mp4" and encoder is None:
        path = path.with_suffix(".gif")
        warnings.warn(f"no imageio-ffmpeg to write mp4 with: writing {path}", stacklevel=2)
    if encoder is None and find_spec("PIL") is None:
        raise ModuleNotFoundError("videos need imageio-ffmpeg: pip install 'rsoccer[render]'")
    if encoder is None and fps > GIF_RATE:
        raise ValueError(f"fps: expected at most {GIF_RATE:g} for a gif, got {fps}")
    _write_whole(path, frames, fps, encoder)
    return path


def _write_whole(path: Path, frames: Iterable[Image], fps: float, encoder: str | None) -> None:
    """Write under another name first, so that `path` is never half a video."""
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
        if encoder is None:
            _write_gif(partial, first, checked, fps)
        else:
            _write_mp4(encoder, partial, first, checked, fps)
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)


def _checked(frames: Iterable[Image]) -> Iterator[Image]:
    """The same images, each compared with the first in shape."""
    shape: tuple[int, ...] | None = None
    for i, frame in enumerate(frames):
        shape = frame.shape if shape is None else shape
        sound = frame.ndim == 3 and frame.shape[2] == 3 and frame.size > 0
        if frame.dtype != np.uint8 or not sound:
            raise ValueError(
                f"frames[{i}]: expected uint8 (height, width, 3), got {frame.dtype} {frame.shape}"
            )
        if frame.shape != shape:
            raise ValueError(f"frames[{i}]: expected shape {shape} as before, got {frame.shape}")
        yield frame


# -- mp4 --


def _find_ffmpeg() -> str | None:
    """The ffmpeg program that imageio-ffmpeg brings along, if there is one."""
    try:
        import imageio_ffmpeg

        return str(imageio_ffmpeg.get_ffmpeg_exe())
    except (ImportError, RuntimeError):
        return None


def _write_mp4(encoder: str, path: Path, first: Image, others: Iterator[Image], fps: float) -> None:
    """Feed images to ffmpeg as they come."""
    command = _ffmpeg_command(encoder, path, first.shape, fps)
    with tempfile.TemporaryFile() as complaints:
        ffmpeg = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=complaints)
        assert ffmpeg.stdin is not None
        try:
            # If ffmpeg gives up, the pipe breaks; its exit code and complaints say why.
            with suppress(BrokenPipeError), ffmpeg.stdin as pipe:
                for frame in chain([first], others):
                    pipe.write(np.ascontiguousarray(frame).data)
        except BaseException:
            ffmpeg.kill()
            raise
        finally:
            code = ffmpeg.wait()
        if code != 0:
            complaints.seek(0)
            said = complaints.read().decode(errors="replace").strip()
            raise RuntimeError(f"ffmpeg could not write the video (exit code {code}): {said}")


def _ffmpeg_command(encoder: str, path: Path, shape: tuple[int, ...], fps: float) -> list[str]:
    """Raw images in, H.264 out: 4:2:0 colour, even sizes, index first: what all players take."""
    height, width = shape[:2]
    given = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}", "-r", str(fps)]
    filters = (
        "pad=ceil(iw/2)*2:ceil(ih/2)*2,"
        # Untagged, players guess by size how colours were stored, and half guess wrong.
        "scale=out_color_matrix=bt709:out_range=tv,"
        "setparams=color_primaries=bt709:color_trc=bt709:colorspace=bt709"
    )
    coded = ["-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-pix_fmt", "yuv420p"]
    return [
        *(encoder, "-v", "error", "-y", *given, "-i", "-", "-vf", filters),
        *(*coded, "-movflags", "+faststart", "-f", "mp4", str(path)),
    ]


# -- gif --


def _write_gif(path: Path, first: Image, others: Iterator[Image], fps: float) -> None:
    """Write what changes from image to image, each change with colours of its own.

    Pillow's own way of saving an animation holds all of it in memory.
    """
    from PIL import GifImagePlugin, ImageChops
    from PIL import Image as Pillow

    before = Pillow.fromarray(first)
    header, _ = GifImagePlugin.getheader(before.quantize(), info={"loop": 0})
    with path.open("wb") as file:
        file.writelines(header)
        for i, frame in enumerate(chain([first], others)):
            now = Pillow.fromarray(frame)
            # An image that repeats the last one still takes its time: rewrite one pixel.
            box = ImageChops.difference(before, now).getbbox() or (0, 0, 1, 1)
            box = box if i else (0, 0, *now.size)
            duration = 10 * (round(100 * (i + 1) / fps) - round(100 * i / fps))  # gifs count 10 ms
            change = now.crop(box).quantize()
            file.writelines(
                GifImagePlugin.getdata(change, box[:2], duration=duration, include_color_table=True)
            )
            before = now
        file.write(b";")

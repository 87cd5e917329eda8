"""What stands in for packages that tests shall not need."""

import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

Clip = tuple[list[Any], int, str]
"""Frames, frames a second, the file's name."""


def moviepy(monkeypatch: pytest.MonkeyPatch) -> list[Clip]:
    """Where the frames go that wrappers hand to MoviePy, which wants an older Pillow than ours."""
    clips: list[Clip] = []

    class ImageSequenceClip:
        def __init__(self, frames: list[Any], fps: int) -> None:
            self.frames, self.fps = frames, fps

        def write_videofile(self, path: str, logger: None) -> None:
            clips.append((list(self.frames), self.fps, Path(path).name))

        def close(self) -> None:
            pass

    module = ModuleType("moviepy.video.io.ImageSequenceClip")
    vars(module)["ImageSequenceClip"] = ImageSequenceClip
    for package in ("moviepy", "moviepy.video", "moviepy.video.io"):
        monkeypatch.setitem(sys.modules, package, ModuleType(package))
    monkeypatch.setitem(sys.modules, module.__name__, module)
    return clips


def assert_filmed(clips: list[Clip], frames: int) -> None:
    """One film, of the second episode of two, with a picture of its own for each moment."""
    [(pictures, fps, file)] = clips
    assert (len(pictures), fps, file) == (frames, 40, "rl-video-episode-1.mp4")
    assert len({picture.tobytes() for picture in pictures}) == frames

"""A fake MoviePy module, which records the frames of videos."""

import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

Clip = tuple[list[Any], int, str]
"""Frames, frames per second, name of the file."""


def moviepy(monkeypatch: pytest.MonkeyPatch) -> list[Clip]:
    """Replace MoviePy, which needs an older Pillow than ours; return the recorded videos."""
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
    """Expect one video, of the second of two episodes, in which no two images are equal."""
    [(images, fps, file)] = clips
    assert (len(images), fps, file) == (frames, 40, "rl-video-episode-1.mp4")
    assert len({image.tobytes() for image in images}) == frames

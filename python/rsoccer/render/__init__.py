"""Images and videos of matches: shapes of a scene, rasterized off-screen, shown or written.

Names are imported on first use, so building a scene needs no pygame and an image no ffmpeg.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rsoccer.render.image import Image, Renderer, draw_image
    from rsoccer.render.picture import Picture
    from rsoccer.render.video import write_video
    from rsoccer.render.window import Window

__all__ = [
    "Image",
    "Picture",
    "Renderer",
    "Window",
    "draw_image",
    "write_video",
]

_MODULES = {
    "Image": "image",
    "Picture": "picture",
    "Renderer": "image",
    "Window": "window",
    "draw_image": "image",
    "write_video": "video",
}


def __getattr__(name: str) -> object:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)

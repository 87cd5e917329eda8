"""A window on the screen that shows images, for watching a match as it is played."""

from __future__ import annotations

import os
import weakref

from rsoccer.render.image import Image
from rsoccer.render.library import pygame

BLIND_DRIVERS = ("dummy", "offscreen")
"""SDL's video drivers that nobody can see; it falls back on them where there is no display."""

_open_windows: weakref.WeakSet[Window] = weakref.WeakSet()


class Window:
    """Shows images one after another, at most `fps` a second; opens with the first.

    Once its user has closed it (or pressed Escape) it stays closed and ignores further images, so a
    run goes on without it.
    """

    def __init__(self, title: str = "rSoccer", fps: float | None = 40.0) -> None:
        """Prepare a window; without `fps` it never waits."""
        self.title = title
        self.fps = fps
        self.closed = False
        self._frame: pygame.Window | None = None
        self._clock = pygame.time.Clock()

    def show(self, image: Image) -> bool:
        """Show an image (height, width, 3); whether the window is still open."""
        if self.closed:
            return False
        if self._frame is None:
            self._frame = _open_frame(self.title, image)
            _open_windows.add(self)
        _hear_users()
        if self.closed:
            return False
        height, width = image.shape[:2]
        if self._frame.size != (width, height):
            self._frame.size = (width, height)
        picture = pygame.image.frombuffer(image.tobytes(), (width, height), "RGB")
        self._frame.get_surface().blit(picture, (0, 0))
        self._frame.flip()
        if self.fps is not None:
            self._clock.tick(self.fps)
        return True

    def close(self) -> None:
        """Take the window off the screen; may be called again."""
        self.closed = True
        if self._frame is not None:
            self._frame.destroy()
            self._frame = None

    def hear(self, event: pygame.Event) -> None:
        """Close if that is what the user asked of this window."""
        if event.type == pygame.QUIT:
            self.close()
        escaped = event.type == pygame.KEYDOWN and event.key == pygame.K_ESCAPE
        if (escaped or event.type == pygame.WINDOWCLOSE) and event.window is self._frame:
            self.close()


def _hear_users() -> None:
    """Hand events to all windows: SDL has one queue of them for the whole process."""
    for event in pygame.event.get():
        for window in list(_open_windows):
            window.hear(event)


def _open_frame(title: str, image: Image) -> pygame.Window:
    """A window of the image's size, or an error where there is no display to put it on."""
    try:
        pygame.display.init()
    except pygame.error as error:
        raise RuntimeError(f"no display to open a window on: {error}") from error
    driver = pygame.display.get_driver()
    asked = os.environ.get("SDL_VIDEODRIVER") or os.environ.get("SDL_VIDEO_DRIVER")
    if driver in BLIND_DRIVERS and not asked:
        raise RuntimeError("no display to open a window on; an image or a video needs none")
    height, width = image.shape[:2]
    return pygame.Window(title, (width, height))

"""A window on the screen that shows images of a match while it is played."""

from __future__ import annotations

import os
import weakref
from collections.abc import Callable

from rsoccer.render.image import Image
from rsoccer.render.pygame_import import pygame

HEADLESS_DRIVERS = ("dummy", "offscreen")
"""SDL's video drivers without a screen; SDL falls back on them where there is no display."""

_open_windows: weakref.WeakSet[Window] = weakref.WeakSet()


class Window:
    """A window that shows images one after another; it opens with the first.

    After the user has closed it (or pressed Escape) the window stays closed and ignores further
    images, so a run goes on without it.

    Attributes:
        title: text of the title bar.
        fps: largest number of images per second, or None.
        closed: the window has been closed, by the user or by `close`.
    """

    def __init__(
        self,
        title: str = "rSoccer",
        fps: float | None = 40.0,
        listener: Callable[[pygame.Event], object] | None = None,
    ) -> None:
        """Prepare a window without opening it.

        Args:
            title: text of the title bar.
            fps: largest number of images per second; None never waits.
            listener: called with each event of this window, and with events of no window.
        """
        self.title = title
        self.fps = fps
        self.closed = False
        self._window: pygame.Window | None = None
        self._listener = listener
        self._clock = pygame.time.Clock()

    def show(self, image: Image) -> bool:
        """Show an image, and wait as `fps` asks.

        Args:
            image: the image (height, width, 3), uint8; the window takes its size.

        Returns:
            True while the window is open.

        Raises:
            RuntimeError: there is no display.
        """
        if self.closed:
            return False
        if self._window is None:
            self._window = _open_window(self.title, image)
            _open_windows.add(self)
        _dispatch_events()
        if self.closed:
            return False
        height, width = image.shape[:2]
        if self._window.size != (width, height):
            self._window.size = (width, height)
        picture = pygame.image.frombuffer(image.tobytes(), (width, height), "RGB")
        self._window.get_surface().blit(picture, (0, 0))
        self._window.flip()
        if self.fps is not None:
            self._clock.tick(self.fps)
        return True

    def close(self) -> None:
        """Close the window; may be called again."""
        self.closed = True
        if self._window is not None:
            self._window.destroy()
            self._window = None

    def handle_event(self, event: pygame.Event) -> None:
        """Pass an event on to the listener, and close the window if the event asks for it.

        Args:
            event: an event of any window.
        """
        if self._listener is not None and getattr(event, "window", None) in (None, self._window):
            self._listener(event)
        if event.type == pygame.QUIT:
            self.close()
        escaped = event.type == pygame.KEYDOWN and event.key == pygame.K_ESCAPE
        if (escaped or event.type == pygame.WINDOWCLOSE) and event.window is self._window:
            self.close()


def _dispatch_events() -> None:
    """Hand events to all windows: SDL has one event queue for the whole process."""
    for event in pygame.event.get():
        for window in list(_open_windows):
            window.handle_event(event)


def _open_window(title: str, image: Image) -> pygame.Window:
    """A window of the image's size; RuntimeError where there is no display."""
    try:
        pygame.display.init()
    except pygame.error as error:
        raise RuntimeError(f"no display to open a window on: {error}") from error
    driver = pygame.display.get_driver()
    requested = os.environ.get("SDL_VIDEODRIVER") or os.environ.get("SDL_VIDEO_DRIVER")
    if driver in HEADLESS_DRIVERS and not requested:
        raise RuntimeError("no display to open a window on; an image or a video needs none")
    height, width = image.shape[:2]
    return pygame.Window(title, (width, height))

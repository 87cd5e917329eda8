import subprocess
import sys
import time
from collections.abc import Iterator

import numpy as np
import pytest

pytest.importorskip("pygame")

import pygame

from rsoccer.render import Image, Window

RED: Image = np.full((60, 80, 3), (200, 30, 10), np.uint8)


@pytest.fixture(autouse=True)
def _headless(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """SDL's dummy driver: windows without a screen."""
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    yield
    pygame.display.quit()


def surface(window: Window) -> pygame.Surface:
    assert window._window is not None
    return window._window.get_surface()


def test_a_window_shows_images_at_their_own_size() -> None:
    window = Window(fps=None)
    assert window.show(RED)
    assert surface(window).get_size() == (80, 60)
    assert surface(window).get_at((40, 30))[:3] == (200, 30, 10)
    assert window.show(np.zeros((100, 120, 3), np.uint8))
    assert surface(window).get_size() == (120, 100)
    assert surface(window).get_at((110, 90))[:3] == (0, 0, 0)
    window.close()


def test_a_window_keeps_its_rate() -> None:
    window = Window(fps=50.0)
    window.show(RED)
    begin = time.monotonic()
    for _ in range(10):
        window.show(RED)
    assert time.monotonic() - begin > 0.15
    window.close()


@pytest.mark.parametrize("key", [None, pygame.K_ESCAPE])
def test_the_user_closes_one_window_and_not_the_other(key: int | None) -> None:
    window, other = Window(fps=None), Window(fps=None)
    window.show(RED)
    other.show(RED)
    if key is None:
        event = pygame.Event(pygame.WINDOWCLOSE, window=window._window)
    else:
        event = pygame.Event(pygame.KEYDOWN, key=key, window=window._window)
    pygame.event.post(event)
    assert other.show(RED)
    assert window.closed
    assert not window.show(RED)
    assert not other.closed
    other.close()


def test_a_listener_gets_the_events_of_its_own_window_and_of_none() -> None:
    heard: list[int] = []
    window = Window(fps=None, listener=lambda event: heard.append(event.type))
    other = Window(fps=None)
    window.show(RED)
    other.show(RED)
    pygame.event.clear()
    heard.clear()
    for target in (window, other):
        pygame.event.post(pygame.Event(pygame.KEYDOWN, key=pygame.K_w, window=target._window))
    pygame.event.post(pygame.Event(pygame.CONTROLLERDEVICEADDED))
    window.show(RED)
    assert heard.count(pygame.KEYDOWN) == 1
    assert heard.count(pygame.CONTROLLERDEVICEADDED) == 1
    window.close()
    other.close()


def test_quitting_closes_all_windows() -> None:
    windows = [Window(fps=None), Window(fps=None)]
    for window in windows:
        window.show(RED)
    pygame.event.post(pygame.Event(pygame.QUIT))
    assert [window.show(RED) for window in windows] == [False, False]


def test_other_keys_close_nothing() -> None:
    window = Window(fps=None)
    window.show(RED)
    pygame.event.post(pygame.Event(pygame.KEYDOWN, key=pygame.K_SPACE, window=window._window))
    assert window.show(RED)
    window.close()


def test_closing_twice_or_before_the_first_image_is_fine() -> None:
    window = Window()
    window.close()
    window.close()
    assert not window.show(RED)


def test_a_window_without_a_display_raises() -> None:
    code = """
import os
for name in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER", "SDL_VIDEO_DRIVER"):
    os.environ.pop(name, None)
import pygame, numpy
pygame.display.init = lambda: None
pygame.display.get_driver = lambda: "offscreen"
from rsoccer.render import Window
try:
    Window().show(numpy.zeros((8, 8, 3), numpy.uint8))
except RuntimeError as error:
    raise SystemExit(0 if "no display" in str(error) else 2)
raise SystemExit(3)
"""
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0

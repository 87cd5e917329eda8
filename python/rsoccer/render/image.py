"""A row as pixels, drawn off-screen: no display, no window, no OpenGL."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from rsoccer.frame import Array
from rsoccer.render.library import pygame
from rsoccer.render.paint import Camera, Painter
from rsoccer.render.robot import robot_outlines
from rsoccer.render.scene import draw_ground, draw_play
from rsoccer.render.scoreboard import Board, scene_bounds
from rsoccer.render.shapes import Shape

if TYPE_CHECKING:
    from rsoccer._core import SimConfig

Image: TypeAlias = NDArray[np.uint8]
"""(height, width, 3), red, green and blue."""

WIDTHS = (64, 4096)
"""Narrowest and widest image, pixels."""
DEFAULT_WIDTHS = (640, 1280)
"""Narrowest and widest image where no width is asked for, pixels."""
ROBOT_PIXELS = 18
"""Pixels across the smallest robot that it takes to read its number."""


def default_width(config: SimConfig, least: int = DEFAULT_WIDTHS[0]) -> int:
    """The width, pixels, at which robots can be told apart: `least`, or more on a large field."""
    sizes = (robot_outlines(robot).size for robot in config.robots)
    smallest = min(sizes, default=math.inf)
    width = scene_bounds(config.field).width / smallest * ROBOT_PIXELS
    return max(least, min(2 * round(width / 2), DEFAULT_WIDTHS[1]))


class Renderer:
    """Draws rows of one configuration at one size; keeps the field, which does not change."""

    def __init__(self, config: SimConfig, width: int | None = None) -> None:
        """Draw the field once; `width` in pixels, the height follows and both are even.

        Without a `width` it is the one at which robots can be told apart.
        """
        low, high = WIDTHS
        width = default_width(config) if width is None else width
        if not low <= width <= high:
            raise ValueError(f"width: expected {low} to {high} pixels, got {width}")
        bounds = scene_bounds(config.field)
        self.config = config
        self.width = 2 * round(width / 2)
        self.height = 2 * round(self.width * bounds.height / bounds.width / 2)
        camera = Camera(self.width / bounds.width, bounds.left, bounds.top)
        self._painter = Painter(camera)
        self._ground = pygame.Surface((self.width, self.height), 0, 32)
        self._painter.paint(self._ground, draw_ground(config))

    def __reduce__(self) -> tuple[type[Renderer], tuple[SimConfig, int]]:
        # Surfaces do not pickle, but what holds a renderer, such as an environment, should.
        return (Renderer, (self.config, self.width))

    def draw(
        self,
        row: Array,
        *,
        score: tuple[int, int] = (0, 0),
        clock: float = 0.0,
        names: tuple[str, str] = ("BLUE", "YELLOW"),
        caption: str = "",
        extras: Sequence[Shape] = (),
    ) -> Image:
        """A fresh image of one world's row (row,); pairs are blue's, yellow's; clock in seconds.

        `extras` are further shapes on the floor, such as those of `rsoccer.render.overlay`.
        """
        board = Board(score, clock, names, caption)
        canvas = self._ground.copy()
        self._painter.paint(canvas, draw_play(self.config, row, board, extras))
        return _pixels(canvas)


def draw_image(
    config: SimConfig,
    row: Array,
    *,
    score: tuple[int, int] = (0, 0),
    clock: float = 0.0,
    names: tuple[str, str] = ("BLUE", "YELLOW"),
    caption: str = "",
    extras: Sequence[Shape] = (),
    width: int | None = None,
) -> Image:
    """A fresh image of one row, `width` pixels wide; for many, keep a `Renderer`."""
    renderer = _renderer(config, width)
    return renderer.draw(row, score=score, clock=clock, names=names, caption=caption, extras=extras)


@lru_cache(maxsize=4)
def _renderer(config: SimConfig, width: int | None) -> Renderer:
    """The last few renderers: the field costs more than what moves on it."""
    return Renderer(config, width)


def _pixels(canvas: pygame.Surface) -> Image:
    """A copy of the canvas as an array; channel by channel is four times as fast as at once."""
    pixels = pygame.surfarray.pixels3d(canvas)  # (width, height, 3)
    image = np.empty((canvas.get_height(), canvas.get_width(), 3), np.uint8)
    for channel in range(3):
        image[..., channel] = pixels[..., channel].T
    return image

"""The rasterizer: antialiased pixels of shapes, through pygame and without a display."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache

from rsoccer.render.pygame_import import pygame
from rsoccer.render.shapes import (
    Arc,
    Circle,
    Color,
    Line,
    Point,
    Polygon,
    Shape,
    Text,
    arc_points,
)

SUPERSAMPLING = 4
"""Sub-pixels along each axis of a pixel."""
MAX_SUBPIXELS = 4_000_000
"""Largest number of sub-pixels of a layer, 4 bytes each: larger shapes are sampled less."""
MAX_TEXT = 1000.0
"""Largest height of a capital, pixels: larger ones are of robots that fill the image."""
FAR = 1 << 20
"""Pixels from the image's corner beyond which coordinates are cut off: pygame holds 32 bits."""


@dataclass(frozen=True, slots=True)
class Camera:
    """An orthographic view from above: the map from meters to pixels.

    Attributes:
        scale: pixels per meter.
        left: x of the image's left edge, meters.
        top: y of the image's upper edge, meters; rows of pixels count downwards.
    """

    scale: float
    left: float
    top: float

    def project(self, points: Iterable[Point]) -> list[Point]:
        """Project points of the world into the image.

        Args:
            points: x and y of each, meters.

        Returns:
            Column and row of each, pixels, with fractions.
        """
        scale, left, top = self.scale, self.left, self.top
        return [((x - left) * scale, (top - y) * scale) for x, y in points]


class Rasterizer:
    """A rasterizer of shapes through one camera.

    Each shape is filled on a small layer of its own at `SUPERSAMPLING` times the size, averaged
    down and blended over the canvas, so edges are smooth and move by fractions of a pixel. Layers
    hold premultiplied colors: averaging then mixes in no color of transparent pixels.
    """

    def __init__(self, camera: Camera) -> None:
        """Prepare for one camera.

        Args:
            camera: the map from meters to pixels.
        """
        pygame.font.init()
        self._camera = camera
        self._text_layer = lru_cache(maxsize=64)(_text_layer)  # per object: freed with it

    def draw(self, canvas: pygame.Surface, shapes: Iterable[Shape]) -> None:
        """Draw shapes over a canvas, in their order.

        Args:
            canvas: the surface, changed in place.
            shapes: shapes in meters, the lowest first.
        """
        for shape in shapes:
            self._draw_one(canvas, shape)

    def _draw_one(self, canvas: pygame.Surface, shape: Shape) -> None:
        """Draw a shape by its kind."""
        match shape:
            case Polygon(points, color, blur):
                self._fill(canvas, points, color, blur)
            case Circle(center, radius, color, blur):
                self._fill(canvas, arc_points(center, radius, 0.0, math.tau), color, blur)
            case Arc():
                self._fill(canvas, _arc_outline(shape), shape.color)
            case Line():
                self._fill(canvas, _line_outline(shape), shape.color)
            case Text():
                self._write(canvas, shape)

    def _fill(
        self, canvas: pygame.Surface, points: Iterable[Point], color: Color, blur: float = 0.0
    ) -> None:
        """Fill an outline given in meters."""
        outline = self._camera.project(points)
        blur_pixels = math.ceil(_near(blur * self._camera.scale))
        area = _pixel_bounds(outline, 2 * blur_pixels).clip(canvas.get_rect().inflate(2, 2))
        if not area:  # outside the image
            return
        factor = _sampling(area)
        layer = pygame.Surface((area.width * factor, area.height * factor), pygame.SRCALPHA)
        corners = [((x - area.x) * factor, (y - area.y) * factor) for x, y in outline]
        # pygame fills row by row, those outside of the layer too.
        if any(max(abs(x), abs(y)) > FAR for x, y in corners):
            corners = _clipped(corners, layer.get_size())
        if corners:
            pygame.draw.polygon(layer, _premultiplied(color), corners)
            _blend(canvas, layer, area, blur_pixels)

    def _write(self, canvas: pygame.Surface, text: Text) -> None:
        """Write a text at a sub-pixel position, so that a number glides with its robot."""
        scale = self._camera.scale
        glyphs = self._text_layer(
            text.text, text.color, min(text.height * scale, MAX_TEXT), text.max_width * scale
        )
        ((x, y),) = self._camera.project((text.center,))
        half_width, half_height = (side / 2 / SUPERSAMPLING for side in glyphs.get_size())
        corner = (x - 2 * text.align * half_width, y - half_height)
        area = _pixel_bounds((corner, (corner[0] + 2 * half_width, y + half_height)), 0)
        if not area.colliderect(canvas.get_rect()):
            return
        size = (area.width * SUPERSAMPLING, area.height * SUPERSAMPLING)
        layer = pygame.Surface(size, pygame.SRCALPHA)
        offset = [round((a - b) * SUPERSAMPLING) for a, b in zip(corner, area.topleft, strict=True)]
        layer.blit(glyphs, offset, special_flags=pygame.BLEND_PREMULTIPLIED)
        _blend(canvas, layer, area, 0)


def _blend(
    canvas: pygame.Surface, layer: pygame.Surface, area: pygame.Rect, blur_pixels: int
) -> None:
    """Average a layer down to its area, blur it and blend it over the canvas."""
    if blur_pixels:
        coarse = [max(1, round(side / blur_pixels)) for side in area.size]
        layer = pygame.transform.smoothscale(layer, coarse)
    if layer.get_size() != area.size:
        layer = pygame.transform.smoothscale(layer, area.size)
    canvas.blit(layer, area, special_flags=pygame.BLEND_PREMULTIPLIED)


def _sampling(area: pygame.Rect) -> int:
    """Sub-pixels along each axis of a pixel: fewer for areas of millions of pixels."""
    affordable = math.isqrt(MAX_SUBPIXELS // (area.width * area.height + 1))
    return min(SUPERSAMPLING, max(1, affordable))


def _pixel_bounds(points: Iterable[Point], border: int) -> pygame.Rect:
    """The whole pixels that hold the points, with a border around them."""
    xs, ys = zip(*points, strict=True)
    left, top = math.floor(_near(min(xs))) - border, math.floor(_near(min(ys))) - border
    right, bottom = math.ceil(_near(max(xs))) + border + 1, math.ceil(_near(max(ys))) + border + 1
    return pygame.Rect(left, top, right - left, bottom - top)


def _near(pixels: float) -> float:
    """A coordinate that pygame can hold."""
    return min(max(pixels, -FAR), FAR)


def _clipped(corners: list[Point], size: tuple[int, int]) -> list[Point]:
    """The part of a polygon within a layer and a border of 1, edge by edge of the layer.

    After Sutherland and Hodgman (1974). At least three corners, or none.
    """
    for axis, side in enumerate(size):
        for bound, sign in ((-1.0, 1.0), (side + 1.0, -1.0)):
            kept = list[Point]()
            for start, end in zip([*corners[-1:], *corners[:-1]], corners, strict=True):
                inside = [sign * (point[axis] - bound) >= 0 for point in (start, end)]
                if inside[0] != inside[1]:
                    share = (bound - start[axis]) / (end[axis] - start[axis])
                    kept.append(_between(start, end, share, axis, bound))
                if inside[1]:
                    kept.append(end)
            corners = kept
    return corners if len(corners) > 2 else []


def _between(start: Point, end: Point, share: float, axis: int, bound: float) -> Point:
    """The point at a share of a side; exactly on the bound along one axis."""
    x, y = ((1.0 - share) * a + share * b for a, b in zip(start, end, strict=True))
    return (bound, y) if axis == 0 else (x, bound)


def _premultiplied(color: Color) -> Color:
    """The color with red, green and blue multiplied by its opacity."""
    red, green, blue, opacity = color
    return (red * opacity // 255, green * opacity // 255, blue * opacity // 255, opacity)


def _arc_outline(arc: Arc) -> tuple[Point, ...]:
    """The outline of an arc: along the outer edge and back along the inner one."""
    outer, inner = arc.radius + arc.width / 2, arc.radius - arc.width / 2
    return (
        *arc_points(arc.center, outer, arc.start, arc.end),
        *arc_points(arc.center, inner, arc.end, arc.start),
    )


def _line_outline(line: Line) -> tuple[Point, ...]:
    """The outline of a line, with square caps, which close the corners of polylines."""
    (x_0, y_0), (x_1, y_1) = line.start, line.end
    length = math.hypot(x_1 - x_0, y_1 - y_0) or 1.0
    along_x, along_y = (
        (x_1 - x_0) / length * line.width / 2,
        (y_1 - y_0) / length * line.width / 2,
    )
    return (
        (x_0 - along_x - along_y, y_0 - along_y + along_x),
        (x_0 - along_x + along_y, y_0 - along_y - along_x),
        (x_1 + along_x + along_y, y_1 + along_y - along_x),
        (x_1 + along_x - along_y, y_1 + along_y + along_x),
    )


def _text_layer(text: str, color: Color, height: float, max_width: float) -> pygame.Surface:
    """A text at `SUPERSAMPLING` times its size, centered on the middle of its capitals.

    `height` is the cap height in pixels; a text wider than `max_width` pixels is shrunk.
    """
    size = max(1, round(height * SUPERSAMPLING / _cap_height_ratio()))
    font = pygame.font.Font(None, size)
    width = font.size(text)[0]
    if width > max_width * SUPERSAMPLING:
        font = pygame.font.Font(None, max(1, int(size * max_width * SUPERSAMPLING / width)))
    drawn = font.render(text, True, color)
    middle = _capital_bounds(font).centery
    half = max(middle, drawn.get_height() - middle)
    layer = pygame.Surface((drawn.get_width(), 2 * half), pygame.SRCALPHA)
    layer.blit(drawn, (0, half - middle))
    return layer.premul_alpha()


@lru_cache(maxsize=1)
def _cap_height_ratio() -> float:
    """Cap height by the nominal size of pygame's default font."""
    size = 200
    return _capital_bounds(pygame.font.Font(None, size)).height / size


def _capital_bounds(font: pygame.font.Font) -> pygame.Rect:
    """Bounds of a capital within a line of text, pixels."""
    return font.render("H", True, "white").get_bounding_rect()

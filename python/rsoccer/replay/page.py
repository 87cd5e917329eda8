"""The page of a replay: one HTML file that plays the match in a browser, without a network.

The files of the folder `web` are its parts. The page contains the replay file itself, without
snapshots, and the shapes of the field and of the robots from `rsoccer.render`.
"""

from __future__ import annotations

import base64
import html
import json
import re
from collections.abc import Iterable, Mapping
from functools import cache
from importlib import resources
from typing import Any, Final

from rsoccer import randomization, sensing_text
from rsoccer._core import RobotModel, SimConfig
from rsoccer.render import palette
from rsoccer.render.ball import GROWTH, MAX_GROWTH, SHADOW_OFFSET
from rsoccer.render.ghosts import FILL, LIGHTNESS, OPACITY
from rsoccer.render.pitch import arena_bounds, pitch_shapes
from rsoccer.render.robot import robot_outlines
from rsoccer.render.scoreboard import GOAL_PAUSE
from rsoccer.render.shapes import Arc, Circle, Color, Line, Point, Polygon, Shape
from rsoccer.replay import file_format
from rsoccer.replay.match_page import match
from rsoccer.replay.recorded import Recorded

SCRIPTS: Final = ("reader.js", "ghosts.js", "field.js", "charts.js", "player.js")
"""Scripts of the page, in their order."""
MATCH_SCRIPTS: Final = ("match.js", "match_floor.js")
"""Further scripts of the page of a match with a referee."""
FRAME_HEIGHT: Final = 620
"""Height of the page in a notebook, pixels."""
_COLORS: Final = (
    *("BLUE", "YELLOW", "ORANGE", "WHITE", "INK", "WALL", "WALL_EDGE", "TABLE", "CARPET", "BOARD"),
    *("SHADOW", "TIRE", "HIGHLIGHT", "HALO", "TRAIL", "DRIBBLER", "DRIBBLER_LIT"),
    *("CAPTION_BAND", "PENDING", "DONE", "YELLOW_CARD", "RED_CARD"),
)
_GHOSTS: Final = {"blue": palette.BLUE, "yellow": palette.YELLOW, "ball": palette.ORANGE}
_PART: Final = re.compile(r"\{\{(\w+)\}\}")
_DIGITS: Final = 5  # of coordinates, hundredths of a millimeter


def to_html(replay: Recorded) -> str:
    """Return the page of a replay.

    Args:
        replay: the replay.

    Returns:
        HTML that needs no other file.

    Raises:
        ReplayError: the replay has numbers that are not finite.
    """
    more = match(replay)
    scripts = SCRIPTS if more is None else (*MATCH_SCRIPTS, *SCRIPTS)
    content = base64.b64encode(file_format.to_bytes(replay, snapshots=False)).decode()
    style = web_part("style.css") + ("" if more is None else web_part("match.css"))
    parts = {
        "scene": to_json(scene(replay.config) | {"conditions": _conditions(replay)}),
        "match": to_json(more),
        "replay": content,
    }
    title = f"{replay.task}: {' - '.join(filter(None, replay.names))}"
    return document(title, style, fill(web_part("page.html"), parts), map(web_part, scripts))


def document(title: str, style: str, body: str, scripts: Iterable[str], head: str = "") -> str:
    """Return a whole page, which needs no other file.

    Args:
        title: title of the page.
        style: style sheet; it can use the variables of `color_variables`.
        body: content of the page, as HTML.
        scripts: scripts in their order, which share names.
        head: further elements of the head, as HTML.
    """
    parts = {
        "title": html.escape(title),
        "head": head,
        "colors": color_variables(),
        "style": style,
        "body": body,
        "script": "\n".join(scripts),
    }
    return fill(web_part("document.html"), parts)


def fill(template: str, parts: Mapping[str, str]) -> str:
    """Return a page with its parts.

    Args:
        template: the page, with names of parts in double braces.
        parts: texts by name.
    """
    return _PART.sub(lambda match: parts[match[1]], template)


def color_variables() -> str:
    """Return the colors of the palette as variables of a style sheet."""
    return "".join(f"--{_name(color)}: {_css(color)};" for color in _COLORS)


def to_frame(replay: Recorded) -> str:
    """Return the page of a replay in an `iframe`, for notebooks.

    Args:
        replay: the replay.

    Returns:
        One HTML element.

    Raises:
        ReplayError: the replay has numbers that are not finite.
    """
    return (
        f'<iframe title="Replay" width="100%" height="{FRAME_HEIGHT}" style="border:0" '
        f'srcdoc="{html.escape(to_html(replay))}"></iframe>'
    )


def scene(config: SimConfig) -> dict[str, Any]:
    """Return all that the page draws and that the replay file does not hold.

    Args:
        config: the configuration.

    Returns:
        Values for JSON: bounds, shapes of the field, outlines and colors of the robots, the ball.
    """
    bounds = arena_bounds(config.field)
    outlines = {model.to_json(): _outlines(model) for model in config.robots}
    models = list(outlines)
    return {
        "bounds": _flat([(bounds.left, bounds.bottom), (bounds.right, bounds.top)]),
        "field": [_shape(shape) for shape in pitch_shapes(config.field)],
        "lineWidth": config.field.line_width,
        "outlines": list(outlines.values()),
        "robots": [models.index(model.to_json()) for model in config.robots],
        "nBlue": config.n_blue,
        "ball": {
            "radius": config.ball.radius,
            "growth": GROWTH,
            "maxGrowth": MAX_GROWTH,
            "shadowOffset": SHADOW_OFFSET,
        },
        "ghosts": {
            "tints": {
                name: _css(palette.mix(color, palette.WHITE, LIGHTNESS))
                for name, color in _GHOSTS.items()
            },
            "opacity": OPACITY,
            "fill": FILL,
        },
        "timeStep": config.time_step,
        "goalPause": GOAL_PAUSE,
        "colors": {_name(color): _css(color) for color in _COLORS},
    }


def _conditions(replay: Recorded) -> list[str]:
    """Senses and varied numbers of the match in words, where it has them."""
    conditions = []
    if replay.sensing is not None:
        conditions.append(f"sensing {sensing_text.describe(replay.sensing)}")
    if replay.randomization:
        conditions.append(randomization.describe(replay.randomization))
    return conditions


def to_json(value: object) -> str:
    """Return JSON that can stand in a page.

    Args:
        value: numbers, texts, lists and dicts of them.
    """
    return json.dumps(value, separators=(",", ":")).replace("<", "\\u003c")


def _outlines(model: RobotModel) -> dict[str, Any]:
    """Outlines of a robot, and the colors of its hull by team."""
    outlines = robot_outlines(model)
    hulls = {
        team: _css(palette.mix(color, palette.INK, outlines.shade))
        for team, color in (("blue", palette.BLUE), ("yellow", palette.YELLOW))
    }
    return {
        "size": outlines.size,
        "hull": _flat(outlines.hull),
        "cover": _flat(outlines.cover),
        "wheels": [_flat(wheel) for wheel in outlines.wheels],
        "arrow": _flat(outlines.arrow),
        "dribbler": _flat(outlines.dribbler),
        "numberX": outlines.number_x,
        "numberHeight": outlines.number_height,
        "hullColors": hulls,
    }


def _shape(shape: Shape) -> list[Any]:
    """A shape as a list: its kind, its color, its numbers."""
    if isinstance(shape, Polygon):
        return ["polygon", _css(shape.color), shape.blur, _flat(shape.points)]
    if isinstance(shape, Circle):
        return ["circle", _css(shape.color), *_flat([shape.center]), shape.radius]
    if isinstance(shape, Arc):
        return [
            "arc",
            _css(shape.color),
            *_flat([shape.center]),
            *(shape.radius, shape.start, shape.end, shape.width),
        ]
    if isinstance(shape, Line):
        return ["line", _css(shape.color), *_flat([shape.start, shape.end]), shape.width]
    raise TypeError(f"shape: expected one without text, got {shape}")


def _flat(points: Iterable[Point]) -> list[float]:
    """Coordinates of points, one after the other, rounded."""
    return [round(v, _DIGITS) for point in points for v in point]


def _css(color: Color | str) -> str:
    """A color, or the color of a name of the palette, as CSS."""
    red, green, blue, alpha = getattr(palette, color) if isinstance(color, str) else color
    return f"rgba({red},{green},{blue},{round(alpha / 255, 3)})"


def _name(color: str) -> str:
    """Name of a color on the page."""
    return color.lower().replace("_", "-")


@cache
def web_part(name: str) -> str:
    """Return the text of a part of the page.

    Args:
        name: name of a file in the folder `web`.
    """
    return (resources.files("rsoccer.replay") / "web" / name).read_text(encoding="utf-8")

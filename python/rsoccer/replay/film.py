"""Images of a replay, for windows and videos."""

from __future__ import annotations

import math
from collections.abc import Iterator

from rsoccer.render.effects import Effects
from rsoccer.render.ghosts import SensedWorld, ghost_shapes
from rsoccer.render.image import Image, Renderer, default_width
from rsoccer.render.overlay import marker_shapes
from rsoccer.render.scoreboard import GOAL_PAUSE, caption_of
from rsoccer.render.shapes import Shape
from rsoccer.render.video import MIN_WIDTH
from rsoccer.replay.recorded import Recorded


def film_replay(
    replay: Recorded, width: int | None = None, *, ghosts: bool = True
) -> tuple[Iterator[Image], float]:
    """Return the images of a replay, those that `film_match` drew for the same match.

    Args:
        replay: the replay.
        width: width of the images, 64 to 4096 pixels; by default 720, or more on a large field.
        ghosts: whether to show ball and robots as the robots knew them too, if they had senses.

    Returns:
        An iterator over images (height, width, 3), and their rate in images per second.

    Raises:
        ValueError: the width is out of range.
    """
    width = default_width(replay.config, MIN_WIDTH) if width is None else width
    renderer = Renderer(replay.config, width, has_referee=replay.referee is not None)
    return _images(replay, renderer, ghosts), 1.0 / replay.config.time_step


def _images(replay: Recorded, renderer: Renderer, ghosts: bool) -> Iterator[Image]:
    """An image for the first state and each control step, and a pause at each caption."""
    goals = {event.frame for event in replay.events if event.kind == "goal"}
    pause = math.ceil(GOAL_PAUSE / replay.config.time_step)
    states = replay.referee_states or (None,) * len(replay)
    announcements = replay.announcements
    effects = Effects(replay.config)
    for frame, row in enumerate(replay.rows):
        if frame and replay.starts[frame]:
            effects.clear()
            continue
        clock = float(replay.clock[frame])
        blue, yellow = replay.score[frame].tolist()
        caption = caption_of(states[frame], scored=frame in goals)
        image = renderer.draw(
            row,
            score=(blue, yellow),
            clock=clock,
            names=replay.names,
            caption=caption,
            referee=states[frame],
            announcement=announcements[frame],
            extras=(
                *marker_shapes(replay.config.field, replay.markers[frame]),
                *(_ghosts(replay, frame) if ghosts else ()),
                *(effects.update(row, clock, replay.commands[frame]) if frame else ()),
            ),
        )
        for _ in range(pause if caption else 1):
            yield image


def _ghosts(replay: Recorded, frame: int) -> tuple[Shape, ...]:
    """Ball and robots of a frame as the robots knew them, if they had senses."""
    sensed = replay.sensed
    if sensed is None:
        return ()
    present = replay.frame.robots.absent[frame] == 0
    known = (sensed.ball[frame], sensed.robots[frame], sensed.headings[frame])
    return ghost_shapes(replay.config, SensedWorld(*known, present))

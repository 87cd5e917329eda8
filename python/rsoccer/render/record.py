"""A match between policies as images, and one call that writes them to a video file."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from rsoccer.controllers import Controllers, given_by_name
from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT
from rsoccer.lineup import task_for
from rsoccer.matches import Matches
from rsoccer.render.image import Image, Renderer, default_width
from rsoccer.render.markers import marked
from rsoccer.render.video import write_video
from rsoccer.task import Task

GOAL_PAUSE = 0.8
"""Seconds that the picture stands still at a goal, before the next episode begins."""
LEAST_WIDTH = 720
"""Width of a video where no other is asked for and robots can be told apart at it, pixels."""


def record_match(
    path: Path | str,
    task: Task | str | None = None,
    controllers: Controllers | None = None,
    seed: int = 0,
    seconds: float = 30.0,
    *,
    names: tuple[str, str] = ("BLUE", "YELLOW"),
    width: int | None = None,
) -> Path:
    """Play `seconds` of a match, episode after episode, into an .mp4 or .gif; the path written.

    `controllers` are those of `Matches` and must leave no robot to a learner; `lineup` makes them
    of a policy and an opponent. Without a `task` it is that of the first trained policy among
    them, or VSSSelfPlay-v0. `names` stand on the score board, blue's first. Without a `width`, in
    pixels, it is one at which robots can be told apart.
    """
    images, fps = film_match(task, controllers, seed, seconds, names=names, width=width)
    return write_video(path, images, fps)


def film_match(
    task: Task | str | None = None,
    controllers: Controllers | None = None,
    seed: int = 0,
    seconds: float = 30.0,
    *,
    names: tuple[str, str] = ("BLUE", "YELLOW"),
    width: int | None = None,
) -> tuple[Iterator[Image], float]:
    """The images that `record_match` writes, played while they are drawn, and images a second."""
    if not (math.isfinite(seconds) and seconds > 0):
        raise ValueError(f"seconds: expected a positive number, got {seconds}")
    task = task_for(*given_by_name(controllers).values()) if task is None else task
    matches = Matches(task, seed=seed, controllers=controllers, autoreset="disabled")
    if matches.agents:
        raise ValueError(
            f"controllers: expected a policy for every robot, got none for {list(matches.agents)}"
        )
    config = matches.task.config
    width = default_width(config, LEAST_WIDTH) if width is None else width
    return _film(matches, Renderer(config, width), seconds, names), 1.0 / config.time_step


def _film(
    matches: Matches, renderer: Renderer, seconds: float, names: tuple[str, str]
) -> Iterator[Image]:
    """An image for each control step, and a pause at each goal."""
    time_step = matches.task.config.time_step
    nobody = np.zeros((1, 0, matches.action_size), np.float32)  # nobody learns
    blue = yellow = 0
    matches.reset()
    row = matches.frame.rows[0]
    yield renderer.draw(row, names=names, extras=marked(matches))
    for step in range(1, max(1, round(seconds / time_step)) + 1):
        if matches.done[0]:
            matches.reset()
        matches.step(nobody)
        crossed = matches.frame.ball.crossed[0]
        blue, yellow = blue + int(crossed == GOAL_RIGHT), yellow + int(crossed == GOAL_LEFT)
        scored = crossed in (GOAL_RIGHT, GOAL_LEFT)
        image = renderer.draw(
            matches.frame.rows[0],
            score=(blue, yellow),
            clock=step * time_step,
            names=names,
            caption="goal" if scored else "",
            extras=marked(matches),
        )
        for _ in range(math.ceil(GOAL_PAUSE / time_step) if scored else 1):
            yield image

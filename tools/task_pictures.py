"""Draws docs/tasks/<name>.png: a moment of play in each registered task (`make docs`)."""

from pathlib import Path
from typing import Final

import numpy as np

import rsoccer
from benches.solvers import SOLVERS
from rsoccer import Matches, make_task
from rsoccer.controllers import Controllers
from rsoccer.render.effects import Effects
from rsoccer.render.image import Image, draw_image
from rsoccer.render.overlay import task_overlay
from rsoccer.render.pygame_import import pygame
from rsoccer.render.referee_state import referee_state
from tools.paths import DOCS

FOLDER: Final = DOCS / "tasks"
WIDTH: Final = 640  # pixels
SECONDS: Final = 1.5  # of play before the moment that is drawn

CONTROLLERS: Final[dict[str, Controllers]] = {
    "VSS-v0": {"blue": "chase", "yellow": "ou"},
    "SSLMatch-v0": {"blue": "best", "yellow": "scripted"},
    "VSSMatch-v0": {"blue": "best", "yellow": "scripted"},
    "VSSMulti-v0": {"blue": "chase", "yellow": "ou"},
    "VSSSelfPlay-v0": {"blue": "chase", "yellow": "chase"},
}
"""Controllers, where they are not the task's defaults with its solver as the learners."""
MOMENTS: Final = {
    "SSLGoToBall-v0": 0.5,
    "SSLMatch-v0": 7.0,
    "SSLPassEndurance-v1": 0.8,
    "VSSMatch-v0": 6.0,
    "VSSSelfPlay-v0": 0.75,
}
"""Seconds of play, where `SECONDS` is not the moment that shows the task."""
SEEDS: Final = {"SSLGoToBall-v0": 4, "SSLSelfPlay-v0": 2, "VSSMulti-v0": 1, "VSSSelfPlay-v0": 2}
"""Seeds of the matches, where it is not 0."""


def main() -> None:
    """Draw the pictures of all registered tasks."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in rsoccer.list_tasks():
        save(path_of(name), draw(name))


def path_of(name: str) -> Path:
    """Return the path of a task's picture."""
    return FOLDER / f"{name}.png"


def draw(name: str) -> Image:
    """Return an image of the task after some play, from a fixed seed."""
    controllers = CONTROLLERS.get(name) or dict.fromkeys(make_task(name).agents, SOLVERS[name])
    matches = Matches(name, seed=SEEDS.get(name, 0), controllers=controllers, autoreset="disabled")
    no_actions = np.zeros((1, len(matches.agents), matches.action_size), np.float32)
    matches.reset()
    config = matches.task.config
    seconds = MOMENTS.get(name, SECONDS)
    steps = 0
    effects = Effects(config)
    events = effects.update(matches.frame.rows[0], 0.0)
    while steps < round(seconds / config.time_step) and not matches.done[0]:
        matches.step(no_actions)
        steps += 1
        clock = steps * config.time_step
        events = effects.update(matches.frame.rows[0], clock, matches.play.commands[0])
    extras = (*task_overlay(matches.task, matches.play), *events)
    row, clock = matches.frame.rows[0], steps * config.time_step
    referee = referee_state(matches.task, matches.play)
    return draw_image(config, row, clock=clock, referee=referee, extras=extras, width=WIDTH)


def save(path: Path, image: Image) -> None:
    """Write an image as a PNG."""
    pygame.image.save(pygame.surfarray.make_surface(image.swapaxes(0, 1)), str(path))


if __name__ == "__main__":
    main()

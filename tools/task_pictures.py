"""Draws docs/tasks/<name>.png: a moment of play in each registered task (`make docs`)."""

from pathlib import Path
from typing import Final

import numpy as np

import rsoccer
from benches.table import ROOT
from rsoccer import Matches
from rsoccer.controllers import Controllers
from rsoccer.render.image import Image, draw_image
from rsoccer.render.overlay import task_overlay
from rsoccer.render.pygame_import import pygame

FOLDER: Final = ROOT / "docs" / "tasks"
WIDTH: Final = 420  # pixels
SECONDS: Final = 1.5  # of play before the moment that is drawn

PLAYERS: Final[dict[str, Controllers]] = {
    "SSLContestedPossession-v0": {"blue_0": "strike"},
    "SSLDribbling-v0": {"blue_0": "weave"},
    "SSLGoToBall-v0": {"blue_0": "fetch"},
    "SSLPassEndurance-v0": {"blue_0": "passer", "blue_1": "receive"},
    "SSLPassEnduranceMulti-v0": {"blue": "passer"},
    "SSLSelfPlay-v0": {"all": "strike"},
    "SSLStaticDefenders-v0": {"blue_0": "strike"},
    "VSS-v0": {"blue": "chase", "yellow": "ou"},
    "VSSMulti-v0": {"blue": "chase", "yellow": "ou"},
    "VSSSelfPlay-v0": {"blue": "chase", "yellow": "chase"},
}
"""Who plays where; robots not named are driven as the task says, or drift."""
MOMENTS: Final = {"SSLGoToBall-v0": 0.5, "SSLPassEndurance-v0": 0.8, "VSSSelfPlay-v0": 0.75}
"""Seconds of play, where `SECONDS` is not the moment that shows the task."""
SEEDS: Final = {"SSLGoToBall-v0": 4, "SSLSelfPlay-v0": 2, "VSSMulti-v0": 1, "VSSSelfPlay-v0": 2}
"""Seeds of the matches, where it is not 0."""


def main() -> None:
    """Draw all of them."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in rsoccer.list_tasks():
        save(path_of(name), draw(name))


def path_of(name: str) -> Path:
    """Where the picture of a task is."""
    return FOLDER / f"{name}.png"


def draw(name: str) -> Image:
    """The task after some play, from a fixed seed."""
    players = PLAYERS.get(name, {"all": "ou"})
    matches = Matches(name, seed=SEEDS.get(name, 0), controllers=players, autoreset="disabled")
    nobody = np.zeros((1, len(matches.agents), matches.action_size), np.float32)
    matches.reset()
    config = matches.task.config
    seconds = MOMENTS.get(name, SECONDS)
    steps = 0
    while steps < round(seconds / config.time_step) and not matches.done[0]:
        matches.step(nobody)
        steps += 1
    row, clock = matches.frame.rows[0], steps * config.time_step
    return draw_image(config, row, clock=clock, extras=task_overlay(matches), width=WIDTH)


def save(path: Path, image: Image) -> None:
    """Write an image as a PNG."""
    pygame.image.save(pygame.surfarray.make_surface(image.swapaxes(0, 1)), str(path))


if __name__ == "__main__":
    main()

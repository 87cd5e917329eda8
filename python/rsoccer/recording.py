"""Recording of matches between policies: their images, or a video file of them."""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator
from contextlib import closing
from pathlib import Path

import numpy as np

from rsoccer import checks
from rsoccer.controllers import Controllers
from rsoccer.game import BLUE, YELLOW, EventKind
from rsoccer.matches import Matches
from rsoccer.matches.policy_match import policy_match
from rsoccer.randomization import Ranges
from rsoccer.render.announcer import Announcer, named_events
from rsoccer.render.effects import Effects
from rsoccer.render.ghosts import sensed_overlay
from rsoccer.render.image import Image, Renderer, default_width
from rsoccer.render.overlay import task_overlay
from rsoccer.render.referee_state import referee_of, referee_state
from rsoccer.render.scoreboard import GOAL_PAUSE, caption_of
from rsoccer.render.shapes import Shape
from rsoccer.render.video import MIN_WIDTH, write_video
from rsoccer.sources import SensingSource, SimulatorSource, closed_after
from rsoccer.task import Task


def record_match(
    path: Path | str,
    task: Task | str | None = None,
    controllers: Controllers | None = None,
    seed: int = 0,
    seconds: float = 30.0,
    *,
    names: tuple[str, str] = ("BLUE", "YELLOW"),
    width: int | None = None,
    ghosts: bool = True,
    simulator: SimulatorSource | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
) -> Path:
    """Play a match, episode after episode, and write it to a video file.

    Example:
        >>> teams = {"blue": "chase", "yellow": "ou"}
        >>> record_match("match.mp4", controllers=teams, seconds=10.0)  # doctest: +SKIP

    Args:
        path: the file, ending in .mp4 or .gif.
        task: the task or its id; by default the task of the first trained policy among
            `controllers`, or VSSSelfPlay-v0.
        controllers: policies as `Matches` takes them, for all robots; `lineup` makes them of a
            policy and an opponent.
        seed: seed of starts and policies.
        seconds: duration of play, without pauses at goals.
        names: names of blue and of yellow on the score board.
        width: width of the video, 64 to 4096 pixels; by default 720, or more on a large field.
        ghosts: whether to show ball and robots as the robots know them too, if they have senses.
        simulator: moves the robots, as for `Matches`.
        sensing: what robots know of the true state, as for `Matches`.
        randomization: numbers that each episode draws, as for `Matches`.

    Returns:
        The path of the file: a .gif where ffmpeg is missing, see `write_video`.

    Raises:
        ImportError: a text "module:name" whose module or name does not exist.
        ValueError: `seconds` is not positive, a robot has no policy, or another bad argument.
    """
    images, fps = film_match(
        task,
        controllers,
        seed,
        seconds,
        names=names,
        width=width,
        ghosts=ghosts,
        simulator=simulator,
        sensing=sensing,
        randomization=randomization,
    )
    with closing(images):
        return write_video(path, images, fps)


def film_match(
    task: Task | str | None = None,
    controllers: Controllers | None = None,
    seed: int = 0,
    seconds: float = 30.0,
    *,
    names: tuple[str, str] = ("BLUE", "YELLOW"),
    width: int | None = None,
    ghosts: bool = True,
    simulator: SimulatorSource | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
) -> tuple[Generator[Image, None, None], float]:
    """Return the images of a match; the match is played while they are drawn.

    The simulator is closed after the last image, after an error, or by `close` of the iterator.

    Args:
        task: the task or its id; by default the task of the first trained policy among
            `controllers`, or VSSSelfPlay-v0.
        controllers: policies as `Matches` takes them, for all robots.
        seed: seed of starts and policies.
        seconds: duration of play, without pauses at goals.
        names: names of blue and of yellow on the score board.
        width: width of the images, 64 to 4096 pixels; by default 720, or more on a large field.
        ghosts: whether to show ball and robots as the robots know them too, if they have senses.
        simulator: moves the robots, as for `Matches`.
        sensing: what robots know of the true state, as for `Matches`.
        randomization: numbers that each episode draws, as for `Matches`.

    Returns:
        An iterator over images (height, width, 3), and their rate in images per second.

    Raises:
        ImportError: a text "module:name" whose module or name does not exist.
        ValueError: `seconds` is not positive, a robot has no policy, or another bad argument.
    """
    names = checks.team_names(names)
    matches = policy_match(
        task,
        controllers,
        seed,
        seconds,
        simulator=simulator,
        sensing=sensing,
        randomization=randomization,
    )
    images = _film(matches, simulator, seconds, names, width, ghosts)
    next(images)  # from now on it closes the simulator, whatever ends it
    return images, 1.0 / matches.task.config.time_step


def _film(
    matches: Matches,
    simulator: SimulatorSource | None,
    seconds: float,
    names: tuple[str, str],
    width: int | None,
    ghosts: bool,
) -> Generator[Image, None, None]:
    """An empty image, and those of the match, at whose end its simulator is closed."""
    with closed_after(matches, simulator):
        config = matches.task.config
        renderer = Renderer(
            config,
            default_width(config, MIN_WIDTH) if width is None else width,
            has_referee=referee_of(matches.task) is not None,
        )
        yield np.empty((0, 0, 3), np.uint8)
        yield from _images(matches, renderer, seconds, names, ghosts)


def _images(
    matches: Matches,
    renderer: Renderer,
    seconds: float,
    names: tuple[str, str],
    ghosts: bool = True,
) -> Iterator[Image]:
    """An image for each control step, and a pause at each goal and at the end of a match."""
    task, time_step = matches.task, matches.task.config.time_step
    actions = np.zeros((1, 0, matches.action_size), np.float32)  # no robot learns
    blue = yellow = 0
    effects, announcer = Effects(task.config), Announcer(task.config.field)
    matches.reset()
    yield renderer.draw(
        matches.frame.rows[0],
        names=names,
        referee=referee_state(task, matches.play),
        extras=_floor(matches, ghosts),
    )
    for step in range(1, max(1, round(seconds / time_step)) + 1):
        if matches.done[0]:
            matches.reset()
            effects.clear()
            announcer.clear()
        matches.step(actions)
        play, clock = matches.play, step * time_step
        goals = play.events.by_team(EventKind.GOAL)[0].tolist()
        blue, yellow = blue + goals[BLUE], yellow + goals[YELLOW]
        state = referee_state(task, play)
        caption = caption_of(state, scored=any(goals))
        image = renderer.draw(
            matches.frame.rows[0],
            score=(blue, yellow),
            clock=clock,
            names=names,
            caption=caption,
            referee=state,
            announcement=announcer.update(named_events(task, play.events.of_world(0)), clock),
            extras=(
                *_floor(matches, ghosts),
                *effects.update(matches.frame.rows[0], clock, play.commands[0]),
            ),
        )
        for _ in range(math.ceil(GOAL_PAUSE / time_step) if caption else 1):
            yield image


def _floor(matches: Matches, ghosts: bool) -> tuple[Shape, ...]:
    """Markers of the task, and what robots know."""
    task, play = matches.task, matches.play
    return (*task_overlay(task, play), *(sensed_overlay(task.config, play) if ghosts else ()))

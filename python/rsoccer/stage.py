"""What the environments of all libraries share: their matches, how these start, and pictures."""

from __future__ import annotations

import copy
import warnings
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from gymnasium.error import ClosedEnvironmentError
from gymnasium.spaces import Space
from numpy.typing import NDArray

from rsoccer import checks, spaces
from rsoccer.controllers import Controllers, given_by_name, resolve
from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT, Array, Floats, Mask
from rsoccer.matches import Matches
from rsoccer.outcome import Outcome
from rsoccer.registry import as_task, make_task
from rsoccer.task import LEARN, Task

if TYPE_CHECKING:
    from rsoccer.render.window import Window

Image = NDArray[np.uint8]

RENDER_MODES: Final = ("human", "rgb_array")


class StageMatches(Matches):
    """Matches that can be copied: a copy, or one in another process, goes on with the same."""

    def __init__(self, task: Task, worlds: int, seed: int, **settings: Any) -> None:  # noqa: ANN401
        """Prepare matches; `settings` are the others of `Matches`."""
        super().__init__(task, worlds, seed, **settings)
        self._settings = settings

    @property
    def begun(self) -> bool:
        """Whether every match has begun an episode."""
        return bool(np.count_nonzero(self._begun) == self.worlds)

    def check_turn(self) -> None:
        """RuntimeError unless every match has begun and none has ended."""
        hint = "call reset() to begin an episode"
        if not self.begun:
            raise RuntimeError(f"step before reset: {hint}")
        if np.count_nonzero(self._done):
            where = "" if self.worlds == 1 else f" in worlds {np.flatnonzero(self._done).tolist()}"
            raise RuntimeError(f"step after the end of the episode{where}: {hint}")

    def score(self, world: int = 0) -> tuple[int, int]:
        """Goals of blue and of yellow in a match: 0 to 0 until a goal ends it."""
        crossed = self.frame.ball.crossed[world]
        return int(crossed == GOAL_RIGHT), int(crossed == GOAL_LEFT)

    def clock(self, world: int = 0) -> float:
        """Seconds played of a match."""
        return float(self.play.steps[world]) * self.task.config.time_step

    def __reduce__(self) -> tuple[Any, ...]:
        """All that the future depends on."""
        return _resumed, (self.task, self.worlds, self._settings, self.state_dict())


class Screen:
    """Shows matches in the way that was asked for, until it is closed for good.

    What draws is imported only when there is something to show.
    """

    def __init__(self, mode: str | None, task: Task, modes: Sequence[str] = RENDER_MODES) -> None:
        """`mode` is one of `modes` or None."""
        if mode is not None and mode not in modes:
            raise ValueError(f"render_mode: expected one of {modes} or None, got {mode!r}")
        self._mode, self._modes, self._fps = mode, modes, frames_per_second(task)
        self._window: Window | None = None
        self.closed = False

    def show(self, matches: StageMatches) -> Image | None:
        """A lone match as an image (height, width, 3), or in a window."""
        self.expect_open("render")
        if self._mode is None:
            text = f"render() needs a render_mode, one of {self._modes}"
            warnings.warn(text, stacklevel=3)
            return None
        image = self.image(matches)
        if self._mode == "rgb_array":
            return image
        if self._window is None:
            from rsoccer.render.window import Window

            self._window = Window(matches.task.name, self._fps)
        self._window.show(image)
        return None

    def image(self, matches: StageMatches, world: int = 0) -> Image:
        """One of the matches as an image (height, width, 3)."""
        self.expect_open("render")
        if not matches.begun:
            raise RuntimeError("render before reset: call reset() to begin an episode")
        from rsoccer.render.image import draw_image
        from rsoccer.render.markers import marked

        return draw_image(
            matches.task.config,
            matches.frame.rows[world],
            score=matches.score(world),
            clock=matches.clock(world),
            extras=marked(matches, world),
        )

    def expect_open(self, call: str) -> None:
        """ClosedEnvironmentError, Gymnasium's own, for calls that come after `close`."""
        if self.closed:
            raise ClosedEnvironmentError(f"{call} after close: make another environment")

    def close(self) -> None:
        """Close the window, if there is one; may be repeated."""
        self.closed = True
        if self._window is not None:
            self._window.close()
            self._window = None

    def __getstate__(self) -> dict[str, Any]:
        """All but the window: a copy opens its own."""
        return {**self.__dict__, "_window": None}


class OneSeat:
    """What both of Gymnasium's environments tell of who plays what."""

    _matches: StageMatches

    @property
    def task(self) -> Task:
        """The task that is played."""
        return self._matches.task

    @property
    def learner(self) -> str:
        """The robot that learns."""
        return str(self._matches.agents[0])


def metadata(task: Task, modes: Sequence[str] = RENDER_MODES) -> dict[str, Any]:
    """What environments of all libraries tell of themselves."""
    return {
        "name": task.name,
        "render_modes": list(modes),
        "render_fps": frames_per_second(task),
    }


def frames_per_second(task: Task) -> int:
    """Steps in a second of the match."""
    return round(1.0 / task.config.time_step)


def chosen_task(task: Task | str, max_steps: int | None, options: Mapping[str, Any]) -> Task:
    """A task from its name and options, or itself; with a clock of its own if asked for."""
    if isinstance(task, str):
        clock = {} if max_steps is None else {"max_steps": max_steps}
        return make_task(task, **options, **clock)
    if options:
        raise TypeError(f"options: a task that is made has its own, got {sorted(options)} besides")
    task = as_task(task)
    return task if max_steps is None else timed(task, "max_steps", max_steps)


def timed(task: Task, name: str, limit: int) -> Task:
    """A copy with another clock: the caller's own task keeps its own."""
    task = copy.copy(task)
    object.__setattr__(task, "max_steps", checks.whole(name, limit, 1))
    return task


def one_learner(task: Task, learner: str | None, controllers: Controllers | None) -> Controllers:
    """A driver for each robot, one of them the learner; or an error that says how to get there."""
    given = given_by_name(controllers)
    if learner is not None:
        if learner not in task.robots:
            raise ValueError(f"learner: expected one of {list(task.robots)}, got {learner!r}")
        given[learner] = LEARN
    chosen = resolve(task, given)
    learners = [robot for robot, controller in chosen.items() if controller is LEARN]
    if len(learners) != 1:
        raise ValueError(
            f"{task.name}: expected one robot that learns, got {learners or 'none'}: name it and "
            f"who drives the others, as in learner={task.robots[0]!r}, controllers={{'all': 'ou'}}"
        )
    return chosen


def reset_options(options: object) -> Mapping[str, Any]:
    """What was given to `reset` as options; keys that nobody here knows are for others."""
    if not isinstance(options, Mapping | None):
        raise TypeError(f"options: expected a dictionary, got {type(options).__name__}")
    return options or {}


def starts(options: Mapping[str, Any], task: Task, mask: Mask) -> Floats | None:
    """Rows (k, row) to start the k worlds of the mask from, if `options["frame"]` gives any.

    It is one row (row,) for all, or a row for each of all worlds (n, row).
    """
    given, size = options.get("frame"), task.config.row_size
    if given is None:
        return None
    if np.ndim(given) == 2:
        return checks.floats("options['frame']", given, (len(mask), size))[mask]
    return np.tile(checks.floats("options['frame']", given, (size,)), (int(mask.sum()), 1))


def actions_of(task: Task, given: object, space: Space[Any]) -> Array:
    """What was chosen in `space` as numbers (..., action); `Matches` checks their values."""
    chosen = np.asarray(given)
    if chosen.shape != space.shape:
        raise ValueError(f"actions: expected shape {space.shape}, got {chosen.shape}")
    return spaces.numbers(task, chosen)


def facts(outcome: Outcome, matches: Matches) -> dict[str, float]:
    """What there is to tell of a lone match that ended: the task's metrics, and steps."""
    told = {name: float(fact[0]) for name, fact in outcome.metrics.items()}
    return {**told, "steps": float(matches.play.steps[0])}


def _resumed(
    task: Task, worlds: int, settings: Mapping[str, Any], state: Mapping[str, Array]
) -> StageMatches:
    matches = StageMatches(task, worlds, 0, **settings)
    matches.load_state_dict(state)
    return matches

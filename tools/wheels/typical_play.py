"""Play from which the compiler learns what is usual: `make profiled`, `make wheels`.

python -m tools.wheels.typical_play

The compiled module is built twice: first with counters, with which this program runs, and then by
what they have counted. Every task plays, with robots that act at random, that all drive at
the ball, and, in whole matches, that scripts drive; without senses and with those of its league.
"""

from collections.abc import Iterator
from typing import Any, Final

import rsoccer
from tools.soak_matches import SIDES, Actions

WORLDS: Final = 32
STEPS: Final = 150
SELDOM: Final = ("VSSSelfPlay-v0", "SSLSelfPlay-v0")
SELDOM_STEPS: Final = 20
"""Tasks and steps of what is seldom used and takes long: the engine rapier, and forecasts."""

SIZES: Final[dict[str, tuple[dict[str, Any], ...]]] = {
    "VSSMatch-v0": ({}, {"n_blue": 5, "n_yellow": 5, "field": "vss_5v5"}),
    "SSLMatch-v0": (
        {"n_blue": 1, "n_yellow": 1},
        {"n_blue": 6, "n_yellow": 6},
        {"n_blue": 11, "n_yellow": 11, "division": "A"},
    ),
}
"""Options of the tasks whose teams have several sizes."""


def main() -> None:
    """Play all of it."""
    for seed, (task, options) in enumerate(cases()):
        for side in SIDES if task in SIZES else ("random", "crowd"):
            for sensing in (None, preset(task)):
                play(task, options, side, sensing, seed)
    for task in SELDOM:
        play(task, {"engine": "rapier"}, "random", None, steps=SELDOM_STEPS)
        play(task, {}, "random", f"{preset(task)}, forecast=1", steps=SELDOM_STEPS)


def preset(task: str) -> str:
    """Return the name of the senses of a task's league."""
    return "vsss" if task.startswith("VSS") else "rc2021"


def cases() -> Iterator[tuple[str, dict[str, Any]]]:
    """Return each task with options for it."""
    for task in rsoccer.list_tasks():
        for options in SIZES.get(task, ({},)):
            yield task, options


def play(
    task: str,
    options: dict[str, Any],
    side: str,
    sensing: str | None,
    seed: int = 0,
    steps: int = STEPS,
) -> None:
    """Play some steps of a task.

    Args:
        task: name of the task.
        options: its options.
        side: one of `SIDES`: how the learners act; "scripted" has no learners.
        sensing: name of a preset of senses; None for none.
        seed: seed of the matches and of the actions.
        steps: number of control steps.
    """
    controllers = {"all": "scripted"} if side == "scripted" else None
    matches = rsoccer.Matches(
        task, WORLDS, seed, controllers=controllers, sensing=sensing, **options
    )
    matches.reset()
    actions = Actions(side, matches.task, seed)
    for _ in range(steps):
        matches.step(actions.next(matches))


if __name__ == "__main__":
    main()

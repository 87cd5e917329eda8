"""Soak test of whole matches under a referee: `python -m tools.soak_matches`.

Plays matches of both leagues and all sizes to their end, with random actions, with robots that all
drive at the ball, and with scripts. In every step clocks, scores and statistics have to add up
(`tools.match_audit`), and the same matches have to have the same bits on two threads, resumed from
saved states at random steps, and alone in a batch of one.
"""

import argparse
import sys
import time
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

import rsoccer
from benches.markdown import table
from benches.result_files import RESULTS
from rsoccer.arrays import Floats
from rsoccer.matches import Matches
from rsoccer.task import Task
from rsoccer.tasks.match import Match
from rsoccer.testing.pressure import Pressing
from tools.match_audit import AuditError, MatchAudit

STORED: Final = RESULTS / "soak_matches.md"
SIDES: Final = ("random", "crowd", "scripted")
HEADER: Final = ("scene", "sides", "matches", "hours", "idle (s)", "resumed", "kinds", "goals")
HELD: Final = 10
"""Steps for which random actions are held."""
RESUMES: Final = 1 / 150
"""Probability of a step from which the twin is resumed."""


@dataclass(frozen=True)
class Scene:
    """League and sizes of the teams."""

    name: str
    task: str
    options: dict[str, Any] = field(default_factory=dict)


def _ssl(size: int, division: str, placement: str) -> Scene:
    options = {"n_blue": size, "n_yellow": size, "division": division, "placement": placement}
    return Scene(f"SSL {size} v {size}, {division}, {placement}", "SSLMatch-v0", options)


SCENES: Final = (
    Scene("VSSS 3 v 3", "VSSMatch-v0"),
    Scene("VSSS 5 v 5", "VSSMatch-v0", {"n_blue": 5, "n_yellow": 5, "field": "vss_5v5"}),
    *(
        _ssl(size, division, placement)
        for size, division in ((1, "B"), (3, "B"), (6, "B"), (11, "A"))
        for placement in ("teleport", "robots")
    ),
)


@dataclass(frozen=True)
class Soaked:
    """Amount of play in a scene, and findings."""

    matches: int
    seconds: float
    """Time of play of all matches, s."""
    longest_idle: float
    """Longest time in which nothing happened, s."""
    resumed: int
    """Times that the twin was resumed."""
    kinds: int
    """Kinds of events."""
    goals: int


class Actions:
    """Actions of learners, in all worlds of a batch."""

    def __init__(self, sides: str, task: Task, seed: int) -> None:
        """Begin.

        Args:
            sides: one of `SIDES`.
            task: the task.
            seed: seed of the actions.
        """
        self._pressing = Pressing(task, seed) if sides == "crowd" else None
        self._rng = np.random.default_rng(seed)
        self._held = np.zeros((0, 0, 0), np.float32)
        self._steps = 0

    def next(self, matches: Matches) -> Floats:
        """Return the actions of the next step.

        Args:
            matches: the batch.
        """
        if self._pressing is not None:
            return self._pressing.actions(matches)
        if self._steps % HELD == 0:
            shape = (matches.worlds, len(matches.agents), matches.action_size)
            self._held = self._rng.uniform(-1.0, 1.0, shape).astype(np.float32)
        self._steps += 1
        return self._held


def soak(scene: Scene, sides: str, worlds: int, half_seconds: float, seed: int = 0) -> Soaked:
    """Play matches of a scene to their end, and check every step.

    Args:
        scene: league and sizes.
        sides: one of `SIDES`.
        worlds: number of matches.
        half_seconds: playing time of a half, s; extra time has half of it, the shoot-out few kicks.
        seed: seed of the first match.

    Raises:
        AuditError: something does not add up, or the same matches differ.
    """
    task = rsoccer.make_task(
        scene.task,
        half_seconds=half_seconds,
        knockout=True,
        referee={
            "extra_half_seconds": half_seconds / 2,
            "shootout_kicks": 1,
            "max_shootout_kicks": 2,  # robots that never score would kick for long
        },
        **scene.options,
    )
    if not isinstance(task, Match):
        raise TypeError(f"scene: expected one of whole matches, got {scene.task}")
    controllers = {"all": "scripted" if sides == "scripted" else rsoccer.LEARN}

    def begun(n: int, first: int, threads: int) -> Matches:
        matches = Matches(task, n, first, threads, controllers=controllers, autoreset="disabled")
        matches.reset()
        return matches

    rng = np.random.default_rng(seed)
    alone = int(rng.integers(worlds))
    batch, twin = begun(worlds, seed, 1), begun(worlds, seed, 2)
    single = begun(1, seed + alone, 1)
    audit, actions, resumed = MatchAudit(batch, task), Actions(sides, task, seed), 0
    while not batch.done.all():
        if rng.random() < RESUMES:
            twin.load_state_dict(batch.state_dict())
            resumed += 1
        chosen = actions.next(batch)
        batch.step(chosen)
        twin.step(chosen)
        audit.step()
        expect_same(batch, twin, slice(None), "on two threads, resumed")
        if not single.done[0]:
            single.step(chosen[alone : alone + 1])
            expect_same(batch, single, slice(alone, alone + 1), f"as world {alone} alone")
        if batch.play.steps.max() >= task.max_steps:
            raise AuditError(f"no end of worlds {np.flatnonzero(~batch.done).tolist()}")
    seconds = float(batch.play.steps.sum()) * task.config.time_step
    goals = int(batch.play.game.score.sum())
    return Soaked(worlds, seconds, audit.longest_idle, resumed, len(audit.events), goals)


def expect_same(batch: Matches, other: Matches, worlds: slice, how: str) -> None:
    """Expect the same bits of bodies and match in some worlds and in other matches.

    Args:
        batch: the matches.
        other: matches that have these worlds alone.
        worlds: the worlds.
        how: how the others were played, for the error.

    Raises:
        AuditError: they differ.
    """
    pairs = {"rows": (batch.frame.rows, other.frame.rows)}
    for name, array in batch.play.game.items():
        pairs[name] = (array, other.play.game[name])
    for name, (ours, theirs) in pairs.items():
        if ours[worlds].tobytes() != theirs.tobytes():
            raise AuditError(f"{name} differ {how}, in step {int(batch.play.steps.max())}")


def main(arguments: list[str] | None = None) -> int:
    """Play all scenes, print a table, and return the number of scenes with a fault.

    Args:
        arguments: command line without the program name; default: that of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--matches", type=int, default=100, help="matches of each scene and side")
    parser.add_argument("--half-seconds", type=float, default=20.0, help="playing time of a half")
    parser.add_argument("--only", default="", help="scenes with this text in their name")
    parser.add_argument("--sides", nargs="+", choices=SIDES, default=SIDES)
    parser.add_argument("--seed", type=int, default=0, help="seed of the first match")
    parser.add_argument(
        "--store", action="store_true", help=f"write {STORED.name}; rows of other scenes stay"
    )
    options = parser.parse_args(arguments)
    rows: list[tuple[str, ...]] = []
    faults = 0
    for scene in SCENES:
        for sides in options.sides if options.only in scene.name else ():
            start = time.process_time()
            try:
                found = soak(scene, sides, options.matches, options.half_seconds, options.seed)
            except AuditError as error:
                faults += 1
                rows.append((scene.name, sides, f"FAULT: {error}", *[""] * 5))
            else:
                rows.append((scene.name, sides, *_cells(found)))
            taken = time.process_time() - start
            sys.stderr.write(f"{taken:.0f} s: {' | '.join(rows[-1])}\n")
    sys.stdout.write(f"{table(HEADER, rows)}\n")
    if options.store:
        STORED.write_text(f"{table(HEADER, with_stored(rows))}\n")
    return faults


def with_stored(rows: list[tuple[str, ...]]) -> list[tuple[str, ...]]:
    """Return rows of a run and those of an older run for other scenes or sides.

    Args:
        rows: rows of the run.

    Returns:
        The rows in the order of the scenes.
    """
    lines = (line[2:-2].split(" | ") for line in results().splitlines()[2:])
    found = {(cells[0], cells[1]): tuple(cells) for cells in lines}
    found |= {(row[0], row[1]): row for row in rows}
    keys = ((scene.name, sides) for scene in SCENES for sides in SIDES)
    return [found[key] for key in keys if key in found]


def results() -> str:
    """Return the table of the last run that was stored; empty without one."""
    return STORED.read_text() if STORED.exists() else ""


def _cells(found: Soaked) -> tuple[str, ...]:
    hours, idle = f"{found.seconds / 3600.0:.2f}", f"{found.longest_idle:.1f}"
    return (str(found.matches), hours, idle, str(found.resumed), str(found.kinds), str(found.goals))


if __name__ == "__main__":
    sys.exit(main())

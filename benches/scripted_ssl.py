"""Measure the scripted SSL side in whole matches: `python -m benches.scripted_ssl`.

Pairings of different skill tell whether the dial is monotonic, pairings of equal skill how often
passes arrive and how many fouls there are. All counts are the referee's statistics of
`SSLMatch-v0`, both teams together; a minute is one of the whole match, stoppages included. The
result file gets every row at once, and `--resume` goes on with the rows that are missing.
"""

import argparse
import json
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from itertools import starmap
from multiprocessing import get_context
from pathlib import Path
from typing import Any, Final

import numpy as np

import rsoccer
from benches.markdown import table
from benches.result_files import RESULTS, this_machine
from rsoccer import files
from rsoccer.arrays import Doubles
from rsoccer.evaluate import Interval
from rsoccer.evaluate.results import bootstrap_interval, bootstrap_rate
from rsoccer.lineup import lineup
from rsoccer.task import Task

TASK: Final = "SSLMatch-v0"
FILE: Final = RESULTS / "scripted_ssl.json"
LARGEST_IN_B: Final = 6
"""Robots of a team in division B; larger teams play in division A."""
WORLDS: Final = 64
"""Matches that are played at once."""
SECONDS: Final = "seconds"
"""Duration of a match, beside its metrics."""


@dataclass(frozen=True)
class Pairing:
    """Two scripted sides that meet."""

    blue: float
    """Skill of blue."""
    yellow: float
    """Skill of yellow."""
    robots: int = 6
    """Robots of each team."""


DIAL: Final = tuple(
    Pairing(better, worse)
    for better, worse in ((1.0, 0.5), (1.0, 0.2), (1.0, 0.0), (0.5, 0.2), (0.5, 0.0), (0.2, 0.0))
)
"""Pairings of different skill."""
EQUALS: Final = tuple(Pairing(skill, skill) for skill in (0.0, 0.2, 0.5, 1.0))
"""Pairings of equal skill."""
SIZES: Final = tuple(Pairing(1.0, 1.0, robots) for robots in (1, 3, 11))
"""Pairings of teams of other sizes."""
GROUPS: Final = {"dial": DIAL, "equals": EQUALS, "sizes": SIZES}


@dataclass(frozen=True)
class Row:
    """Results of the matches of a pairing; intervals are of 95%."""

    pairing: Pairing
    matches: int
    won: Interval
    """Share of the matches that blue wins."""
    drawn: float
    """Share of draws."""
    goals: Interval
    """Goals a minute."""
    passes: Interval
    """Passes a minute that arrive."""
    fouls: Interval
    """Fouls a minute."""
    in_play: float
    """Share of the time with the ball in play."""
    speed: float
    """Time of all matches together, in times of the processor's: once is real time."""


def measure(pairing: Pairing, matches: int, half_seconds: float, seed: int) -> Row:
    """Play matches of a pairing to their ends.

    Args:
        pairing: The two sides.
        matches: Number of matches, at least 1.
        half_seconds: Playing time of a half, s.
        seed: Seed of the first match.

    Returns:
        Results of all matches.
    """
    division = "B" if pairing.robots <= LARGEST_IN_B else "A"
    task = rsoccer.make_task(
        TASK,
        n_blue=pairing.robots,
        n_yellow=pairing.robots,
        division=division,
        half_seconds=half_seconds,
    )
    begin = time.process_time()
    parts = [
        _play(task, pairing, min(WORLDS, matches - start), seed + start)
        for start in range(0, matches, WORLDS)
    ]
    busy = time.process_time() - begin
    found = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    minutes = found[SECONDS] / 60.0
    rng = np.random.default_rng(seed)

    def a_minute(name: str) -> Interval:
        counted = found[f"blue_{name}"] + found[f"yellow_{name}"]
        return bootstrap_rate([np.stack((counted, minutes), axis=1)], rng)

    score = found["goal_score"]
    return Row(
        pairing,
        matches,
        won=bootstrap_interval([(score > 0.0).astype(np.float64)], rng),
        drawn=float((score == 0.0).mean()),
        goals=a_minute("goals"),
        passes=a_minute("passes"),
        fouls=a_minute("fouls"),
        in_play=float(found["in_play"].sum() / found[SECONDS].sum()),
        speed=float(found[SECONDS].sum() / busy),
    )


def _play(task: Task, pairing: Pairing, worlds: int, seed: int) -> dict[str, Doubles]:
    """Metrics (worlds,) at the end of matches that are played at once, and their durations, s."""
    sides = (f"scripted:{pairing.blue}", f"scripted:{pairing.yellow}")
    matches = rsoccer.Matches(
        task, worlds, seed, controllers=lineup(task, *sides), autoreset="disabled"
    )
    matches.reset()
    nobody = np.zeros((worlds, 0, matches.action_size), np.float32)
    found: dict[str, Doubles] = {}
    step = 0
    while not matches.done.all():
        outcome = matches.step(nobody)
        step += 1
        ended = outcome.ended
        if ended.any():
            now = {**outcome.metrics, SECONDS: np.full(worlds, step * task.config.time_step)}
            for name, values in now.items():
                found.setdefault(name, np.zeros(worlds))[ended] = values[ended]
    return found


def _measured(jobs: Sequence[tuple[Pairing, int, float, int]], processes: int) -> Iterator[Row]:
    """Rows of the arguments of `measure`, in their order, from some processes."""
    if processes == 1:
        yield from starmap(measure, jobs)
        return
    with ProcessPoolExecutor(processes, get_context("spawn")) as pool:
        yield from pool.map(measure, *zip(*jobs, strict=True))


def results() -> str:
    """Return the rows of the last run as a table below a line about them; empty without one."""
    if not FILE.exists():
        return ""
    kept = json.loads(FILE.read_text())
    half = kept["half_seconds"]
    intro = f"Whole matches of `{TASK}` with two halves of {half:g} s; both teams together."
    return f"{intro}\n\n{report([_row(**row) for row in kept['rows']])}\n"


def _row(pairing: dict[str, Any], **values: Any) -> Row:  # noqa: ANN401  (numbers of a file)
    """A row of the result file."""
    of_file: dict[str, Any] = {
        name: Interval(**value) if isinstance(value, dict) else value
        for name, value in values.items()
    }
    return Row(Pairing(**pairing), **of_file)


def report(rows: Sequence[Row]) -> str:
    """Return rows as a Markdown table."""
    matches = ("Robots", "Skill", "Against", "Matches", "Won", "Drawn")
    rates = ("Goals a minute", "Passes a minute", "Fouls a minute", "In play", "Speed")
    return table((*matches, *rates), map(_cells, rows))


def _cells(row: Row) -> tuple[str, ...]:
    pairing = row.pairing
    numbers = (str(pairing.robots), f"{pairing.blue:g}", f"{pairing.yellow:g}", str(row.matches))
    rates = (_text(rate) for rate in (row.goals, row.passes, row.fouls))
    shares = (f"{row.in_play:.0%}", f"{row.speed:.0f} x real time")
    return (*numbers, _text(row.won), f"{row.drawn:.2f}", *rates, *shares)


def _text(interval: Interval) -> str:
    if interval.low is None or interval.high is None:
        return f"{interval.mean:.2f}"
    return f"{interval.mean:.2f} ({interval.low:.2f} to {interval.high:.2f})"


def main(arguments: Sequence[str] | None = None) -> Path:
    """Measure, print a table, write the result file and return its path.

    Args:
        arguments: Command line without the program name; default: that of the process.
    """
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--only", choices=tuple(GROUPS), help="one group of pairings")
    parser.add_argument("--matches", type=int, default=64, help="matches of a pairing")
    parser.add_argument("--half-seconds", type=float, default=300.0, help="time of a half, s")
    parser.add_argument("--seed", type=int, default=0, help="seed of the first match")
    parser.add_argument("--processes", type=int, default=1, help="pairings measured at once")
    parser.add_argument("--out", type=Path, default=FILE, help="result file")
    parser.add_argument("--resume", action="store_true", help="keep the rows of the result file")
    options = parser.parse_args(arguments)
    chosen = [options.only] if options.only else list(GROUPS)
    settings = (options.matches, options.half_seconds, options.seed)
    jobs = [(pairing, *settings) for group in chosen for pairing in GROUPS[group]]
    rows = _kept(options.out, options) if options.resume else []
    known = {row.pairing for row in rows}
    for row in _measured([job for job in jobs if job[0] not in known], options.processes):
        rows.append(row)
        sys.stderr.write(f"{report([row]).splitlines()[-1]}\n")
        _write(options.out, rows, options)
    sys.stdout.write(f"{report(rows)}\n")
    return Path(options.out)


def _kept(path: Path, options: argparse.Namespace) -> list[Row]:
    """Rows of a result file of the same duration, seed and number of matches."""
    if not path.exists():
        return []
    kept = json.loads(path.read_text())
    if (kept["half_seconds"], kept["seed"]) != (options.half_seconds, options.seed):
        return []
    return [_row(**row) for row in kept["rows"] if row["matches"] == options.matches]


def _write(path: Path, rows: Sequence[Row], options: argparse.Namespace) -> None:
    """Write the result file."""
    result = {
        "machine": asdict(this_machine()),
        "half_seconds": options.half_seconds,
        "seed": options.seed,
        "rows": [asdict(row) for row in rows],
    }
    path.parent.mkdir(parents=True, exist_ok=True)
    files.write_atomically(path, (json.dumps(result, indent=1) + "\n").encode())


if __name__ == "__main__":
    main()

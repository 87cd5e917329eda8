"""Speed of the trainer, in three steps as Isaac Lab reports it: `python -m benches.training_speed`.

Decisions a second of single robots in whole teams: of the simulation alone, with observations and
policies, and with learning. Each update has three passes over its batch. Speeds are made of the
least times of single decisions and minibatches, so that other programs on the machine count little.
`--base FOLDER` measures the trainer of another checkout in turn with this one, an update of each
after the other. `--store` renews `benches/results/training_speed.md`, which
`make docs` puts into `docs/speed.md`.
"""

import argparse
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import astuple, dataclass
from pathlib import Path
from statistics import median
from typing import IO, Final

from benches.markdown import table
from benches.result_files import RESULTS, format_number

STORED: Final = RESULTS / "training_speed.md"
ROOT: Final = Path(__file__).parents[1]
WORKER: Final = Path(__file__).with_name("training_worker.py")
TASKS: Final = ("VSSSelfPlay-v0", "VSS-v0")
HEADER: Final = (
    *("task", "threads", "simulation", "+ observations and policies", "+ learning"),
    "processor time per decision",
)
BASE_HEADER: Final = ("speed relative to the base", "processor time relative to the base")


@dataclass(frozen=True)
class Times:
    """Seconds per decision of one update."""

    simulation: float
    rollout: float
    learning: float
    processor: float

    @property
    def total(self) -> float:
        """Seconds of rollout and learning."""
        return self.rollout + self.learning


class Worker:
    """A process with a trainer."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        """Take a process of `training_worker`."""
        self._input, self._output = _pipe(process.stdin), _pipe(process.stdout)

    def update(self) -> Times:
        """Play and learn once."""
        self._input.write("\n")
        self._input.flush()
        return Times(*map(float, self._output.readline().split()))


def _pipe(stream: IO[str] | None) -> IO[str]:
    assert stream is not None, "a pipe was asked for"
    return stream


@contextmanager
def worker(root: Path, task: str, threads: int, worlds: int) -> Iterator[Worker]:
    """Start a trainer of a checkout, and end it.

    Args:
        root: Folder of the checkout.
        task: Name of the task.
        threads: Threads of the run.
        worlds: Matches at once; 0 for the recommended number.
    """
    process = subprocess.Popen(
        [sys.executable, str(WORKER), task, str(threads), str(worlds)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": str(root / "python")},
    )
    with process:
        yield Worker(process)


def measure(
    roots: list[Path], task: str, threads: int, worlds: int, rounds: int
) -> tuple[str, ...]:
    """Measure the trainers of some checkouts in turn, and return the cells of a row.

    Args:
        roots: Folders; the first one is compared with the second one, if there is one.
        task: Name of the task.
        threads: Threads of each run.
        worlds: Matches at once; 0 for the recommended number.
        rounds: Updates of each run after the first one, which is not counted.
    """
    with ExitStack() as stack:
        runs = [stack.enter_context(worker(root, task, threads, worlds)) for root in roots]
        found = [[run.update() for run in runs] for _ in range(rounds + 1)][1:]
    least = [_least([row[index] for row in found]) for index in range(len(roots))]
    own = least[0]
    speeds = [1.0 / seconds for seconds in (own.simulation, own.rollout, own.total)]
    processor = format_number(1e6 * median(row[0].processor for row in found), 2)
    cells = (f"`{task}`", str(threads), *map(format_number, speeds), f"{processor} us")
    if len(roots) == 1:
        return cells
    speed = f"{format_number(least[1].total / own.total, 3)}x"
    return (*cells, speed, _ratio(sorted(row[0].processor / row[1].processor for row in found)))


def _least(times: list[Times]) -> Times:
    """Least seconds of each kind."""
    return Times(*(min(values) for values in zip(*map(astuple, times), strict=True)))


def _ratio(values: list[float]) -> str:
    """Median of sorted ratios, with the least and the greatest."""
    middle, low, high = (format_number(x, 3) for x in (median(values), values[0], values[-1]))
    return f"{middle}x ({low}x to {high}x)"


def main(arguments: list[str] | None = None) -> None:
    """Measure, print and on demand store the table.

    Args:
        arguments: Command line without the program name; default: that of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--base", type=Path, help="folder of a checkout to compare with")
    parser.add_argument("--task", choices=TASKS, action="append", help="default: both")
    parser.add_argument("--threads", type=int, action="append", help="default: 1 and 2")
    parser.add_argument("--rounds", type=int, default=15, help="updates of each run")
    parser.add_argument("--worlds", type=int, default=0, help="matches at once")
    parser.add_argument("--store", action="store_true", help=f"write {STORED.name}")
    options = parser.parse_args(arguments)
    roots = [ROOT] if options.base is None else [ROOT, options.base]
    header = HEADER if options.base is None else (*HEADER, *BASE_HEADER)
    rows = [
        measure(roots, task, threads, options.worlds, options.rounds)
        for task in options.task or TASKS
        for threads in options.threads or (1, 2)
    ]
    text = table(header, rows) + "\n"
    sys.stdout.write(text)
    if options.store:
        STORED.write_text(text)


if __name__ == "__main__":
    main()

"""Speed of the trainer, in three steps as Isaac Lab reports it: `python -m benches.training_speed`.

Decisions a second of single robots in whole teams: of the simulation alone, with observations and
policies, and with learning. Each update has three passes over its batch. Speeds are made of the
least times of single decisions and minibatches, on one thread of those of the processor, so that
other programs on the machine count little.
`--whole` measures whole updates by wall time instead, for each `--device`, and with `--overlap`
also with rollouts that are played meanwhile, in turns: single minibatches say nothing where two
things happen at once.
`--base FOLDER` measures the trainer of another checkout in turn with this one, an update of each
after the other. `--store` renews `benches/results/training_speed.md`, which
`make docs` puts into `docs/speed.md`.
"""

import argparse
import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
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
DEVICES: Final = ("cpu", "cuda")
HEADER: Final = (
    *("task", "threads", "simulation", "+ observations and policies", "+ learning"),
    "processor time per decision",
)
WHOLE_HEADER: Final = (
    *("task", "threads", "device", "overlap", "rollout", "learning or waiting", "update"),
    "decisions per second",
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


@dataclass(frozen=True)
class WholeTimes:
    """Seconds of one update, and its decisions."""

    rollout: float
    learning: float
    update: float
    decisions: float


class Worker:
    """A process with a trainer."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        """Take a process of `training_worker`."""
        self._input, self._output = _pipe(process.stdin), _pipe(process.stdout)

    def update(self) -> Times:
        """Play and learn once."""
        return Times(*self._numbers())

    def whole_update(self) -> WholeTimes:
        """Play and learn once, in a process that measures whole updates."""
        return WholeTimes(*self._numbers())

    def _numbers(self) -> list[float]:
        """Numbers of the next update."""
        self._input.write("\n")
        self._input.flush()
        numbers = [float(number) for number in self._output.readline().split()]
        assert numbers, "the process has ended; its error stands above"
        return numbers


def _pipe(stream: IO[str] | None) -> IO[str]:
    assert stream is not None, "a pipe was asked for"
    return stream


@contextmanager
def worker(
    root: Path, task: str, threads: int, worlds: int, options: tuple[str, ...] = ()
) -> Iterator[Worker]:
    """Start a trainer of a checkout, and end it.

    Args:
        root: Folder of the checkout.
        task: Name of the task.
        threads: Threads of the run.
        worlds: Matches at once; 0 for the recommended number.
        options: Further options of `training_worker`.
    """
    process = subprocess.Popen(
        [sys.executable, str(WORKER), task, str(threads), str(worlds), *options],
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


def measure_whole(
    task: str,
    threads: int,
    worlds: int,
    rounds: int,
    *,
    devices: Sequence[str] = ("cpu",),
    overlap: bool = False,
) -> list[tuple[str, ...]]:
    """Measure whole updates by wall time, in turns, and return a row for each way to learn.

    Args:
        task: Name of the task.
        threads: Threads of each run.
        worlds: Matches at once; 0 for the recommended number.
        rounds: Updates of each run after the first one, which is not counted.
        devices: Devices of the updates.
        overlap: Also with rollouts that are played during the updates.
    """
    ways = [
        (device, overlapped)
        for device in devices
        for overlapped in ((False, True) if overlap else (False,))
    ]
    with ExitStack() as stack:
        runs = []
        for device, overlapped in ways:
            options = ("--whole", "--device", device, *(["--overlap"] if overlapped else []))
            runs.append(stack.enter_context(worker(ROOT, task, threads, worlds, options)))
        found = [[run.whole_update() for run in runs] for _ in range(rounds + 1)][1:]
    rows = []
    for index, (device, overlapped) in enumerate(ways):
        times = [row[index] for row in found]
        middle = [median(values) for values in zip(*map(astuple, times), strict=True)][:3]
        seconds = [f"{format_number(value, 3)} s" for value in middle]
        speed = format_number(median(each.decisions / each.update for each in times))
        name = "yes" if overlapped else "no"
        rows.append((f"`{task}`", str(threads), device, name, *seconds, speed))
    return rows


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
    parser.add_argument("--rounds", type=int, help="updates of each run; default: 15, whole: 8")
    parser.add_argument("--worlds", type=int, default=0, help="matches at once")
    parser.add_argument("--store", action="store_true", help=f"write {STORED.name}")
    parser.add_argument("--whole", action="store_true", help="whole updates by wall time")
    parser.add_argument("--device", choices=DEVICES, action="append", help="default: cpu")
    parser.add_argument("--overlap", action="store_true", help="with and without ppo.overlap")
    options = parser.parse_args(arguments)
    if options.whole and (options.store or options.base is not None):
        parser.error("--whole has no --store and no --base")
    if not options.whole and (options.device or options.overlap):
        parser.error("--device and --overlap need --whole")
    if options.whole:
        _print_whole(options)
        return
    roots = [ROOT] if options.base is None else [ROOT, options.base]
    header = HEADER if options.base is None else (*HEADER, *BASE_HEADER)
    rows = [
        measure(roots, task, threads, options.worlds, options.rounds or 15)
        for task in options.task or TASKS
        for threads in options.threads or (1, 2)
    ]
    text = table(header, rows) + "\n"
    sys.stdout.write(text)
    if options.store:
        STORED.write_text(text)


def _print_whole(options: argparse.Namespace) -> None:
    """Print the table of whole updates."""
    rows = [
        row
        for task in options.task or TASKS
        for threads in options.threads or (1, 2)
        for row in measure_whole(
            task,
            threads,
            options.worlds,
            options.rounds or 8,
            devices=options.device or ("cpu",),
            overlap=options.overlap,
        )
    ]
    sys.stdout.write(table(WHOLE_HEADER, rows) + "\n")


if __name__ == "__main__":
    main()

"""Speed of a step before and after: `python -m benches.comparison COMMIT`.

It builds the package of an earlier commit in `out/comparison`, and steps both versions with the
same actions in turns of some milliseconds: `Matches` of every task with 1, 64 and 512 worlds, the
environments of one world, and `Simulator` in the scenes of `benches.scenarios`. Turns are measured
in processor time, and a ratio is taken of two neighboring ones, so that other load of the machine
affects both versions alike. The extension of the working tree has to be built: `make compare
BEFORE=COMMIT` builds it, and before that `make profiled` as wheels have it.
"""

import argparse
import io
import json
import math
import os
import statistics
import subprocess
import sys
import tarfile
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Final, Self

import rsoccer
from benches.markdown import table
from benches.result_files import ROOT
from benches.scenarios import SCENARIOS

FOLDER: Final = ROOT / "out" / "comparison"
WORKER: Final = Path(__file__).with_name("comparison_worker.py")
WORLDS: Final = (1, 64, 512)
SIMULATOR_WORLDS: Final = 256
"""Number of worlds of a `Simulator`."""
TURN: Final = 0.05  # s
WARM_UP: Final = 20  # turns


@dataclass(frozen=True)
class Case:
    """An interface to a task or a scene with a number of worlds."""

    interface: str
    """`Matches`, `Simulator`, or the name of a function that makes an environment."""
    task: str
    """Name of the task, or of the scene of a `Simulator`."""
    worlds: int
    """Number of worlds."""

    @property
    def title(self) -> str:
        """Title for selection by `--only`."""
        return f"{self.interface}, {self.task}, {self.worlds}"


@dataclass(frozen=True)
class Ratio:
    """Median of independent ratios, with its interval of 95%."""

    median: float
    low: float
    high: float

    @classmethod
    def of(cls, ratios: Sequence[float]) -> Self:
        """Return the median of ratios.

        Its interval is that of the sign test, with the normal approximation of the binomial
        distribution: as wide as the number of ratios demands, whatever their distribution.
        """
        ordered, n = sorted(ratios), len(ratios)
        first = max(0, math.floor(n / 2 - 1.96 * math.sqrt(n) / 2))
        return cls(statistics.median(ordered), ordered[first], ordered[n - 1 - first])


class Stepper:
    """A process that steps one version of the package."""

    def __init__(self, package: Path, case: Case) -> None:
        """Start the process.

        Args:
            package: The folder that contains `rsoccer`.
            case: What to step.
        """
        # The scenes are those of this checkout, for both versions.
        paths = {"PYTHONPATH": f"{package}{os.pathsep}{ROOT}", "PYTHONSAFEPATH": "1"}
        self._process = subprocess.Popen(
            [sys.executable, WORKER, case.interface, case.task, str(case.worlds)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, **paths, "OMP_NUM_THREADS": "1"},
            text=True,
        )
        self.imported = Path(self._answer())
        """File of the package that the process has imported."""

    def seconds(self, steps: int) -> float:
        """Make steps, and return their processor time, s."""
        assert self._process.stdin is not None, "a pipe"
        self._process.stdin.write(f"{steps}\n")
        self._process.stdin.flush()
        return float(self._answer())

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._process.communicate()

    def _answer(self) -> Any:  # noqa: ANN401  (JSON)
        assert self._process.stdout is not None, "a pipe"
        line = self._process.stdout.readline()
        if not line:
            self._process.communicate()
            raise RuntimeError(f"a process ended with status {self._process.returncode}")
        return json.loads(line)


def main(arguments: list[str] | None = None) -> None:
    """Build the earlier version, compare, and print a table.

    Args:
        arguments: Command line without the program name; default: that of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("commit", help="the version before: a commit, a tag or a branch")
    only = "compare only cases with this text in their title, such as VSS-v0, env or 512"
    parser.add_argument("--only", metavar="TEXT", default="", help=only)
    parser.add_argument("--rounds", type=int, default=100, help="number of pairs of turns")
    options = parser.parse_args(arguments)
    if options.rounds < 1:
        parser.error(f"rounds must be above 0, got {options.rounds}")
    before, now = built(options.commit) / "python", ROOT / "python"
    selected = [case for case in cases(before) if options.only in case.title]
    if not selected:
        sys.exit(f"no case of both versions has {options.only!r} in its title")
    rows = []
    for case in selected:
        sys.stderr.write(f"{case.title}\n")
        rows.append(row(case, *compare(before, now, case, options.rounds)))
    header = (
        "interface",
        "task or scene",
        "worlds",
        "before, us",
        "now, us",
        "speed, now / before",
    )
    sys.stdout.write(table(header, rows) + "\n")


def built(commit: str) -> Path:
    """Return the folder of an earlier version with its extension, which it builds if necessary.

    Args:
        commit: Name of the version for git.
    """
    command = ["git", "rev-parse", "--verify", "--short", f"{commit}^{{commit}}"]
    named = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if named.returncode:
        sys.exit(f"expected a commit, got {commit!r}: {named.stderr.strip()}")
    folder = FOLDER / named.stdout.strip()
    if not list(folder.glob("python/rsoccer/_core*.so")):
        command = ["git", "archive", commit]
        files = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, check=True).stdout
        with tarfile.open(fileobj=io.BytesIO(files)) as archive:
            archive.extractall(folder, filter="data")
        maturin = str(Path(sys.executable).with_name("maturin"))
        command = [maturin, "develop", "--release", "--skip-install"]
        environment = {**os.environ, "VIRTUAL_ENV": sys.prefix}
        subprocess.run(command, cwd=folder, env=environment, stdout=sys.stderr, check=True)
    return folder


def cases(before: Path) -> Iterator[Case]:
    """Yield the cases that both versions have.

    Args:
        before: The folder that contains the earlier `rsoccer`.
    """
    command = [sys.executable, "-c", "import rsoccer; print(*rsoccer.list_tasks())"]
    environment = {**os.environ, "PYTHONPATH": str(before)}
    ran = subprocess.run(command, env=environment, stdout=subprocess.PIPE, text=True, check=True)
    known = set(ran.stdout.split())
    for task in (task for task in rsoccer.list_tasks() if task in known):
        for worlds in WORLDS:
            yield Case("Matches", task, worlds)
        one = len(rsoccer.make_task(task).agents) == 1
        for interface in ("single_env",) if one else ("parallel_env", "env"):
            yield Case(interface, task, 1)
    for scenario in SCENARIOS:
        yield Case("Simulator", scenario.name, SIMULATOR_WORLDS)


def compare(before: Path, now: Path, case: Case, rounds: int) -> tuple[list[float], list[float]]:
    """Return the times of a step in each round, s: before, and now.

    Args:
        before: The folder that contains the earlier `rsoccer`.
        now: The folder that contains the present one.
        case: What to step.
        rounds: Number of pairs of turns.
    """
    times: tuple[list[float], list[float]] = ([], [])
    with ExitStack() as stack:
        steppers = [stack.enter_context(Stepper(package, case)) for package in (before, now)]
        steps = max(1, round(TURN / steppers[0].seconds(1)))
        for turn in range(-WARM_UP, rounds):
            pair = list(zip(times, steppers, strict=True))
            for kept, stepper in reversed(pair) if turn % 2 else pair:
                seconds = stepper.seconds(steps) / steps
                if turn >= 0:
                    kept.append(seconds)
    return times


def row(case: Case, before: Sequence[float], now: Sequence[float]) -> tuple[str, ...]:
    """Return the cells of a case, from its times of a step before and now, s."""
    ratio = Ratio.of([a / b for a, b in zip(before, now, strict=True)])
    cells = (f"{statistics.median(times) * 1e6:,.4g}" for times in (before, now))
    speed = f"{ratio.median:.3f} ({ratio.low:.3f} to {ratio.high:.3f})"
    return (case.interface, case.task, f"{case.worlds}", *cells, speed)


if __name__ == "__main__":
    main()

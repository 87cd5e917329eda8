"""Tables of measured figures: one CSV file per machine, with machine and build in each row."""

import csv
import datetime
import platform
import re
import subprocess
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

from rsoccer._core import build_info
from rsoccer.evaluate.schedule import processors

ROOT = Path(__file__).parent.parent
RESULTS = ROOT / "benches" / "results"
WRITTEN = (":!benches/results", ":!docs", ":!README.md")
"""Files that benchmarks and reports write: a change of them is none of the code."""


@dataclass(frozen=True)
class Figure:
    """Measured values of one quantity of one variant."""

    group: str
    """Group of benchmarks: core, threads, scaling, batched, single, libraries, training, memory,
    capacity, startup, rust or pace."""
    scenario: str
    """Physics scenario or id of a task."""
    variant: str
    """Name of the variant; for a ratio, numerator / denominator."""
    engine: str
    """Contact engine; empty for third-party simulators and no-op environments. For a ratio of two
    engines, numerator / denominator."""
    worlds: int
    threads: int
    quantity: str
    unit: str
    median: float
    minimum: float
    maximum: float
    rounds: int


@dataclass(frozen=True)
class Machine:
    """Machine, date and build, the same in every row."""

    machine: str
    cores: int
    date: str
    commit: str
    version: str
    profile: str


def this_machine() -> Machine:
    """Return this machine, today's date and the installed build."""
    build = build_info()
    return Machine(
        machine=_processor(),
        cores=processors(),
        date=datetime.datetime.now(datetime.UTC).date().isoformat(),
        commit=_commit(),
        version=str(build["version"]),
        profile=str(build["profile"]),
    )


def store(figures: Iterable[Figure], machine: Machine, folder: Path) -> Path:
    """Write the table of a machine, replacing an older one, and return its path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{file_name(machine)}.csv"
    rows = [{**_rounded(figure), **asdict(machine)} for figure in figures]
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return path


def file_name(machine: Machine) -> str:
    """Return the file name of a machine's table, without suffix."""
    name = re.sub(r"[^a-z0-9]+", "-", f"{machine.machine} {machine.cores} cores".lower())
    return name.strip("-")


def load(path: Path) -> tuple[Machine, list[Figure]]:
    """Read a table written by `store`.

    Raises:
        ValueError: The file has no rows.
    """
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise ValueError(f"expected at least one row in {path}, got none")
    first = rows[0]
    machine = Machine(
        **{name: first[name] for name in ("machine", "date", "commit", "version", "profile")},
        cores=int(first["cores"]),
    )
    return machine, [_parsed(row) for row in rows]


def format_number(value: float, digits: int = 3) -> str:
    """Format a number with the digits that repeat between runs."""
    if float(f"{value:.{digits}g}") >= 10**digits:
        return f"{float(f'{value:.{digits}g}'):,.0f}"
    return f"{value:.{digits}g}"


def format_ratio(ratio: float) -> str:
    """Format a ratio, such as 1.99x."""
    return f"{format_number(ratio, 2 if 10 <= ratio < 100 else 3)}x"


def _rounded(figure: Figure) -> dict[str, object]:
    """Return the fields of a row with numbers rounded to four digits."""
    values = asdict(figure).items()
    return {name: float(f"{x:.4g}") if isinstance(x, float) else x for name, x in values}


def _parsed(row: dict[str, str]) -> Figure:
    kinds = Figure.__annotations__
    return Figure(**{name: kind(row[name]) for name, kind in kinds.items()})


def _processor() -> str:
    """Return the model name of the processor if the system has it."""
    info = Path("/proc/cpuinfo")
    if info.exists() and (found := re.search(r"model name\s*:\s*(.+)", info.read_text())):
        return found[1]
    return platform.processor() or platform.machine()


def _commit() -> str:
    """Return the short commit id, marked if the code has changed since; "unknown" outside git."""
    commit = _git("rev-parse", "--short", "HEAD")
    changed = _git("status", "--porcelain", "--untracked-files=no", "--", ".", *WRITTEN)
    return f"{commit}-dirty" if commit and changed else commit or "unknown"


def _git(*arguments: str) -> str:
    ran = subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False)
    return ran.stdout.strip()

"""Tables of measured figures: one CSV file a machine, each row with how it came about."""

import csv
import datetime
import os
import platform
import re
import subprocess
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

from rsoccer._core import build_info

ROOT = Path(__file__).parent.parent
RESULTS = ROOT / "benches" / "results"


@dataclass(frozen=True)
class Figure:
    """What was measured of one thing."""

    group: str
    """What it belongs to: core, threads, growth, many, one, training, memory, hosting, start or
    rust."""
    game: str
    """What was played: a scene, or a task."""
    who: str
    """By whom; a ratio is of the first by the second."""
    worlds: int
    threads: int
    quantity: str
    unit: str
    median: float
    least: float
    most: float
    rounds: int


@dataclass(frozen=True)
class Machine:
    """Where, when and of what build: the same in every row."""

    machine: str
    cores: int
    date: str
    commit: str
    version: str
    profile: str


def this_machine() -> Machine:
    """The machine and build at hand."""
    build = build_info()
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return Machine(
        machine=_processor(),
        cores=cores or 1,
        date=datetime.datetime.now(datetime.UTC).date().isoformat(),
        commit=_commit(),
        version=str(build["version"]),
        profile=str(build["profile"]),
    )


def store(figures: Iterable[Figure], machine: Machine, folder: Path) -> Path:
    """Write the table of this machine, in place of an older one; its path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{file_name(machine)}.csv"
    rows = [{**_rounded(figure), **asdict(machine)} for figure in figures]
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return path


def file_name(machine: Machine) -> str:
    """The machine as part of a path."""
    name = re.sub(r"[^a-z0-9]+", "-", f"{machine.machine} {machine.cores} cores".lower())
    return name.strip("-")


def load(path: Path) -> tuple[Machine, list[Figure]]:
    """What `store` wrote."""
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise ValueError(f"{path} holds no figures")
    first = rows[0]
    machine = Machine(
        **{name: first[name] for name in ("machine", "date", "commit", "version", "profile")},
        cores=int(first["cores"]),
    )
    return machine, [_parsed(row) for row in rows]


def digits(value: float, most: int = 3) -> str:
    """A number with no more digits than repeat."""
    if float(f"{value:.{most}g}") >= 10**most:
        return f"{float(f'{value:.{most}g}'):,.0f}"
    return f"{value:.{most}g}"


def times(ratio: float) -> str:
    """A ratio for people."""
    return f"{digits(ratio, 2 if 10 <= ratio < 100 else 3)}x"


def _rounded(figure: Figure) -> dict[str, object]:
    """Fields of a row; four digits are more than repeat."""
    values = asdict(figure).items()
    return {name: float(f"{x:.4g}") if isinstance(x, float) else x for name, x in values}


def _parsed(row: dict[str, str]) -> Figure:
    kinds = Figure.__annotations__
    return Figure(**{name: kind(row[name]) for name, kind in kinds.items()})


def _processor() -> str:
    """The processor's own name, where the system tells."""
    info = Path("/proc/cpuinfo")
    if info.exists() and (found := re.search(r"model name\s*:\s*(.+)", info.read_text())):
        return found[1]
    return platform.processor() or platform.machine()


def _commit() -> str:
    """Short id of the commit; marked where the tree differs from it, "unknown" outside git."""
    told = subprocess.run(
        ["git", "describe", "--always", "--dirty", "--exclude", "*"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    return told.stdout.strip() or "unknown"

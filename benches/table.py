"""Tables of measured figures: one CSV file a machine, each row with how it came about."""

import csv
import datetime
import json
import os
import platform
import re
import subprocess
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from rsoccer._core import build_info

ROOT = Path(__file__).parent.parent
RESULTS = ROOT / "benches" / "results"
CRITERION = ROOT / "target" / "criterion"  # where `cargo bench` leaves what it measured


@dataclass(frozen=True)
class Figure:
    """What was measured of one case."""

    name: str
    worlds: int
    threads: int
    unit: str
    median: float
    slowest: float
    fastest: float
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
    name = re.sub(r"[^a-z0-9]+", "-", f"{machine.machine} {machine.cores} cores".lower())
    path = folder / f"{name.strip('-')}.csv"
    rows = [{**_rounded(figure), **asdict(machine)} for figure in figures]
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    return path


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


def physics_alone(folder: Path = CRITERION) -> Iterator[Figure]:
    """Figures that the last `cargo bench` left; none if it has not run."""
    for path in sorted(folder.glob("**/new/benchmark.json")):
        case = json.loads(path.read_text())
        if case["throughput"] is None:
            continue  # not of steps
        median = json.loads((path.parent / "estimates.json").read_text())["median"]
        within = median["confidence_interval"]
        steps = 1e9 * case["throughput"]["Elements"]  # times are in nanoseconds
        worlds, threads = case["value_str"].split("x")
        yield Figure(
            name=f"core_{case['group_id'].removesuffix('_step')}_{case['function_id']}",
            worlds=int(worlds),
            threads=int(threads),
            unit="world-steps/s",
            median=steps / median["point_estimate"],
            slowest=steps / within["upper_bound"],
            fastest=steps / within["lower_bound"],
            rounds=1,
        )


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

"""Memory per world, capacity and start-up time, each measured in a fresh process."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Final

from benches.measuring import SPEED, Measure, Quantity, UnavailableError, Values
from benches.result_files import ROOT
from benches.scenarios import Scenario

MEMORY: Final = Quantity("memory", "KiB per world")
PROCESS_MEMORY: Final = Quantity("process memory", "GiB")
BUILD_TIME: Final = Quantity("build time", "s")
BYTES_PER_WORLD: Final = 40 * 1024  # upper bound, with a world's share of the process
LIMITS: Final = (  # memory limit of a container, cgroup v1 and v2: bytes, or "max"
    "sys/fs/cgroup/memory/memory.limit_in_bytes",
    "sys/fs/cgroup/memory.max",
)
STARTUP: Final = {
    "import": Quantity("import of rsoccer after gymnasium and pettingzoo", "s"),
    "libraries": Quantity("import of gymnasium and pettingzoo", "s"),
    "reset": Quantity("first environment and reset", "s"),
    "build": Quantity("construction of 4,096 matches", "s"),
    "begin": Quantity("first reset of 4,096 matches", "s"),
}


def memory(scenario: Scenario, worlds: int) -> Measure:
    """Return a measure of the memory of a world that has had contacts."""

    def measure(seconds: float) -> Values:
        if not seconds:  # a warm-up has no effect on the next process
            return {}
        results = run_probe("memory", *described(scenario), str(worlds))
        return {MEMORY: results["bytes"] / 1024}

    return measure


def capacity(scenario: Scenario, worlds: int, threads: int) -> Measure:
    """Return a measure of speed, memory and build time of a very large batch.

    Raises:
        UnavailableError: Free memory is too small for that many worlds.
    """
    if (free := free_memory()) < worlds * BYTES_PER_WORLD:
        needed = f"{worlds:,} worlds need {worlds * BYTES_PER_WORLD / 2**30:.1f} GiB of memory"
        raise UnavailableError(f"{needed}, {free / 2**30:.1f} GiB are free")

    def measure(seconds: float) -> Values:
        if not seconds:  # a warm-up has no effect on the next process
            return {}
        results = run_probe("capacity", *described(scenario), str(worlds), str(threads))
        gib = results["bytes"] / 2**30
        return {SPEED: results["speed"], PROCESS_MEMORY: gib, BUILD_TIME: results["build"]}

    return measure


def described(scenario: Scenario) -> tuple[str, str, str]:
    """Return engine, field and robots per team as arguments of the process."""
    return scenario.engine, scenario.field, str(scenario.robots)


def free_memory(system: Path = Path("/")) -> int:
    """Return the memory available to processes, bytes; total memory if the system does not say."""
    meminfo = system / "proc/meminfo"
    if not meminfo.exists():
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    rows = dict(line.split(":") for line in meminfo.read_text().splitlines())
    free = 1024 * int(rows["MemAvailable"].split()[0])
    limits = [(system / file).read_text() for file in LIMITS if (system / file).exists()]
    return min([free, *(int(limit) for limit in limits if limit.strip().isdigit())])


def startup(seconds: float) -> Values:
    """Measure the time of imports, first environment and first reset."""
    del seconds  # the duration is fixed
    results = run_probe("startup")
    return {quantity: results[name] for name, quantity in STARTUP.items()}


def run_probe(*arguments: str) -> dict[str, float]:
    """Run `benches.process_probe` in a fresh process and return its results.

    Raises:
        RuntimeError: The process failed; the message has its error output.
    """
    command = [sys.executable, "-m", "benches.process_probe", *arguments]
    ran = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if ran.returncode:
        raise RuntimeError(f"{' '.join(command)} failed ({ran.returncode}):\n{ran.stderr}")
    results: dict[str, float] = json.loads(ran.stdout)
    return results

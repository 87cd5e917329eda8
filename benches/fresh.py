"""Figures of fresh processes: memory, very many worlds, and how soon one can play."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Final

from benches.games import Game
from benches.measuring import SPEED, LeftOut, Measure, Quantity, Values
from benches.table import ROOT

MEMORY: Final = Quantity("memory", "KiB a world")
HOSTED: Final = Quantity("memory of the process", "GiB")
BUILT: Final = Quantity("worlds built", "s")
ROOM: Final = 40 * 1024  # bytes that a world takes at most, with its share of the process
LIMITS: Final = (  # what a container may take, by old kernels and by new: bytes, or "max"
    "sys/fs/cgroup/memory/memory.limit_in_bytes",
    "sys/fs/cgroup/memory.max",
)
START: Final = {
    "import": Quantity("import beyond gymnasium and pettingzoo", "s"),
    "libraries": Quantity("import of gymnasium and pettingzoo", "s"),
    "reset": Quantity("first env and reset", "s"),
    "build": Quantity("4,096 matches built", "s"),
    "begin": Quantity("their first reset", "s"),
}


def memory(game: Game, worlds: int) -> Measure:
    """Memory of a world that has seen contacts."""

    def measure(seconds: float) -> Values:
        del seconds  # takes what it takes
        told = probe("memory", game.field, str(game.robots), str(worlds))
        return {MEMORY: told["bytes"] / 1024}

    return measure


def hosting(game: Game, worlds: int, threads: int) -> Measure:
    """Very many worlds in one process; left out where memory is short."""
    if (free := free_memory()) < worlds * ROOM:
        needed = f"{worlds:,} worlds need {worlds * ROOM / 2**30:.1f} GiB of memory"
        raise LeftOut(f"{needed}, {free / 2**30:.1f} GiB are free")

    def measure(seconds: float) -> Values:
        if not seconds:  # nothing of it would be warm in the next process
            return {}
        words = ("hosting", game.field, str(game.robots), str(worlds), str(threads))
        told = probe(*words)
        return {SPEED: told["speed"], HOSTED: told["bytes"] / 2**30, BUILT: told["build"]}

    return measure


def free_memory(system: Path = Path("/")) -> int:
    """Bytes that processes may still take; where the system does not say, all that there are."""
    meminfo = system / "proc/meminfo"
    if not meminfo.exists():
        return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    rows = dict(line.split(":") for line in meminfo.read_text().splitlines())
    free = 1024 * int(rows["MemAvailable"].split()[0])
    limits = [(system / file).read_text() for file in LIMITS if (system / file).exists()]
    return min([free, *(int(limit) for limit in limits if limit.strip().isdigit())])


def start(seconds: float) -> Values:
    """How soon one can play."""
    del seconds
    told = probe("start")
    return {quantity: told[name] for name, quantity in START.items()}


def probe(*words: str) -> dict[str, float]:
    """What a fresh process measures."""
    command = [sys.executable, "-m", "benches.probe", *words]
    ran = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if ran.returncode:
        raise RuntimeError(f"{' '.join(command)} failed ({ran.returncode}):\n{ran.stderr}")
    told: dict[str, float] = json.loads(ran.stdout)
    return told

"""Figures of fresh processes: memory, and how soon one can play."""

import json
import subprocess
import sys
from typing import Final

from benches.games import Game
from benches.measuring import Measure, Quantity, Values
from benches.table import ROOT

MEMORY: Final = Quantity("memory", "KiB a world")
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
        raise RuntimeError(f"{' '.join(command)} failed:\n{ran.stderr}")
    told: dict[str, float] = json.loads(ran.stdout)
    return told

"""What a second thread brings, and what this machine lets it bring at most."""

import hashlib
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Final

from benches.games import Game
from benches.measuring import SPEED, Measure, Quantity, Values
from benches.simulators import Ours, bout

HASHING: Final = Quantity("speed", "blocks/s")
BLOCK: Final = bytes(1 << 16)  # 64 KiB, at home in the innermost caches; hashing lets go of the GIL
TIMED: Final = range(30, 40)  # steps of an episode: few, of many worlds; by then things touch


def stepping(game: Game, worlds: int, threads: int) -> Measure:
    """One simulator that shares its worlds out itself."""
    return bout(game, lambda: Ours(game, worlds, threads), worlds, timed=TIMED)


def side_by_side(game: Game, worlds: int, threads: int) -> Measure:
    """As many simulators as threads, each with its share of the worlds and nobody to wait for."""
    share = worlds // threads
    bouts = [bout(game, lambda: Ours(game, share), share, timed=TIMED) for _ in range(threads)]

    def measure(seconds: float) -> Values:
        values: list[Values] = []

        def add(one: Measure) -> None:
            values.append(one(seconds))

        together([partial(add, one) for one in bouts])
        return {SPEED: sum(value[SPEED] for value in values)} if seconds else {}

    return measure


def hashing(threads: int) -> Measure:
    """Pure computing that shares nothing."""

    def measure(seconds: float) -> Values:
        made = [0] * threads
        end = time.perf_counter() + seconds

        def hash_on(thread: int) -> None:
            while not made[thread] or time.perf_counter() < end:
                hashlib.sha256(BLOCK).digest()
                made[thread] += 1

        together([partial(hash_on, n) for n in range(threads)])
        return {HASHING: sum(made) / seconds} if seconds else {}

    return measure


def together(works: list[Callable[[], object]]) -> None:
    """Do all at once, a thread each."""
    threads = [threading.Thread(target=work) for work in works]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()

"""Speed-up by a second thread, and upper bounds of that speed-up on this machine."""

import hashlib
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import Final

from benches.measuring import SPEED, Measure, Quantity, Values
from benches.scenarios import Scenario
from benches.simulators import SimulatorAdapter, timed_episodes

HASHING: Final = Quantity("speed", "blocks/s")
BLOCK: Final = bytes(1 << 16)  # 64 KiB fit into the inner caches; hashing releases the GIL
TIMED: Final = range(30, 40)  # steps of an episode: few, as batches are large; contacts exist then


def one_simulator(scenario: Scenario, worlds: int, threads: int) -> Measure:
    """Return a measure of one simulator that distributes its worlds over threads."""
    return timed_episodes(
        scenario, lambda: SimulatorAdapter(scenario, worlds, threads), worlds, timed=TIMED
    )


def separate_simulators(scenario: Scenario, worlds: int, threads: int) -> Measure:
    """Return a measure of one simulator per thread, without synchronization between them."""
    share = worlds // threads
    measures = [
        timed_episodes(scenario, lambda: SimulatorAdapter(scenario, share), share, timed=TIMED)
        for _ in range(threads)
    ]

    def measure(seconds: float) -> Values:
        values: list[Values] = []

        def add(one: Measure) -> None:
            values.append(one(seconds))

        run_in_parallel([partial(add, one) for one in measures])
        return {SPEED: sum(value[SPEED] for value in values)} if seconds else {}

    return measure


def hashing(threads: int) -> Measure:
    """Return a measure of hashing, which shares no memory between threads."""

    def measure(seconds: float) -> Values:
        hashed = [0] * threads
        end = time.perf_counter() + seconds

        def hash_blocks(thread: int) -> None:
            while not hashed[thread] or time.perf_counter() < end:
                hashlib.sha256(BLOCK).digest()
                hashed[thread] += 1

        run_in_parallel([partial(hash_blocks, n) for n in range(threads)])
        return {HASHING: sum(hashed) / seconds} if seconds else {}

    return measure


def run_in_parallel(functions: list[Callable[[], object]]) -> None:
    """Run each function in a thread of its own and wait for all."""
    threads = [threading.Thread(target=function) for function in functions]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()

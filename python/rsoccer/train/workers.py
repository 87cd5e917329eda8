"""Threads that share the parts of a computation, with results that do not depend on their number.

NumPy, torch and the simulator leave the interpreter to other threads while they compute, so
threads of Python keep all cores busy. Each job writes to a place of its own, and sums over jobs are
taken in their order afterwards. Who does which job therefore changes no bit.
"""

from __future__ import annotations

import itertools
from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import torch

Job = Callable[[int], None]
"""A part of a computation; its argument is the index of the thread that does it."""


class Workers:
    """Threads for jobs; the calling thread is one of them.

    Attributes:
        threads: number of threads, at least 1.
    """

    def __init__(self, threads: int, torch_threads: int = 1) -> None:
        """Start without jobs; threads begin with the first ones.

        Args:
            threads: number of threads, at least 1.
            torch_threads: threads of each operation of torch.
        """
        self.threads = threads
        self._executor: ThreadPoolExecutor | None = None
        if threads > 1:
            self._executor = ThreadPoolExecutor(
                threads - 1, "workers", torch.set_num_threads, (torch_threads,)
            )

    def run(self, jobs: Sequence[Job]) -> None:
        """Do jobs and wait for all of them.

        Args:
            jobs: the jobs, which may run at the same time.

        Raises:
            Exception: that of a job; others may have been left out then.
        """
        left = deque(jobs)
        helpers = min(self.threads, len(jobs)) - 1
        if self._executor is None or helpers < 1:
            _work(left, 0)
            return
        futures = [self._executor.submit(_work, left, index + 1) for index in range(helpers)]
        try:
            _work(left, 0)
        finally:
            left.clear()
            # A thread that has not begun has no job left. On a busy machine it may wake late.
            errors = [future.exception() for future in futures if not future.cancel()]
        for error in filter(None, errors):
            raise error


def _work(left: deque[Job], thread: int) -> None:
    """Do jobs until none is left."""
    while True:
        try:
            job = left.popleft()
        except IndexError:
            return
        job(thread)


def shards(rows: int, largest: int, alone: int | None = None) -> list[slice]:
    """Return consecutive parts of some rows, nearly equal and an even number of them.

    Two threads have the same work with an even number. The parts depend on the number of rows
    alone.

    Args:
        rows: number of rows.
        largest: greatest number of rows in a part, unless one part has all of them.
        alone: greatest number of rows in an only part; None for the same.

    Example:
        >>> [(part.start, part.stop) for part in shards(5, 2)]
        [(0, 1), (1, 2), (2, 3), (3, 5)]
        >>> len(shards(4, 4))
        1
    """
    alone = largest if alone is None else alone
    count = 1 if rows <= alone else 2 * -(-rows // (2 * largest))
    bounds = [rows * index // count for index in range(count + 1)]
    return [slice(*pair) for pair in itertools.pairwise(bounds)]

"""Runs of a study in processes of their own, one on each core."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Final

from benches.learning.experiments import Run
from rsoccer.train.run.stop_signal import StopSignal

POLL: Final = 0.2  # s
BUSY: Final = 75
"""Exit status of a process whose run another process works on."""
THREAD_VARIABLES: Final = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")

Command = Callable[[Run, int | None], list[str]]
"""Command line of the process for a run, on a core."""


Slot = int | str
"""Place for a process: the number of a processor, or a name."""


@dataclass
class _Job:
    """Process that works on a run."""

    run: Run
    process: subprocess.Popen[bytes]
    began: float
    asked: bool = False

    def ask_to_stop(self) -> None:
        """Send SIGTERM, once: the trainer then saves its checkpoint and ends."""
        if not self.asked:
            self.process.terminate()
            self.asked = True


@dataclass
class Pool:
    """Processes that work on runs."""

    jobs: int
    """Processes at once, at least 1."""
    command: Command
    deadline: float = float("inf")
    """Time of `time.monotonic` after which no run starts."""
    log: Callable[[str], object] = field(default_factory=lambda: sys.stdout.write)
    failed: list[str] = field(default_factory=list)
    """Keys of the runs whose process failed."""

    def work(self, runs: Sequence[Run], done: set[str]) -> None:
        """Work on runs until all are done, the deadline has passed, or a signal comes.

        Args:
            runs: The runs in their order; one that needs others waits for them.
            done: Keys of finished runs; grows.
        """
        left, slots = list(runs), _slots(self.jobs)
        active: dict[Slot, _Job] = {}
        with StopSignal() as stop:
            while True:
                self._collect(active, done)
                if stop.signal is None and time.monotonic() < self.deadline:
                    self._fill(slots, left, active, done)
                if not active:
                    break
                if stop.signal is not None:
                    for job in active.values():
                        job.ask_to_stop()
                time.sleep(POLL)
        if stop.signal is not None or (left and time.monotonic() >= self.deadline):
            ended = f"{stop.name}: " if stop.signal is not None else ""
            self.log(f"{ended}{len(left)} runs not started; the same command continues\n")
            return
        for run in left:
            missing = ", ".join(need.key for need in run.needs if need.key not in done)
            self.log(f"not started: {run.key} needs {missing}\n")

    def _fill(
        self, slots: list[Slot], left: list[Run], active: dict[Slot, _Job], done: set[str]
    ) -> None:
        """Start runs that are ready on the free slots."""
        for slot in slots:
            run = next((run for run in left if done >= {need.key for need in run.needs}), None)
            if slot in active or run is None:
                continue
            left.remove(run)
            core = slot if isinstance(slot, int) else None
            self.log(f"{time.strftime('%H:%M:%S')} start {run.key}\n")
            environment = {**os.environ, **dict.fromkeys(THREAD_VARIABLES, "1")}
            # In a session of its own: Ctrl-C reaches it once, as SIGTERM from here.
            process = subprocess.Popen(
                self.command(run, core), env=environment, start_new_session=True
            )
            active[slot] = _Job(run, process, time.monotonic())

    def _collect(self, active: dict[Slot, _Job], done: set[str]) -> None:
        """Remove the processes that have ended."""
        for slot, job in list(active.items()):
            status = job.process.poll()
            if status is None:
                continue
            del active[slot]
            key, minutes = job.run.key, (time.monotonic() - job.began) / 60.0
            if status == 0:
                done.add(key)
            elif not job.asked and status != BUSY:
                self.failed.append(key)
            words = {0: "done ", BUSY: "taken"}.get(status, f"exit status {status}")
            words = "saved" if job.asked and status else words
            self.log(f"{time.strftime('%H:%M:%S')} {words} {key} ({minutes:.1f} min)\n")


def _slots(jobs: int) -> list[Slot]:
    """Places for processes: the processors if there are as many, else names.

    Fewer processes are not bound to processors: another program may bind its own to the same ones.
    """
    if hasattr(os, "sched_getaffinity"):
        available = sorted(os.sched_getaffinity(0))
        if jobs == len(available):
            return list(available)
    return [f"job {index}" for index in range(jobs)]

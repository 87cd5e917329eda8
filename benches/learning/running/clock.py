"""Time that the learning of a run took over several attempts."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from rsoccer.files import write_atomically

TIME_FILE: Final = "time.json"
TIME_INTERVAL: Final = 5.0
"""Time between two writings of the time of a run, s: what a run that is killed may lose."""


@contextmanager
def timed(folder: Path) -> Iterator[dict[str, float]]:
    """Add the time within the block to that of earlier attempts.

    A thread writes it every few seconds, so that a process that is killed leaves it, too.

    Yields:
        Seconds before this attempt: `wall`, `cpu` and the number of `attempts`.
    """
    before = spent(folder)
    wall, cpu = time.monotonic(), time.process_time()
    ended = threading.Event()

    def write() -> None:
        after = {
            "wall": before["wall"] + time.monotonic() - wall,
            "cpu": before["cpu"] + time.process_time() - cpu,
            "attempts": before["attempts"] + 1,
        }
        write_atomically(folder / TIME_FILE, (json.dumps(after) + "\n").encode())

    def write_until_ended() -> None:
        while not ended.wait(TIME_INTERVAL):
            write()

    writer = threading.Thread(target=write_until_ended, daemon=True)
    writer.start()
    try:
        yield before
    finally:
        ended.set()
        writer.join()
        write()


def restart_clock(folder: Path) -> None:
    """Forget the time of earlier attempts, as the run starts again."""
    (folder / TIME_FILE).unlink(missing_ok=True)


def spent(folder: Path) -> dict[str, float]:
    """Return the seconds that the attempts of a run took so far."""
    path = folder / TIME_FILE
    if not path.is_file():
        return {"wall": 0.0, "cpu": 0.0, "attempts": 0}
    seconds: dict[str, float] = json.loads(path.read_text())
    return seconds

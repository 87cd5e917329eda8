"""Signals: the run saves a checkpoint, reports it and ends; it can be resumed."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from rsoccer.train import train
from rsoccer.train.run import checkpoint
from rsoccer.train.run.stop_signal import SIGNALS, Stopped, StopSignal
from tests.train.short_task import tiny

SCRIPT = """
import sys
from pathlib import Path
from rsoccer.train import train
from tests.train.short_task import register_all, tiny
register_all()
overlap = sys.argv[2] == "True"
train(tiny(Path(sys.argv[1]), samples=10**9, checkpoint_interval=999.0, overlap=overlap))
"""


def wait_for(condition: object, seconds: float = 60.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():  # type: ignore[operator]
        assert time.monotonic() < deadline, "timeout"
        time.sleep(0.02)


def lines(path: Path) -> int:
    return path.read_bytes().count(b"\n")


@pytest.mark.parametrize(
    ("number", "overlap"),
    [(signal.SIGINT, False), (signal.SIGTERM, False), (signal.SIGINT, True)],
)
def test_a_run_that_a_signal_ended_can_be_resumed(
    number: signal.Signals, overlap: bool, tmp_path: Path
) -> None:
    arguments = [str(tmp_path), str(overlap)]
    process = subprocess.Popen(
        [sys.executable, "-c", SCRIPT, *arguments], stderr=subprocess.PIPE, text=True
    )
    log = tmp_path / "progress.csv"
    # The second row comes after the first update is captured.
    wait_for(lambda: process.poll() is not None or (log.exists() and lines(log) > 2))
    process.send_signal(number)
    _, errors = process.communicate(timeout=120)  # the run itself would take hours
    assert process.returncode == 128 + number
    assert f"{number.name}: saved after" in errors and "--resume" in errors
    assert "Traceback" not in errors
    saved = checkpoint.load(tmp_path / checkpoint.FILE_NAME)
    assert saved.info["samples"] > 0
    target = saved.info["samples"] + 144
    train(tiny(tmp_path, samples=target, resume=True, overlap=overlap))
    resumed = checkpoint.load(tmp_path / checkpoint.FILE_NAME)
    assert resumed.info["samples"] == target


def test_the_first_signal_sets_a_flag_and_the_second_acts_as_usual() -> None:
    def handler(number: int, frame: object) -> None:
        raise KeyboardInterrupt

    previous = signal.signal(signal.SIGINT, handler)
    try:
        with StopSignal() as stop:
            stop.check()
            os.kill(os.getpid(), signal.SIGINT)
            assert (stop.name, stop.exit_status) == ("SIGINT", 130)
            with pytest.raises(Stopped):
                stop.check()
            with pytest.raises(KeyboardInterrupt):
                os.kill(os.getpid(), signal.SIGINT)
        assert signal.getsignal(signal.SIGINT) is handler
    finally:
        signal.signal(signal.SIGINT, previous)


def test_without_a_signal_the_handlers_are_restored_at_the_end() -> None:
    previous = [signal.getsignal(number) for number in SIGNALS]
    with StopSignal() as stop:
        assert all(signal.getsignal(number) not in previous for number in SIGNALS)
    assert (stop.name, stop.exit_status) == ("", 0)
    assert [signal.getsignal(number) for number in SIGNALS] == previous


def test_other_threads_do_not_catch_signals() -> None:
    previous = signal.getsignal(signal.SIGINT)
    handlers = []

    def enter() -> None:
        with StopSignal():
            handlers.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=enter)
    thread.start()
    thread.join()
    assert handlers == [previous]

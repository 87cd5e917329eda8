"""Signals: the run saves, says so and leaves; and can go on."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from rsoccer.train import Args, checkpoint, train
from rsoccer.train.stop_signal import Stop, Stopped
from tests.train.short_task import TINY

SCRIPT = """
import sys
from pathlib import Path
from rsoccer.train import Args, train
from tests.train.short_task import TINY, register_all
register_all()
train(Args(**{**TINY, "out": Path(sys.argv[1]), "samples": 10**9, "checkpoint_interval": 999.0}))
"""


def wait_for(condition: object, seconds: float = 60.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():  # type: ignore[operator]
        assert time.monotonic() < deadline, "it never happened"
        time.sleep(0.02)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_saves_and_the_run_can_go_on(number: signal.Signals, tmp_path: Path) -> None:
    process = subprocess.Popen(
        [sys.executable, "-c", SCRIPT, str(tmp_path)], stderr=subprocess.PIPE, text=True
    )
    log = tmp_path / "progress.csv"
    wait_for(lambda: process.poll() is not None or (log.exists() and log.stat().st_size > 500))
    process.send_signal(number)
    _, said = process.communicate(timeout=120)  # of a run that would go on for hours
    assert process.returncode == 128 + number
    assert f"{number.name}: saved after" in said and "--resume" in said
    assert "Traceback" not in said
    saved = checkpoint.load(tmp_path / checkpoint.FILE_NAME)
    assert saved.info["samples"] > 0
    target = saved.info["samples"] + 144
    train(Args(**{**TINY, "out": tmp_path, "samples": target, "resume": True}))
    resumed = checkpoint.load(tmp_path / checkpoint.FILE_NAME)
    assert resumed.info["samples"] == target


def test_the_first_signal_asks_and_the_second_acts() -> None:
    def act(number: int, frame: object) -> None:
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGINT, act)
    try:
        with Stop() as stop:
            stop.check()
            os.kill(os.getpid(), signal.SIGINT)
            assert (stop.name, stop.status) == ("SIGINT", 130)
            with pytest.raises(Stopped):
                stop.check()
            with pytest.raises(KeyboardInterrupt):
                os.kill(os.getpid(), signal.SIGINT)
        assert signal.getsignal(signal.SIGINT) is act
    finally:
        signal.signal(signal.SIGINT, before)


def test_outside_the_main_thread_signals_stay_as_they_are() -> None:
    before = signal.getsignal(signal.SIGINT)
    seen = []

    def enter() -> None:
        with Stop():
            seen.append(signal.getsignal(signal.SIGINT))

    thread = threading.Thread(target=enter)
    thread.start()
    thread.join()
    assert seen == [before]

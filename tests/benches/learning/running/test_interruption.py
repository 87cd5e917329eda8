"""Interruptions of the study: finished runs stay, unfinished ones continue."""

import json
import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import ExitStack
from pathlib import Path

import pytest

from benches.learning.__main__ import main
from benches.learning.run_files import Folders
from benches.learning.running.workplace import is_running, lock
from benches.result_files import ROOT

TABLE = "tests.benches.learning.tiny_table"
KEY = "interrupted/run/seed-0"


def wait_for(path: Path, seconds: float = 120.0) -> None:
    deadline = time.monotonic() + seconds
    while not path.exists():
        assert time.monotonic() < deadline, f"{path} was not written"
        time.sleep(0.05)


def test_an_interrupted_run_continues(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    results, work = tmp_path / "results", tmp_path / "work"
    options = ["--table", TABLE, "--results", str(results), "--work", str(work)]
    options += ["--group", "interrupted", "--jobs", "1"]
    command = [sys.executable, "-m", "benches.learning", *options]
    paths = os.pathsep.join(path for path in sys.path if path)
    process = subprocess.Popen(
        command, cwd=ROOT, env={**os.environ, "PYTHONPATH": paths}, start_new_session=True
    )
    wait_for(work / KEY / "checkpoint.safetensors")
    process.send_signal(signal.SIGINT)  # goes on as SIGTERM
    assert process.wait(timeout=120) == 0
    assert not (results / "runs" / f"{KEY}.json").exists()
    main([*options, "--list"])
    assert "unfinished" in capsys.readouterr().out
    assert main(options) == 0
    result = json.loads((results / "runs" / f"{KEY}.json").read_text())
    assert result["seconds"]["attempts"] == 2
    assert result["samples"] == 6_000


def test_a_look_at_the_lock_takes_no_run_away(tmp_path: Path) -> None:
    """`--list` holds the lock for a moment."""
    folders = Folders(tmp_path / "results", tmp_path / "work")
    with ExitStack() as look:
        assert look.enter_context(lock(folders, KEY))
        threading.Timer(0.2, look.pop_all().close).start()
        with lock(folders, KEY) as held:
            assert held


def test_two_processes_do_not_work_on_one_run(tmp_path: Path) -> None:
    folders = Folders(tmp_path / "results", tmp_path / "work")
    assert not is_running(folders, KEY)
    with lock(folders, KEY) as first, lock(folders, KEY) as second:
        assert (first, second) == (True, False)
        assert is_running(folders, KEY)
    assert not is_running(folders, KEY)

import json
import time
from pathlib import Path

import pytest

from benches.learning.running import clock
from benches.learning.running.clock import TIME_FILE, restart_clock, spent, timed


def test_attempts_add_up_until_the_clock_starts_again(tmp_path: Path) -> None:
    for attempt in (1, 2):
        with timed(tmp_path) as before:
            time.sleep(0.02)
        assert before["attempts"] == attempt - 1
        assert spent(tmp_path)["attempts"] == attempt
    assert spent(tmp_path)["wall"] >= 0.04
    restart_clock(tmp_path)
    assert spent(tmp_path) == {"wall": 0.0, "cpu": 0.0, "attempts": 0}


def test_the_time_is_on_disk_before_the_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(clock, "TIME_INTERVAL", 0.01)
    path = tmp_path / TIME_FILE
    with timed(tmp_path):
        deadline = time.monotonic() + 60.0
        while not path.exists():
            assert time.monotonic() < deadline, "nothing was written"
            time.sleep(0.01)
        seconds = json.loads(path.read_text())
    assert seconds["attempts"] == 1
    assert 0.0 < seconds["wall"] <= spent(tmp_path)["wall"]

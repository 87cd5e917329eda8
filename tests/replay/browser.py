"""Pages in a headless Chromium: the result of a script, and what the console says."""

import json
import re
import shutil
import subprocess
import threading
from pathlib import Path
from typing import Any, NamedTuple

import pytest

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
FLAGS = ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars")
HELPERS = """
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
const key = (name, more) => document.dispatchEvent(
  new KeyboardEvent("keydown", {key: name, bubbles: true, ...more}));
const pointer = (id, kind, x, y) => {
  const element = document.getElementById(id);
  const box = element.getBoundingClientRect();
  element.dispatchEvent(new PointerEvent(kind, {
    clientX: box.left + x * box.width, clientY: box.top + y * box.height, pointerId: 1}));
};
"""
MARK = "test-result "
MESSAGE = re.compile(r':CONSOLE(?::\d+|\(\d+\))\] "(.*)", source: ')
TIMEOUT = 60.0  # s


class Shown(NamedTuple):
    """A page after its script."""

    result: Any
    console: list[str]


def show(page: str, script: str, folder: Path, width: int = 1280, height: int = 900) -> Shown:
    """Open a page, run a script with its `player`, and return what the script returns.

    Tests are skipped where there is no Chromium.
    """
    program = next(filter(None, map(shutil.which, NAMES)), None)
    if program is None:
        pytest.skip(f"no browser: none of {', '.join(NAMES)} is installed")
    run = f"window.rsoccerPlayer.then(async (player) => {{ {script} }}).catch(String)"
    finish = f'console.log("{MARK}" + JSON.stringify(value ?? null))'
    added = f"<script>{HELPERS}{run}.then((value) => {{ {finish}; }});</script></body>"
    file = folder / "page.html"
    file.write_text(page.replace("</body>", added))
    command = [program, *FLAGS, f"--user-data-dir={folder / 'profile'}"]
    command += [f"--window-size={width},{height}", "--enable-logging=stderr", file.as_uri()]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE) as process:
        try:
            return _read(process)
        finally:
            process.terminate()


def _read(process: subprocess.Popen[bytes]) -> Shown:
    """Messages of the console, up to the result of the script."""
    watchdog = threading.Timer(TIMEOUT, process.kill)
    watchdog.start()
    console: list[str] = []
    log: list[str] = []
    try:
        assert process.stderr is not None
        for line in process.stderr:
            log.append(line.decode(errors="replace"))
            if message := MESSAGE.search(log[-1]):
                if message[1].startswith(MARK):
                    return Shown(json.loads(message[1].removeprefix(MARK)), console)
                console.append(message[1])
        pytest.fail(f"no result within {TIMEOUT} s:\n{''.join(log)}")
    finally:
        watchdog.cancel()

"""Speed of matches as WebAssembly in Node, and of the same matches by native code, on one core.

`python -m tools.playground.speed` prints control steps a second of processor time. The module is
that of `make playground`, or another one: `--module PATH`.

With `--page` it opens the page of `make playground` in a headless Chromium, without a graphics
card, and prints when the page was first painted and when its match had begun, from the start of
navigation, and the pictures and control steps a second of the largest match.
"""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Final

from tests.replay.browser import NAMES, show
from tools.paths import ROOT
from tools.playground.__main__ import MODULE, PAGE
from tools.playground.native import NativeMatch
from tools.playground.page import LEAGUES

RUN: Final = ROOT / "tests" / "wasm" / "run.js"
MATCHES: Final = (("ssl_b", 6), ("ssl_a", 11))
"""Fields, and robots of each team."""
SKILLS: Final = (1.0, 0.6)
SEED: Final = 7
STEPS: Final = 4000
REPEATS: Final = 3
"""Measurements, of which the fastest counts."""
_SCRIPT: Final = """
const match = engine.newMatch({{field: "{field}", blue: {robots}, yellow: {robots}, seed: {seed}}});
match.setScripted(0, {blue});
match.setScripted(1, {yellow});
const begun = process.cpuUsage();
for (let step = 0; step < {steps}; step++) match.step();
const used = process.cpuUsage(begun);
return (used.user + used.system) / 1e6;
"""


_PAGE_SCRIPT: Final = """
const begun = performance.now();
const painted = performance.getEntriesByName("first-contentful-paint")[0].startTime;
const league = document.getElementById("league");
league.value = "{league}";
league.dispatchEvent(new Event("change"));
for (let second = 0; second < {seconds}; second++) await wait(1000);
const {{ pictures, played, possible }} = player.rate;
return {{ painted, begun, pictures, played, possible }};
"""
_SECONDS: Final = 5
"""Seconds of play on the page; the last one counts."""


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description="Measure the speed of matches as WebAssembly.")
    parser.add_argument("--page", action="store_true", help="the page in Chromium, not the module")
    parser.add_argument("--module", type=Path, default=MODULE, help="the WebAssembly module")
    args = parser.parse_args()
    if args.page:
        sys.exit(_measure_page())
    if not args.module.is_file():
        parser.error(f"--module: expected a file, got {args.module}: `make wasm` builds it")
    print(f"module: {args.module.stat().st_size / 1e6:.2f} MB")
    for field, robots in MATCHES:
        wasm = min(_wasm_seconds(args.module, field, robots) for _ in range(REPEATS))
        native = min(_native_seconds(field, robots) for _ in range(REPEATS))
        rates = f"{STEPS / wasm:,.0f} steps/s as WebAssembly, {STEPS / native:,.0f} by native code"
        print(f"{field}, {robots} v {robots}: {rates}, ratio {native / wasm:.2f}", flush=True)


def _measure_page() -> str | None:
    """Measure the page, and print; return an error where something is missing."""
    if not PAGE.is_file():
        return f"expected the page {PAGE}: `make playground` writes it"
    if not any(map(shutil.which, NAMES)):
        return f"expected a browser, one of {', '.join(NAMES)}"
    largest = max(LEAGUES, key=lambda league: league.robots)
    script = _PAGE_SCRIPT.format(league=largest.id, seconds=_SECONDS)
    ready = "<script>window.rsoccerPlayer = window.rsoccerPlayground;</script></body>"
    page = PAGE.read_text(encoding="utf-8").replace("</body>", ready)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        shown = show(page, script, Path(folder))
    got = shown.result
    print(f"page: {PAGE.stat().st_size / 1e6:.2f} MB, console: {shown.console or 'empty'}")
    print(f"first paint after {got['painted']:.0f} ms, match after {got['begun']:.0f} ms")
    rates = f"{got['pictures']} pictures/s, {got['played']} steps/s of up to {got['possible']:,}"
    print(f"{largest.name}: {rates}")
    return None


def _wasm_seconds(module: Path, field: str, robots: int) -> float:
    """Processor time of a match in Node, s."""
    (blue, yellow), names = SKILLS, {"field": field, "robots": robots}
    script = _SCRIPT.format(**names, seed=SEED, blue=blue, yellow=yellow, steps=STEPS)
    command = ["node", str(RUN), str(module), script]
    ran = subprocess.run(command, capture_output=True, text=True, check=True)
    return float(json.loads(ran.stdout))


def _native_seconds(field: str, robots: int) -> float:
    """Processor time of the same match by native code, s."""
    match = NativeMatch(field, robots, SKILLS, SEED)
    begun = time.process_time()
    for _ in range(STEPS):
        match.step()
    return time.process_time() - begun


if __name__ == "__main__":
    main()

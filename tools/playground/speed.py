"""Speed of matches as WebAssembly in Node, and of the same matches by native code, on one core.

`python -m tools.playground.speed` prints control steps a second of processor time. The module is
that of `make playground`.
"""

import json
import subprocess
import time
from typing import Final

from tools.paths import ROOT
from tools.playground.__main__ import MODULE
from tools.playground.native import NativeMatch

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


def main() -> None:
    """Measure and print."""
    for field, robots in MATCHES:
        wasm = min(_wasm_seconds(field, robots) for _ in range(REPEATS))
        native = min(_native_seconds(field, robots) for _ in range(REPEATS))
        rates = f"{STEPS / wasm:,.0f} steps/s as WebAssembly, {STEPS / native:,.0f} by native code"
        print(f"{field}, {robots} v {robots}: {rates}, ratio {native / wasm:.2f}", flush=True)


def _wasm_seconds(field: str, robots: int) -> float:
    """Processor time of a match in Node, s."""
    (blue, yellow), names = SKILLS, {"field": field, "robots": robots}
    script = _SCRIPT.format(**names, seed=SEED, blue=blue, yellow=yellow, steps=STEPS)
    command = ["node", str(RUN), str(MODULE), script]
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

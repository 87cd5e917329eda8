"""The WebAssembly module in Node, and what it returns."""

import base64
import json
import os
import subprocess
from pathlib import Path
from typing import Any

import numpy as np

from rsoccer.arrays import Floats

MODULE = Path(os.environ.get("RSOCCER_WASM", "rsim_wasm.wasm"))
RUN = Path(__file__).parent / "run.js"


def run(script: str) -> Any:  # noqa: ANN401  (any JSON)
    """What a script returns; it sees `engine` and the parts of the playground."""
    command = ["node", str(RUN), str(MODULE), script]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    return json.loads(ran.stdout)


def numbers(encoded: list[str]) -> Floats:
    """Rows of numbers from base64 of each."""
    return np.stack([np.frombuffer(base64.b64decode(row), np.float32) for row in encoded])

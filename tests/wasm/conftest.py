"""Tests of the WebAssembly module: `make check-wasm` builds it and sets `RSOCCER_WASM` to its path.

Without that variable they are not collected, since most machines have no compiler for it.
"""

import os

collect_ignore_glob = [] if "RSOCCER_WASM" in os.environ else ["test_*.py"]

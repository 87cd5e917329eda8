"""Writes the playground into `out/playground/index.html`: `make playground`.

The page holds the WebAssembly module of `crates/rsim-wasm`, the shipped policies that it can play,
shapes of fields and robots from `rsoccer.render`, and the drawing of the pages of replays.
"""

import argparse
import base64
import gzip
from pathlib import Path

from rsoccer.files import write_atomically
from tools.paths import ROOT
from tools.playground.page import to_html

MODULE = ROOT / "target" / "wasm" / "wasm32-unknown-unknown" / "release" / "rsim_wasm.wasm"
"""The module, where cargo writes it."""
PAGE = ROOT / "out" / "playground" / "index.html"
"""The page; the site copies it."""


def main() -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(description="Write the playground as one page.")
    parser.add_argument("--module", type=Path, default=MODULE, help="the WebAssembly module")
    parser.add_argument("--out", type=Path, default=PAGE, help="the page")
    args = parser.parse_args()
    if not args.module.is_file():
        parser.error(f"--module: expected a file, got {args.module}: `make playground` builds it")
    packed = base64.b64encode(gzip.compress(args.module.read_bytes(), 9, mtime=0)).decode()
    page = to_html(packed).encode()
    args.out.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(args.out, page)
    print(f"wrote {args.out} ({len(page) / 1e6:.2f} MB)")


if __name__ == "__main__":
    main()

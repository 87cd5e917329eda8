"""Builds the documentation site into `out/site`: `make site`.

Warnings are errors. The reference of the Rust crates is copied from `target/doc` where `cargo doc`
has left it there. Nothing is fetched from a network.
"""

import argparse
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Final

from tools.paths import ROOT
from tools.site import matches, playground
from tools.site.api import RUST
from tools.site.source import lay_out

SITE: Final = ROOT / "out" / "site"
PAGES: Final = ROOT / "out" / "site-pages"
CONFIGURATION: Final = Path(__file__).parent


def main() -> int:
    """Lay out the pages and build them.

    Returns:
        Sphinx's exit status: 0 if there was no warning.
    """
    parser = argparse.ArgumentParser(description="Build the documentation site into out/site.")
    parser.add_argument("--out", type=Path, default=SITE, help="folder of the site")
    parser.add_argument("--without-rust", action="store_true", help="leave out the crates")
    args = parser.parse_args()
    out: Path = args.out
    lay_out(PAGES, rust=not args.without_rust)
    status = build(PAGES, out)
    matches.write(out / matches.FOLDER)
    playground.copy(out)
    if RUST.is_dir() and not args.without_rust:
        shutil.copytree(RUST, out / "rust", dirs_exist_ok=True)
    if status == 0:
        print(f"built {out / 'index.html'}")
    return status


def build(pages: Path, out: Path) -> int:
    """Run Sphinx.

    Args:
        pages: Folder of the pages to read.
        out: Folder to write the site into.

    Returns:
        Sphinx's exit status: 0 if there was no warning.
    """
    trees = out.parent / "site-trees"
    command = [sys.executable, "-m", "sphinx", "--builder", "html", "--quiet"]
    command += ["--fail-on-warning", "--keep-going", "--nitpicky"]
    command += ["--conf-dir", str(CONFIGURATION), "--doctree-dir", str(trees)]
    for folder in (out, trees):
        shutil.rmtree(folder, ignore_errors=True)  # a page that is kept would not warn again
    return subprocess.run([*command, str(pages), str(out)], cwd=ROOT, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())

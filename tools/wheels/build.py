"""The source distribution and a wheel for each architecture of Linux: `make wheels`.

python -m tools.wheels.build [--architectures x86_64 aarch64] [--folder out/wheels]

Zig links against the symbols of an old glibc, so that a wheel runs on the distributions since.
The wheel for this machine's architecture is built by a profile of `tools.wheels.typical_play`, if
the compiler has LLVM's tools: `rustup component add llvm-tools`.
A wheel for an architecture needs Rust's standard library for it; for one that the compiler does not
have, `rustup target add` or a package of the distribution brings it (CONTRIBUTING.md).
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from tools.paths import ROOT
from tools.wheels import maturin, profile

PLATFORMS: Final = {
    # glibc 2.17 of 2012, the oldest that Rust's own standard library runs on.
    "x86_64": "manylinux2014",
    # glibc 2.28 of 2018.
    "aarch64": "manylinux_2_28",
}
"""Platform tag of the wheel for each architecture."""

MAX_MEGABYTES: Final = 12.0
"""Size of a wheel that a change may not pass unnoticed: trained policies are part of it."""


def target(architecture: str) -> str:
    """Return Rust's name of an architecture's Linux."""
    return f"{architecture}-unknown-linux-gnu"


def has_standard_library(architecture: str) -> bool:
    """Return whether the compiler has Rust's standard library for an architecture."""
    rustc = os.environ.get("RUSTC", "rustc")
    command = [rustc, "--print", "target-libdir", "--target", target(architecture)]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    return any(Path(printed.strip()).glob("libstd-*.rlib"))


def build_wheel(architecture: str, folder: Path) -> Path:
    """Build and audit the wheel for an architecture.

    Args:
        architecture: A key of `PLATFORMS`.
        folder: Folder for the wheel.

    Returns:
        Path of the wheel.

    Raises:
        CalledProcessError: The build has failed, or the library needs symbols that its platform
            does not have.
        RuntimeError: The wheel is not there, or it is too large.
    """
    options = ["--locked", "--release", "--zig", "--interpreter", "python3"]
    options += ["--target", target(architecture), "--compatibility", PLATFORMS[architecture]]
    options += ["--out", str(folder)]
    if (tool := profile.merging_tool(target(architecture))) is None:
        print(f"the wheel for {architecture} is built without a profile", file=sys.stderr)
        maturin.run("build", *options)
    else:
        with TemporaryDirectory() as temporary:
            flag = profile.flag(target(architecture), tool, Path(temporary))
            maturin.run("build", *options, RUSTFLAGS=profile.with_flag(flag))
    wheels = sorted(folder.glob(f"rsoccer-*_{architecture}.whl"), key=lambda p: p.stat().st_mtime)
    if not wheels:
        raise RuntimeError(f"expected a wheel for {architecture} in {folder}, found none")
    # maturin has audited the library for the platform; auditwheel does it independently.
    show = [sys.executable, "-m", "auditwheel", "show", str(wheels[-1])]
    report = subprocess.run(show, check=True, capture_output=True, text=True).stdout
    if PLATFORMS[architecture].replace("2014", "_2_17") not in report:
        raise RuntimeError(f"expected a wheel for {PLATFORMS[architecture]}, auditwheel: {report}")
    if megabytes(wheels[-1]) > MAX_MEGABYTES:
        size = f"{megabytes(wheels[-1]):.1f} MB"
        raise RuntimeError(f"expected a wheel of at most {MAX_MEGABYTES} MB, got {size}")
    return wheels[-1]


def build_source(folder: Path) -> Path:
    """Build the source distribution, and return its path."""
    maturin.run("sdist", "--out", str(folder))
    return max(folder.glob("rsoccer-*.tar.gz"), key=lambda path: path.stat().st_mtime)


def megabytes(path: Path) -> float:
    """Return the size of a file in 10^6 bytes."""
    return path.stat().st_size / 1e6


def main(arguments: list[str] | None = None) -> int:
    """Build the distributions, and print their sizes.

    Args:
        arguments: Of the command line; None for those of this process.

    Returns:
        The number of architectures whose wheel could not be built.
    """
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--architectures", nargs="+", choices=PLATFORMS, default=["x86_64"])
    parser.add_argument("--folder", type=Path, default=ROOT / "out" / "wheels")
    options = parser.parse_args(arguments)
    options.folder.mkdir(parents=True, exist_ok=True)
    built, missing = [build_source(options.folder)], 0
    for architecture in options.architectures:
        if has_standard_library(architecture):
            built.append(build_wheel(architecture, options.folder))
        else:
            missing += 1
            text = "the compiler has no standard library for it (CONTRIBUTING.md, Wheels)"
            print(f"no wheel for {architecture}: {text}", file=sys.stderr)
    for path in built:
        print(f"{path.name}: {megabytes(path):.1f} MB")
    return missing


if __name__ == "__main__":
    sys.exit(main())

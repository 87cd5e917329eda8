"""Profile of typical play, by which the compiler builds a wheel.

`maturin --pgo` does the same for `make profiled`, but zig does not link a module with counters:
here the system's linker does, and zig links the wheel itself.
"""

import os
import platform
import subprocess
import sys
from pathlib import Path

from tools.paths import ROOT
from tools.wheels import maturin, typical_play


def merging_tool(target: str) -> Path | None:
    """Return the compiler's program that merges counts; None if no profile can be made.

    The module with counters has to run here, and a compiler reads profiles of its own LLVM alone.

    Args:
        target: Rust's name of the system of the wheel.
    """
    if not target.startswith(f"{platform.machine()}-"):
        return None
    command = [os.environ.get("RUSTC", "rustc"), "--print", "sysroot"]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    tool = Path(printed.strip()) / "lib" / "rustlib" / target / "bin" / "llvm-profdata"
    return tool if tool.exists() else None


def flag(target: str, tool: Path, folder: Path) -> str:
    """Make a profile, and return the flag of the compiler that builds by it.

    Args:
        target: Rust's name of the system of the wheel.
        tool: What `merging_tool` returned.
        folder: An empty folder, which has to stay until the wheel is built.

    Raises:
        CalledProcessError: The build with counters or the play has failed.
        RuntimeError: The play has counted nothing.
    """
    counts, wheels, packages = (folder / name for name in ("counts", "wheels", "packages"))
    options = ["--locked", "--release", "--interpreter", "python3", "--target", target]
    variables = {
        "RUSTFLAGS": with_flag(f"-Cprofile-generate={counts}"),
        # Other flags would compile everything in the usual folder again, too.
        "CARGO_TARGET_DIR": str(ROOT / "target" / "counting-play"),
    }
    maturin.run("build", *options, "--compatibility", "linux", "--out", str(wheels), **variables)
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    pip += ["--constraint", str(ROOT / "constraints.txt"), "--target", str(packages)]
    subprocess.run([*pip, *map(str, wheels.iterdir())], check=True)
    names = str(counts / "%m-%p.profraw")
    environment = {**os.environ, "PYTHONPATH": str(packages), "LLVM_PROFILE_FILE": names}
    play = [sys.executable, "-m", typical_play.__name__]
    subprocess.run(play, check=True, cwd=ROOT, env=environment)
    files = [str(path) for path in counts.glob("*.profraw")]
    if not files:
        raise RuntimeError(f"expected counts of the play in {counts}, found none")
    merged = folder / "profile"
    subprocess.run([str(tool), "merge", "--output", str(merged), *files], check=True)
    return f"-Cprofile-use={merged}"


def with_flag(flag: str) -> str:
    """Return the compiler's flags of this process with another one."""
    return " ".join(filter(None, (os.environ.get("RUSTFLAGS"), flag)))

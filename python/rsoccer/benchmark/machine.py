"""The machine and the versions that made a result."""

from __future__ import annotations

import platform
import re
from pathlib import Path

import numpy as np

from rsoccer._core import build_info
from rsoccer.evaluate.schedule import processors


def machine() -> dict[str, str | int]:
    """Return the processor, its cores, the system, and versions of Python and NumPy, as JSON."""
    return {
        "processor": _processor(),
        "cores": processors(),
        "system": f"{platform.system()} {platform.machine()}",
        "python": platform.python_version(),
        "numpy": np.__version__,
    }


def versions() -> dict[str, str | int]:
    """Return the versions of the package and of its physics, as JSON."""
    info = build_info()
    return {"package": str(info["version"]), "physics": int(info["physics"])}


def _processor() -> str:
    """Model name of the processor, if the system tells it."""
    info = Path("/proc/cpuinfo")
    if info.exists() and (found := re.search(r"model name\s*:\s*(.+)", info.read_text())):
        return found[1]
    return platform.processor() or platform.machine()

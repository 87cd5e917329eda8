"""A command in a process of its own."""

import os
import subprocess
import sys


def run(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a command in a new process, as a shell does."""
    return subprocess.run(
        [sys.executable, "-m", "rsoccer", *arguments],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, **environment},
        check=False,
    )

"""`rsoccer list | train | evaluate | watch`, and what becomes of errors on the way."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

WRONG_INPUT = 2  # exit status, as command-line parsers have it
INTERRUPTED = 130  # what shells report after Ctrl-C

EXTRAS = {
    "PIL": "render",
    "imageio_ffmpeg": "render",
    "matplotlib": "train",
    "pygame": "render",
    "safetensors": "cli",
    "tensorboard": "train",
    "torch": "train",
    "tqdm": "train",
    "tyro": "cli",
}
"""Which of the package's extras brings each optional module."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command, by default that of `sys.argv`; the exit status."""
    try:
        _run(arguments)
        sys.stdout.flush()
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        # Whoever read our output has left; without this Python complains once more at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (ImportError, OSError, RuntimeError, ValueError) as error:
        sys.stderr.write(f"rsoccer: {_explain(error)}\n")
        return WRONG_INPUT
    return 0


def _run(arguments: Sequence[str] | None) -> None:
    import tyro

    from rsoccer.commands import Command

    command = tyro.cli(
        Command,
        prog="rsoccer",
        description="Robot soccer for reinforcement learning.",
        args=arguments,
        config=(tyro.conf.FlagCreatePairsOff,),
    )
    command.run()


def _explain(error: Exception) -> str:
    """One line that says what is wrong and, where a module is missing, how to get it."""
    module = (getattr(error, "name", None) or "").partition(".")[0]
    if isinstance(error, ImportError) and module in EXTRAS:
        return f"this needs {module}: pip install 'rsoccer[{EXTRAS[module]}]'"
    return " ".join(str(error).split()) or type(error).__name__

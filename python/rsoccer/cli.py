"""Entry point of the command `rsoccer`, whose commands are in `rsoccer.commands`.

Errors are reported as one line.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence

from rsoccer import interrupts

WRONG_INPUT = 2  # exit status for wrong input, as of command-line parsers

REPEATABLE = "--import"
"""The option that may be given more than once."""

EXTRAS = {
    "PIL": "render",
    "google": "network",
    "h5py": "data",
    "imageio_ffmpeg": "render",
    "matplotlib": "train",
    "minari": "data",
    "onnx": "onnx",
    "onnxruntime": "onnx",
    "pygame": "render",
    "safetensors": "train",
    "tensorboard": "train",
    "torch": "train",
    "tqdm": "train",
    "tyro": "cli",
    "websockets": "network",
}
"""The extra of this package that installs each optional module."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command. Errors are reported as one line on standard error.

    Args:
        arguments: words after `rsoccer`; by default those of `sys.argv`.

    Returns:
        Exit status: 0, `WRONG_INPUT`, or `interrupts.INTERRUPTED` after Ctrl-C.

    Raises:
        SystemExit: with status 2 if the words cannot be parsed, 0 after `--help`, or the status
            of an interrupted training run.
    """
    try:
        interrupts.handle()
        _run(arguments)
        sys.stdout.flush()
    except KeyboardInterrupt:
        return interrupts.INTERRUPTED
    except BrokenPipeError:
        # The reader of the output has closed it. Otherwise Python reports a second error at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (ImportError, OSError, RuntimeError, ValueError) as error:
        sys.stderr.write(f"rsoccer: {_explain(error)}\n")
        return WRONG_INPUT
    return 0


def _run(arguments: Sequence[str] | None) -> None:
    """Parse the arguments and run the command."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    if words == ["--version"]:
        sys.stdout.write(f"{version()}\n")
        return
    import tyro

    from rsoccer.commands import command_type
    from rsoccer.commands.numbers import whole_numbers
    from rsoccer.commands.sources import refusals_as_wrong_input

    _refuse_repetitions(words)
    with refusals_as_wrong_input():
        command = tyro.cli(
            command_type(words),
            prog="rsoccer",
            description="Robot soccer for reinforcement learning. `rsoccer --version` prints the "
            "versions of the package and of its physics.",
            args=words,
            registry=whole_numbers(),
        )
        command.run()


def _refuse_repetitions(words: Sequence[str]) -> None:
    """Refuse an option that is given twice: the last one would silently replace the others."""
    names = [word.partition("=")[0] for word in words if word.startswith("--")]
    for name in dict.fromkeys(names):
        if names.count(name) > 1 and name != REPEATABLE:
            raise ValueError(
                f"{name}: expected once, got {names.count(name)} times; several values follow one "
                f"option, as in {name} A B"
            )


def version() -> str:
    """Return the versions of the package and of its physics in one line."""
    from rsoccer._core import build_info

    info = build_info()
    return f"rsoccer {info['version']}, physics {info['physics']}"


def _explain(error: Exception) -> str:
    """One line for an error; for a missing module the command that installs it."""
    module = (getattr(error, "name", None) or "").partition(".")[0]
    if isinstance(error, ImportError) and module in EXTRAS:
        return f"this needs {module}: pip install 'rsoccer[{EXTRAS[module]}]'"
    return " ".join(str(error).split()) or type(error).__name__

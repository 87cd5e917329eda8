"""Ctrl-C while the package is imported for the command `rsoccer`: the process ends without a word.

The first import of the package imports this module before all others. In programs that import the
package themselves it does nothing.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Sequence

INTERRUPTED = 130
"""Exit status after Ctrl-C, as shells report it: 128 + SIGINT."""
_SCRIPTS = ("rsoccer", "rsoccer.exe", "rsoccer-script.py")
"""Names of the command's script."""


def is_command(arguments: Sequence[str], interpreter_arguments: Sequence[str]) -> bool:
    """Return whether a process is the command `rsoccer`.

    Args:
        arguments: `sys.argv` during the import of the package.
        interpreter_arguments: `sys.orig_argv`. Processes that a command starts may have its
            `sys.argv`, but never these.
    """
    if not 0 < len(arguments) <= len(interpreter_arguments):
        return False
    started = interpreter_arguments[-len(arguments)]
    if arguments[0] == "-m":  # Python has not found the module yet
        return started == "rsoccer"
    # `pathlib` takes long to import, and Ctrl-C in that time prints a traceback.
    return started == arguments[0] and os.path.basename(started) in _SCRIPTS


def handle() -> None:
    """Let Ctrl-C raise `KeyboardInterrupt` again, now that the command catches it."""
    if signal.getsignal(signal.SIGINT) is _end:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _end(*_: object) -> None:
    # An exception could come out of the midst of another package's import as another error.
    os._exit(INTERRUPTED)


if is_command(sys.argv, sys.orig_argv) and (
    signal.getsignal(signal.SIGINT) is signal.default_int_handler  # not ignored, as `nohup` has it
):
    signal.signal(signal.SIGINT, _end)

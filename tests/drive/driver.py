"""A process that drives robots of FIRASim and then fails.

`python -m tests.drive.driver HOW COMMAND_PORT VISION_PORT`.
"""

from __future__ import annotations

import os
import signal
import sys
import time

import numpy as np

from rsoccer import SimConfig
from rsoccer.drive.connection import Connection
from rsoccer.drive.settings import Settings


def main(how: str, command: int, vision: int) -> None:
    config = SimConfig("vss_3v3", 3, 3)
    settings = Settings(
        "firasim",
        ports={"command": command, "vision": vision},
        groups={"vision": "127.0.0.1"},
        referee="ignore",
        patience=60.0,
    )
    connection = Connection(config, settings)
    connection.begin()
    commands = np.full((6, 2), 20.0, np.float32)
    connection.advance(commands, connection.sight.clock.now + 0.1)
    if how == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    if how == "hanging":
        time.sleep(60.0)
    connection.close()


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))

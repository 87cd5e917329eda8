"""Policies for other simulators and for robots, over the protocols of the leagues.

| module | content |
| --- | --- |
| `settings` | numbers and places of a connection |
| `peers` | grSim, FIRASim and the simulation protocol: ports and messages |
| `sight`, `vision_clock` | from frames of vision to states and their times |
| `officials` | packets of a referee, and what robots may do under it |
| `limits` | greatest speeds |
| `link` | sockets |
| `guard`, `guard_process` | the process that stops robots when this one fails |
| `connection` | all of them: commands out, states in |
| `simulator` | a connection as the simulator of `Matches` |
| `check`, `delay` | signs and sides with one robot, and the delay of the whole loop |
| `session` | `rsoccer drive` |

The package needs protobuf: `pip install 'rsoccer[network]'`.
"""

from rsoccer.drive.settings import Limits, Settings
from rsoccer.drive.simulator import (
    Network,
    NetworkSimulator,
    NetworkStepper,
    UntouchedNetwork,
    firasim,
    forecasting,
    grsim,
    ssl_simulation,
)

__all__ = [
    "Limits",
    "Network",
    "NetworkSimulator",
    "NetworkStepper",
    "Settings",
    "UntouchedNetwork",
    "firasim",
    "forecasting",
    "grsim",
    "ssl_simulation",
]

"""Policies for other simulators and for robots, over the protocols of the leagues.

| module | content |
| --- | --- |
| `settings` | numbers and places of a connection |
| `peers` | grSim, FIRASim and the simulation protocol: ports and messages |
| `sight`, `state_sight`, `vision_clock` | from frames of vision to states and their times |
| `officials` | packets of a referee, and what robots may do under it |
| `limits` | greatest speeds |
| `link` | sockets |
| `guard`, `guard_process` | the process that stops robots when this one fails |
| `reception` | what comes in: frames, packets of the referee, answers |
| `connection` | all of them: commands out, states in |
| `simulator`, `network` | a connection as the simulator of `Matches`; places that have names |
| `check`, `delay` | signs and sides with one robot, and the delay of the whole loop |
| `session` | `rsoccer drive` |

The package needs protobuf: `pip install 'rsoccer[network]'`.
"""

from rsoccer.drive.network import Network, firasim, forecasting, grsim, ssl_simulation
from rsoccer.drive.settings import Settings
from rsoccer.drive.simulator import NetworkSimulator, NetworkStepper, UntouchedNetwork
from rsoccer.protocols.limits import Limits

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

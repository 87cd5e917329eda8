"""Messages of the leagues' protocols to and from states and commands, without sockets.

Sides, uniform numbers and units are converted here alone: `WireLayout` knows them. `parsing.parse`
turns bytes into messages that are complete and finite; modules named after protocols turn messages
into states and commands and back. The package needs protobuf: `pip install 'rsoccer[network]'`.

| module | messages |
| --- | --- |
| `vision`, `geometry`, `cameras` | detections and geometry of SSL-Vision |
| `tracker` | tracked frames |
| `referee`, `game_events`, `referee_state` | packets of the SSL game controller |
| `simulator_control`, `robot_control`, `answers` | the simulation protocol |
| `grsim`, `fira`, `vssref` | packets of grSim, FIRASim and VSSReferee |
| `logs`, `replay_log`, `log_replay` | log files of the SSL, from and to replays |
"""

from rsoccer.protocols.errors import Code, MessageError, Problem
from rsoccer.protocols.layout import WireLayout

__all__ = ["Code", "MessageError", "Problem", "WireLayout"]

"""What actions ask of robots of the SSL, in NumPy: what the core says is checked against it."""

import numpy as np

from rsoccer._core import COMMAND_COLUMNS
from rsoccer.frame import Floats, Frame
from rsoccer.tasks.ssl import Ssl

BODY = COMMAND_COLUMNS["omni"]


def commands(task: Ssl, frame: Frame, actions: Floats) -> Floats:
    """(n, robots, 6) for actions (n, robots, 5)."""
    asked = actions * task.action_scales
    told = np.zeros((*actions.shape[:2], len(BODY)), np.float32)
    told[..., :3] = asked[..., :3]
    if task.velocity_frame == "field":
        signs = np.repeat(np.array([1.0, -1.0], np.float32), task.team_sizes())
        heading = frame.robots.heading * signs[:, None]
        cos, sin = heading[..., 0], heading[..., 1]
        x, y = asked[..., 0], asked[..., 1]
        told[..., 0], told[..., 1] = x * cos + y * sin, y * cos - x * sin
    told[..., BODY.index("kick_v_x")] = np.maximum(asked[..., 3], 0.0)
    told[..., BODY.index("dribbler")] = actions[..., 4] > 0.0
    return told

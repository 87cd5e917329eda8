"""Reference of the commands of SSL robots in NumPy, for comparison with the core."""

import numpy as np

from rsoccer._core import COMMAND_COLUMNS
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.tasks.ssl import Ssl

BODY = COMMAND_COLUMNS["omni"]


def commands(task: Ssl, frame: Frame, actions: Floats) -> Floats:
    """(n, robots, 6) for actions (n, robots, 5)."""
    scaled = actions * task.action_scales
    commanded = np.zeros((*actions.shape[:2], len(BODY)), np.float32)
    commanded[..., :3] = scaled[..., :3]
    if task.velocity_frame == "field":
        signs = np.repeat(np.array([1.0, -1.0], np.float32), task.team_sizes())
        heading = frame.robots.heading * signs[:, None]
        cos, sin = heading[..., 0], heading[..., 1]
        x, y = scaled[..., 0], scaled[..., 1]
        commanded[..., 0], commanded[..., 1] = x * cos + y * sin, y * cos - x * sin
    commanded[..., BODY.index("kick_v_x")] = np.maximum(scaled[..., 3], 0.0)
    commanded[..., BODY.index("dribbler")] = actions[..., 4] > 0.0
    return commanded

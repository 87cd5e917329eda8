"""The rest of a recorded match as other policies would have played it."""

from __future__ import annotations

from contextlib import closing

import numpy as np

from rsoccer import checks
from rsoccer.controllers import Controllers
from rsoccer.replay.container import ReplayError
from rsoccer.replay.recorder import Recorder
from rsoccer.replay.replay import Replay
from rsoccer.sources import SensingSource
from rsoccer.task import Task


def what_if(
    replay: Replay,
    frame: int,
    controllers: Controllers,
    *,
    seed: int = 0,
    seconds: float = 30.0,
    names: tuple[str, str] = ("BLUE", "YELLOW"),
    task: Task | None = None,
    recorded: Controllers | None = None,
    sensing: SensingSource | None = None,
) -> Replay:
    """Play on from any frame with other policies, to the end of the match, and record it.

    Example:
        >>> from rsoccer.replay import record_replay, what_if
        >>> replay = record_replay(controllers={"all": "chase"}, seconds=2.0)
        >>> other = what_if(replay, 20, {"blue": "zero", "yellow": "chase"}, seconds=1.0)
        >>> bool((other.rows[0] == replay.rows[20]).all())
        True

    Args:
        replay: the replay.
        frame: index of a frame at which the match has not ended, as for `Replay.branch`.
        controllers: policies of all robots from the frame on.
        seed: seed of the new policies.
        seconds: longest duration, s, above 0.
        names: names of blue and of yellow on the score board.
        task: the task; by default made from its name and options.
        recorded: controllers of the recording, where a policy has no name.
        sensing: what robots know, where the recording had a sensor model of one's own.

    Returns:
        A replay whose first frame is that frame. Its score begins with 0:0.

    Raises:
        ReplayError: as for `Replay.branch`, or a robot without a policy.
        ValueError: `seconds` is not positive.
    """
    checks.positive_number("seconds", seconds)
    names = checks.team_names(names)
    matches = replay.branch(
        frame, controllers, seed=seed, task=task, recorded=recorded, sensing=sensing
    )
    with closing(matches):
        if matches.agents:
            raise ReplayError(
                "controllers: expected a policy for every robot, got none for "
                f"{list(matches.agents)}"
            )
        recorder = Recorder(matches, names=names, controllers=controllers)
        recorder.begin_here()
        actions = np.zeros((1, 0, matches.action_size), np.float32)
        for _ in range(max(1, round(seconds / matches.task.config.time_step))):
            if matches.done[0]:
                break
            recorder.add(matches.step(actions))
        return recorder.replay()

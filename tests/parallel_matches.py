"""Initial states, random actions and transcripts for tests of PettingZoo environments."""

from typing import Any

import numpy as np

import rsoccer
from rsoccer.arrays import Floats
from rsoccer.envs.parallel import SoccerParallelEnv
from rsoccer.frame import Frame
from tests.helpers import comparable

TASKS = rsoccer.list_tasks()
VSS_TASKS = [name for name in TASKS if name.startswith("VSS")]
SELF_PLAY = "VSSSelfPlay-v0"


def shot_at(goal_side: int) -> Floats:
    """State row: the ball rolls into the goal at +x (1) or -x (-1), and no robot is near."""
    frame = Frame.empty(1, 3, 3)
    frame.robots.position[0] = [[-0.5 + 0.2 * i, 0.45] for i in range(6)]
    frame.ball.position[0] = [0.6 * goal_side, 0.0]
    frame.ball.velocity[0] = [1.0 * goal_side, 0.0]
    row: Floats = frame.rows[0]
    return row


def crowded() -> Floats:
    """State row with two robots at the same position."""
    row = shot_at(1)
    robots = Frame(row[None], 3, 3).robots
    robots.position[0, 5] = robots.position[0, 0]
    return row


def random_actions(match: SoccerParallelEnv, rng: np.random.Generator) -> dict[str, Floats]:
    size = match.task.action_size
    return {agent: rng.uniform(-1, 1, size).astype(np.float32) for agent in match.agents}


def play_episode(match: SoccerParallelEnv, seed: int | None, **reset: Any) -> list[Any]:  # noqa: ANN401
    """All results of one episode, from reset to end, as comparable values."""
    rng = np.random.default_rng(0 if seed is None else seed)
    transcript = [comparable(part) for part in match.reset(seed=seed, **reset)]
    while match.agents:
        transcript.append([comparable(part) for part in match.step(random_actions(match, rng))])
        transcript.append((match.state().tobytes(), list(match.agents)))
    return [*transcript, match.last_metrics]

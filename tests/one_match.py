"""One match, played and compared: what several tests of the environments share."""

from typing import Any

import numpy as np

import rsoccer
from rsoccer.envs.parallel import SoccerParallelEnv
from rsoccer.frame import Floats, Frame

TASKS = rsoccer.list_tasks()
VSS_TASKS = [name for name in TASKS if name.startswith("VSS")]
SELF_PLAY = "VSSSelfPlay-v0"


def shot_at(goal_side: int) -> Floats:
    """A row in which the ball rolls into the goal at +x (1) or -x (-1), robots out of its way."""
    frame = Frame.empty(1, 3, 3)
    frame.robots.position[0] = [[-0.5 + 0.2 * i, 0.45] for i in range(6)]
    frame.ball.position[0] = [0.6 * goal_side, 0.0]
    frame.ball.velocity[0] = [1.0 * goal_side, 0.0]
    row: Floats = frame.rows[0]
    return row


def crowded() -> Floats:
    """A row with two robots in each other."""
    row = shot_at(1)
    robots = Frame(row[None], 3, 3).robots
    robots.position[0, 5] = robots.position[0, 0]
    return row


def random_actions(match: SoccerParallelEnv, rng: np.random.Generator) -> dict[str, Floats]:
    size = match.task.action_size
    return {agent: rng.uniform(-1, 1, size).astype(np.float32) for agent in match.agents}


def as_bytes(value: Any) -> Any:  # noqa: ANN401
    """Arrays as bytes, dictionaries by key: what `==` can compare to the last bit."""
    if isinstance(value, dict):
        return {key: as_bytes(part) for key, part in value.items()}
    return (value.dtype.str, value.shape, value.tobytes()) if hasattr(value, "tobytes") else value


def play_episode(match: SoccerParallelEnv, seed: int | None, **reset: Any) -> list[Any]:  # noqa: ANN401
    """All that one episode returns, from reset to end, as bytes."""
    rng = np.random.default_rng(0 if seed is None else seed)
    transcript = [as_bytes(part) for part in match.reset(seed=seed, **reset)]
    while match.agents:
        transcript.append([as_bytes(part) for part in match.step(random_actions(match, rng))])
        transcript.append((match.state().tobytes(), list(match.agents)))
    return [*transcript, match.last_metrics]

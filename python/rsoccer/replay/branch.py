"""Matches that go on from any frame of a replay with other controllers."""

from __future__ import annotations

import numpy as np

from rsoccer import checks
from rsoccer._core import Simulator, Threads
from rsoccer.arrays import Array, Floats
from rsoccer.controllers import Controllers
from rsoccer.frame import Frame
from rsoccer.matches import Matches
from rsoccer.replay.container import ReplayError
from rsoccer.replay.recorded import Recorded
from rsoccer.replay.resume import LEARNER, REFUSALS, made_again, resume
from rsoccer.sources import SensingSource, closed_on_error
from rsoccer.task import Task

_TOLERANCE = 5e-3
"""Largest deviation of positions, m, at which a match that is played again is the recorded one.
Rows are rounded to 0.1 mm, and the last bits of a network's actions may differ by machine."""


def branch(
    replay: Recorded,
    frame: int,
    controllers: Controllers,
    *,
    seed: int = 0,
    task: Task | None = None,
    recorded: Controllers | None = None,
    sensing: SensingSource | None = None,
) -> Matches:
    """Return matches that go on from a frame of a replay with other controllers.

    From the last snapshot before it the recorded controllers play again up to the frame, so that
    clock, score, referee, senses and each bit of the physics are those of the recording. The new
    policies begin anew. Without a snapshot in the episode, a new episode begins with the bodies of
    the frame.

    Args:
        replay: the replay.
        frame: index of the frame, which is not the last one of an episode that has ended.
        controllers: controllers from the frame on, as for `Matches`.
        seed: seed of the new policies, and of all else without a snapshot.
        task: the task; None to make it from the replay.
        recorded: controllers of the recording, where a policy has no name.
        sensing: what robots know, where the recording had a sensor model of one's own.

    Returns:
        Matches of one world at that frame. `autoreset` is "disabled".

    Raises:
        ReplayError: no such frame, a frame at which the match has ended, a recording that cannot be
            played again up to it, another version of the physics, a task or senses that have to be
            given, or a policy that needs a forecast in a team that had none.
    """
    episode = _episode(replay, frame)
    try:
        task, sensing = made_again(replay, task, sensing)
        before = [held for held in replay.snapshots if episode <= held <= frame]
        state = None
        if before:
            state = _played_again(replay, max(before), frame, task, recorded, sensing)
        matches = Matches(
            task,
            seed=seed,
            controllers=controllers,
            autoreset="disabled",
            sensing=sensing,
            forecasting=replay.forecasting,
            randomization=replay.randomization,
            history=replay.history,
        )
        with closed_on_error(matches):
            more = sorted(set(matches.forecasting) - set(replay.forecasting))
            if state is not None and more:
                raise ReplayError(
                    f"controllers: expected policies without forecasts for {', '.join(more)}, as "
                    "the recording has none for that team"
                )
            if state is None:
                _place(matches, replay, frame)
            else:
                matches.take_over(state, seed)
    except ReplayError:
        raise
    except REFUSALS as error:
        raise ReplayError(f"branch: {error}") from error
    return matches


def has_exact_start(replay: Recorded, frame: int) -> bool:
    """Return whether a branch at a frame has the complete state of the recording.

    Args:
        replay: the replay.
        frame: index of the frame.
    """
    episode = _episode(replay, frame)
    return any(episode <= held <= frame for held in replay.snapshots)


def _episode(replay: Recorded, frame: int) -> int:
    """The first frame of the episode that a frame lies in."""
    if checks.integer("frame", frame, 0) >= len(replay):
        raise ReplayError(f"frame: expected 0 to {len(replay) - 1}, got {frame}")
    episode = next(part for part in replay.episodes if part.start <= frame < part.stop)
    if episode.end and frame == episode.stop - 1:
        raise ReplayError(f"frame: expected one before the end of the match, got {frame}")
    return episode.start


def _played_again(
    replay: Recorded,
    held: int,
    frame: int,
    task: Task,
    recorded: Controllers | None,
    sensing: SensingSource | None,
) -> dict[str, Array]:
    """The state of the recording at a frame, from a snapshot before it."""
    if held == frame:
        return dict(replay.snapshots[held])
    if recorded is None and LEARNER in replay.controllers.values():
        raise ReplayError(
            f"frame: expected one with a snapshot ({sorted(replay.snapshots)}), as learners have "
            f"played, got {frame}"
        )
    matches = resume(
        *(replay, held, task, recorded), simulator=None, sensing=sensing, randomization=None
    )
    actions = np.zeros((1, len(matches.agents), matches.action_size), np.float32)
    for _ in range(frame - held):
        matches.step(actions)
    moved = np.abs(_positions(matches.frame)[0] - _positions(replay.frame)[frame]).max()
    if not moved <= _TOLERANCE:
        raise ReplayError(
            f"frame: expected one with a snapshot ({sorted(replay.snapshots)}), as the policies "
            f"play otherwise than in the recording: at {frame} a body is {moved:.3f} m away"
        )
    return matches.state_dict()


def _positions(frame: Frame) -> Floats:
    """Positions (n, bodies, 2) of ball and robots, m."""
    return np.concatenate([frame.ball.position[:, None], frame.robots.position], axis=1)


def _place(matches: Matches, replay: Recorded, frame: int) -> None:
    """Begin an episode with the bodies of a frame, whose rounded rows may overlap."""
    config = matches.task.config
    valid = np.empty((1, config.row_size), np.float32)
    everywhere = np.ones(1, np.bool_)
    simulator = Simulator(config, 1, Threads(1))
    simulator.place_estimates(everywhere, replay.rows[[frame]], valid)
    matches.reset(rows=valid)

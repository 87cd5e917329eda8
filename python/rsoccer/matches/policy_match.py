"""A match between policies: the one that videos and replays show for the same arguments."""

from __future__ import annotations

from rsoccer import checks
from rsoccer.controllers import Controllers, given_by_name
from rsoccer.lineup import task_for
from rsoccer.matches.loop import Matches
from rsoccer.randomization import Ranges
from rsoccer.sources import SensingSource, SimulatorSource, closed_after
from rsoccer.task import Task


def policy_match(
    task: Task | str | None,
    controllers: Controllers | None,
    seed: int,
    seconds: float,
    *,
    simulator: SimulatorSource | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
) -> Matches:
    """Prepare one match in which policies control all robots; `reset` begins it.

    Args:
        task: the task or its id; None for the task of the first trained policy among
            `controllers`, or VSSSelfPlay-v0.
        controllers: policies as `Matches` takes them, for all robots.
        seed: seed of starts and policies.
        seconds: duration of play that is asked for, above 0; checked only.
        simulator: moves the robots, as for `Matches`.
        sensing: what robots know of the true state, as for `Matches`.
        randomization: numbers that each episode draws, as for `Matches`.

    Returns:
        Matches of one world. `autoreset` is "disabled".

    Raises:
        ImportError: a text "module:name" whose module or name does not exist.
        ValueError: `seconds` is not positive, a robot has no policy, or another bad argument.
    """
    checks.positive_number("seconds", seconds)
    task = task_for(*given_by_name(controllers).values()) if task is None else task
    matches = Matches(
        task,
        seed=seed,
        controllers=controllers,
        autoreset="disabled",
        simulator=simulator,
        sensing=sensing,
        randomization=randomization,
    )
    if matches.agents:
        with closed_after(matches, simulator):
            raise ValueError(
                "controllers: expected a policy for every robot, got none for "
                f"{list(matches.agents)}"
            )
    return matches

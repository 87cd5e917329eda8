"""Episodes as a Minari data set."""

from __future__ import annotations

import json
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np

from rsoccer._core import build_info
from rsoccer.datasets.episodes import LearnerEpisode, check_continuous
from rsoccer.policies import is_registered
from rsoccer.randomization import written
from rsoccer.registry import as_task, options_of
from rsoccer.sources import make_sensing
from rsoccer.spaces import observation_space
from rsoccer.task import Task
from rsoccer.view import SIDES

if TYPE_CHECKING:
    from minari import MinariDataset


def save_minari(
    dataset_id: str,
    episodes: Sequence[LearnerEpisode],
    task: Task | str,
    *,
    author: str | None = None,
    description: str | None = None,
) -> MinariDataset:
    """Write episodes as a data set in Minari's folder (`MINARI_DATASETS_PATH`, or `~/.minari`).

    Each episode is one robot's. Its metadata have `policy`, `robot`, `seed`, and each metric of the
    task at the end of the match as `metric_<name>`, and `opponent`, `sensing` and `randomization`
    where they are not the task's own. Where one robot learns and all matches were alike, the data
    set names the environment, so that `recover_environment` makes it after `import rsoccer`.

    Args:
        dataset_id: its name in Minari, such as "rsoccer/SSLGoToBall/mixed-v0". It must be new.
        episodes: at least one episode, all of the task.
        task: the task or its name.
        author: name of the author.
        description: description of the data set.

    Returns:
        The data set, as `minari.load_dataset` would return it.

    Raises:
        ImportError: Minari is not installed.
        ValueError: no episode, episodes of another task, a discrete task, whose episodes have the
            rows of its table as actions, or a name that Minari refuses or has.
    """
    import minari
    from minari.data_collector import EpisodeBuffer

    task = as_task(task)
    sizes = {(part.observations.shape[1], part.actions.shape[1]) for part in episodes}
    if sizes != {(task.layout.size, task.action_size)}:
        raise ValueError(
            f"episodes: expected observations and actions of {task.layout.size} and "
            f"{task.action_size} numbers, as {task.name} has, got {sorted(sizes) or 'no episode'}"
        )
    check_continuous(task)
    if dataset_id in minari.list_local_datasets():
        raise ValueError(f"dataset_id: expected a new one, got {dataset_id!r}, which exists")
    policies = ", ".join(dict.fromkeys(part.policy for part in episodes))
    with warnings.catch_warnings():
        # Minari asks for a link to code and an address, which not every data set has.
        warnings.simplefilter("ignore", UserWarning)
        dataset = minari.create_dataset_from_buffers(
            dataset_id,
            [
                EpisodeBuffer(
                    id=index,
                    seed=part.seed,
                    observations=part.observations,
                    actions=part.actions,
                    rewards=part.rewards.tolist(),
                    terminations=_at_end(len(part), part.terminated),
                    truncations=_at_end(len(part), not part.terminated),
                )
                for index, part in enumerate(episodes)
            ],
            env=_spec(task, episodes),
            observation_space=observation_space(task),
            action_space=gymnasium.spaces.Box(-1.0, 1.0, (task.action_size,), np.float32),
            algorithm_name=policies,
            author=author,
            description=description,
            requirements=[f"rsoccer=={build_info()['version']}"],
        )
    dataset.storage.update_episode_metadata([_metadata(part) for part in episodes])
    dataset.storage.update_metadata(
        {"rsoccer_task": task.name, "rsoccer_physics": int(build_info()["physics"])}
    )
    return dataset


def _at_end(steps: int, value: bool) -> list[bool]:
    """Flags of an episode's steps: one at its end."""
    return [*([False] * (steps - 1)), value]


def _metadata(episode: LearnerEpisode) -> dict[str, str | float]:
    """Policy, robot, conditions and metrics of an episode."""
    metrics = {f"metric_{name}": value for name, value in episode.metrics.items()}
    varied = json.dumps(dict(episode.randomization)) if episode.randomization else ""
    given = {"opponent": episode.opponent, "sensing": episode.sensing, "randomization": varied}
    conditions = {name: text for name, text in given.items() if text}
    return {"policy": episode.policy, "robot": episode.robot, **conditions, **metrics}


def _spec(
    task: Task, episodes: Sequence[LearnerEpisode]
) -> gymnasium.envs.registration.EnvSpec | None:
    """The environment of a task in which one robot learns; None where it cannot be named."""
    name = f"rsoccer/{task.name}"
    if len(task.agents) != 1 or name not in gymnasium.registry:
        return None
    options = options_of(task)
    if options is None or not np.all([isinstance(v, str | float | int) for v in options.values()]):
        return None
    conditions = _conditions(episodes)
    if conditions is None:
        return None
    given: dict[str, Any] = {**options, **conditions}
    return gymnasium.make(name, **given).spec if given else gymnasium.spec(name)


def _conditions(episodes: Sequence[LearnerEpisode]) -> dict[str, Any] | None:
    """Arguments of an environment with the conditions of all episodes; None if there is none."""
    first = episodes[0]
    conditions = [(each.opponent, each.sensing, each.randomization) for each in episodes]
    if any(each != conditions[0] for each in conditions):
        return None
    given: dict[str, Any] = {}
    if first.opponent:
        if not is_registered(first.opponent):
            return None
        given["controllers"] = {SIDES[1]: first.opponent}
    if first.sensing:
        try:
            make_sensing(first.sensing)
        except (ImportError, TypeError, ValueError):
            return None  # a model that was an object, by the name of its class
        given["sensing"] = first.sensing
    if first.randomization:
        given["randomization"] = written(first.randomization)
    return given

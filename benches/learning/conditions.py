"""Conditions of a result: settings, physics, and the runs that it needs."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import asdict
from importlib.util import find_spec
from typing import Any, Final

from benches.learning import ppo_settings, run_files, sb3_settings
from benches.learning.experiments import CLONES, PPO, SB3, Run, Study
from benches.learning.run_files import DIGEST_DIGITS, Folders
from rsoccer._core import build_info
from rsoccer.benchmark.protocol import MATCHES
from rsoccer.policies import Policy, make_policy
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import VALUE
from rsoccer.registry import make_task
from rsoccer.train.network.observation_mask import observation_mask

MAX_CHANGE: Final = 120
"""Most characters of a change that are listed with both values."""


def settings(run: Run) -> dict[str, Any]:
    """Return all settings that decide the result of a run, as JSON values.

    `observation`, the blocks of the observation and their shapes, is not set but compared.

    Raises:
        TypeError: The algorithm has no such setting.
        ValueError: A setting outside its range.
    """
    values = _settings_of_algorithm(run)
    task = make_task(run.experiment.task, **values.get("task_options", {}))
    for name in ("network.masked_observations", "masked_observations"):
        observation_mask(task, values.get(name, ()))  # refuses unknown parts
    values["observation"] = task.layout.text
    # Results without conditions are older than these.
    if run.experiment.conditions:
        values["conditions"] = list(run.experiment.conditions)
        values["matches"] = MATCHES
    if run.experiment.senses:
        values["senses"] = dict(run.experiment.senses)
    return values


def _settings_of_algorithm(run: Run) -> dict[str, Any]:
    algorithm = run.experiment.algorithm
    if algorithm == PPO:
        return ppo_settings.settings(run)
    return _clones(run) if algorithm == CLONES else sb3_settings.settings(run)


def _clones(run: Run) -> dict[str, Any]:
    """Settings of clones: the experiment whose policy is evaluated, or the policy's name."""
    if set(run.experiment.settings) != {"policy"}:
        raise TypeError(f"expected the setting 'policy', got {sorted(run.experiment.settings)}")
    policy = str(run.experiment.settings["policy"])
    if policy.startswith("@"):
        return {"policy": policy}
    player = make_policy(policy, run.experiment.task)
    return {"policy": policy, "digest": weights_digest(player)}


def weights_digest(policy: Policy) -> str:
    """Return a digest of the weights that a network plays with, 12 hexadecimal digits.

    Its value network is no part of it, as only a lookahead plays with that.

    Args:
        policy: a policy; the digest of other policies than networks is empty.
    """
    if not isinstance(policy, Network):
        return ""
    arrays = policy.arrays()
    names = sorted(name for name in arrays if not name.startswith(f"{VALUE}."))
    content = b"".join(name.encode() + arrays[name].tobytes() for name in names)
    return hashlib.sha256(content).hexdigest()[:DIGEST_DIGITS]


def missing_library(run: Run) -> str:
    """Return the name of a library that a run needs and that is not installed, or an empty text."""
    names = {PPO: "torch", **dict.fromkeys(SB3, "stable_baselines3")}
    name = names.get(run.experiment.algorithm)
    return name if name and find_spec(name) is None else ""


def defaults(run: Run) -> dict[str, Any]:
    """Return the defaults of settings that a result may lack, as it is older than the setting."""
    algorithm = run.experiment.algorithm
    if algorithm == PPO:
        return ppo_settings.defaults()
    return {} if algorithm == CLONES else sb3_settings.defaults()


def without_effect(run: Run) -> frozenset[str]:
    """Return the names of settings that leave the result of a run as it is."""
    return ppo_settings.without_effect(run) if run.experiment.algorithm == PPO else frozenset()


def conditions(run: Run, folders: Folders) -> dict[str, Any]:
    """Return all that decides what a run learns, as JSON values, for its result.

    Args:
        run: The run.
        folders: Folders with the results of the runs that it needs.
    """
    return {
        "settings": settings(run),
        "physics": build_info()["physics"],
        "needs": run_files.needs(folders, run),
    }


def differences(
    run: Run,
    study: Study,
    folders: Folders,
    settings: Mapping[str, Any],
    result: Mapping[str, Any],
) -> list[str]:
    """Return what differs from the settings of a result and of the runs that it needed, in lines.

    A setting that is newer than the result counts as its default.

    Args:
        run: The run.
        study: Its study.
        folders: Folders with the results of the runs that it needs.
        settings: Present settings of the run.
        result: The result in its file.
    """
    protocol = {f"protocol.{name}": value for name, value in asdict(study.protocol).items()}
    kept_protocol = {f"protocol.{name}": value for name, value in result["protocol"].items()}
    now = {**settings, **protocol, "physics": build_info()["physics"]}
    ignored = without_effect(run)
    settings_then = {n: v for n, v in result["settings"].items() if n not in ignored}
    kept = {**settings_then, **kept_protocol, "physics": result["physics"]}
    missing = {n: v for n, v in defaults(run).items() if n in now and n not in kept}
    before = {**missing, **kept}
    changes = [
        _change(name, before.get(name), now.get(name))
        for name in {**now, **before}
        if now.get(name) != before.get(name)
    ]
    needed = run_files.needs(folders, run)
    return changes + [
        f"{key} has changed" for key, digest in needed.items() if result["needs"][key] != digest
    ]


def _change(name: str, before: object, now: object) -> str:
    text = f"{name} was {before!r}, now {now!r}"
    return text if len(text) <= MAX_CHANGE else f"{name} has changed"

"""Recommended settings: each entry names a task and settings, and those of the trained policies."""

import json
import shlex

import pytest

import rsoccer
from rsoccer import cli
from rsoccer.commands import distill as distill_command
from rsoccer.commands import evolve as evolve_command
from rsoccer.commands import train as train_command
from rsoccer.policies import trained
from rsoccer.policies.evolved import is_tactics
from rsoccer.policies.policy_file import read_file
from rsoccer.registry import list_aliases
from rsoccer.train import Args, RolloutSettings, task_settings
from rsoccer.train.args import CHANGEABLE_ON_RESUME
from rsoccer.train.distillation import DistillArgs
from rsoccer.train.evolution import EvolveArgs
from rsoccer.train.network.observation_mask import observation_mask
from rsoccer.train.ppo.mirror import check_symmetric

FIELDS = set(Args().to_json()) - {"task", "seed"}
FREE = FIELDS - set(CHANGEABLE_ON_RESUME) | {"samples"}


def test_entries_name_tasks_and_fields_of_the_settings() -> None:
    assert set(task_settings.TASK_SETTINGS) <= {*rsoccer.list_tasks(), *list_aliases()}
    for name, settings in task_settings.TASK_SETTINGS.items():
        assert set(settings) <= FREE, name


@pytest.mark.parametrize("name", [*rsoccer.list_tasks(), *list_aliases()])
def test_recommended_values_fit_the_task(name: str) -> None:
    args = Args.for_task(name)
    task = args.make_task()
    observation_mask(task, args.network.masked_observations)
    if args.ppo.mirror_augmentation:
        check_symmetric(task)


def test_given_values_replace_recommended_ones(monkeypatch: pytest.MonkeyPatch) -> None:
    settings = {"ppo.gamma": 0.5, "rollout.worlds": 8, "opponents.fixed": {"ou": 1.0}}
    monkeypatch.setattr(task_settings, "TASK_SETTINGS", {"VSS-v0": settings})
    args = Args.for_task("VSS-v0", rollout={"worlds": 9}, opponents={"fixed": {"chase": 2.0}})
    assert (args.task, args.ppo.gamma, args.rollout.worlds) == ("VSS-v0", 0.5, 9)
    assert args.opponents.fixed == {"chase": 2.0}, "as a whole"
    whole = Args.for_task("VSS-v0", rollout=RolloutSettings(horizon=4))
    assert whole.rollout == RolloutSettings(horizon=4)
    assert Args.for_task("VSSMulti-v0") == Args("VSSMulti-v0")
    assert Args.for_task("VSSFIRA-v0").ppo.gamma == 0.5, "the alias of VSS-v0"
    with pytest.raises(TypeError, match="horizons"):
        Args.for_task("VSS-v0", horizons=3)


TRAINED = trained.list_trained()
EVOLVED = [name for name, path in TRAINED.items() if is_tactics(read_file(path)[1])]
FILES_EVOLVED = {name: TRAINED[name] for name in EVOLVED} | trained.list_trained("opponents")


@pytest.mark.parametrize("name", FILES_EVOLVED)
def test_learned_tactics_were_made_with_the_settings_of_their_task(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    received: list[EvolveArgs] = []
    monkeypatch.setattr(evolve_command, "evolve", received.append)
    _, metadata = read_file(FILES_EVOLVED[name])
    training = json.loads(metadata["training"])
    assert cli.main(shlex.split(training["command"])[1:]) == 0
    assert received[0].to_json() == EvolveArgs.for_task(name, seed=training["seed"]).to_json()


@pytest.mark.parametrize("name", [n for n in TRAINED if n not in EVOLVED])
def test_each_trained_policy_was_made_with_the_settings_of_its_task(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Formerly that of SSLPassEnduranceMulti-v1 was not: it had a centralized critic."""
    received: list[Args] = []
    monkeypatch.setattr(train_command, "train", received.append)
    _, metadata = read_file(trained.list_trained()[name])
    training = json.loads(metadata["training"])
    assert cli.main(shlex.split(training["command"])[1:]) == 0
    threads = received[0].threads  # which change no result
    expected = Args.for_task(name, seed=training["seed"], threads=threads).to_json()
    assert received[0].to_json() == expected


@pytest.mark.parametrize("name", trained.list_trained("robust"))
def test_each_robust_policy_was_made_with_the_settings_of_its_task(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    received: list[DistillArgs | Args] = []
    monkeypatch.setattr(distill_command, "distill", received.append)
    monkeypatch.setattr(train_command, "train", received.append)
    _, metadata = read_file(trained.list_trained("robust")[name])
    training = json.loads(metadata["training"])
    assert cli.main(shlex.split(training["command"])[1:]) == 0
    expected = DistillArgs.for_task(name, seed=training["seed"]).to_json()
    if isinstance(received[0], Args):  # `best` behind a forecast, or trained on behind it
        expected = Args.for_task(name, seed=training["seed"], threads=1).to_json()
        expected |= task_settings.ROBUST_SETTINGS.get(name, {})
    # Threads change nothing in a policy, and commands name them no more.
    assert {**received[0].to_json(), "threads": 1} == expected

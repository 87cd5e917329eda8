"""Training runs: equal for equal seeds, equal after a resume, and rewards rise."""

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import torch

from rsoccer.policies.network import Network
from rsoccer.train import train
from rsoccer.train.ppo import update
from rsoccer.train.ppo.batch import Batch
from rsoccer.train.run import checkpoint
from rsoccer.train.run.log import read_progress
from rsoccer.train.run.loop import Loop
from rsoccer.train.run.state import capture
from rsoccer.train.run.stop_signal import StopSignal
from rsoccer.train.run.trainer import Trainer
from tests.train.runs import digest, progress, run_until
from tests.train.short_task import NAME, UPDATES, easy, tiny


def test_the_log_and_the_checkpoint_of_a_run_are_complete(finished: Path) -> None:
    rows = progress(finished)
    assert len(rows) == 6
    assert [int(row["samples"]) for row in rows] == [144 * k for k in range(1, 7)]
    assert sum(int(row["episodes"]) for row in rows) > 10
    assert sum(float(row["wins"]) for row in rows) > 0
    assert sum(float(row["losses"]) for row in rows) > 0
    log = read_progress(finished)
    elapsed = np.diff(log["seconds"], prepend=0.0)
    np.testing.assert_allclose(log["samples_per_second"] * elapsed, 144, rtol=1e-6)
    arrays = checkpoint.load(finished / checkpoint.FILE_NAME).arrays
    assert set(arrays["worlds.yellow_0.drawn"].tolist()) & {2, 3}, "no past policy plays"
    assert arrays["pool.frozen_at"].tolist() == [5, 6]
    settings = json.loads((finished / "args.json").read_text())
    assert settings["task"] == NAME and settings["rollout.worlds"] == 6
    assert not log["time_opponents"][:3].any() and log["time_opponents"][3:].all(), "solo, teams"
    [events] = (finished / "tensorboard").iterdir()
    assert events.read_bytes().count(b"value_loss") == 6


def test_the_log_has_the_share_of_each_part_of_the_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The time of matches is that of physics, opponents and tasks."""
    trainer = Trainer(tiny(tmp_path))
    shares = {"acting": 0.05, "learning": 0.25, "matches": 0.625, "physics": 0.25}
    monkeypatch.setattr(trainer.clock, "take", lambda: (2.0, {**shares, "opponents": 0.125}))
    Loop(trainer, {}).run(StopSignal(), 0)
    log = read_progress(tmp_path)
    times = {name: values[-1] for name, values in log.items() if name.startswith("time_")}
    assert times == {
        "time_acting": 0.05,
        "time_ladder": 0.0,
        "time_learning": 0.25,
        "time_opponents": 0.125,
        "time_physics": 0.25,
        "time_tasks": 0.25,
    }
    assert log["seconds"].tolist() == [2.0, 4.0, 6.0, 8.0, 10.0, 12.0]
    assert set(log["samples_per_second"]) == {72.0}


def test_the_same_seed_gives_the_same_run(finished: Path, tmp_path: Path) -> None:
    torch.manual_seed(123)  # global generators must not matter
    np.random.seed(5)  # noqa: NPY002
    train(tiny(tmp_path / "same"))
    assert digest(tmp_path / "same") == digest(finished)
    train(tiny(tmp_path / "other", seed=1))
    assert digest(tmp_path / "other") != digest(finished)


def test_training_does_not_use_global_generators(tmp_path: Path) -> None:
    torch.manual_seed(7)
    np.random.seed(7)  # noqa: NPY002
    expected = torch.rand(3).tolist(), np.random.rand(3).tolist()  # noqa: NPY002
    torch.manual_seed(7)
    np.random.seed(7)  # noqa: NPY002
    train(tiny(tmp_path, samples=144))
    assert (torch.rand(3).tolist(), np.random.rand(3).tolist()) == expected  # noqa: NPY002


# An update has 8 checks in the rollout, 4 in the minibatches and one at the end.
@pytest.mark.parametrize(
    ("checks", "updates"), [(0, 0), (3, 0), (13 + 4, 1), (3 * 13 + 10, 3), (5 * 13 + 12, 6)]
)
def test_a_resumed_run_equals_the_uninterrupted_one(
    checks: int, updates: int, finished: Path, tmp_path: Path
) -> None:
    assert run_until(tiny(tmp_path), checks) == updates
    saved = checkpoint.load(tmp_path / checkpoint.FILE_NAME)
    assert saved.info["updates"] == updates
    assert digest(tmp_path) != digest(finished) or updates == 6
    train(tiny(tmp_path, resume=True))
    assert digest(tmp_path) == digest(finished)
    assert progress(tmp_path) == progress(finished)
    policies = [Network.load(folder / "policy.safetensors") for folder in (tmp_path, finished)]
    resumed, expected = (policy.arrays() for policy in policies)
    assert all(resumed[name].tobytes() == expected[name].tobytes() for name in expected)


def test_a_run_that_is_killed_in_its_first_update_has_a_checkpoint(tmp_path: Path) -> None:
    class Killed(StopSignal):
        def check(self) -> None:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        Loop(Trainer(tiny(tmp_path)), {}).run(Killed(), 0)
    assert checkpoint.load(tmp_path / checkpoint.FILE_NAME).info["updates"] == 0


def test_rows_after_the_checkpoint_are_dropped(finished: Path, tmp_path: Path) -> None:
    run_until(tiny(tmp_path), 2 * 13)
    with (tmp_path / "progress.csv").open("a") as file:
        file.write("a row from before a crash")
    train(tiny(tmp_path, resume=True))
    assert progress(tmp_path) == progress(finished)


def test_a_task_with_one_learning_team_keeps_its_own_opponent(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, task="VSSMulti-v0", solo_fraction=0))
    assert trainer.pool is None
    assert trainer.collector.matches.agents == ("blue_0", "blue_1", "blue_2")
    train(tiny(tmp_path, task="VSSMulti-v0", samples=144))
    assert Network.load(tmp_path / "policy.safetensors").task_name == "VSSMulti-v0"


def test_a_run_starts_solo_and_continues_with_self_play(tmp_path: Path) -> None:
    args = tiny(tmp_path)
    trainer = Trainer(args)
    assert list(trainer.collector.matches.agents) == ["blue_0"]
    assert trainer.collector.matches.worlds == args.rollout.worlds * 3, (
        "as many learners as in self-play"
    )
    Loop(trainer, {}).run(StopSignal(), 0)
    assert list(trainer.collector.matches.agents) == ["blue_0", "blue_1", "blue_2"]
    assert not trainer.is_solo
    scores = [row["episode_latest/goal_score"] for row in progress(tmp_path)]
    assert set(scores[:3]) == {"nan"}, "solo learners meet the ou policy only"


@pytest.mark.parametrize("share", [0.34, 0.5])
def test_whole_teams_follow_once_after_the_solo_part(share: float, tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, solo_fraction=share))
    collect, seen = trainer.collect_rollout, []

    def noting(check_stop: Callable[[], None]) -> Batch:
        seen.append((len(trainer.collector.matches.agents), trainer.collector.matches))
        return collect(check_stop)

    trainer.collect_rollout = noting  # type: ignore[method-assign]
    Loop(trainer, {}).run(StopSignal(), 0)
    assert [learners for learners, _ in seen] == [1, 1, 1, 3, 3, 3], "of whole updates"
    assert len({id(matches) for _, matches in seen}) == 2


def test_actions_spread_as_much_as_the_settings_say(tmp_path: Path) -> None:
    args = tiny(tmp_path, action_std=0.8, final_action_std=0.2)
    trainer = Trainer(args)
    stds = [trainer.network().action_std]
    while trainer.samples < args.samples:
        trainer.update(trainer.collect_rollout(lambda: None), lambda: None)
        stds.append(trainer.network().action_std)
    expected = 0.8 * 0.25 ** (np.arange(7) / 6)
    assert np.array(stds) == pytest.approx(np.repeat(expected[:, None], 2, axis=1), rel=1e-5)


def test_the_first_policy_plays_the_initial_action(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, initial_action=(0.5, -0.25)))
    observations = trainer.collector.observations
    actions = trainer.network().mean_actions(observations)
    assert np.abs(actions - np.array([0.5, -0.25], np.float32)).max() < 0.1


def test_components_without_a_number_begin_at_0(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, initial_action=(0.5,)))
    actions = trainer.network().mean_actions(trainer.collector.observations)
    assert np.abs(actions - np.array([0.5, 0.0], np.float32)).max() < 0.1


def test_an_initial_action_of_another_size_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"initial_action must have at most 2 numbers.*got 3"):
        train(tiny(tmp_path / "run", initial_action=(0.0, 0.0, 0.0)))
    assert not (tmp_path / "run" / "args.json").exists()


def test_a_minibatch_has_two_samples_or_more(tmp_path: Path) -> None:
    message = r"n_minibatches must be at most half of the 6 samples of an update.*got 4"
    with pytest.raises(ValueError, match=message):
        train(tiny(tmp_path / "run", task="VSS-v0", worlds=2, horizon=3, n_minibatches=4))
    assert not (tmp_path / "run").exists()
    Trainer(
        tiny(
            tmp_path, task="VSS-v0", worlds=2, horizon=3, n_minibatches=6, mirror_augmentation=True
        )
    )


def test_a_run_that_diverges_keeps_its_last_checkpoint(tmp_path: Path) -> None:
    args = tiny(tmp_path, checkpoint_interval=1e-9)
    trainer = Trainer(args)
    run = trainer.update

    def diverge(batch: Batch, check_stop: Callable[[], None]) -> None:
        if trainer.updates == 2:
            trainer.model.log_std.data[0] = torch.nan
        run(batch, check_stop)

    trainer.update = diverge  # type: ignore[method-assign]
    with pytest.raises(ValueError, match=r"training diverged after 432 samples.*learning_rate"):
        Loop(trainer, {}).run(StopSignal(), 0)
    saved = checkpoint.load(tmp_path / checkpoint.FILE_NAME)
    assert saved.info["updates"] == 2
    assert all(np.isfinite(part).all() for part in saved.arrays.values() if part.dtype.kind == "f")


def test_a_single_weight_that_is_not_finite_is_a_divergence(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path))
    run = trainer.ppo.update

    def spoil(
        batch: Batch,
        learning_rate: float,
        check_stop: Callable[[], None],
        *,
        critic_only: bool = False,
    ) -> dict[str, float]:
        stats = run(batch, learning_rate, check_stop, critic_only=critic_only)
        next(trainer.model.actor.parameters()).data[0, 0] = torch.inf
        return stats

    trainer.ppo.update = spoil  # type: ignore[method-assign]
    with pytest.raises(ValueError, match="training diverged after 144 samples"):
        trainer.update(trainer.collect_rollout(lambda: None), lambda: None)


def test_training_raises_the_reward(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(update, "TARGET_KL", 1.0)
    args = easy(tmp_path)
    trainer, rewards = Trainer(args), []
    for _ in range(UPDATES):
        trainer.update(trainer.collect_rollout(lambda: None), lambda: None)
        rewards.append(trainer.collector.reward_means["reward"] / args.rollout.action_repeat)
    assert abs(rewards[0]) < 0.1, "untrained"
    assert rewards[-1] > 0.6, "the maximum is 1, at full power ahead"


def test_capturing_the_state_does_not_change_the_run(tmp_path: Path) -> None:
    first, second = Trainer(tiny(tmp_path)), Trainer(tiny(tmp_path))
    for _ in range(2):
        capture(first, {}, 0)
        for trainer in (first, second):
            trainer.update(trainer.collect_rollout(lambda: None), lambda: None)
    left, right = capture(first, {}, 0).arrays, capture(second, {}, 0).arrays
    assert all(left[name].tobytes() == right[name].tobytes() for name in left)

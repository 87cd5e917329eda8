"""Learning by playing: PPO (Schulman et al. 2017) with one policy shared by all learners.

Reads top to bottom: one decision, the estimate of what each decision was worth, then the run,
which plays, learns and keeps itself on disk. A task is seen through `Matches` and `Outcome` only.
Time limits are bootstrapped: a match cut off by the clock is worth what the value network expects
of its last true observation. Goals are not.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from torch import Tensor, nn

from rsoccer.files import write_atomically
from rsoccer.frame import Array, Floats, Mask
from rsoccer.matches import Matches
from rsoccer.policies.network import Network
from rsoccer.registry import make_task
from rsoccer.train import checkpoint
from rsoccer.train.args import SETTINGS_FILE, Args
from rsoccer.train.checkpoint import Checkpoint
from rsoccer.train.curriculum import Curriculum
from rsoccer.train.log import EpisodeStats, Log, Row
from rsoccer.train.networks import OBSERVATION_CLIP, ActorCritic
from rsoccer.train.opponent_pool import KINDS, kinds
from rsoccer.train.run_state import capture, restore
from rsoccer.train.running_mean_std import RunningMeanStd
from rsoccer.train.stop_signal import Interrupted, Stop, Stopped
from rsoccer.train.timing import Clock

POLICY_FILE = "policy.safetensors"
UNTRAINED_FILE = "untrained.safetensors"


# -- One decision -----------------------------------------------------------------------------


@dataclass
class Decision:
    """What came of holding one action for some control steps."""

    observations: Floats  # (n, agents, o) true last ones, also where the episode ended
    rewards: Floats  # (n, agents) summed over the control steps
    terms: dict[str, float]  # mean over worlds and agents of each reward term
    terminated: Mask  # (n,)
    ended: Mask  # (n,) terminated, or out of time
    metrics: dict[str, Array]  # (n,) valid where ended


def decide(matches: Matches, actions: Floats, repeat: int) -> Decision:
    """Hold `actions` (n, agents, action) for `repeat` control steps, or until a match ends.

    `matches` must not restart by itself: a match that ends within the repeat waits for the next
    decision, so no reward of one episode is paid for an action taken in another.
    """
    outcome = matches.step(actions)
    result = Decision(
        outcome.observations,
        outcome.rewards,
        {name: float(term.mean()) for name, term in outcome.terms.items()},
        outcome.terminated,
        outcome.ended,
        outcome.metrics,
    )
    for _ in range(repeat - 1):
        playing = ~result.ended
        outcome = matches.step(actions)
        result.rewards += outcome.rewards * playing[:, None]
        for name, term in outcome.terms.items():
            result.terms[name] += float((term * playing[:, None]).mean())
        result.observations[playing] = outcome.observations[playing]
        result.terminated |= outcome.terminated & playing
        result.ended |= outcome.ended & playing
        for name, values in outcome.metrics.items():
            result.metrics[name][playing] = values[playing]
    return result


# -- What decisions were worth ----------------------------------------------------------------


def advantages(
    rewards: Tensor,
    values: Tensor,
    next_values: Tensor,
    terminated: Tensor,
    ended: Tensor,
    gamma: float,
    gae_lambda: float,
) -> Tensor:
    """How much better each decision was than expected, (decisions, robots), by GAE.

    All arguments are (decisions, robots). `next_values` are of the true next observation, so an
    episode that ran out of time counts what it could have gone on to; a terminated one does not.
    """
    result, later = torch.zeros_like(rewards), torch.zeros_like(rewards[0])
    for t in reversed(range(len(rewards))):
        expected = gamma * next_values[t] * ~terminated[t]
        surprise = rewards[t] + expected - values[t]
        later = surprise + gamma * gae_lambda * later * ~ended[t]
        result[t] = later
    return result


@dataclass
class Batch:
    """Decisions to learn from, (size, ...), where size is decisions x worlds x agents."""

    observations: Tensor
    actions: Tensor
    log_probs: Tensor
    advantages: Tensor
    returns: Tensor


# -- The run ----------------------------------------------------------------------------------


class Trainer:
    """A run: everything that changes while it learns."""

    def __init__(self, args: Args) -> None:
        """A fresh run; `state.restore` turns it into a saved one."""
        torch.set_num_threads(args.torch_threads)
        words = np.random.SeedSequence(args.seed).generate_state(3, np.uint64) >> np.uint64(1)
        self.seeds = words.tolist()
        self.args, self.clock = args, Clock()
        self.task = make_task(args.task)
        self.generator = torch.Generator().manual_seed(self.seeds[0])
        self.curriculum = Curriculum(args, self.task, self.clock)
        self.pool, self.is_solo = self.curriculum.pool, self.curriculum.starts_solo
        opened = self.curriculum.solo if self.is_solo else self.curriculum.self_play
        self._enter(opened(self.seeds[1]))
        sizes = (self.matches.observation_size, self.task.action_size)
        self.model = ActorCritic(*sizes, args.hidden_sizes, args.action_std, self.generator)
        self.optimiser = torch.optim.Adam(
            self.model.parameters(), lr=args.learning_rate, eps=1e-5, foreach=True
        )
        self.obs_rms, self.return_rms = (
            RunningMeanStd(sizes[0]),
            RunningMeanStd(1, smallest_std=1e-6),
        )
        self.gamma = args.gamma**args.action_repeat
        self.episode_stats = EpisodeStats(KINDS)
        self.row: Row = {}
        self.samples, self.updates, self.elapsed = 0, 0, 0.0
        if self.pool is not None:
            self.pool.latest = self.network()

    def start_self_play(self) -> None:
        """Let all learners play, from where the lone one has come."""
        self.is_solo = False
        self._enter(self.curriculum.self_play(self.seeds[2]))

    def _enter(self, matches: Matches) -> None:
        """Begin to play these matches."""
        self.matches = matches
        self.returns = np.zeros((matches.worlds, len(matches.agents)), np.float32)
        self.observations = matches.reset()

    # -- Playing --

    def play(self, check: Callable[[], None]) -> Batch:
        """Play `horizon` decisions in every world with the present policy."""
        steps: list[tuple[Tensor, ...]] = []
        raw: list[Floats] = []
        for _ in range(self.args.horizon):
            check()
            raw.append(self.observations)
            steps.append(self._play_decision())
        self.obs_rms.update(np.concatenate(raw).reshape(-1, self.matches.observation_size))
        self.samples += self.args.horizon * self.returns.size
        return self._make_batch(*(torch.stack(parts) for parts in zip(*steps, strict=True)))

    @torch.no_grad()
    def _play_decision(self) -> tuple[Tensor, ...]:
        """One decision in every world, (worlds x agents, ...), in the order of `_make_batch`."""
        with self.clock.measure("acting"):
            observations = self._normalise(self.observations)
            mean = self.model.actor(observations)
            noise = torch.randn(mean.shape, generator=self.generator)
            actions = mean + noise * self.model.log_std.exp()
            log_probs = self.model.log_prob(mean, actions)
        with self.clock.measure("matches"):
            shape = (*self.returns.shape, self.task.action_size)
            decision = decide(self.matches, actions.numpy().reshape(shape), self.args.action_repeat)
            self._record(decision)
            restarted = decision.ended | self._draw_truncations()
            self.returns[restarted] = 0.0
            self.observations = decision.observations
            if restarted.any():
                self.observations = self.matches.reset(mask=restarted)
        agents = self.returns.shape[1]
        return (
            observations,
            actions,
            log_probs,
            torch.tensor(decision.rewards.reshape(-1)),
            self._normalise(decision.observations),
            torch.tensor(np.repeat(decision.terminated, agents)),
            torch.tensor(np.repeat(restarted, agents)),
        )

    def _draw_truncations(self) -> Mask:
        """Matches to end before their time, (n,); their value goes on, as at a time limit."""
        drawn = torch.rand(len(self.returns), generator=self.generator)
        return (drawn < self.args.random_truncation).numpy()

    def _record(self, decision: Decision) -> None:
        """Keep count of rewards and of ended matches."""
        self.returns = self.returns * np.float32(self.gamma) + decision.rewards
        self.return_rms.update(self.returns.reshape(-1, 1))
        ended = decision.ended
        opponents = np.zeros(len(ended), int)
        if self.pool is not None and not self.is_solo:
            opponents = kinds(self.pool.opponents)
        metrics = {name: values[ended] for name, values in decision.metrics.items()}
        self.episode_stats.add(opponents[ended], metrics)
        for name, value in {**decision.terms, "reward": float(decision.rewards.mean())}.items():
            key = name if name == "reward" else f"reward_{name}"
            self.row[key] = self.row.get(key, 0.0) + value / self.args.horizon

    def _make_batch(self, *played: Tensor) -> Batch:
        """A batch to learn from, out of all decisions (decisions, robots, ...)."""
        observations, actions, log_probs, rewards, nexts, terminated, ended = played
        with self.clock.measure("learning"), torch.no_grad():
            values, next_values = self.model.value(observations), self.model.value(nexts)
            scaled = rewards / float(self.return_rms.std[0])
            chances = (terminated, ended, self.gamma, self.args.gae_lambda)
            better = advantages(scaled, values, next_values, *chances)
            batch = (observations, actions, log_probs, better, better + values)
            return Batch(*(part.flatten(0, 1) for part in batch))

    def _normalise(self, observations: Floats) -> Tensor:
        """Observations (..., o) as the networks take them, (robots, o)."""
        mean, std = self.obs_rms.as_floats()
        flat = observations.reshape(-1, observations.shape[-1])
        return torch.tensor(np.clip((flat - mean) / std, -OBSERVATION_CLIP, OBSERVATION_CLIP))

    # -- Learning --

    def learn(self, batch: Batch, check: Callable[[], None]) -> None:
        """Improve the policy and the value network on a batch, some epochs long."""
        done = min(self.samples / self.args.samples, 1.0)
        rate = self.args.learning_rate * (1.0 - 0.9 * done)
        self.optimiser.param_groups[0]["lr"] = rate
        with self.clock.measure("learning"):
            epochs, approx_kl = 0, 0.0
            while epochs < self.args.n_epochs and approx_kl <= self.args.target_kl:
                approx_kl = self._learn_epoch(batch, check)
                epochs += 1
        self.updates += 1
        self.row.update(
            approx_kl=approx_kl,
            epochs=epochs,
            learning_rate=rate,
            action_std=float(self.model.log_std.detach().exp().mean()),
        )
        self._update_pool()

    def _learn_epoch(self, batch: Batch, check: Callable[[], None]) -> float:
        """One pass over the batch; the mean KL divergence from the policy that played."""
        order = torch.randperm(len(batch.returns), generator=self.generator)
        stats = []
        for part in order.chunk(self.args.n_minibatches):
            check()
            loss, stats_of_part = self._loss(batch, part)
            self.optimiser.zero_grad()
            loss.backward()  # type: ignore[no-untyped-call]
            nn.utils.clip_grad_norm_(self.model.parameters(), self.args.max_grad_norm)
            self.optimiser.step()
            stats.append(stats_of_part)
        approx_kl, clip_fraction, value_loss = torch.stack(stats).mean(0).tolist()
        self.row.update(clip_fraction=clip_fraction, value_loss=value_loss)
        return float(approx_kl)

    def _loss(self, batch: Batch, part: Tensor) -> tuple[Tensor, Tensor]:
        """PPO's clipped loss on part of the batch; and approx_kl, share clip_fraction, value error."""
        args, observations = self.args, batch.observations[part]
        better = batch.advantages[part]
        better = (better - better.mean()) / (better.std() + 1e-8)
        density = self.model.log_prob(self.model.actor(observations), batch.actions[part])
        change = density - batch.log_probs[part]
        ratio = change.exp()
        bounded = ratio.clamp(1 - args.clip_range, 1 + args.clip_range)
        policy_loss = -torch.minimum(ratio * better, bounded * better).mean()
        value_loss = (self.model.value(observations) - batch.returns[part]).square().mean()
        loss = policy_loss + args.value_coef * value_loss
        loss = loss - args.entropy_coef * self.model.entropy()
        with torch.no_grad():
            approx_kl = (ratio - 1 - change).mean()
            clip_fraction = ((ratio - 1).abs() > args.clip_range).float().mean()
            return loss, torch.stack([approx_kl, clip_fraction, value_loss])

    def _update_pool(self) -> None:
        """Let the pool play the policy that was just learned, and keep it now and then."""
        if self.pool is None:
            return
        self.pool.latest = self.network()
        if self.updates % self.args.pool_interval == 0:
            self.pool.freeze(self.pool.latest, self.updates)

    # -- Keeping --

    def network(self) -> Network:
        """The present policy as it plays here, in NumPy."""
        name, repeat = self.args.task, self.args.action_repeat
        return self.model.export(self.task, name, repeat, *self.obs_rms.as_floats())

    def save(self, saved: Checkpoint) -> None:
        """Put a checkpoint, and the policy of the same moment, on disk."""
        checkpoint.save(self.args.out / checkpoint.FILE_NAME, saved)
        self.network().save(self.args.out / POLICY_FILE)

    # -- All of it --

    def run(self, stop: Stop, log_size: int) -> None:
        """Play and learn until the samples are used up or a signal comes; either way save."""
        log = Log(self.args, self.samples, log_size)
        saved, saved_at = capture(self, log.size), time.monotonic()
        self.save(saved)
        try:
            while self.samples < self.args.samples:
                self.learn(self.play(stop.check), stop.check)
                self._report(log)
                if self.is_solo and self.samples >= self.args.solo_fraction * self.args.samples:
                    self.start_self_play()
                saved = capture(self, log.size)
                if time.monotonic() - saved_at > self.args.checkpoint_interval:
                    self.save(saved)
                    saved_at = time.monotonic()
                stop.check()
        except Stopped:
            restore(self, saved)  # drop the update that the signal cut short
            self.save(saved)
            raise
        finally:
            log.close()
        self.save(saved)

    def _report(self, log: Log) -> None:
        """Log the update that just ended."""
        seconds, shares = self.clock.take()
        self.elapsed += seconds
        # The same columns whether or not a pool plays: a lone learner meets none.
        shares = {"physics": 0.0, "opponents": 0.0, **shares}
        shares["tasks"] = shares.pop("matches") - shares["physics"] - shares["opponents"]
        row = {
            "update": self.updates,
            "samples": self.samples,
            "seconds": self.elapsed,
            "samples_per_second": self.args.horizon * self.returns.size / seconds,
            **self.episode_stats.take(),
            **self.row,
            **{f"time_{part}": share for part, share in sorted(shares.items())},
        }
        self.row = {}
        log.write(self.samples, row)


def train(args: Args) -> Path:
    """Run the training that `args` describe; the path of the policy file."""
    saved = _open_run(args)
    trainer, log_size = Trainer(args), 0
    if saved is None:
        trainer.network().save(args.out / UNTRAINED_FILE)
    else:
        restore(trainer, saved)
        log_size = saved.info["log_size"]
    with Stop() as stop:
        try:
            trainer.run(stop, log_size)
        except Stopped:
            sys.stderr.write(
                f"{stop.name}: saved after {trainer.samples:,} of {args.samples:,} samples in "
                f"{args.out}; go on with --resume\n"
            )
            raise Interrupted(stop.status) from None
    return args.out / POLICY_FILE


def _open_run(args: Args) -> Checkpoint | None:
    """Make sure that the run can be kept in `out`; the checkpoint to go on from, if any."""
    path = args.out / checkpoint.FILE_NAME
    saved = checkpoint.load(path) if args.resume else None
    if saved is not None and (changed := args.differences(saved.info["args"])):
        raise ValueError(f"{path} is of a run with other settings: {'; '.join(changed)}")
    checkpoint.prepare_folder(args.out)
    if path.exists() and not (args.resume or args.overwrite):
        raise ValueError(f"out: {args.out} holds a run; set resume, overwrite, or another folder")
    settings = json.dumps(args.to_json(), indent=2)
    write_atomically(args.out / SETTINGS_FILE, settings.encode())
    return saved

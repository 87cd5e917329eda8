"""The parts of a training run in turn: rollouts, PPO updates, logs, checkpoints.

One policy is shared by all learners. `rollout` plays the matches, `gae` estimates the advantages,
`ppo` updates the networks, `curriculum` chooses the matches, `run_state` captures and restores the
state.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
import torch

from rsoccer.policies.network import Network
from rsoccer.train import checkpoint
from rsoccer.train.args import Args
from rsoccer.train.batch import Batch
from rsoccer.train.checkpoint import Checkpoint
from rsoccer.train.curriculum import Curriculum
from rsoccer.train.discount import discount_per_decision
from rsoccer.train.ladder import Ladder
from rsoccer.train.learning_rate import LearningRate
from rsoccer.train.log import Logger, Row
from rsoccer.train.mirror import check_symmetric, with_reflections
from rsoccer.train.networks import ActorCritic
from rsoccer.train.observation_mask import observation_mask
from rsoccer.train.ppo import PPO
from rsoccer.train.rollout import RolloutCollector
from rsoccer.train.run_folder import POLICY_FILE, policy_digests
from rsoccer.train.run_state import capture, restore
from rsoccer.train.stop_signal import Stopped, StopSignal
from rsoccer.train.timing import Clock
from rsoccer.train.weight_sharing import WeightSharing, robot_slots


class Trainer:
    """State of a training run, and its updates.

    Attributes:
        args: settings of the run.
        task: the task to train on.
        clock: measures the time of each part.
        generator: draws weights, actions, truncations and minibatches.
        curriculum: creates the matches.
        pool: opponents of the learners if both teams learn, else None.
        is_solo: True while one robot per match learns.
        model: policy and value network.
        collector: plays the matches.
        ladder: measures the policy against fixed opponents.
        ppo: updates the model.
        learning_rate: step size of the updates.
        update_stats: columns of the log from the last update of the model.
        policy_files: digests of the policy files that play beside the learners, by name.
        samples: decisions that were learned from.
        updates: number of updates.
        elapsed: seconds of training, summed over resumed runs.
    """

    def __init__(self, args: Args) -> None:
        """Create a new run; `run_state.restore` continues a saved one.

        Args:
            args: settings of the run.

        Raises:
            ValueError: settings that do not fit the task or each other.
        """
        torch.set_num_threads(args.torch_threads)
        words = np.random.SeedSequence(args.seed).generate_state(3, np.uint64) >> np.uint64(1)
        torch_seed, self._first_seed, self._self_play_seed = words.tolist()
        self.args, self.clock = args, Clock()
        self.task = args.make_task()
        if args.mirror_augmentation:
            check_symmetric(self.task)
        self.generator = torch.Generator().manual_seed(torch_seed)
        self.curriculum = Curriculum(args, self.task, self.clock)
        samples = args.worlds * args.horizon * len(self.curriculum.learners)
        samples *= 2 if args.mirror_augmentation else 1
        if samples < 2 * args.n_minibatches:  # advantages are normalised within a minibatch
            raise ValueError(
                f"n_minibatches must be at most half of the {samples} samples of an update "
                f"(worlds x horizon x learners), got {args.n_minibatches}"
            )
        self.pool, self.is_solo = self.curriculum.pool, self.curriculum.starts_solo
        create = self.curriculum.solo if self.is_solo else self.curriculum.self_play
        matches = create(self._first_seed)
        sizes = (matches.observation_size, self.task.action_size)
        slots = robot_slots(self.task) if args.robot_units else []
        shared_units = args.robot_units * sum(len(columns) for columns in slots)
        first, *others = args.hidden_sizes
        self.model = ActorCritic(
            *sizes,
            (first + shared_units, *others),
            args.action_std,
            self.generator,
            state_size=matches.state_size if args.central_critic else 0,
            learn_action_std=args.final_action_std is None,
            mask=observation_mask(self.task, args.masked_observations),
        )
        sharing: WeightSharing | None = None
        if slots:
            sharing = WeightSharing(slots, args.robot_units, sizes[0], self.model)
            sharing.tie(self.model)
        if args.initial_action:
            self.model.set_mean_action(args.initial_action)
        self.collector = RolloutCollector(
            args, self.task, self.model, self.generator, self.clock, self.curriculum.kinds
        )
        self.collector.enter(matches, None if self.is_solo else self.curriculum.opponents)
        self.ladder = Ladder(args, self.task)
        self.ppo = PPO(args, self.model, self.generator, sharing)
        self.learning_rate = LearningRate(args)
        self.policy_files = policy_digests(args)
        self.update_stats: Row = {}
        self.samples, self.updates, self.elapsed = 0, 0, 0.0
        self.show_policy()

    def show_policy(self) -> None:
        """Make the current policy the latest one of all pools, and set its share beside itself."""
        partners = self.curriculum.partners
        pools = [pool for pool in (self.pool, partners) if pool is not None]
        if pools:
            network = self.network()
            for pool in pools:
                pool.latest = network
        if partners is not None:
            part = self.args.solo_fraction * self.args.samples
            partners.set_shares(self.args.solo_copies * min(self.samples / part, 1.0), 0.0)

    def start_self_play(self) -> None:
        """Begin the second part of the run, in which all learners play."""
        self.is_solo = False
        matches = self.curriculum.self_play(self._self_play_seed)
        self.collector.enter(matches, self.curriculum.opponents)

    @property
    def progress(self) -> float:
        """Share of the run's samples so far, 0 to 1."""
        return min(self.samples / self.args.samples, 1.0)

    def collect_rollout(self, check_stop: Callable[[], None]) -> Batch:
        """Play `horizon` decisions in every world, and count them as samples.

        Args:
            check_stop: called before each decision; an exception that it raises ends the rollout.

        Returns:
            Batch of horizon x worlds x agents samples.
        """
        self.collector.gamma = discount_per_decision(self.args, self.progress)
        batch = self.collector.collect(check_stop)
        self.samples += len(batch)
        return batch

    def update(self, batch: Batch, check_stop: Callable[[], None]) -> None:
        """Train the model on a batch, and put its new policy into the pool.

        Args:
            batch: samples from `collect_rollout`.
            check_stop: called before each minibatch; an exception that it raises ends the update.

        Raises:
            ValueError: the networks have NaN or infinite weights now.
        """
        learning_rate = self.learning_rate.start_update(self.progress)
        with self.clock.measure("learning"):
            if self.args.mirror_augmentation:
                batch = with_reflections(batch, self.task, self.model)
            self.update_stats = self.ppo.update(batch, learning_rate, check_stop)
        self._check_finite()
        stats = self.update_stats
        self.learning_rate.end_update(stats["n_epochs"], stats["approx_kl"])
        self.updates += 1
        if self.args.final_action_std is not None:
            ratio = self.args.final_action_std / self.args.action_std
            self.model.set_action_std(self.args.action_std * ratio**self.progress)
        self._update_pool()

    def _check_finite(self) -> None:
        """Raise ValueError if training has diverged, before it replaces the last checkpoint."""
        if not all(bool(part.isfinite().all()) for part in self.model.state_dict().values()):
            raise ValueError(
                f"training diverged after {self.samples:,} samples: weights are NaN or infinite; "
                f"lower learning_rate ({self.args.learning_rate:g}) or max_grad_norm "
                f"({self.args.max_grad_norm:g}); the last checkpoint is kept"
            )

    def _update_pool(self) -> None:
        """Make the new policy the latest one, and freeze it every `pool_interval` updates."""
        self.show_policy()
        if self.pool is not None and self.updates % self.args.pool_interval == 0:
            assert self.pool.latest is not None, "the policy was shown"
            self.pool.freeze(self.pool.latest, self.updates)

    def network(self) -> Network:
        """Return the current policy in NumPy."""
        mean, std = self.collector.obs_rms.as_float32()
        return self.model.export(self.task, self.args, mean, std)

    def save(self, saved: Checkpoint) -> None:
        """Write a checkpoint and the current policy to the run's folder.

        Args:
            saved: state of the run, captured after the last update.
        """
        checkpoint.save(self.args.out / checkpoint.FILE_NAME, saved)
        self.network().save(self.args.out / POLICY_FILE)

    def run(self, stop: StopSignal, log_size: int) -> None:
        """Train until the samples are used up or a signal comes, and save in both cases.

        Args:
            stop: reports a signal.
            log_size: bytes of the log's CSV file to keep; 0 for a new run.

        Raises:
            Stopped: a signal came. The update in progress was dropped.
        """
        logger = Logger(self.args, self.samples, log_size)
        saved, saved_at = capture(self, logger.size), time.monotonic()
        self.save(saved)
        try:
            while self.samples < self.args.samples:
                batch = self.collect_rollout(stop.check)
                self.update(batch, stop.check)
                self._log_update(logger, len(batch))
                if self.is_solo and self.samples >= self.args.solo_fraction * self.args.samples:
                    self.start_self_play()
                saved = capture(self, logger.size)
                if time.monotonic() - saved_at > self.args.checkpoint_interval:
                    self.save(saved)
                    saved_at = time.monotonic()
                stop.check()
        except Stopped:
            restore(self, saved)  # drop the update that the signal cut short
            self.save(saved)
            raise
        finally:
            logger.close()
        self.save(saved)

    def _log_update(self, logger: Logger, batch_size: int) -> None:
        """Log the last update, which learned from `batch_size` samples."""
        strength = self.ladder.skip()
        if self.ladder.is_due(self.updates, self.samples):
            with self.clock.measure("ladder"):
                strength = self.ladder.measure(self.network())
        seconds, shares = self.clock.take()
        self.elapsed += seconds
        # The columns are the same in all updates: solo learners meet no pool.
        shares = {"ladder": 0.0, "opponents": 0.0, "physics": 0.0, **shares}
        shares["tasks"] = shares.pop("matches") - shares["physics"] - shares["opponents"]
        row = {
            "update": self.updates,
            "samples": self.samples,
            "seconds": self.elapsed,
            "samples_per_second": batch_size / seconds,
            **self.collector.episode_stats.take(),
            **strength,
            **self.collector.reward_means,
            **self.update_stats,
            **{f"time_{part}": share for part, share in sorted(shares.items())},
        }
        logger.write(self.samples, row)

"""The parts of a training run: the matches, the networks, their updates, and what they count.

One policy is shared by all learners. `opponents` chooses the matches, `rollout` plays them, `ppo`
updates the networks. `loop` runs one update after the other, `state` captures and restores them.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable

import numpy as np
import torch

from rsoccer.history import ObservationStack
from rsoccer.matches import Matches
from rsoccer.policies import training_conditions
from rsoccer.policies.layers import read_layers
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import Value
from rsoccer.policies.shield import Shield, check_shield
from rsoccer.sources import closed_on_error
from rsoccer.train.args import Args
from rsoccer.train.clock import Clock
from rsoccer.train.network import initial_policy
from rsoccer.train.network.build import build_networks
from rsoccer.train.network.evaluator import Evaluator
from rsoccer.train.opponents.curriculum import Curriculum
from rsoccer.train.ppo.batch import Batch
from rsoccer.train.ppo.device import find_device
from rsoccer.train.ppo.discount import discount_per_decision
from rsoccer.train.ppo.gae import make_batch
from rsoccer.train.ppo.learning_rate import LearningRate
from rsoccer.train.ppo.mirror import check_symmetric, with_reflections
from rsoccer.train.ppo.update import PPO
from rsoccer.train.rollout.central_inputs import CentralInputs
from rsoccer.train.rollout.collector import RolloutCollector
from rsoccer.train.rollout.episode_stats import Row
from rsoccer.train.run.played import Played
from rsoccer.train.workers import Workers


class Trainer:
    """State of a training run, and its updates.

    Attributes:
        args: settings of the run.
        task: the task to train on.
        stack: what the networks observe of it.
        clock: measures the time of each part.
        generator: draws weights, actions, truncations and minibatches.
        minibatch_generator: draws the minibatches; `generator` itself unless rollouts and updates
            overlap, where the order in which two threads draw would depend on their speed.
        curriculum: creates the matches.
        pool: opponents of the learners if both teams learn, else None.
        is_solo: True while one robot per match learns.
        model: policy and value network.
        evaluator: evaluates them, on the threads of the run.
        collector: plays the matches.
        ppo: updates the model.
        learning_rate: step size of the updates.
        update_stats: columns of the log from the last update of the model.
        pending: rollout that the next update learns from, played during the last one; None if
            that has still to be played.
        samples: decisions that were learned from.
        updates: number of updates.
        elapsed: seconds of training, summed over resumed runs.
    """

    def __init__(self, args: Args) -> None:
        """Create a new run; `state.restore` continues a saved one.

        Args:
            args: settings of the run.

        Raises:
            ValueError: settings that do not fit the task or each other, or a GPU where torch finds
                none.
        """
        torch.set_num_threads(args.torch_threads)
        words = np.random.SeedSequence(args.seed).generate_state(4, np.uint64) >> np.uint64(1)
        torch_seed, first_seed, self._team_seed, minibatch_seed = words.tolist()
        self.args, self.clock = args, Clock()
        self.task = args.make_task()
        self.stack = ObservationStack.of(self.task, args.history)
        if args.ppo.mirror_augmentation:
            check_symmetric(self.task)
        self.generator = self.minibatch_generator = torch.Generator().manual_seed(torch_seed)
        if args.ppo.overlap:
            self.minibatch_generator = torch.Generator().manual_seed(minibatch_seed)
        opponents = args.opponents
        if args.is_on_network:  # one learner a match needs a match for each
            opponents = dataclasses.replace(opponents, solo_fraction=0.0)
        self.curriculum = Curriculum(
            opponents,
            self.task,
            self.clock,
            worlds=args.rollout.worlds,
            threads=args.threads,
            action_repeat=args.rollout.action_repeat,
            simulator=args.simulator,
            sensing=args.sensing,
            randomization=args.randomization,
            history=args.history,
        )
        _check_batch(args, len(self.curriculum.learners))
        check_shield("network.shield", args.network.shield, self.task)
        self.pool, self.is_solo = self.curriculum.pool, self.curriculum.starts_solo
        create = self.curriculum.solo if self.is_solo else self.curriculum.team
        matches = create(first_seed)
        with closed_on_error(matches, args.simulator):
            self._begin(matches)

    def _begin(self, matches: Matches) -> None:
        """Create the networks and what updates them, and enter the matches."""
        args = self.args
        self.model, sharing = build_networks(
            args.network, self.task, self.stack, matches.state_size, self.generator
        )
        self.evaluator = Evaluator(self.model, Workers(args.threads, args.torch_threads))
        self.collector = _collector(args, self)
        if args.network.initial_policy is not None and not args.resume:
            policy = initial_policy.load_for_task(
                args.network.initial_policy, self.task, self.stack
            )
            initial_policy.copy_weights(policy, self.stack, self.model)
            if sharing is not None:
                sharing.tie(self.model)
            self.collector.obs_rms.load_state_dict(initial_policy.statistics(policy, self.stack))
        self.collector.enter(matches, None if self.is_solo else self.curriculum.opponents)
        workers = self.evaluator.workers
        if args.ppo.overlap:  # these play meanwhile
            workers = Workers(args.threads, args.torch_threads)
        device = find_device(args.device)
        self.ppo = PPO(args.ppo, self.model, self.minibatch_generator, device, sharing, workers)
        self.learning_rate = LearningRate(args.ppo)
        self.update_stats: Row = {}
        self.pending: Played | None = None
        self.samples, self.updates, self.elapsed = 0, 0, 0.0
        self.show_policy()

    def close(self) -> None:
        """Close the simulator of the matches."""
        self.collector.matches.close()

    def show_policy(self) -> None:
        """Make the current policy the latest one of the pool."""
        if self.pool is not None:
            self.pool.latest = self.network()

    def start_team(self) -> None:
        """Begin the second part of the run, in which all learners play."""
        self.is_solo = False
        matches = self.curriculum.team(self._team_seed)
        self.collector.matches.close()
        self.collector.enter(matches, self.curriculum.opponents)

    @property
    def ends_solo(self) -> bool:
        """True if whole teams are to play from the next rollout on, see `start_team`."""
        args = self.args
        return self.is_solo and self.samples >= args.opponents.solo_fraction * args.samples

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
        batch = self.play_rollout(check_stop)
        self.samples += len(batch)
        return batch

    def play_rollout(self, check_stop: Callable[[], None]) -> Batch:
        """Play a rollout as `collect_rollout` does, without counting its samples.

        Args:
            check_stop: called before each decision; an exception that it raises ends the rollout.

        Returns:
            Batch of horizon x worlds x agents samples.
        """
        args = self.args
        gamma = discount_per_decision(args.ppo, args.rollout.action_repeat, self.progress)
        rollout = self.collector.collect(gamma, check_stop)
        with self.clock.measure("learning"):
            return make_batch(rollout, self.evaluator, args.ppo, gamma)

    def reflected(self, batch: Batch) -> Batch:
        """Return a batch with reflected samples, too, if the settings ask for them.

        Args:
            batch: samples that the model has played as it is.
        """
        if not self.args.ppo.mirror_augmentation:
            return batch
        with self.clock.measure("learning"):
            return with_reflections(batch, self.task, self.stack, self.evaluator)

    def update(self, batch: Batch, check_stop: Callable[[], None]) -> None:
        """Train the model on a batch, and put its new policy into the pool.

        Args:
            batch: samples from `collect_rollout`.
            check_stop: called before each minibatch; an exception that it raises ends the update.

        Raises:
            ValueError: the networks have NaN or infinite weights now.
        """
        learning_rate = self.learning_rate.start_update(self.progress)
        batch = self.reflected(batch)
        with self.clock.measure("learning"):
            stats = self.ppo.update(batch, learning_rate, check_stop, critic_only=self.is_warmup)
        self.end_update(stats)

    @property
    def is_warmup(self) -> bool:
        """True if the value network alone learns in the next update."""
        return self.updates < self.args.ppo.critic_warmup

    def end_update(self, stats: Row) -> None:
        """Count an update, follow its schedules, and put the new policy into the pool.

        Args:
            stats: columns of the log from `PPO`, whose parameters the model has now.

        Raises:
            ValueError: the networks have NaN or infinite weights now.
        """
        self._check_finite()
        self.update_stats = stats
        if not self.is_warmup:  # a policy that stays as it is says nothing about the rate
            self.learning_rate.end_update(stats["n_epochs"], stats["approx_kl"])
        self.updates += 1
        first, last = self.args.network.action_std, self.args.network.final_action_std
        self.model.set_action_std(first * (last / first) ** self.progress)
        if self.pool is not None:
            self.pool.show(self.network(), self.updates)

    def _check_finite(self) -> None:
        """Raise ValueError if training has diverged, before it replaces the last checkpoint."""
        if not all(bool(part.isfinite().all()) for part in self.model.state_dict().values()):
            raise ValueError(
                f"training diverged after {self.samples:,} samples: weights are NaN or infinite; "
                f"{self._advice()}; the last checkpoint is kept"
            )

    def _advice(self) -> str:
        """Cause of weights that are NaN or infinite, or advice."""
        means = self.collector.reward_means.items()
        causes = [name for name, mean in means if not math.isfinite(mean)]
        if not np.isfinite(self.collector.observations).all():
            causes.append("observations")
        if causes:
            return f"so are {', '.join(causes)} of task {self.task.name}"
        return f"lower ppo.learning_rate ({self.args.ppo.learning_rate:g})"

    def network(self) -> Network:
        """Return the current policy in NumPy, as it plays and is measured."""
        args, (mean, std) = self.args, self.collector.obs_rms.as_float32()
        network = self.model.export(
            self.task,
            mean,
            std,
            args.play_action_repeat,
            args.history,
            args.task,
            args.task_options,
        )
        matches = self.collector.matches
        network.metadata |= training_conditions.written(matches.sensing, matches.randomization)
        if args.network.shield is not None:
            network.metadata["shield"] = args.network.shield
            network.shield = Shield(args.network.shield)
        return network

    def saved_network(self) -> Network:
        """Return the current policy as its file has it: with the value network.

        A value network that reads more than the observation of a robot, a central one, is of no
        use in play and stays out, and so is one that reads a history.
        """
        network, args = self.network(), self.args
        if args.network.central_critic or args.history > 1:
            return network
        repeat = args.rollout.action_repeat
        discount = discount_per_decision(args.ppo, repeat, self.progress)
        reward_std = float(self.collector.return_rms.std[0])
        layers, _ = read_layers(self.model.critic)
        network.set_value(Value(layers, discount, repeat, reward_std))
        return network


def _check_batch(args: Args, learners: int) -> None:
    """Raise ValueError if a batch is too small for its minibatches."""
    samples = args.rollout.worlds * args.rollout.horizon * learners
    samples *= 2 if args.ppo.mirror_augmentation else 1
    if samples < 2 * args.ppo.n_minibatches:  # advantages are normalized within a minibatch
        raise ValueError(
            f"ppo.n_minibatches must be at most half of the {samples} samples of an update "
            f"(worlds x horizon x learners), got {args.ppo.n_minibatches}"
        )


def _collector(args: Args, trainer: Trainer) -> RolloutCollector:
    """A collector for the networks of a trainer."""
    task, symmetric = trainer.task, args.ppo.mirror_augmentation
    central: CentralInputs | None = None
    if args.network.central_critic:
        central = CentralInputs(task, symmetric=symmetric)
    return RolloutCollector(
        args.rollout,
        trainer.evaluator,
        trainer.generator,
        trainer.clock,
        trainer.curriculum.kinds,
        central=central,
        reflection=trainer.stack.reflection(task) if symmetric else None,
        shield=None if args.network.shield is None else Shield(args.network.shield),
    )

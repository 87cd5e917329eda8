"""Updates during which the next rollout is played, by the policy from before the update.

With a GPU neither the matches nor the learner wait for the other one. What a rollout depends on is
the same at any speed of both:

- update k learns from rollout k, while rollout k + 1 is played with the parameters from before
  update k. Samples are therefore one update old, those of rollout 0 and of the first rollout of
  whole teams excepted: nothing is learned while these are played.
- no rollout is played during the last update, nor during the last one with one learner per match.
- the learner's thread has a copy of the model, an optimizer, a generator and buffers of its own.
  All else is done on the thread of the run, before the learner begins or after it has ended.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

import torch

from rsoccer.train.run.played import Played
from rsoccer.train.run.trainer import Trainer


class _Canceled(Exception):
    """The rollout beside an update has failed; ends the update."""


def update(trainer: Trainer, check_stop: Callable[[], None]) -> Played:
    """Learn from the pending rollout, or from a new one, and play the next one meanwhile.

    No thread is left at the end, even if an exception ends the update. The model is the one from
    before the update then.

    Args:
        trainer: the run, whose pending rollout is replaced.
        check_stop: called before each decision, and by the learner's thread before each
            minibatch; an exception that it raises ends both.

    Returns:
        The rollout that was learned from.

    Raises:
        ValueError: the networks have NaN or infinite weights now.
    """
    played, trainer.pending = trainer.pending, None
    if played is None:
        played = play(trainer, check_stop)
    trainer.samples += played.samples
    learning_rate = trainer.learning_rate.start_update(trainer.progress)
    goes_on = trainer.samples < trainer.args.samples and not trainer.ends_solo
    following: Played | None = None
    canceled = threading.Event()

    def check() -> None:
        if canceled.is_set():
            raise _Canceled
        check_stop()

    trainer.ppo.begin()
    threads = trainer.args.torch_threads
    with ThreadPoolExecutor(1, "learner", torch.set_num_threads, (threads,)) as learner:
        learning = learner.submit(
            trainer.ppo.learn, played.batch, learning_rate, check, critic_only=trainer.is_warmup
        )
        try:
            if goes_on:
                following = play(trainer, check_stop)
            with trainer.clock.measure("learning"):
                stats = learning.result()
        except BaseException:  # an interrupt, too
            canceled.set()
            raise
    trainer.ppo.finish()
    trainer.end_update(stats)
    trainer.pending = following
    return played


def play(trainer: Trainer, check_stop: Callable[[], None]) -> Played:
    """Play a rollout with the model as it is.

    Advantages and reflections are of the parameters that play, too: both densities of a sample and
    its reflection are then of one policy, and the work is done while the learner learns.

    Args:
        trainer: the run.
        check_stop: called before each decision; an exception that it raises ends the rollout.

    Returns:
        The rollout, to learn from later.
    """
    batch = trainer.play_rollout(check_stop)
    collector = trainer.collector
    return Played(
        trainer.reflected(batch),
        len(batch),
        collector.episode_stats.take(),
        collector.reward_means,
    )

"""The loop of a run: one update after the other, with its log and its checkpoints."""

from __future__ import annotations

import dataclasses
import time

import numpy as np

from rsoccer.train.rollout.episode_stats import Row
from rsoccer.train.run import checkpoint, overlap
from rsoccer.train.run.callback import Callback, Update
from rsoccer.train.run.checkpoint import Checkpoint
from rsoccer.train.run.folder import POLICY_FILE
from rsoccer.train.run.ladder import Ladder
from rsoccer.train.run.log import Logger
from rsoccer.train.run.played import Played
from rsoccer.train.run.state import capture, restore_networks
from rsoccer.train.run.stop_signal import StopSignal
from rsoccer.train.run.trainer import Trainer


class Loop:
    """Trains until the samples are used up.

    Attributes:
        trainer: the run.
        ladder: measures the policy against fixed opponents.
    """

    def __init__(
        self, trainer: Trainer, policy_files: dict[str, str], callback: Callback | None = None
    ) -> None:
        """Prepare the loop of a run.

        Args:
            trainer: the run.
            policy_files: digests of the policies that play beside the learners, for checkpoints.
            callback: called after each update; None for none.
        """
        self.trainer, self._policy_files, self._callback = trainer, policy_files, callback
        settings = trainer.args.run
        if trainer.args.is_on_network:
            settings = dataclasses.replace(settings, ladder_interval=0)
        self.ladder = Ladder(
            settings,
            trainer.task,
            trainer.args.threads,
            simulator=trainer.args.simulator,
            sensing=trainer.args.sensing,
            randomization=trainer.args.randomization,
        )

    def run(self, stop: StopSignal, log_size: int) -> None:
        """Train until the samples are used up, the callback ends the run or a signal comes.

        The run is saved in all cases, also if the callback raises an error, training diverges or
        robots on a network do not answer: as it was after the last complete update.

        Args:
            stop: reports a signal.
            log_size: bytes of the log's CSV file to keep; 0 for a new run.

        Raises:
            BaseException: what ended the run early, such as `Stopped` by a signal. The update in
                progress was dropped.
        """
        trainer, args = self.trainer, self.trainer.args
        logger = Logger(
            args.out, trainer.samples, args.samples, log_size, progress=args.run.progress
        )
        saved, saved_at = self._capture(logger), time.monotonic()
        self.save(saved)
        try:
            while trainer.samples < args.samples:
                row = self._update(stop, logger)
                saved = self._capture(logger)
                if self._ends(row):
                    break
                if time.monotonic() - saved_at > args.run.checkpoint_interval:
                    self.save(saved)
                    saved_at = time.monotonic()
                stop.check()
        except BaseException:
            restore_networks(trainer, saved)  # drop the update that was cut short
            self.save(saved)
            raise
        finally:
            logger.close()
        self.save(saved)

    def save(self, saved: Checkpoint) -> None:
        """Write a checkpoint and the current policy to the run's folder.

        Args:
            saved: state of the run, captured after the last update.
        """
        out = self.trainer.args.out
        checkpoint.save(out / checkpoint.FILE_NAME, saved)
        self.trainer.saved_network().save(out / POLICY_FILE)

    def _ends(self, row: Row) -> bool:
        """Return whether the callback ends the run."""
        if self._callback is None:
            return False
        answer = self._callback(Update(self.trainer.args, dict(row), self.trainer.saved_network))
        if answer is None:
            return False
        if not isinstance(answer, bool | np.bool_):  # NumPy's comparisons return the latter
            raise TypeError(f"callback: expected it to return None or a bool, got {answer!r}")
        return not answer

    def _update(self, stop: StopSignal, logger: Logger) -> Row:
        """Play and learn once, and return the row of the log.

        Whole teams follow after the first part of the samples.
        """
        trainer = self.trainer
        if trainer.args.ppo.overlap:
            played = overlap.update(trainer, stop.check)
        else:
            batch = trainer.collect_rollout(stop.check)
            trainer.update(batch, stop.check)
            collector = trainer.collector
            episodes, rewards = collector.episode_stats.take(), collector.reward_means
            played = Played(batch, len(batch), episodes, rewards)
        row = self._row(played)
        logger.write(trainer.samples, row)
        if trainer.ends_solo:
            trainer.start_team()
        return row

    def _capture(self, logger: Logger) -> Checkpoint:
        return capture(self.trainer, self._policy_files, logger.size)

    def _row(self, played: Played) -> Row:
        """Columns of the log for the last update, which learned from a rollout."""
        trainer = self.trainer
        strength = self.ladder.skip()
        if self.ladder.is_due(trainer.updates, last=trainer.samples >= trainer.args.samples):
            with trainer.clock.measure("ladder"):
                strength = self.ladder.measure(trainer.network())
        seconds, shares = trainer.clock.take()
        trainer.elapsed += seconds
        # The columns are the same in all updates: solo learners meet no pool, and nothing is
        # played during the last update of overlapping ones.
        parts = ("acting", "ladder", "matches", "opponents", "physics")
        shares = {**dict.fromkeys(parts, 0.0), **shares}
        shares["tasks"] = shares.pop("matches") - shares["physics"] - shares["opponents"]
        return {
            "update": trainer.updates,
            "samples": trainer.samples,
            "seconds": trainer.elapsed,
            "samples_per_second": played.samples / seconds,
            **played.episodes,
            **strength,
            **played.rewards,
            **trainer.update_stats,
            **{f"time_{part}": share for part, share in sorted(shares.items())},
        }

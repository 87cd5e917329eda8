"""Who plays whom while a run learns: first one robot alone, then whole sides.

Among teammates that learn too, a robot is paid for what they do as much as for what it does itself,
and learns slowly. So a run starts with a lone learner, while all other robots drift. What it has
learned is then every learner's to start from.
"""

from __future__ import annotations

from rsoccer.matches import Matches
from rsoccer.policies.base import Policy
from rsoccer.task import LEARN, Learn, Task
from rsoccer.train.args import Args
from rsoccer.train.opponent_pool import OpponentPool
from rsoccer.train.timing import Clock, TimedSimulator

Controllers = dict[str, str | Learn | Policy]


class Curriculum:
    """Opens the matches of both parts of a run."""

    def __init__(self, args: Args, task: Task, clock: Clock) -> None:
        """Find out who learns, and make a pool of opponents if both sides do."""
        self._args, self._task, self._clock = args, task, clock
        who = task.default_controllers()
        self.learners = [name for name in task.robots if who[name] is LEARN]
        self.pool: OpponentPool | None = None
        if {name.split("_")[0] for name in self.learners} == {"blue", "yellow"}:
            shares = {
                "latest": args.latest_fraction,
                "past": args.past_fraction,
                "ou": args.ou_fraction,
            }
            self.pool = OpponentPool(task, shares, args.pool_size, args.action_repeat, clock)
            self.learners = [name for name in self.learners if name.startswith("blue")]

    @property
    def starts_solo(self) -> bool:
        """Whether there is a first part."""
        return self._args.solo_fraction > 0 and len(self.learners) > 1

    def solo(self, seed: int) -> Matches:
        """As many learners in all as `self_play` has, but one in a match."""
        controllers: Controllers = {"all": "ou", self.learners[0]: LEARN}
        return self._open(controllers, self._args.worlds * len(self.learners), seed)

    def self_play(self, seed: int) -> Matches:
        """The task's own learners, or those of one side against the pool if both learn."""
        controllers: Controllers = {}
        if self.pool is not None:
            controllers = {"blue": LEARN, "yellow": self.pool}
        return self._open(controllers, self._args.worlds, seed)

    def _open(self, controllers: Controllers, worlds: int, seed: int) -> Matches:
        threads = self._args.threads
        return Matches(
            self._task,
            worlds,
            seed,
            threads,
            controllers=controllers,
            autoreset="disabled",
            simulator=TimedSimulator(self._task.config, worlds, threads, self._clock),
        )

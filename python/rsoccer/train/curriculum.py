"""Curriculum of a run: first one learner per match, then whole teams.

Among teammates that learn too, a robot's reward depends as much on their actions as on its own, so
learning is slow. A run therefore starts with one learner per match; all other robots follow
`solo_partners`, `ou` by default. All learners then start from the policy that this first part has
learned.
"""

from __future__ import annotations

from rsoccer.frame import team_of
from rsoccer.matches import Matches
from rsoccer.policies.base import Policy
from rsoccer.task import LEARN, Learn, Task
from rsoccer.train.args import Args
from rsoccer.train.opponent_pool import OpponentPool
from rsoccer.train.timing import Clock, TimedSimulator

Controllers = dict[str, str | Learn | Policy]
"""Controllers by robot or team, as `Matches` takes them."""


class Curriculum:
    """Creates the matches of both parts of a run.

    Attributes:
        learners: names of the robots that learn in self-play; blue's if both teams learn.
        pool: opponents of the learners if both teams learn, else None.
    """

    def __init__(self, args: Args, task: Task, clock: Clock) -> None:
        """Find the learners of a task, and create a pool of opponents if both teams learn.

        Args:
            args: settings of the run.
            task: the task to train on.
            clock: measures the time of the simulator and of the pool.
        """
        self._args, self._task, self._clock = args, task, clock
        defaults = task.default_controllers()
        self.learners = [name for name in task.robots if defaults[name] is LEARN]
        self.pool: OpponentPool | None = None
        if {team_of(name) for name in self.learners} == {"blue", "yellow"}:
            fractions = {
                "latest": args.latest_fraction,
                "past": args.past_fraction,
                "ou": args.ou_fraction,
            }
            self.pool = OpponentPool(task, fractions, args.pool_size, args.action_repeat, clock)
            self.learners = [name for name in self.learners if team_of(name) == "blue"]

    @property
    def starts_solo(self) -> bool:
        """True if the run starts with one learner per match."""
        return self._args.solo_fraction > 0 and len(self.learners) > 1

    def solo(self, seed: int) -> Matches:
        """Return matches with one learner each, as many learners in all as in `self_play`.

        Args:
            seed: seed of the first world; the others follow.
        """
        controllers: Controllers = {"all": self._args.solo_partners, self.learners[0]: LEARN}
        return self._create(controllers, self._args.worlds * len(self.learners), seed)

    def self_play(self, seed: int) -> Matches:
        """Return matches with the task's learners; yellow is the pool if both teams learn.

        Args:
            seed: seed of the first world; the others follow.
        """
        controllers: Controllers = {}
        if self.pool is not None:
            controllers = {"blue": LEARN, "yellow": self.pool}
        return self._create(controllers, self._args.worlds, seed)

    def _create(self, controllers: Controllers, worlds: int, seed: int) -> Matches:
        """Create matches whose simulator is timed, without automatic resets."""
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

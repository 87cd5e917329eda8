"""Curriculum of a run: first one learner per match, then whole teams.

Among teammates that learn too, a robot's reward depends as much on their actions as on its own, so
learning is slow. A run therefore starts with one learner per match; all other robots follow
`solo_partners`, `ou` by default. All learners then start from the policy that this first part has
learned. The second part has the opponents and teammates that the settings name.
"""

from __future__ import annotations

from rsoccer.frame import team_of
from rsoccer.lineup import DEFAULT_OPPONENT, learning_team
from rsoccer.matches import Matches
from rsoccer.policies import make_policy
from rsoccer.policies.base import Policy
from rsoccer.task import LEARN, Learn, Task
from rsoccer.train.args import Args
from rsoccer.train.opponent_pool import OpponentPool
from rsoccer.train.policy_mix import PolicyMix
from rsoccer.train.timing import Clock, TimedSimulator

Controllers = dict[str, str | Learn | Policy]
"""Controllers by robot or team, as `Matches` takes them."""


class Curriculum:
    """Creates the matches of both parts of a run.

    Attributes:
        learners: names of the robots that learn in self-play; blue's if both teams learn.
        opponents: policies of the other team in the second part; None for the task's own.
        pool: the same policies if both teams learn, else None.
        partners: policies of the learner's later fellow learners in the first part; None if they
            follow `solo_partners` in all matches.
    """

    def __init__(self, args: Args, task: Task, clock: Clock) -> None:
        """Find the learners of a task, and make the policies of its other robots.

        Args:
            args: settings of the run.
            task: the task to train on.
            clock: measures the time of the simulator and of the policies.

        Raises:
            ValueError: a task without learners, opponents or teammates in a task without such
                robots, a policy that does not fit the task, or opponents in a run that leaves no
                matches for them.
        """
        self._args, self._task, self._clock = args, task, clock
        make_policy(args.solo_partners, task)  # refuses a wrong one, even where none plays
        self.learners = learning_team(task)
        home = team_of(self.learners[0])
        self.pool: OpponentPool | None = None
        self.opponents: PolicyMix | None = None
        self._rivals = [name for name in task.robots if team_of(name) != home]
        if len(self.learners) < len(task.agents):
            self.opponents = self.pool = self._create_opponent_pool()
        elif args.opponents:
            shares = self._with_solo_policy(args.opponents)
            self.opponents = self._create_mix("opponents", self._rivals, shares)
        self.partners: OpponentPool | None = None
        if args.solo_copies > 0.0 and self.starts_solo:
            self.partners = self._create_pool({args.solo_partners: 1.0}, (args.solo_copies, 0.0))
        others = [name for name in task.robots if name not in [*self._rivals, *self.learners]]
        self._teammates: Controllers = {}
        if args.teammates:
            mix = self._create_mix("teammates", others, args.teammates)
            self._teammates = dict.fromkeys(others, mix)

    def _create_opponent_pool(self) -> OpponentPool:
        """Pool of opponents for a task in which both teams learn."""
        args = self._args
        selves = (args.latest_fraction, args.past_fraction)
        if args.opponents and sum(selves) > 1.0 - 1e-6:
            raise ValueError(
                "opponents: expected none where latest_fraction + past_fraction is 1, "
                f"got {args.opponents}"
            )
        fixed = self._with_solo_policy(args.opponents or {DEFAULT_OPPONENT: 1.0})
        return self._create_pool(fixed, selves)

    def _create_pool(self, fixed: dict[str, float], selves: tuple[float, float]) -> OpponentPool:
        """Pool with fixed policies, and shares of the current policy and of past ones."""
        size, repeat, power = self._args.pool_size, self._args.action_repeat, self._args.pfsp_power
        return OpponentPool(self._task, fixed, selves, size, repeat, power, self._clock)

    def _create_mix(self, setting: str, robots: list[str], shares: dict[str, float]) -> PolicyMix:
        """Mix of policies for some robots, which the task must have."""
        if not robots:
            raise ValueError(
                f"{setting}: expected none, as {self._task.name} has no such robots without a "
                f"learner, got {getattr(self._args, setting)}"
            )
        return PolicyMix(self._task, shares, self._clock)

    def _with_solo_policy(self, shares: dict[str, float]) -> dict[str, float]:
        """Shares with the policy of the first part in front, so that its code is 0."""
        return {self._args.solo_partners: 0.0, **shares} if self.starts_solo else shares

    @property
    def kinds(self) -> tuple[str, ...]:
        """Names of the kinds of opponents in logs; those of the first part have the first one."""
        return () if self.opponents is None else self.opponents.kinds

    @property
    def starts_solo(self) -> bool:
        """True if the run starts with one learner per match."""
        return self._args.solo_fraction > 0 and len(self.learners) > 1

    def solo(self, seed: int) -> Matches:
        """Return matches with one learner each, as many learners in all as in `self_play`.

        Args:
            seed: seed of the first world; the others follow.
        """
        learner, *others = self.learners
        controllers: Controllers = {"all": self._args.solo_partners, learner: LEARN}
        if self.partners is not None:
            controllers |= dict.fromkeys(others, self.partners)
        return self._create(controllers, self._args.worlds * len(self.learners), seed)

    def self_play(self, seed: int) -> Matches:
        """Return matches with the task's learners, and the other robots' policies.

        Args:
            seed: seed of the first world; the others follow.
        """
        controllers = dict(self._teammates)
        if self.opponents is not None:
            controllers |= dict.fromkeys(self._rivals, self.opponents)
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

"""Curriculum of a run: first one learner per match, then whole teams.

Among teammates that learn too, a robot's reward depends as much on their actions as on its own, so
learning is slow. A run therefore starts with one learner per match; all other robots follow
`DEFAULT_OPPONENT`. All learners then start from the policy that this first part has learned. The
second part has the opponents that the settings name.
"""

from __future__ import annotations

from rsoccer._core import SimConfig, Threads
from rsoccer.frame import team_of
from rsoccer.history import ObservationStack
from rsoccer.lineup import DEFAULT_OPPONENT, learning_team
from rsoccer.matches import Matches
from rsoccer.policies.base import Policy
from rsoccer.randomization import Ranges
from rsoccer.sources import SensingSource, SimulatorSource, make_simulator
from rsoccer.task import LEARN, Learn, Task
from rsoccer.train.clock import Clock, TimedSimulator
from rsoccer.train.opponents.opponent_pool import OpponentPool
from rsoccer.train.opponents.policy_mix import PolicyMix
from rsoccer.train.opponents.settings import OpponentSettings

Controllers = dict[str, str | Learn | Policy]
"""Controllers by robot or team, as `Matches` takes them."""


class Curriculum:
    """Creates the matches of both parts of a run.

    Attributes:
        learners: names of the robots that learn in the second part; blue's if both teams learn.
        opponents: policies of the other team in the second part; None for the task's own.
        pool: the same policies if both teams learn, else None.
    """

    def __init__(
        self,
        settings: OpponentSettings,
        task: Task,
        clock: Clock,
        *,
        worlds: int,
        threads: int,
        action_repeat: int,
        simulator: SimulatorSource | None = None,
        sensing: SensingSource | None = None,
        randomization: Ranges | None = None,
        history: int = 1,
    ) -> None:
        """Find the learners of a task, and make the policies of its other robots.

        Args:
            settings: settings of the opponents.
            task: the task to train on.
            clock: measures the time of the simulator and of the policies.
            worlds: matches at once in the second part, at least 1.
            threads: threads of the simulator, at least 1.
            action_repeat: control steps that networks hold each decision.
            simulator: moves the robots, as for `Matches`.
            sensing: what robots know of the true state, as for `Matches`.
            randomization: numbers that each episode draws, as for `Matches`.
            history: observations in a stacked one, as for `Matches`.

        Raises:
            ValueError: a task without learners, opponents in a task without such robots, a policy
                that does not fit the task, opponents in a run that leaves no matches for them, or
                selves as opponents in a task whose teams have different parts.
        """
        self._settings, self._task, self._clock = settings, task, clock
        self._worlds, self._threads = worlds, threads
        self._simulator, self._sensing = simulator, sensing
        self._randomization, self._history = randomization, history
        self.learners = learning_team(task)
        home = team_of(self.learners[0])
        self.pool: OpponentPool | None = None
        self.opponents: PolicyMix | None = None
        self._rivals = [name for name in task.robots if team_of(name) != home]
        if len(self.learners) < len(task.agents):
            self.opponents = self.pool = self._create_pool(action_repeat)
        elif settings.fixed:
            self.opponents = self._create_mix()

    def _create_pool(self, action_repeat: int) -> OpponentPool:
        """Opponents in a task in which both teams learn."""
        settings = self._settings
        selves = (settings.latest_fraction, settings.past_fraction)
        if any(selves) and not self._task.two_sided:  # nobody would learn the part of the others
            raise ValueError(
                "opponents.latest_fraction: expected 0, and past_fraction 0, as yellow cannot play "
                f"blue's part in {self._task.name}, got {selves[0]:g} and {selves[1]:g}: let one "
                "team learn"
            )
        if settings.fixed and sum(selves) > 1.0 - 1e-6:
            raise ValueError(
                "opponents.fixed: expected none where latest_fraction + past_fraction is 1, "
                f"got {settings.fixed}"
            )
        fixed = self._with_solo_policy(settings.fixed or {DEFAULT_OPPONENT: 1.0})
        stack = ObservationStack.of(self._task, self._history)
        return OpponentPool(self._task, fixed, selves, action_repeat, self._clock, stack)

    def _create_mix(self) -> PolicyMix:
        """Opponents in a task in which one team learns."""
        if not self._rivals:
            raise ValueError(
                f"opponents.fixed: expected none, as {self._task.name} has one team, "
                f"got {self._settings.fixed}"
            )
        return PolicyMix(self._task, self._with_solo_policy(self._settings.fixed), self._clock)

    def _with_solo_policy(self, shares: dict[str, float]) -> dict[str, float]:
        """Shares with the policy of the first part in front, so that its code is 0."""
        return {DEFAULT_OPPONENT: 0.0, **shares} if self.starts_solo else shares

    @property
    def kinds(self) -> tuple[str, ...]:
        """Names of the kinds of opponents in logs; those of the first part have the first one."""
        return () if self.opponents is None else self.opponents.kinds

    @property
    def starts_solo(self) -> bool:
        """True if the run starts with one learner per match."""
        return self._settings.solo_fraction > 0 and len(self.learners) > 1

    def solo(self, seed: int) -> Matches:
        """Return matches with one learner each, as many learners in all as in `team`.

        Args:
            seed: seed of the first world; the others follow.
        """
        controllers: Controllers = {"all": DEFAULT_OPPONENT, self.learners[0]: LEARN}
        return self._create(controllers, self._worlds * len(self.learners), seed)

    def team(self, seed: int) -> Matches:
        """Return matches with all learners, and with the opponents of the second part.

        Args:
            seed: seed of the first world; the others follow.
        """
        controllers: Controllers = {}
        if self.opponents is not None:
            controllers = dict.fromkeys(self._rivals, self.opponents)
        return self._create(controllers, self._worlds, seed)

    def _create(self, controllers: Controllers, worlds: int, seed: int) -> Matches:
        """Create matches whose simulator is timed, without automatic resets."""
        return Matches(
            self._task,
            worlds,
            seed,
            self._threads,
            controllers=controllers,
            autoreset="disabled",
            simulator=self._timed_simulator,
            sensing=self._sensing,
            randomization=self._randomization,
            history=self._history,
        )

    def _timed_simulator(self, config: SimConfig, worlds: int, threads: Threads) -> TimedSimulator:
        """A simulator of some matches whose time is measured."""
        simulator = make_simulator(self._simulator, config, worlds, threads)
        return TimedSimulator(simulator, self._clock)

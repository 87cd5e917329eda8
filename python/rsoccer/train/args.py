"""Settings of a training run; the defaults learn three-a-side play on two cores.

This module does not import torch, because the command line builds its help from it.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any, Literal, Self, get_args, get_type_hints

from rsoccer import plugins
from rsoccer.option_values import encoded
from rsoccer.registry import task_with_options
from rsoccer.task import Task
from rsoccer.train.setting_types import converted
from rsoccer.train.task_settings import recommended_settings

SETTINGS_FILE = "args.json"
"""File in a run's folder with its settings, written when the run starts and when it resumes."""

Device = Literal["auto", "cpu", "cuda"]
"""Names of devices."""

Schedule = Literal["linear", "adaptive"]
"""Names of schedules of the learning rate."""

CHANGEABLE_ON_RESUME = (
    "imports",
    "out",
    "device",
    "resume",
    "overwrite",
    "samples",
    "checkpoint_interval",
    "progress",
    "match_page",
    "ladder_interval",
    "ladder_matches",
)
"""Fields that may change when a run resumes. Two of them affect the updates: the learning rate in
its linear schedule, and the spread of actions and the discount if they have a final value, change
towards the end that `samples` sets, and each `device` rounds in its own way."""


# The docstrings of the fields are the help of `rsoccer train`, which keeps their line breaks.
@dataclass(frozen=True)
class Args:
    """Settings of one training run. A sample is one decision of one learning robot.

    Raises:
        ImportError: a module of `imports` does not exist or raises an error.
        ValueError: a value of another type or outside its range, fractions of opponents whose sum
            is above 1, options of the task that JSON cannot hold, `resume` together with
            `overwrite`, or an adaptive learning rate with one epoch.
    """

    task: str = "VSSSelfPlay-v0"
    """registered task to train on (`rsoccer list` prints the names)"""
    out: Path = Path("out/train")
    """folder for the policy, the checkpoint and the logs"""
    samples: int = 10_000_000
    """decisions to learn from, over all learning robots; at least 1, rounded up to full updates"""
    task_options: Mapping[str, Any] = field(default_factory=dict)
    """options of the task by name (`rsoccer list` prints them), such as reward_weights=paper or
    opponent=chase: JSON values, and models of robots, balls and fields or their .json files"""
    imports: tuple[str, ...] = ()
    """modules to import first: those that register a task or policies of one's own"""
    seed: int = 0
    """random seed, at least 0; equal seed, settings, machine and threads give equal runs"""
    threads: int = 2
    """threads of the simulator, at least 1"""
    torch_threads: int = 1
    """threads of torch, at least 1; more help wide networks only, in small ones threads wait"""
    device: Device = "cpu"
    """where the networks learn: cpu, cuda (a GPU), or auto (a GPU if there is one).
    Physics and acting are always on the CPU"""
    resume: bool = False
    """continue the run in `out` from its last checkpoint; on the command line, with its settings"""
    overwrite: bool = False
    """start a new run in `out` even if it already holds one"""
    checkpoint_interval: float = 30.0
    """seconds between checkpoints, above 0; a crash loses the updates after the last one"""
    progress: bool = True
    """show a progress bar"""
    match_page: bool = True
    """write a match of the trained policy to `out` at the end, as match.html and match.rsr"""

    solo_fraction: float = 0.4
    """first part of the samples, 0 to 1, with one learner per match; others follow `solo_partners`.
    Its rewards then follow from its own actions; 0 lets all learners play from the start"""
    solo_partners: str = "ou"
    """policy of all other robots in that first part: a name, or the path of a policy file"""
    solo_copies: float = 0.0
    """share of the matches of that first part, 0 to 1, in which the robots that learn later follow
    the current policy instead of `solo_partners`. It rises from 0 to this value over the part, so
    that partners become those of a team that learns"""
    worlds: int = 256
    """matches played at once, at least 1; more give steadier gradients, slower first progress"""
    horizon: int = 16
    """decisions per world between two updates, at least 1; more cover more of an episode"""
    action_repeat: int = 3
    """control steps (25 ms each) per decision, at least 1; more explore further, react slower"""
    random_truncation: float = 0.002
    """probability, 0 to 1, that a match is truncated after a decision and starts again.
    More gives fresh starts in place of long stalemates, less teaches to get out of them"""
    gamma: float = 0.985
    """discount factor per control step, 0 to 1, whatever `action_repeat` is.
    Closer to 1 looks further ahead, but waiting costs less, so speed is learned later"""
    final_gamma: float | None = None
    """discount factor per control step at the end of the run, at least 0 and below 1, as `gamma`
    then has to be; None keeps `gamma`.
    A longer horizon at the end makes play careful, once it is learned with a short one"""
    gae_lambda: float = 0.9
    """lambda of generalised advantage estimation, 0 to 1.
    1 trusts the collected rewards only, 0 trusts the value network only"""

    hidden_sizes: tuple[int, ...] = (128, 128)
    """widths of the hidden layers of the policy and of the value network, at least 1 each"""
    central_critic: bool = False
    """let the value network read the state of the whole match, as in MAPPO, and the observation.
    The policy still acts on the observation of its robot alone"""
    robot_units: int = 0
    """units of the first layer, at least 0, for each other robot of a team, in addition to the
    first of `hidden_sizes`. Their weights are shared by the robots of a team (Deep Sets), so what
    is learned about one of them holds for all. 0 treats every robot on its own"""
    action_std: float = 0.6
    """initial standard deviation of the actions, above 0; 1 is full speed"""
    final_action_std: float | None = 0.1
    """standard deviation of the actions at the end of the run, above 0; None learns it instead.
    It changes geometrically from `action_std`, and `entropy_coef` has no effect"""
    initial_action: tuple[float, ...] = ()
    """mean action at the start, one number from -1 to 1 per component of the action; empty is 0.
    In SSL a kick of -1 keeps the ball until kicking is learned"""
    learning_rate: float = 2e-3
    """initial step size of Adam, above 0"""
    learning_rate_schedule: Schedule = "linear"
    """change of the step size: linear (it falls to a tenth by the end of the run) or adaptive (it
    falls after updates that `target_kl` cut short, and rises after those that changed little)"""
    n_epochs: int = 6
    """passes over each batch, at least 1; more learn faster until the policy changes too much"""
    n_minibatches: int = 8
    """minibatches per epoch, at least 1"""
    mirror_augmentation: bool = False
    """learn from each sample a second time, with left and right swapped, in up to twice the time.
    The task must be symmetric, as all are but SSLDribbling-v0"""
    clip_range: float = 0.2
    """clip range of PPO, above 0: largest change of an action's probability ratio in an update"""
    target_kl: float = 0.02
    """KL divergence from the policy that played, above 0, at which the epochs of an update stop"""
    entropy_coef: float = 0.002
    """weight of the entropy bonus, at least 0, where `final_action_std` is None;
    raise it if the robots stop exploring early"""
    value_coef: float = 0.5
    """weight of the value loss, at least 0"""
    max_grad_norm: float = 0.5
    """largest norm of a gradient, above 0; longer gradients are shortened to it"""

    normalise_observations: bool = True
    """scale observations by their running mean and standard deviation; off for ablations"""
    normalise_rewards: bool = True
    """divide rewards by the running standard deviation of discounted returns; off for ablations"""
    bootstrap_time_limits: bool = True
    """count the value of the last observation where an episode is truncated.
    Off treats time limits and random truncations as ends of the task; for ablations"""
    masked_observations: tuple[str, ...] = ()
    """blocks of the observation that policy and value network read as 0; for ablations.
    Numbers of a block by their last index: opponents:2,3 are the headings of opponents"""

    latest_fraction: float = 0.5
    """share of matches, 0 to 1, against the current policy (tasks where both teams learn)"""
    past_fraction: float = 0.35
    """share of matches, 0 to 1, against frozen past policies"""
    opponents: dict[str, float] = field(default_factory=dict)
    """policies of the other team in all other matches: names or files, each with its share, as in
    `ou 2 scripted 1`; the shares need not sum to 1. Where one team learns they play all matches.
    By default `ou` where both teams learn, else the task's own policies"""
    teammates: dict[str, float] = field(default_factory=dict)
    """policies of the teammates that do not learn, as `opponents`; by default the task's own"""
    pool_size: int = 8
    """past policies kept, at least 1; a full pool drops the one closest in age to its neighbours"""
    pool_interval: int = 10
    """updates between two additions to the past policies, at least 1"""
    pfsp_power: float = 1.0
    """preference for past policies that are seldom beaten, at least 0: a past policy is drawn with
    a weight of (1 - win rate) ** pfsp_power (prioritised fictitious self-play); 0 draws evenly"""
    ladder_interval: int = 100
    """updates between two measurements of the policy against fixed opponents, at least 0, and one
    after the last update; each takes as long as several updates. 0 turns them off"""
    ladder_matches: int = 100
    """matches of a measurement, at least 1, with the same seeds each time, spread over `zero`,
    `ou` and the scripts for a whole team; tasks for one team are played as they are"""

    def __post_init__(self) -> None:
        """Convert every value to the type of its field, and check it."""
        for name, kind in _types().items():
            object.__setattr__(self, name, converted(name, getattr(self, name), kind))
        plugins.import_modules(self.imports)
        object.__setattr__(self, "task_options", _as_json(self.task_options))
        for name in _MIXES:  # sorted, so that equal mixes give equal runs
            object.__setattr__(self, name, dict(sorted(getattr(self, name).items())))
        for name in _COUNTS:
            _expect(self, name, getattr(self, name) >= 1, "at least 1")
        for name in _POSITIVE:
            value = getattr(self, name)
            _expect(self, name, math.isfinite(value) and value > 0, "finite and above 0")
        for name in _FRACTIONS:
            _expect(self, name, 0 <= getattr(self, name) <= 1, "between 0 and 1")
        for name in _AT_LEAST_0:
            value = getattr(self, name)
            _expect(self, name, math.isfinite(value) and value >= 0, "finite and at least 0")
        _expect(self, "seed", self.seed >= 0, "at least 0")
        std = self.final_action_std
        valid = std is None or (math.isfinite(std) and std > 0)
        _expect(self, "final_action_std", valid, "None, or finite and above 0")
        valid = all(-1 <= number <= 1 for number in self.initial_action)
        _expect(self, "initial_action", valid, "numbers from -1 to 1")
        for name, kind in (("device", Device), ("learning_rate_schedule", Schedule)):
            choices = get_args(kind)
            _expect(self, name, getattr(self, name) in choices, f"one of {', '.join(choices)}")
        valid = bool(self.hidden_sizes) and min(self.hidden_sizes) >= 1
        _expect(self, "hidden_sizes", valid, "one or more widths of at least 1")
        self._check_mixes()
        self._check_combinations()

    def _check_mixes(self) -> None:
        """Check the shares of policies."""
        for name in _MIXES:
            shares = getattr(self, name).values()
            valid = all(math.isfinite(share) and share >= 0 for share in shares)
            valid = valid and (not shares or sum(shares) > 0)
            _expect(self, name, valid, "policies with finite shares of at least 0, one above 0")

    def _check_combinations(self) -> None:
        """Check fields that depend on each other."""
        total = self.latest_fraction + self.past_fraction
        if total > 1.0 + 1e-6:
            raise ValueError(f"latest_fraction + past_fraction must be at most 1, got {total:g}")
        if self.resume and self.overwrite:
            raise ValueError("resume and overwrite exclude each other, got both")
        if self.final_gamma is not None:  # the horizon 1 / (1 - discount) has to be finite
            for name in ("gamma", "final_gamma"):
                valid = 0 <= getattr(self, name) < 1
                _expect(self, name, valid, "at least 0 and below 1 where final_gamma is set")
        if self.learning_rate_schedule == "adaptive" and self.n_epochs == 1:
            # An only pass is never cut short, so the rate would never fall.
            raise ValueError("n_epochs must be at least 2 if learning_rate_schedule is adaptive")

    @classmethod
    def for_task(cls, task: str, **changes: Any) -> Self:  # noqa: ANN401  (any field)
        """Return the recommended settings for a task, with changes.

        Args:
            task: a registered name or an alias.
            **changes: values by field; others have the values of `rsoccer.train.task_settings`, or
                their defaults.

        Raises:
            TypeError: a field that does not exist.
            ValueError: a value that the settings refuse.

        Example:
            >>> Args.for_task("VSS-v0", samples=1_000_000).samples
            1000000
        """
        plugins.import_modules(changes.get("imports", ()))  # one may register the name
        return cls(**{"task": task, **recommended_settings(task), **changes})

    def make_task(self) -> Task:
        """Return a new task with its options.

        Raises:
            ValueError: an unknown task, or options that it refuses.
        """
        return task_with_options(self.task, self.task_options)

    def to_json(self) -> dict[str, Any]:
        """Return the settings as JSON values by field name; `Args(**values)` restores them."""
        return {
            **dataclasses.asdict(self),
            "out": str(self.out),
            "hidden_sizes": list(self.hidden_sizes),
            "initial_action": list(self.initial_action),
            "masked_observations": list(self.masked_observations),
            "imports": list(self.imports),
        }

    def differences(self, saved: dict[str, Any]) -> list[str]:
        """Return the settings that differ from a saved run's and would change its updates.

        Args:
            saved: settings of the saved run, from `to_json`. Settings that it lacks are newer than
                the run, and count with their defaults.

        Returns:
            One text per field, such as "gamma was 0.985, now 0.9"; empty if the run may resume.
            Fields in `CHANGEABLE_ON_RESUME` are ignored.
        """
        current = self.to_json()
        saved = {**type(self)().to_json(), **saved}
        names = [name for name in {**current, **saved} if name not in CHANGEABLE_ON_RESUME]
        return [
            f"{name} was {saved.get(name)!r}, now {current.get(name)!r}"
            for name in names
            if current.get(name) != saved.get(name)
        ]


@cache
def _types() -> dict[str, Any]:
    """Types of the fields by name."""
    return get_type_hints(Args)


_COUNTS = (
    *("samples", "threads", "torch_threads", "worlds", "horizon", "action_repeat"),
    *("n_epochs", "n_minibatches", "pool_size", "pool_interval", "ladder_matches"),
)
_POSITIVE = (
    *("learning_rate", "clip_range", "target_kl", "max_grad_norm", "action_std"),
    "checkpoint_interval",
)
_FRACTIONS = (
    *("solo_fraction", "solo_copies", "random_truncation", "gamma", "gae_lambda"),
    *("latest_fraction", "past_fraction"),
)
_AT_LEAST_0 = ("entropy_coef", "value_coef", "pfsp_power", "ladder_interval", "robot_units")
_MIXES = ("opponents", "teammates")


def _as_json(options: Mapping[str, Any]) -> dict[str, Any]:
    """Copy of the task's options as JSON values, with the models of files."""
    try:
        return {name: encoded(f"task_options: {name}", value) for name, value in options.items()}
    except (OSError, TypeError) as error:
        raise ValueError(str(error)) from error


def _expect(args: Args, name: str, valid: bool, expected: str) -> None:
    """Raise ValueError, which names the field, unless its value is valid."""
    if not valid:
        raise ValueError(f"{name} must be {expected}, got {getattr(args, name)!r}")

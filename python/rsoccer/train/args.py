"""What a training run can be told, with defaults that learn three-a-side play on two cores.

No torch here: the command line reads this file to build its help.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

SETTINGS_FILE = "args.json"
"""In a run's folder: its settings, as they were when it was begun or resumed."""

FREE_ON_RESUME = ("out", "resume", "overwrite", "samples", "checkpoint_interval", "progress")
"""Fields that a resumed run may set. Of these only `samples` changes what an update computes: the
step size falls towards the end that it names."""


@dataclass(frozen=True)
class Args:
    """Settings of one training run. A sample is one decision of one learning robot."""

    task: str = "VSSSelfPlay-v0"
    """registered task to train on (`rsoccer list` names them)"""
    out: Path = Path("out/train")
    """folder for the policy, checkpoint, logs and curve data"""
    samples: int = 10_000_000
    """decisions to learn from, summed over all learning robots"""
    seed: int = 0
    """the same seed, settings, machine and threads give the same run"""
    threads: int = 2
    """threads for physics"""
    torch_threads: int = 1
    """threads for torch; more pay for wide networks only, small ones just wait for each other"""
    resume: bool = False
    """continue the run in `out` from its last checkpoint"""
    overwrite: bool = False
    """start anew in `out` even if it already holds a run"""
    checkpoint_interval: float = 30.0
    """most time between two checkpoints; more loses more if the machine dies"""
    progress: bool = True
    """show a progress bar"""

    solo_fraction: float = 0.4
    """share of the samples at the start in which one robot of a match learns and all others
    drift; what it is paid for is then its own doing (0 lets all learn from the start)"""
    worlds: int = 256
    """matches played at once; more gives steadier gradients and slower first progress"""
    horizon: int = 16
    """decisions played in every world between two updates; longer sees more of an episode"""
    action_repeat: int = 3
    """control steps (25 ms) that each decision is held; more explores further, reacts slower"""
    random_truncation: float = 0.01
    """chance after each decision that a match is cut off, as by the clock, and starts anew: more
    gives fresh starts in place of long stalemates, less shows how matches end"""
    gamma: float = 0.97
    """discount per control step, so its meaning does not change with `action_repeat`; closer to 1
    looks further ahead and, as waiting costs less, learns to hurry more slowly"""
    gae_lambda: float = 0.9
    """1 trusts played rewards only, 0 the value network only"""

    hidden_sizes: tuple[int, ...] = (64, 64)
    """widths of the hidden layers, of the policy and of the value network alike"""
    action_std: float = 0.6
    """spread of the first random actions, as a share of full power"""
    learning_rate: float = 2e-3
    """Adam's step size at the start; it falls to a tenth of it by the end"""
    n_epochs: int = 6
    """times each batch is learned from; more learns faster until the policy changes too much"""
    n_minibatches: int = 4
    """pieces that a batch is split into for each epoch"""
    clip_range: float = 0.2
    """how far one update may move the probability of an action, as a ratio"""
    target_kl: float = 0.02
    """KL divergence from the policy that played at which the epochs of an update stop"""
    entropy_coef: float = 0.002
    """reward for staying random; raise it if play freezes early"""
    value_coef: float = 0.5
    """weight of the value network's error"""
    max_grad_norm: float = 0.5
    """gradients longer than this are shortened to it"""

    latest_fraction: float = 0.5
    """share of matches against the current self (tasks where both sides learn)"""
    past_fraction: float = 0.35
    """share of matches against frozen past selves"""
    ou_fraction: float = 0.15
    """share of matches against random drifting (an Ornstein-Uhlenbeck process)"""
    pool_size: int = 8
    """frozen past selves kept; when full, the one closest in age to its neighbours makes room"""
    pool_interval: int = 10
    """updates between two additions to the frozen past selves"""

    def __post_init__(self) -> None:
        """Refuse values that cannot train, naming the field."""
        object.__setattr__(self, "out", Path(self.out))
        object.__setattr__(self, "hidden_sizes", tuple(self.hidden_sizes))
        for name in _COUNTS:
            _expect(self, name, getattr(self, name) >= 1, "at least 1")
        for name in _POSITIVE:
            value = getattr(self, name)
            _expect(self, name, math.isfinite(value) and value > 0, "finite and above 0")
        for name in _SHARES:
            _expect(self, name, 0 <= getattr(self, name) <= 1, "between 0 and 1")
        for name in ("entropy_coef", "value_coef"):
            value = getattr(self, name)
            _expect(self, name, math.isfinite(value) and value >= 0, "finite and at least 0")
        _expect(self, "seed", self.seed >= 0, "at least 0")
        self._check_together()

    def _check_together(self) -> None:
        widths = all(isinstance(width, int) and width >= 1 for width in self.hidden_sizes)
        _expect(
            self,
            "hidden_sizes",
            widths and bool(self.hidden_sizes),
            "one or more widths of at least 1",
        )
        total = self.latest_fraction + self.past_fraction + self.ou_fraction
        if not math.isclose(total, 1.0, abs_tol=1e-6):
            raise ValueError(
                f"latest_fraction + past_fraction + ou_fraction must be 1, got {total:g}"
            )
        if self.resume and self.overwrite:
            raise ValueError("resume and overwrite exclude each other")

    def to_json(self) -> dict[str, Any]:
        """The settings as plain JSON values."""
        return {
            **dataclasses.asdict(self),
            "out": str(self.out),
            "hidden_sizes": list(self.hidden_sizes),
        }

    def differences(self, saved: dict[str, Any]) -> list[str]:
        """Fields whose value differs from a saved run's in a way that would change the run."""
        own = self.to_json()
        names = [name for name in {**own, **saved} if name not in FREE_ON_RESUME]
        return [
            f"{name} was {saved.get(name)!r}, now {own.get(name)!r}"
            for name in names
            if own.get(name) != saved.get(name)
        ]


_COUNTS = (
    *(
        "samples",
        "threads",
        "torch_threads",
        "worlds",
        "horizon",
        "action_repeat",
        "n_epochs",
        "n_minibatches",
    ),
    *("pool_size", "pool_interval"),
)
_POSITIVE = (
    *("learning_rate", "clip_range", "target_kl", "max_grad_norm", "action_std"),
    "checkpoint_interval",
)
_SHARES = (
    "solo_fraction",
    "random_truncation",
    "gamma",
    "gae_lambda",
    "latest_fraction",
    "past_fraction",
    "ou_fraction",
)


def _expect(args: Args, name: str, good: bool, expected: str) -> None:
    if not good:
        raise ValueError(f"{name} must be {expected}, got {getattr(args, name)!r}")

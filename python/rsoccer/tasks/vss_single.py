"""`VSS-v0`: a single learner with teammates and opponents that follow policies."""

from dataclasses import dataclass

from rsoccer.task import LEARN, Learn
from rsoccer.tasks import options
from rsoccer.tasks.vss import Vss


@dataclass(frozen=True)
class VssSingle(Vss):
    """VSSS match in which blue_0 learns; its teammates and its opponents follow policies.

    Goal of the task, initial state, reward terms, termination and metrics are those of `Vss`.

    Source: the single-agent task of the rSoccer paper (2021), whose other robots follow
    Ornstein-Uhlenbeck noise, here the policy "ou".
    """

    teammates: str = "ou"
    """Policy of the other blue robots: a policy's name or the path of a policy file."""
    opponent: str = "ou"
    """Policy of the yellow robots: a policy's name or the path of a policy file."""

    def __post_init__(self) -> None:
        """Validate the options."""
        super().__post_init__()
        options.set_policies(self, "teammates", "opponent")

    def default_controllers(self) -> dict[str, str | Learn]:
        """Return `LEARN` for blue_0 and the policies of the options for the others."""
        blue = dict.fromkeys(self.robots[: self.n_blue], self.teammates)
        yellow = dict.fromkeys(self.robots[self.n_blue :], self.opponent)
        return {**blue, **yellow, "blue_0": LEARN}

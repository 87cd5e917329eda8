"""`VSSMulti-v0`: a team of learners against a team that follows a policy."""

from dataclasses import dataclass

from rsoccer.frame import robot_names
from rsoccer.task import LEARN, Learn
from rsoccer.tasks import options
from rsoccer.tasks.vss import Vss


@dataclass(frozen=True)
class VssMulti(Vss):
    """VSSS match in which every blue robot is an independent learner; yellow follows a policy.

    Goal of the task, initial state, reward terms, termination and metrics are those of `Vss`.

    Source: the multi-agent task of the rSoccer paper (2021).
    """

    opponent: str = "ou"
    """Policy of the yellow robots: a policy's name or the path of a policy file."""

    def __post_init__(self) -> None:
        """Validate the options."""
        super().__post_init__()
        options.set_policies(self, "opponent")

    def default_controllers(self) -> dict[str, str | Learn]:
        """Return `LEARN` for blue robots and the policy `opponent` for yellow ones."""
        blue = dict.fromkeys(robot_names(self.n_blue, 0), LEARN)
        return blue | dict.fromkeys(robot_names(0, self.n_yellow), self.opponent)

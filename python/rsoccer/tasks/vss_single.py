"""`VSS-v0`: one learner among robots that do not learn. The paper's single-agent task."""

from dataclasses import dataclass

from rsoccer.task import LEARN, Learn
from rsoccer.tasks.vss import Vss


@dataclass(frozen=True)
class VssSingle(Vss):
    """blue_0 learns; its teammates and its opponents follow policies."""

    teammates: str = "ou"  # a policy's name or file
    opponent: str = "ou"  # likewise

    def default_controllers(self) -> dict[str, str | Learn]:
        """blue_0 learns, `teammates` and `opponent` drive the others."""
        blue = dict.fromkeys(self.robots[: self.n_blue], self.teammates)
        yellow = dict.fromkeys(self.robots[self.n_blue :], self.opponent)
        return {**blue, **yellow, "blue_0": LEARN}

"""`VSSMulti-v0`: a team of learners against a team that does not learn."""

from dataclasses import dataclass

from rsoccer.frame import robot_names
from rsoccer.task import LEARN, Learn
from rsoccer.tasks.vss import Vss


@dataclass(frozen=True)
class VssMulti(Vss):
    """Blue learns, each robot for itself; yellow follows a policy. The paper's multi-agent task."""

    opponent: str = "ou"  # a policy's name or file

    def default_controllers(self) -> dict[str, str | Learn]:
        """Blue learns; `opponent` drives yellow."""
        blue = dict.fromkeys(robot_names(self.n_blue, 0), LEARN)
        return blue | dict.fromkeys(robot_names(0, self.n_yellow), self.opponent)

"""Opponents and official scenarios of the evaluation."""

from __future__ import annotations

from typing import Final

from rsoccer.registry import make_task
from rsoccer.tasks import scenarios

VSSS: Final = ("ou", "zero", "chase", "scripted")
SSL: Final = ("ou", "zero", "strike")
SCENARIOS: Final = {
    "SSLStaticDefenders-v0": scenarios.N_STATIC_DEFENDERS,
    "SSLContestedPossession-v0": scenarios.N_CONTESTED_POSSESSION,
}
"""Numbers of official scenarios; policies of the task's random initial states play them too."""
OFFICIAL: Final = "official scenarios"
"""Name of their row, in the place of an opponent."""


def opponents_of(task: str) -> tuple[str | None, ...]:
    """Return the opponents of a task's policies; None is the task's own."""
    if not make_task(task).two_sided:
        return (None,)
    return VSSS if task.startswith("VSS") else SSL

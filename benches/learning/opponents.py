"""Official scenarios of the evaluation; opponents are those of `rsoccer.benchmark.protocol`."""

from __future__ import annotations

from typing import Final

from rsoccer.tasks import scenarios

SCENARIOS: Final = {
    "SSLStaticDefenders-v0": scenarios.N_STATIC_DEFENDERS,
    "SSLContestedPossession-v0": scenarios.N_CONTESTED_POSSESSION,
}
"""Numbers of official scenarios; policies of the task's random initial states play them too."""
OFFICIAL: Final = "official scenarios"
"""Name of their row, in the place of an opponent."""

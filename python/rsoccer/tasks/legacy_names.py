"""The environments of rsoccer-gym 1.4, by the names that they had there.

An alias asks of the robots what its environment did; observations and rewards are this package's.
"""

from typing import Any, Final

from rsoccer.registry import alias, retire

KEPT: Final = (
    "VSS-v0",
    "SSLGoToBall-v0",
    "SSLStaticDefenders-v0",
    "SSLDribbling-v0",
    "SSLContestedPossession-v0",
    "SSLPassEndurance-v0",
)
"""Names that the tasks here have too."""
ALIASES: Final[dict[str, tuple[str, dict[str, Any]]]] = {
    "VSSMA-v0": ("VSSMulti-v0", {}),
    # Its opponent was a network that the package did not come with; here, a script.
    "VSSMAOpp-v0": ("VSSMulti-v0", {"opponent": "scripted:0.5"}),
    # The same task on FIRASim, another simulator.
    "VSSFIRA-v0": ("VSS-v0", {}),
    "SSLGoToBallIR-v0": ("SSLGoToBall-v0", {"n_opponents": 6}),
    "SSLGoToBallShoot-v0": ("SSLStaticDefenders-v0", {"n_opponents": 0, "max_steps": 2400}),
    "SSLPassEnduranceMA-v0": ("SSLPassEnduranceMulti-v0", {}),
}
"""Tasks and options for the other names."""
GONE: Final = {
    "VSSGk-v0": "its attacker was a network that rsoccer-gym did not come with; a task of your own "
    "can pay a robot for keeping the goal against any policy",
}
"""Why there is none of this name, and what to take instead."""


def announce() -> None:
    """Make the names known, once the tasks are."""
    for name, (task, options) in ALIASES.items():
        alias(name, task, **options)
    for name, hint in GONE.items():
        retire(name, hint)

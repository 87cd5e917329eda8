"""Names of the environments of rsoccer-gym 1.4, as aliases of the tasks here.

An alias sets the same problem as the environment of that name. Observations and rewards are those
of this package.
"""

from typing import Any, Final

from rsoccer.registry import alias, register_removed

KEPT: Final = (
    "VSS-v0",
    "SSLGoToBall-v0",
    "SSLStaticDefenders-v0",
    "SSLDribbling-v0",
    "SSLContestedPossession-v0",
)
"""Names that tasks of this package have too."""
ALIASES: Final[dict[str, tuple[str, dict[str, Any]]]] = {
    "VSSMA-v0": ("VSSMulti-v0", {}),
    # Its opponent was a network that the package did not include; here it is a scripted policy.
    "VSSMAOpp-v0": ("VSSMulti-v0", {"opponent": "scripted:0.5"}),
    # The same task on another simulator, FIRASim.
    "VSSFIRA-v0": ("VSS-v0", {}),
    "SSLGoToBallIR-v0": ("SSLGoToBall-v0", {"n_opponents": 6}),
    "SSLGoToBallShoot-v0": ("SSLStaticDefenders-v0", {"n_opponents": 0, "max_steps": 2400}),
    "SSLPassEnduranceMA-v0": ("SSLPassEnduranceMulti-v1", {}),
}
"""Tasks and options by alias."""
REMOVED: Final = {
    "SSLPassEndurance-v0": "there a ball that was carried to the receiver counted as a pass; "
    "'SSLPassEndurance-v1' asks for a ball that travels free",
    "VSSGk-v0": "its attacker was a network that rsoccer-gym did not come with; a task of your own "
    "can pay a robot for keeping the goal against any policy",
}
"""Reason and replacement by name, for names without a task."""


def register_aliases() -> None:
    """Register the aliases and removed names; the tasks must be registered before."""
    for name, (task, options) in ALIASES.items():
        alias(name, task, **options)
    for name, hint in REMOVED.items():
        register_removed(name, hint)

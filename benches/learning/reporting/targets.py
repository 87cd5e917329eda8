"""Targets of the study: scores that the lower ends of the intervals should reach."""

from typing import Final

from benches.learning.opponents import OFFICIAL

TARGETS: Final[dict[tuple[str, str], float]] = {
    ("VSS-v0", "ou"): 0.95,
    ("VSS-v0", "zero"): 0.9,
    ("VSS-v0", "scripted"): 0.6,
    ("VSSMulti-v0", "ou"): 0.97,
    ("VSSMulti-v0", "@ppo/VSS-v0"): 0.3,
    ("VSSSelfPlay-v0", "ou"): 0.9,
    ("VSSSelfPlay-v0", "zero"): 0.9,
    ("VSSSelfPlay-v0", "chase"): 0.9,
    ("VSSSelfPlay-v0", "scripted"): 0.9,
    ("SSLGoToBall-v0", "-"): 0.99,
    ("SSLPassEndurance-v1", "-"): 0.98,
    ("SSLContestedPossession-v0", "-"): 0.9,
    ("SSLStaticDefenders-v0", "-"): 0.85,
    ("SSLStaticDefenders-v0", OFFICIAL): 0.85,
    ("SSLPassEnduranceMulti-v1", "-"): 10.0,
    ("SSLSelfPlay-v0", "strike"): 0.0,  # more wins than losses
}
"""Score by task and opponent; "-" is the task's own, "@ppo/TASK" a policy of another task."""

PASSES: Final[dict[tuple[str, str], float]] = {("SSLSelfPlay-v0", "strike"): 1.0}
"""Passes per match by task and opponent: a side that plays passes makes one at least."""

FULL_SUCCESS: Final[dict[str, float]] = {"SSLDribbling-v0": 0.9}
"""Share of episodes with full success, by task, where the target is not a score."""

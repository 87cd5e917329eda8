"""The shipped policy that plays each task best."""

from typing import Final

SOLVERS: Final[dict[str, str]] = {
    "SSLContestedPossession-v0": "strike",
    "SSLDribbling-v0": "weave",
    "SSLGoToBall-v0": "fetch",
    "SSLKeepaway-v0": "keep",
    "SSLMatch-v0": "scripted",
    "SSLPassEndurance-v1": "passer",
    "SSLPassEnduranceMulti-v1": "passer",
    "SSLSelfPlay-v0": "strike",
    "SSLStaticDefenders-v0": "strike",
    "VSS-v0": "scripted",
    "VSSMatch-v0": "scripted",
    "VSSMulti-v0": "scripted",
    "VSSSelfPlay-v0": "scripted",
}
"""Name of the policy by task. `docs/solved.json` has its measured results."""

EPISODIC: Final = {task: name for task, name in SOLVERS.items() if "Match-" not in task}
"""The same without whole matches, which last too long to be played many times."""

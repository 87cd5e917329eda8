"""Study of runs that take seconds, for tests in processes of their own."""

from typing import Any, Final

from benches.learning.experiments import Experiment, Protocol, Study

TINY: Final[dict[str, Any]] = {
    "samples": 600,
    "rollout.worlds": 10,
    "rollout.horizon": 20,
    "network.hidden_sizes": (8,),
    "ppo.n_epochs": 2,
    "ppo.n_minibatches": 1,
}
LONGER: Final = {**TINY, "samples": 6_000}
PROTOCOL: Final = Protocol(starts=2)
VSS: Final = Experiment("ppo", "VSS-v0", "VSS-v0", settings=TINY, seeds=2, opponents=("ou", "zero"))
STUDY: Final = Study(
    (
        VSS,
        Experiment("ppo", "SSLGoToBall-v0", "SSLGoToBall-v0", settings=TINY, seeds=1),
        Experiment(
            "cooperation",
            "clones",
            "VSSMulti-v0",
            "clones",
            settings={"policy": "@ppo/VSS-v0"},
            seeds=1,
            opponents=("@ppo/VSS-v0",),
            needs=(VSS,),
        ),
        Experiment("interrupted", "run", "SSLPassEndurance-v1", settings=LONGER, seeds=1),
    ),
    PROTOCOL,
)

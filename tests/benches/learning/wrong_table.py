"""Study of experiments that cannot run, for tests."""

from typing import Final

from benches.learning.experiments import Experiment, Study

MISSPELT: Final = Experiment("a", "misspelt", "VSS-v0", settings={"ppo.gama": 0.9}, seeds=1)
STUDY: Final = Study(
    (
        MISSPELT,
        Experiment("a", "dependent", "VSS-v0", seeds=1, needs=(MISSPELT,)),
        Experiment("a", "mask", "VSS-v0", settings={"network.masked_observations": ["x"]}, seeds=1),
        Experiment("a", "rows", "VSS-v0", "sac", settings={"rows": "x"}, seeds=1),
        Experiment("a", "unknown", "VSS-v9", seeds=1),
    )
)

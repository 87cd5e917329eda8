"""Study of experiments that cannot run, for tests."""

from typing import Final

from benches.learning.experiments import Experiment, Study

STUDY: Final = Study(
    (
        Experiment("a", "misspelt", "VSS-v0", settings={"gama": 0.9}, seeds=1),
        Experiment("a", "unknown", "VSS-v9", seeds=1),
    )
)

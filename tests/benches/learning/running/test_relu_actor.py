from pathlib import Path

import numpy as np

from benches.learning.running.relu_actor import ReluActor
from rsoccer.rng import WorldRng


def test_an_actor_survives_its_file(tmp_path: Path) -> None:
    rng = np.random.default_rng(0)

    def layer(inputs: int, outputs: int) -> tuple[np.ndarray, np.ndarray]:
        return (
            rng.normal(size=(outputs, inputs)).astype(np.float32),
            rng.normal(size=outputs).astype(np.float32),
        )

    actor = ReluActor([layer(4, 8), layer(8, 2)], 3, layer(8, 2))
    actor.save(tmp_path / "actor.npz")
    loaded = ReluActor.load(tmp_path / "actor.npz")
    observations = rng.normal(size=(5, 1, 4)).astype(np.float32)
    for one, other in ((actor, loaded), (actor.mean(), loaded.mean())):
        expected = one.choose(observations, WorldRng.seeded(1, 5))
        np.testing.assert_array_equal(other.choose(observations, WorldRng.seeded(1, 5)), expected)
    assert loaded.action_repeat == 3

"""Short tasks, registered for the tests of this folder only, a run, and libraries of products."""

from collections.abc import Iterator
from pathlib import Path

import pytest
import torch

from rsoccer.registry import names as registry_names
from rsoccer.train import train
from rsoccer.train.network import perceptron
from rsoccer.train.opponents import opponent_pool
from tests.train.short_task import register_all, tiny


@pytest.fixture(autouse=True, scope="module")
def short_tasks() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(registry_names, "_TASKS", dict(registry_names._TASKS))
        register_all()
        # A run of six updates fills the pool, and evicts past policies from it.
        patch.setattr(opponent_pool, "POOL_SIZE", 2)
        patch.setattr(opponent_pool, "FREEZE_INTERVAL", 1)
        yield


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a run without interruption."""
    folder = tmp_path_factory.mktemp("finished")
    train(tiny(folder))
    return folder


@pytest.fixture(params=[False, True], ids=["mkl", "onednn"])
def onednn(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> bool:
    """Products in single precision by either library, whatever the processor has.

    With oneDNN those of few rows are by it, too.
    """
    if request.param and not hasattr(torch.ops.mkldnn, "_linear_pointwise"):
        pytest.skip("this torch has no oneDNN")
    monkeypatch.setattr(perceptron, "_ONEDNN_IS_FASTER", request.param)
    monkeypatch.setattr(perceptron, "MIN_ONEDNN_ROWS", 1)
    return bool(request.param)

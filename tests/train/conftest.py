"""Short tasks, which are registered for the tests of this folder only, and a finished run."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from rsoccer import registry
from rsoccer.train import train
from tests.train.short_task import register_all, tiny


@pytest.fixture(autouse=True, scope="module")
def short_tasks() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(registry, "_TASKS", dict(registry._TASKS))
        register_all()
        yield


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder of a run without interruption."""
    folder = tmp_path_factory.mktemp("finished")
    train(tiny(folder))
    return folder

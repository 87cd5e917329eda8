"""Registers the short tasks for the tests of this folder only."""

from collections.abc import Iterator

import pytest

from rsoccer import registry
from tests.train.short_task import register_all


@pytest.fixture(autouse=True, scope="module")
def short_tasks() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(registry, "_TASKS", dict(registry._TASKS))
        register_all()
        yield

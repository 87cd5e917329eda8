"""Fixtures of the tests of commands."""

from pathlib import Path
from typing import Any

import pytest

import rsoccer
from rsoccer.arrays import Array


@pytest.fixture
def filmed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[Any]:
    """Replace the video by a record of the task, the controllers and the names of the teams."""
    record, video = pytest.importorskip("rsoccer.recording"), tmp_path / "never.mp4"
    filmed: list[Any] = []

    def film(task: rsoccer.Task, controllers: Any, *_: Any, names: Any, **__: Any) -> Any:  # noqa: ANN401
        filmed.append((task.name, controllers, names))
        images: list[Array] = []
        return (image for image in images), 40.0

    monkeypatch.setattr(record, "film_match", film)
    monkeypatch.setattr("rsoccer.render.video.write_video", lambda *_: video)
    return filmed

"""PettingZoo's tests of time limits and rendering; `test_parallel.py` runs its other tests."""

from collections.abc import Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from pettingzoo.utils import wrappers
from pettingzoo.utils.conversions import parallel_to_aec

import rsoccer
from rsoccer.envs.aec import env
from rsoccer.envs.parallel import SoccerParallelEnv
from tests.envs.test_parallel import official
from tests.fake_moviepy import assert_filmed, moviepy
from tests.parallel_matches import TASKS


class Seeded(SoccerParallelEnv):
    """A match with a fixed seed and fixed actions, although the test sets none.

    With random ones an episode might end before the time limit.
    """

    def reset(self, seed: int | None = None, options: Mapping[str, Any] | None = None) -> Any:  # noqa: ANN401
        for agent in self.possible_agents:
            self.action_space(agent).seed(0)
        return super().reset(0, options)


@pytest.mark.parametrize("name", TASKS)
def test_episodes_last_exactly_max_cycles(name: str) -> None:
    def match(max_cycles: int) -> Seeded:
        return Seeded(rsoccer.make_task(name, max_steps=max_cycles))

    def in_turn(max_cycles: int) -> Any:  # noqa: ANN401
        return parallel_to_aec(match(max_cycles))

    official.max_cycles_test(SimpleNamespace(parallel_env=match, env=in_turn))


@pytest.mark.parametrize("name", TASKS)
def test_pettingzoo_accepts_the_rendering(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pygame")
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    official.render_test(lambda render_mode: env(name, render_mode=render_mode))


@pytest.mark.skipif(
    not hasattr(wrappers, "RecordVideoParallel"), reason="PettingZoo before 1.27 has none"
)
@pytest.mark.parametrize("name", ["VSSSelfPlay-v0", "SSLDribbling-v0"])  # one of each league
def test_pettingzoo_records_videos(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("pygame")
    clips = moviepy(monkeypatch)
    match = Seeded(rsoccer.make_task(name, max_steps=3), "rgb_array")
    recorder = wrappers.RecordVideoParallel(match, str(tmp_path / "videos"), bool)
    for _ in range(2):
        recorder.reset()
        while recorder.agents:
            recorder.step(
                {agent: recorder.action_space(agent).sample() for agent in recorder.agents}
            )
    recorder.close()
    assert_filmed(clips, 4)

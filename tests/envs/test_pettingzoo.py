"""PettingZoo's tests of clocks and pictures on every task; `test_parallel.py` runs its others."""

from collections.abc import Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from pettingzoo.utils import wrappers
from pettingzoo.utils.conversions import parallel_to_aec

import rsoccer
from rsoccer.envs.parallel import SoccerParallelEnv, env
from tests.envs.test_parallel import official
from tests.one_match import TASKS
from tests.stand_ins import assert_filmed, moviepy


class Seeded(SoccerParallelEnv):
    """The match of one seed with the actions of one, though the tester gives none.

    Else an episode might now and then end before the clock, by right.
    """

    def reset(self, seed: int | None = None, options: Mapping[str, Any] | None = None) -> Any:  # noqa: ANN401
        for agent in self.possible_agents:
            self.action_space(agent).seed(0)
        return super().reset(0, options)


@pytest.mark.parametrize("name", TASKS)
def test_episodes_last_exactly_max_cycles(name: str) -> None:
    def match(max_cycles: int) -> Seeded:
        return Seeded(rsoccer.make_task(name, max_steps=max_cycles))

    def turns(max_cycles: int) -> Any:  # noqa: ANN401
        return parallel_to_aec(match(max_cycles))

    official.max_cycles_test(SimpleNamespace(parallel_env=match, env=turns))


@pytest.mark.parametrize("name", TASKS)
def test_pettingzoo_accepts_what_is_rendered(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
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
    film = wrappers.RecordVideoParallel(match, str(tmp_path / "films"), bool)
    for _ in range(2):
        film.reset()
        while film.agents:
            film.step({agent: film.action_space(agent).sample() for agent in film.agents})
    film.close()
    assert_filmed(clips, 4)

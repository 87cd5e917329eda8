"""PettingZoo's test of pictures on every task; `test_parallel.py` runs its other tests.

Its `max_cycles_test` stays there, on one task: it seeds nothing, and an episode of some others may
end before the clock by right. That the clock ends those that last is in `test_single.py`.
"""

import pytest

from rsoccer.parallel import env
from tests.one_match import TASKS
from tests.test_parallel import official


@pytest.mark.parametrize("name", TASKS)
def test_pettingzoo_accepts_what_is_rendered(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pygame")
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    official.render_test(lambda render_mode: env(name, render_mode=render_mode))

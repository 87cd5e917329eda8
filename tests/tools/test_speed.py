from pathlib import Path

import pytest

from benches.result_files import Figure, store
from tests.benches.figures import (
    MACHINE,
    OTHER,
    OTHER_ENGINE,
    PSIM,
    RSOCCER,
    SCALING,
    THIRD_PARTY,
)
from tools import speed


def text_of(figures: list[Figure]) -> str:
    return speed.machine_speed("some-cpu", MACHINE, figures)


def test_results_without_third_party_simulators_are_shown() -> None:
    text = text_of(RSOCCER)
    assert text.startswith("Some CPU @ 2.5GHz, 2 cores, 2026-01-31, release build of commit abc")
    assert "| steps per second on one thread | 1 world | 64 worlds |" in text
    assert "| VSSS 3 v 3 random | 25,000 | 50,000 |" in text
    row = "| `Matches` | `VSSSelfPlay-v0` | 1,024 | 2 | 40,000 |  |  | 4 us per world-step |"
    assert row in text
    assert "59 KiB for SSL 11 v 11." in text
    assert "59 KiB for SSL 11 v 11" in text
    assert (
        "100,000 worlds (VSSS 3 v 3 random) in one process on 2 threads: build time 1.2 s" in text
    )
    assert "process memory 2.6 GiB after first contacts, 45,700 steps per second." in text
    assert "first environment and reset 0.13 s" in text
    assert "robosim" not in text
    assert "rSim" not in text
    assert "vmas" not in text


def test_results_with_third_party_simulators_show_ratios() -> None:
    text = text_of(RSOCCER + THIRD_PARTY + SCALING)
    assert "| steps per second on one thread | rSim | 1 world | speed-up |" in text
    assert "rSim (rc-robosim 1.2) is the simulator of robocin's rSoccer" in text
    row = "| VSSS 3 v 3 random | 500 | 25,000 | 50x (45x to 55x) | 50,000 | 100x (90x to 110x) |"
    assert row in text
    assert "compat.robosim` runs at least 20x as fast" in text
    assert "| vmas 1.5.2 | football | 1,024 | 2 | 20,000 |  |  |  |" in text
    assert "relative to vmas 1.5.2's football" in text
    assert "controlled: 2x (1.8x to 2.2x) at 1,024 worlds." in text
    assert "steps 30 to 40): 1.9x (1.71x to 2.09x)." in text
    assert "1.98x (1.78x to 2.18x) for hashing" in text
    assert "0.97x at 16,384" in text


def test_the_engine_that_is_not_the_default_has_columns_of_its_own() -> None:
    text = text_of(RSOCCER + THIRD_PARTY + SCALING + OTHER)
    assert "| VSSS 3 v 3 random | 500 | 25,000 | 50x (45x to 55x) |" in text
    assert f"`{OTHER_ENGINE}`, was measured in the same rounds:" in text
    row = "| VSSS 3 v 3 random | 10,000 | 30x (27x to 33x) | 2.5x (2.25x to 2.75x) | 20,000 |"
    assert row in text
    row = "1,024 | 2 | 40,000 | 30,000 | 1.3x (1.17x to 1.43x) | 4 us per world-step |"
    assert f"| `Matches` | `VSSSelfPlay-v0` | {row}" in text
    assert f"at 1,024 worlds; with `{OTHER_ENGINE}` 1.5x (1.35x to 1.65x) at 1,024" in text
    assert f"0.97x at 16,384 worlds; with `{OTHER_ENGINE}` 0.70x at 16,384." in text
    assert f"59 KiB for SSL 11 v 11 (20 KiB with `{OTHER_ENGINE}`)." in text


def test_psim_is_compared_by_steps_and_by_time_of_play() -> None:
    text = text_of(RSOCCER + PSIM)
    assert "| pSim 0.2.4 | VSSS 3 v 3 | 1 | 1 | 3,000 |" in text
    assert "`parallel_env` takes 2.5x (2.25x to 2.75x) as many steps a second" in text
    assert "200 in `parallel_env`, 220 in `Matches`, 50 in pSim." in text


def test_counted_instructions_are_shown(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    stored = tmp_path / "instructions.md"
    monkeypatch.setattr(speed, "STORED", stored)
    assert speed.instructions() == ""
    stored.write_text("| scene |\n")
    assert speed.instructions() == "| scene |\n"


def test_every_machine_has_a_section(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(speed, "RESULTS", tmp_path)
    assert speed.speed() == ""
    store(RSOCCER, MACHINE, tmp_path)
    assert "64 worlds" in speed.speed()


def test_the_sentence_on_speed_has_the_measured_numbers(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(speed, "RESULTS", tmp_path)
    assert "steps a second" not in speed.feature()
    store(RSOCCER, MACHINE, tmp_path)
    assert "at 25,000 steps a second on one thread of Some CPU @ 2.5GHz. [" in speed.feature()
    store(RSOCCER + THIRD_PARTY, MACHINE, tmp_path)
    assert "50 times as fast as rSim (rc-robosim 1.2), the simulator of rsoccer" in speed.feature()

import json
import random
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rsoccer.replay import Replay, ReplayError, container
from rsoccer.replay.quantized import STEPS
from tests.helpers import same
from tests.replay.conftest import sensed_vss, ssl, vss


def test_a_replay_comes_back(replay: Replay) -> None:
    content = replay.to_bytes()
    read = Replay.from_bytes(content)
    for name in ("task", "options", "controllers", "names", "config", "observers", "episodes"):
        assert getattr(read, name) == getattr(replay, name)
    assert (read.events, read.package, read.physics) == (
        replay.events,
        replay.package,
        replay.physics,
    )
    assert np.abs(read.frame.ball.position - replay.frame.ball.position).max() <= 5.1e-5
    assert np.abs(read.frame.robots.position - replay.frame.robots.position).max() <= 5.1e-5
    assert np.abs(read.commands - replay.commands).max() <= STEPS["left"] / 2 + 1e-5
    assert (read.score == replay.score).all()
    assert read.to_bytes() == content
    assert replay.to_bytes() == content


def test_metrics_that_no_file_holds_are_named(replay: Replay) -> None:
    first, *others = replay.episodes
    episodes = (replace(first, metrics={"own": float("nan")}), *others)
    with pytest.raises(ReplayError, match="metric 'own': expected a finite number, got nan"):
        replace(replay, episodes=episodes).to_bytes()


def test_rewards_are_accurate(replay: Replay) -> None:
    read = Replay.from_bytes(replay.to_bytes())
    assert list(read.terms) == list(replay.terms)
    for name, term in replay.terms.items():
        assert np.abs(read.terms[name] - term).max() <= np.abs(term).max() / 2**15
    assert np.abs(replay.rewards).max() > 0


def test_markers_are_rounded_to_tenths_of_millimeters() -> None:
    replay = ssl()
    read = Replay.from_bytes(replay.to_bytes())
    assert len(set(replay.markers)) > 1
    for found, expected in zip(read.markers, replay.markers, strict=True):
        assert [type(m) for m in found] == [type(m) for m in expected]
    (segment, target), (expected_segment, expected_target) = read.markers[-1], replay.markers[-1]
    assert vars(target)["center"] == pytest.approx(vars(expected_target)["center"], abs=6e-5)
    assert vars(segment)["end"] == pytest.approx(vars(expected_segment)["end"], abs=6e-5)


def test_rows_with_a_snapshot_and_the_snapshots_are_exact() -> None:
    replay = vss()
    read = Replay.from_bytes(replay.to_bytes())
    assert len(replay.snapshots) >= 2
    assert list(read.snapshots) == list(replay.snapshots)
    for frame, arrays in replay.snapshots.items():
        assert same(read.rows[frame], replay.rows[frame])
        assert list(arrays) == list(read.snapshots[frame])
        assert all(same(array, read.snapshots[frame][name]) for name, array in arrays.items())
    others = set(range(len(replay))) - set(replay.snapshots)
    assert any(not same(read.rows[frame], replay.rows[frame]) for frame in others)


def test_a_second_of_play_takes_few_kilobytes(replay: Replay) -> None:
    assert len(replay.to_bytes(snapshots=False)) / replay.seconds < 6 * 1024


def test_a_file_is_written_and_read(replay: Replay, tmp_path: Path) -> None:
    path = replay.save(tmp_path / "match.rsr")
    assert Replay.load(path).to_bytes() == path.read_bytes()
    with pytest.raises(ReplayError, match=r"ending in \.rsr"):
        replay.save(tmp_path / "match.bin")


def test_a_bad_file_is_refused_with_its_path(tmp_path: Path) -> None:
    path = tmp_path / "match.rsr"
    path.write_bytes(b"not a replay")
    with pytest.raises(ReplayError, match=r"match\.rsr is not a usable replay: magic"):
        Replay.load(path)
    with pytest.raises(FileNotFoundError):
        Replay.load(tmp_path / "absent.rsr")


def test_numbers_that_are_not_finite_are_not_written() -> None:
    replay = ssl()
    rows = replay.rows.copy()
    rows[3, 0] = np.nan
    with pytest.raises(ReplayError, match="rows"):
        replace(replay, rows=rows).to_bytes()
    objects = {0: {"frame": np.array([None])}}
    with pytest.raises(ReplayError, match="expected numbers in 'frame'"):
        replace(replay, snapshots=objects).to_bytes()


# -- Files that are wrong in one place ----------------------------------------------------------


def changed(key: str, value: object) -> bytes:
    """A file with a valid checksum and another value in its header."""
    header, sections = container.unpack(vss().to_bytes())
    at = header
    *path, last = key.split(".")
    for part in path:
        at = at[part]
    at[last] = value
    return container.pack(header, sections)


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        ("task", 5, "task: expected str, got int"),
        ("physics", "5", "physics: expected int"),
        ("config", "{}", "config: "),
        ("columns", {}, "columns: expected those of this package"),
        ("columns.ball", ["x"], "columns: expected those of this package"),
        ("frames", 10**15, "episodes: expected all"),
        ("frames", 0, "episodes"),
        ("frames", True, "frames: expected int, got bool"),
        ("names", ["A"], "names: expected two"),
        ("names", [1, 2], "names: expected texts"),
        ("steps.rows", [1.0], "rows: expected 83 columns"),
        ("steps.commands", [0.0] * 12, "steps of commands: expected positive numbers"),
        ("steps.terms", {"goal": float("1e300")}, "steps of term:goal: expected positive"),
        ("steps.terms", {"other": 1.0}, "expected 'term:other'"),
        ("steps.terms", [], "steps of terms: expected an object"),
        ("observers", ["blue_0"] * 10**4, "bytes"),
        ("episodes", [], "episodes: expected all"),
        ("episodes", [{"start": 0}], "episodes: expected start, stop"),
        ("events", [[-1, "goal", "", "blue"]], "events: expected a frame, a kind and a robot"),
        ("events", [[1, "party", "", ""]], "events: expected a frame, a kind and a robot"),
        ("events", [[1, "touch", "red_7", ""]], "events: expected a frame, a kind and a robot"),
        ("events", [1], "events: expected a frame and three texts"),
        ("options", 3, "options: expected an object or null"),
        ("controllers", {"blue_0": 1}, "controllers: expected names"),
        ("marker_sets", [[["Star", 1]]], "markers: expected one of"),
        ("marker_sets", [[["Target", [0, 0]]]], "markers: expected the fields of Target"),
        ("marker_sets", [[["Target", [0, "x"], 1]]], "markers: expected x and y"),
        ("markers", [[0, 7]], "markers: expected frames and sets in order"),
        ("markers", [[0]], "markers: expected a frame and a set"),
        ("markers", [], "markers: expected"),
        ("snapshots", [[0, []]], "snapshots: expected 0 bytes"),
        ("snapshots", [[0, [["frame", "|O", [1]]]]], "snapshots: expected a type of numbers"),
        ("snapshots", [[0, [["frame", "(9,9)f4", [1]]]]], "snapshots: expected a type"),
        ("snapshots", [[0, [["frame", "<f4", [2**40]]]]], "snapshots: expected a shape"),
        ("snapshots", [[0, [["frame", "<f4", [2**30, 2**30]]]]], "snapshots: expected .* fewer"),
        ("snapshots", [[10**6, []]], "snapshots: expected a frame and arrays"),
    ],
)
def test_a_wrong_value_is_refused_by_name(key: str, value: object, message: str) -> None:
    with pytest.raises(ReplayError, match=message):
        Replay.from_bytes(changed(key, value))


# -- Random damage ------------------------------------------------------------------------------


def only_replay_errors(content: bytes) -> bool:
    """Whether a file is refused; any other exception fails the test."""
    try:
        read = Replay.from_bytes(content)
    except ReplayError:
        return True
    assert read.score.shape == (len(read), 2)
    assert np.isfinite(read.rows).all()
    return False


def test_flipped_bytes_and_cut_files_are_refused() -> None:
    content, rng = vss().to_bytes(), random.Random(0)
    for _ in range(300):
        damaged = bytearray(content)
        for _ in range(rng.choice((1, 1, 5))):
            damaged[rng.randrange(len(damaged))] ^= rng.randrange(1, 256)
        assert only_replay_errors(bytes(damaged))
    for _ in range(100):
        assert only_replay_errors(content[: rng.randrange(len(content))])


def test_damage_under_a_valid_checksum_raises_no_other_error() -> None:
    rng = random.Random(1)
    header, sections = container.unpack(ssl().to_bytes())
    refused = 0
    for _ in range(400):
        damaged = dict(sections)
        name = rng.choice(sorted(damaged))
        damaged[name] = scrambled(damaged[name], rng)
        refused += only_replay_errors(container.pack(header, damaged))
    assert 0 < refused < 400


@pytest.mark.parametrize("recorded", [vss, ssl, sensed_vss])
def test_a_scrambled_header_raises_no_other_error(recorded: Callable[[], Replay]) -> None:
    rng = random.Random(2)
    header, sections = container.unpack(recorded().to_bytes())
    text = json.dumps(header)
    refused = 0
    for _ in range(300):
        mutated = json.loads(text)
        for _ in range(rng.choice((1, 1, 3))):
            replace_one(mutated, rng)
        refused += only_replay_errors(container.pack(mutated, sections))
    assert refused > 100


STRANGE: list[Any] = [None, True, 0, -1, 10**18, 2**31, 1e-310, 1e299, "", "blue_0", [], {}, [[]]]


def replace_one(value: Any, rng: random.Random) -> None:  # noqa: ANN401
    """Put something strange somewhere into nested lists and dictionaries."""
    keys = list(value) if isinstance(value, dict) else list(range(len(value)))
    if not keys:
        return
    key = rng.choice(keys)
    if isinstance(value[key], dict | list) and value[key] and rng.random() < 0.8:
        replace_one(value[key], rng)
    else:
        value[key] = rng.choice(STRANGE)


def scrambled(content: bytes, rng: random.Random) -> bytes:
    """Other bytes, or fewer of them."""
    if not content or rng.random() < 0.3:
        return content[: rng.randrange(len(content) + 1)] + b"\x00" * rng.randrange(3)
    start = rng.randrange(len(content))
    return content[:start] + rng.randbytes(20) + content[start + 20 :]

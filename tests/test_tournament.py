"""Tournaments: results, tables, pictures, and policies that are refused before anything plays."""

import json
from pathlib import Path

import numpy as np
import pytest

import rsoccer
from rsoccer.cli import main
from rsoccer.evaluate.tournament import summarize
from rsoccer.matches import Matches
from rsoccer.policies.network import Network
from rsoccer.policies.noise import Zero
from rsoccer.policies.policy_file import FORMAT
from rsoccer.registry import names as registry_names
from tests.train.short_task import NAME, ShortSelfPlay, register_all

TASK = ShortSelfPlay()


def write_network(path: Path, observation_size: int = TASK.layout.size) -> str:
    """Write a network that drives ahead."""
    arrays = {
        "layers.0.weight": np.zeros((2, observation_size), np.float32),
        "layers.0.bias": np.full(2, 0.5, np.float32),
        "mean": np.zeros(observation_size, np.float32),
        "std": np.ones(observation_size, np.float32),
    }
    metadata = {"format": FORMAT, "task": "VSSSelfPlay-v0", "activation": "tanh", "clip": "10"}
    metadata |= {"observation_size": str(observation_size), "action_size": "2"}
    path.parent.mkdir(exist_ok=True)
    Network(arrays, metadata).save(path)
    return str(path)


def test_everyone_plays_everyone_from_both_sides(tmp_path: Path) -> None:
    network = write_network(tmp_path / "ahead" / "policy.safetensors")
    pairs: list[tuple[int, int]] = []
    result = rsoccer.tournament(
        [Path(network), "zero", "chase"],
        matches=8,
        task=TASK,
        threads=1,
        on_pair=lambda done, total: pairs.append((done, total)),
    )
    assert pairs == [(1, 3), (2, 3), (3, 3)]
    assert result.matches == 8 and result.anchor is None and result.task == TASK.name
    assert {standing.label for standing in result.standings} == {"ahead", "zero", "chase"}
    played = [(s.wins + s.draws + s.losses) for s in result.standings]
    assert played == [16, 16, 16]
    wins, losses = (sum(getattr(s, n) for s in result.standings) for n in ("wins", "losses"))
    assert wins == losses > 0
    ratings = [standing.rating for standing in result.standings]
    assert ratings == sorted(ratings, reverse=True)
    assert np.mean(ratings) == pytest.approx(1000.0)
    scores = np.array(result.scores)
    np.testing.assert_allclose(scores, -scores.T)
    for standing, row in zip(result.standings, scores, strict=True):
        assert standing.score == pytest.approx(row.sum() / 2)
    assert json.loads(json.dumps(result.as_dict()))["standings"][0]["rating"] == ratings[0]


def test_both_policies_of_a_pair_have_the_same_starts_on_both_sides() -> None:
    """Two equal policies, one of which is named otherwise, have opposite results on the sides."""
    result = rsoccer.tournament([Zero(), "zero"], matches=20, task=TASK, threads=1)
    assert result.standings[0].wins == result.standings[0].losses > 0
    assert result.scores == ((0.0, 0.0), (0.0, 0.0))


def test_equal_seeds_give_equal_results_for_any_threads() -> None:
    first, second, other = (
        rsoccer.tournament(["ou", "chase"], 4, seed, task=TASK, threads=threads)
        for seed, threads in ((3, 1), (3, 2), (4, 1))
    )
    assert first == second != other
    assert first.anchor == "ou"
    assert {s.label: s.rating for s in first.standings}["ou"] == 1000.0


def test_a_file_named_as_the_anchor_is_not_the_anchor(tmp_path: Path) -> None:
    """Formerly the label chose the policy whose rating is 1000."""
    file = write_network(tmp_path / "ou" / "policy.safetensors")
    result = rsoccer.tournament([file, "chase", "zero"], 2, task=TASK, threads=1)
    assert result.anchor is None
    assert {standing.label for standing in result.standings} == {file, "chase", "zero"}
    with_noise = rsoccer.tournament([file, "ou"], 2, task=TASK, threads=1)
    assert with_noise.anchor == "ou"
    assert {s.policy: s.rating for s in with_noise.standings}["ou"] == 1000.0


def test_ssl_teams_play_tournaments() -> None:
    task = rsoccer.make_task("SSLSelfPlay-v0", max_steps=40)
    result = rsoccer.tournament(["strike", "zero"], 2, task=task, threads=1)
    assert len(result.standings) == 2


@pytest.mark.parametrize(
    ("policies", "task", "message"),
    [
        (["ou"], None, "at least two, got 1"),
        (["ou", "zero", "ou"], None, "'ou' twice"),
        (["ou", "nobody"], None, "unknown policy 'nobody'"),
        (["zero", "strike"], None, "strike cannot play VSSSelfPlay-v0"),
        (["zero", "fetch"], "SSLGoToBall-v0", "that two teams play, got SSLGoToBall-v0"),
    ],
)
def test_unfit_policies_are_refused_before_anything_is_played(
    policies: list[str], task: str | None, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Matches, "__init__", lambda *args, **options: pytest.fail("played"))
    with pytest.raises(ValueError, match=message):
        rsoccer.tournament(policies, task=task)


def test_files_are_refused_by_name(tmp_path: Path) -> None:
    path = write_network(tmp_path / "a.safetensors")
    same = str(tmp_path / "b" / ".." / "a.safetensors")
    with pytest.raises(ValueError, match="twice"):
        rsoccer.tournament([path, same])
    other = write_network(tmp_path / "other.safetensors", 5)
    with pytest.raises(ValueError, match=r"other.safetensors cannot play VSSSelfPlay-v0"):
        rsoccer.tournament(["ou", other], task="VSSSelfPlay-v0")
    with pytest.raises(FileNotFoundError):
        rsoccer.tournament(["ou", str(tmp_path / "gone.safetensors")])


@pytest.mark.parametrize("policies", ["ou", 3, ["ou", 4]])
def test_wrong_types_are_refused(policies: object) -> None:
    with pytest.raises(TypeError, match="polic"):
        rsoccer.tournament(policies)  # type: ignore[arg-type]


def counted(k: int) -> np.ndarray:
    """Return counts in which each policy beats the next, and the last the first."""
    counts = np.zeros((k, k, 3), np.int64)
    for a in range(k):
        for b in range(k):
            if a != b:
                counts[a, b] = (40, 5, 5) if (b - a) % k == 1 else (20, 10, 20)
    for a in range(k):
        counts[(a + 1) % k, a] = (5, 5, 40)
    return counts


def test_the_report_names_cycles() -> None:
    result = summarize(["rock", "scissors", "paper"], counted(3), "VSSSelfPlay-v0", 0)
    assert result.cycles == (("rock", "scissors", "paper"),)
    text = str(result)
    assert "rock beats scissors beats paper beats rock" in text
    lines = text.splitlines()
    assert lines[0] == "VSSSelfPlay-v0, 100 matches a pair, half from each side"
    assert lines[2].split() == [
        *("policy", "rating", "95%", "interval", "won", "drawn", "lost", "goal", "score"),
    ]
    assert "+0.70" in text and "-0.70" in text


def test_the_score_of_a_standing_is_a_mean_over_its_matches() -> None:
    counts = np.zeros((2, 2, 3), np.int64)
    counts[0, 1] = 3, 1, 1  # as blue
    counts[1, 0] = 0, 2, 3
    result = summarize(["chase", "zero"], counts, "VSSSelfPlay-v0", 0)
    assert [(s.label, s.wins, s.draws, s.losses, s.score) for s in result.standings] == [
        ("chase", 6, 3, 1, 0.5),
        ("zero", 1, 3, 6, -0.5),
    ]


def test_few_matches_have_neither_intervals_nor_cycles(tmp_path: Path) -> None:
    """Formerly one match a side had intervals of width 0, and cycles of them."""
    names = ["rock", "scissors", "paper"]
    one = np.zeros((3, 3, 3), np.int64)
    for a in range(3):
        one[a, (a + 1) % 3, 0] = one[(a + 1) % 3, a, 2] = 1
    for per_side in (1, 9, 10):
        result = summarize(names, one * per_side, "VSSSelfPlay-v0", 0)
        assert result.matches == 2 * per_side and result.scores[0][1] == 1.0
        assert result.save_picture(tmp_path / "result.png").stat().st_size > 1000
        text, loaded = str(result), json.loads(json.dumps(result.as_dict(), allow_nan=False))
        bounds = {standing[bound] for standing in loaded["standings"] for bound in ("low", "high")}
        if per_side == 10:
            assert result.cycles == (("rock", "scissors", "paper"),)
            assert None not in bounds and loaded["low"][0][1] == 1.0 and "[1000, 1000]" in text
            continue
        assert result.cycles == () and result.low is None and result.high is None
        assert bounds == {None}
        row = (str(2 * per_side), "0", str(2 * per_side), "+0.000")
        assert text.splitlines()[3].split() == ["rock", "1000", "-", *row]
        assert text.endswith("intervals and cycles of wins need 20 matches a pair or more")


@pytest.mark.parametrize("seed", range(3))
def test_teams_of_nearly_equal_skill_have_no_cycle_after_two_matches(seed: int) -> None:
    policies = [f"scripted:{skill}" for skill in (0.9, 0.91, 0.92, 0.93)]
    result = rsoccer.tournament(policies, matches=2, seed=seed, task=TASK, threads=1)
    assert result.cycles == ()


def test_the_command_prints_and_writes_the_result(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(registry_names, "_TASKS", dict(registry_names._TASKS))
    register_all()
    paths = [tmp_path / "result.json", tmp_path / "result.png"]
    words = ["tournament", "chase", "ou", "--matches", "2", "--task", NAME, "--threads", "1"]
    assert main([*words, "--json", str(paths[0]), "--picture", str(paths[1])]) == 0
    printed = capsys.readouterr().out
    assert "goal score of the row against the column" in printed
    assert f"picture: {paths[1]}" in printed
    written = json.loads(paths[0].read_text())
    assert written["matches"] == 2 and written["standings"][0]["low"] is None
    assert paths[1].read_bytes().startswith(b"\x89PNG")
    assert main([*words, "--picture", str(tmp_path / "result.jpg")]) == 2
    assert ".png" in capsys.readouterr().err


def test_matches_have_the_simulator_and_the_senses_that_are_named() -> None:
    policies, blind = ["chase", "zero"], "tests.simulators:Blind"
    still = rsoccer.tournament(policies, matches=4, simulator="tests.simulators:Still")
    assert not any(standing.wins or standing.losses for standing in still.standings)
    usual, sensing = (rsoccer.tournament(policies, 4, sensing=given) for given in (None, blind))
    assert usual.standings[0].wins > sensing.standings[0].wins


def test_a_notebook_shows_ratings_and_scores_in_color() -> None:
    counts = np.zeros((3, 3, 3), np.int64)
    for blue in range(3):
        for yellow in range(3):
            if blue != yellow:
                counts[blue, yellow] = (20, 0, 0) if blue < yellow else (0, 0, 20)
    result = summarize(["chase", "zero", "ou"], counts, "VSSSelfPlay-v0", 0)
    shown = result._repr_html_()
    assert shown.count("<table>") == 2
    assert shown.count("rgba(47,109,179,0.60)") == shown.count("rgba(200,60,50,0.60)") == 3
    assert all(standing.label in shown for standing in result.standings)
    assert "40 matches a pair" in shown

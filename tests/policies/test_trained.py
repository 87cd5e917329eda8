"""Trained policies: their resolution by the name `best`, and the files in the package."""

import json
import math
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches, Sensing, policies
from rsoccer.policies import trained
from rsoccer.policies.evolved import Evolved
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import Score, read_scores, scores_text
from rsoccer.task import Task
from rsoccer.tasks import SslGoToBall, VssMatch, VssSelfPlay
from rsoccer.train.distillation import DistillArgs
from tests.policies.networks import network_for

MAX_SIZE = 144 * 1024
SHIPPED = trained.list_trained()
FILES: list[tuple[str, str | None, Path]] = [(name, None, path) for name, path in SHIPPED.items()]
FILES += [(name, "robust", path) for name, path in trained.list_trained("robust").items()]
FILES += [(name, "opponents", path) for name, path in trained.list_trained("opponents").items()]
IDS = ["-".join(filter(None, file[:2])) for file in FILES]


def save(folder: Path, stem: str, **metadata: str) -> Path:
    """Write a policy for the task that the file's name begins with."""
    task = rsoccer.make_task(stem.partition(".")[0])
    network = network_for(task)
    network.metadata |= {"layout": task.layout.text, **metadata}
    network.save(folder / f"{stem}.safetensors")
    return folder / f"{stem}.safetensors"


def test_equal_networks_have_equal_scores() -> None:
    """Those that play as `best` and as `best:robust` have been measured alike."""
    compared = 0
    for name, path in trained.list_trained("robust").items():
        best, robust = trained.load_file(SHIPPED[name]), trained.load_file(path)
        assert isinstance(best, Network)
        assert isinstance(robust, Network)
        arrays, others = best.arrays(), robust.arrays()
        if arrays.keys() != others.keys():
            continue
        if not all(np.array_equal(array, others[key]) for key, array in arrays.items()):
            continue
        scores = {
            (score.opponent, score.metric, score.matches): score.score
            for score in trained.list_scores(path)
            if not score.sensing
        }
        for score in trained.list_scores(SHIPPED[name]):
            compared += 1
            assert scores[score.opponent, score.metric, score.matches] == score.score, name
    assert compared >= 8


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Replace the files of the package by one for VSSMulti-v0."""
    monkeypatch.setattr(trained, "FOLDER", tmp_path)
    save(tmp_path, "VSSMulti-v0")
    return tmp_path


@pytest.mark.parametrize("name", ["VSS-v0", "VSSMulti-v0", "VSSSelfPlay-v0"])
def test_vsss_tasks_without_a_file_have_the_policy_of_teams(name: str, folder: Path) -> None:
    policy = policies.make_policy("best", rsoccer.make_task(name))
    assert isinstance(policy, Network)
    assert (policy.task_name, policy.mode) == ("VSSMulti-v0", "sample")
    save(folder, name, clip="5")
    own = policies.make_policy("best", rsoccer.make_task(name))
    assert isinstance(own, Network)
    assert (own.task_name, float(own.clip)) == (name, 5.0)


def test_a_derived_task_has_it_if_its_observations_are_equal(folder: Path) -> None:
    @dataclass(frozen=True)
    class Derived(VssSelfPlay):
        name = "Derived-v0"

    assert isinstance(policies.make_policy("best", Derived()), Network)
    with pytest.raises(ValueError, match="best: expected a task with a trained policy, got Der"):
        policies.make_policy("best", Derived(n_blue=5))


@dataclass(frozen=True)
class Derived(SslGoToBall):
    """A task that is not registered."""


@dataclass(frozen=True)
class DerivedMatch(VssMatch):
    """A task that is not registered, of a parent that plays with the skills of another."""


@pytest.mark.parametrize("derived", [Derived, DerivedMatch])
def test_a_derived_task_has_the_policy_of_its_parent(derived: type[Task]) -> None:
    policy = policies.make_policy("best", derived())
    expected = policies.make_policy("best", derived.__mro__[1]())
    assert isinstance(policy, Network) and isinstance(expected, Network)
    assert policy.metadata | {"task": ""} == expected.metadata | {"task": ""}


def test_the_mode_may_follow(folder: Path) -> None:
    task = rsoccer.make_task("VSS-v0")
    for mode in ("mean", "sample"):
        policy = policies.make_policy(f"best:{mode}", task)
        assert isinstance(policy, Network)
        assert policy.mode == mode
    expected = r"best: expected one of \('sample', 'mean', 'lookahead', 'robust'\).*'0.5'"
    with pytest.raises(ValueError, match=expected):
        policies.make_policy("best:0.5", task)


@pytest.mark.parametrize("options", [{}, {"n_blue": 5, "n_yellow": 5, "field": "vss_5v5"}])
def test_best_plays_whole_matches_with_the_skills_of_another_task(options: dict[str, Any]) -> None:
    task = rsoccer.make_task("VSSMatch-v0", half_seconds=5.0, **options)
    assert task.name not in trained.list_trained()
    found = rsoccer.evaluate("best:mean", "zero", 20, task=task, threads=1)
    assert found.wins > 4
    assert found.losses == 0
    policy = policies.make_policy("best:mean", task)
    assert isinstance(policy, Network)
    assert (policy.mode, policy.observation_size) == ("mean", task.layout.size)
    robust = policies.make_policy("best:robust", task)
    assert isinstance(robust, Network)
    assert robust.needs_forecast
    assert robust.shield is not None
    assert policy.shield is not None


@pytest.mark.parametrize("name", ["VSS-v0", "VSSMulti-v0"])
def test_files_of_single_agents_play_in_matches(name: str, tmp_path: Path) -> None:
    path = tmp_path / "a.safetensors"
    policies.make_policy("best", rsoccer.make_task(name)).save(path)  # type: ignore[attr-defined]
    match = rsoccer.make_task("VSSMatch-v0", half_seconds=5.0)
    policy = policies.make_policy(path, match)
    assert isinstance(policy, Network)
    assert (policy.observation_size, policy.action_size) == (match.layout.size, 2)
    assert rsoccer.evaluate(path, "zero", 2, task=match, threads=1).matches == 2


def test_files_with_the_skills_of_a_match_play_it(tmp_path: Path) -> None:
    source = rsoccer.make_task("VSSSelfPlay-v0")
    policies.make_policy("best", source).save(tmp_path / "a.safetensors")  # type: ignore[attr-defined]
    match = rsoccer.make_task("VSSMatch-v0", half_seconds=2.0)
    own = policies.make_policy(f"{tmp_path / 'a.safetensors'}:mean", match)
    best = policies.make_policy("best:mean", match)
    assert isinstance(own, Network)
    assert isinstance(best, Network)
    assert own.mode == "mean"
    assert all(np.array_equal(a, best.arrays()[name]) for name, a in own.arrays().items())
    message = r"a network trained on 'VSSSelfPlay-v0' has observation.*; it plays 'VSSSelfPlay-v0':"
    with pytest.raises(ValueError, match=message):
        policies.make_policy(tmp_path / "a.safetensors", rsoccer.make_task("SSLMatch-v0"))


def test_the_error_names_the_tasks_that_have_a_policy(folder: Path) -> None:
    save(folder, "SSLGoToBall-v0")
    message = (
        r"best: expected a task with a trained policy, got SSLDribbling-v0; there are policies "
        r"for SSLGoToBall-v0, VSSMulti-v0 \(and tasks with its observations\)"
    )
    with pytest.raises(ValueError, match=message):
        policies.make_policy("best", rsoccer.make_task("SSLDribbling-v0"))
    with pytest.raises(
        ValueError, match="best: a network trained on 'VSSMulti-v0' has observation_s"
    ):
        policies.make_policy("best", rsoccer.make_task("VSSMulti-v0", n_yellow=5))
    with pytest.raises(ValueError, match="; it plays 'VSSMulti-v0' with n_yellow=3: the network"):
        policies.make_policy("best", rsoccer.make_task("VSSMulti-v0", n_yellow=5))
    for path in folder.iterdir():
        path.unlink()
    with pytest.raises(ValueError, match="there are policies for no task"):
        policies.make_policy("best", rsoccer.make_task("VSS-v0"))


def test_robust_policies_have_files_of_their_own(folder: Path) -> None:
    task = rsoccer.make_task("VSS-v0")
    message = (
        r"best:robust: expected a task with a robust policy, got VSS-v0; there are policies for "
    )
    with pytest.raises(ValueError, match=f"{message}no task"):
        policies.make_policy("best:robust", task)
    save(folder, "SSLGoToBall-v0.robust", clip="7")
    with pytest.raises(ValueError, match=f"{message}SSLGoToBall-v0"):
        policies.make_policy("best:robust", task)
    assert list(trained.list_trained()) == ["VSSMulti-v0"]
    for name, mode in (("best:robust", "sample"), ("best:robust:mean", "mean")):
        policy = policies.make_policy(name, rsoccer.make_task("SSLGoToBall-v0"))
        assert isinstance(policy, Network)
        assert (float(policy.clip), policy.mode) == (7.0, mode)
    with pytest.raises(
        ValueError, match=r"best: expected one of \('sample', 'mean', 'lookahead'\).*'0.5'"
    ):
        policies.make_policy("best:robust:0.5", rsoccer.make_task("SSLGoToBall-v0"))


def test_best_plays_wherever_a_policy_is_named(folder: Path) -> None:
    by_name = Matches("VSSSelfPlay-v0", 2, controllers={"yellow": "best"})
    by_file = Matches(
        "VSSSelfPlay-v0", 2, controllers={"yellow": str(folder / "VSSMulti-v0.safetensors")}
    )
    for matches in (by_name, by_file):
        matches.reset()
        for _ in range(5):
            matches.step(np.zeros((2, 3, 2), np.float32))
    assert np.array_equal(by_name.frame.rows, by_file.frame.rows)
    assert by_name.play.actions[:, 3:].any()
    Matches("VSS-v0", teammates="best", opponent="best:mean").reset()
    found = rsoccer.evaluate("best", "best:mean", 2, task="VSSMulti-v0", worlds=2)
    assert (found.policy, found.opponent, found.task) == ("best", "best:mean", "VSSMulti-v0")
    assert rsoccer.evaluate("best", matches=2, worlds=2).task == "VSSSelfPlay-v0"
    assert policies.trained_on("best") is None
    assert policies.trained_on("best:mean") is None


def test_numpy_suffices(folder: Path) -> None:
    """An opponent in someone's training should need no package that only files need."""
    code = (
        "import sys\n"
        "for name in ('safetensors', 'torch', 'tyro'): sys.modules[name] = None\n"
        "from pathlib import Path\n"
        "import rsoccer\n"
        "from rsoccer.policies import trained\n"
        f"trained.FOLDER = Path({str(folder)!r})\n"
        "rsoccer.Matches('VSSSelfPlay-v0', controllers={'yellow': 'best'}).reset()\n"
        "network = trained.load_best_network(rsoccer.make_task('VSS-v0'))\n"
        "try: network.save(Path('never.safetensors'))\n"
        "except ImportError as error: print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "writing policy files needs safetensors: pip install 'rsoccer[train]'" in done.stdout


def test_scores_are_kept_in_the_metadata(folder: Path) -> None:
    score = Score("ou", "goal_score", 200, 0.5, 0.4, 0.6)
    path = save(folder, "VSS-v0", scores=scores_text([score]))
    assert trained.list_scores(path) == [score]
    assert trained.list_scores(save(folder, "VSSMulti-v0")) == []
    wrong = ["[1]", "{}1", '[{"opponent": "ou"}]', scores_text([score]).replace("0.5", "NaN")]
    for text in [*wrong, scores_text([score]).replace("200", '"200"')]:
        with pytest.raises(ValueError, match="metadata 'scores' should"):
            read_scores({"scores": text})


# -- files in the package -----------------------------------------------------------------------


def task_of(name: str, variant: str | None) -> Task:
    """The task that a file of the package is for."""
    return rsoccer.make_task(name, **({"n_opponents": 1} if variant == "opponents" else {}))


def test_there_is_a_policy_for_teams() -> None:
    assert trained.TEAM_TASK in SHIPPED


@pytest.mark.parametrize(("name", "variant", "path"), FILES, ids=IDS)
def test_a_shipped_policy_is_small_and_fits_its_task(
    name: str, variant: str | None, path: Path
) -> None:
    task = task_of(name, variant)
    assert path.stat().st_size <= MAX_SIZE
    policy = trained.load_best(task, "robust" if variant == "robust" else None)
    assert (policy.sensing is None) == (variant != "robust")
    assert policy.task_name == name
    training = json.loads(policy.metadata["training"])
    assert set(training) == {"command", "samples", "seed", "package", "physics"}
    assert f"--task {name}" in training["command"]
    trainers = ("rsoccer train", "rsoccer distill") if variant else ("rsoccer train",)
    if isinstance(policy, Evolved):
        trainers = ("rsoccer evolve",)
    else:
        assert policy.metadata["layout"] == task.layout.text
    assert training["command"].startswith(trainers)
    scores = trained.list_scores(path)
    assert scores
    for score in scores:
        assert score.metric == task.success
        assert score.low <= score.score <= score.high


@pytest.mark.parametrize("task", trained.list_trained("robust"))
def test_robust_policies_name_the_delays_that_their_matches_drew(task: str) -> None:
    """Within half a control step of those that were asked for, see `rsoccer distill`."""
    network = trained.load_best(rsoccer.make_task(task), "robust")
    command = json.loads(network.metadata["training"])["command"]
    if isinstance(network, Evolved):
        return
    if "--network.initial-policy best" in command:  # trained on behind a forecast
        low, high = network.randomization["sensing.command_delay"]
        assert isinstance(network.sensing, Sensing)
        assert 0.0 <= low <= network.sensing.command_delay < high
        assert network.needs_forecast
        return
    if command.startswith("rsoccer train"):  # `best` behind a forecast
        best = trained.load_best_network(rsoccer.make_task(task))
        assert all(np.array_equal(a, best.arrays()[name]) for name, a in network.arrays().items())
        assert network.needs_forecast
        return
    delays = DistillArgs.for_task(task).command_delays
    assert f"--command-delays {' '.join(map(str, delays))} " in command
    longest = max(delays) + rsoccer.make_task(task).config.time_step / 2
    assert network.randomization["sensing.command_delay"] == pytest.approx([0.0, longest])


def test_some_tasks_have_a_robust_policy() -> None:
    assert {"SSLGoToBall-v0", "VSS-v0"} <= set(trained.list_trained("robust"))
    assert set(trained.list_trained("robust")) <= set(SHIPPED)


@pytest.mark.parametrize(
    ("name", "variant", "said"),
    [
        (name, variant, score)
        for name, variant, path in FILES
        for score in trained.list_scores(path)
    ],
    ids=lambda value: f"{value.opponent}-{value.sensing}" if isinstance(value, Score) else value,
)
def test_a_shipped_policy_scores_what_its_file_says(
    name: str, variant: str | None, said: Score
) -> None:
    """Within four standard errors of these few matches."""
    # Whole matches of ten minutes take as long as many episodes.
    task = task_of(name, variant)
    matches = 4 if hasattr(task, "referee_config") else 40
    policy = "best:robust" if variant == "robust" else "best"
    opponent = None if said.opponent == "-" else said.opponent
    if opponent is not None and " " in opponent:
        opponent = None  # several policies: the task's own
    sensing = said.sensing or None
    found = rsoccer.evaluate(
        policy, opponent, matches, seed=1, task=task, worlds=40, sensing=sensing
    )
    standard_error = (said.high - said.low) / (2 * 1.96) * math.sqrt(said.matches / matches)
    # By the rule of three 3 matches may differ where next to all are equal.
    standard_error = max(standard_error, math.sqrt(3.0 / said.matches / matches))
    assert found.metric == said.metric
    assert abs(found.score - said.score) <= 4.0 * standard_error + 0.02

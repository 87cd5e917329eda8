"""Misspelt arguments, wrong files, wrong types: errors say what was meant, in every interface."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import cli, policies
from rsoccer.policies.network import Network
from rsoccer.registry import options_of
from rsoccer.replay import Replay, record_replay
from rsoccer.task import Task


@pytest.mark.parametrize(
    ("make", "arguments"),
    [
        (rsoccer.Matches, ["worlds", "threads", "controllers", "simulator"]),
        (rsoccer.parallel_env, ["render_mode", "controllers", "max_steps", "max_cycles"]),
        (rsoccer.env, ["render_mode", "controllers", "max_steps", "max_cycles"]),
        (rsoccer.single_env, ["render_mode", "learner", "simulator", "sensing"]),
        (rsoccer.vector_env, ["num_envs", "learner", "threads", "autoreset_mode"]),
        (rsoccer.robots_vector_env, ["num_envs", "worlds", "learner", "threads"]),
    ],
)
@pytest.mark.parametrize("task", ["VSS-v0", "VSSMA-v0", rsoccer.make_task("VSS-v0")], ids=str)
def test_an_unknown_argument_lists_all_valid_ones(
    make: Callable[..., object], arguments: list[str], task: Task | str
) -> None:
    """Formerly the options of the task alone."""
    with pytest.raises(TypeError, match="'wordls'") as error:
        make(task, wordls=8)
    assert all(repr(name) in str(error.value) for name in arguments)
    assert "'task'" not in str(error.value)
    if isinstance(task, str):
        assert "got an unexpected keyword argument 'wordls'" in str(error.value)
        assert "'n_yellow'" in str(error.value)


def test_sb3_lists_its_arguments() -> None:
    pytest.importorskip("stable_baselines3")
    from rsoccer import sb3

    with pytest.raises(TypeError, match=r"'wordls'.*'worlds', 'threads', 'controllers'"):
        sb3.SoccerVecEnv("VSSMulti-v0", wordls=8)


@pytest.mark.parametrize(
    ("task", "option"),
    [("VSSMulti-v0", "opponent"), ("VSS-v0", "opponent"), ("VSS-v0", "teammates")],
)
@pytest.mark.parametrize("policy", [3, None, 0.5, ["ou"]])
def test_a_wrong_opponent_is_reported_by_the_name_of_the_option(
    task: str,
    option: str,
    policy: Any,  # noqa: ANN401
) -> None:
    """Formerly `controllers['yellow_0']`, which nobody had given."""
    for make in (rsoccer.make_task, rsoccer.single_env, rsoccer.Matches):
        with pytest.raises(TypeError, match=rf"^{option}: expected a policy's name or the path"):
            make(task, **{option: policy})


@pytest.mark.parametrize(
    ("task", "option"),
    [("VSSMulti-v0", "opponent"), ("VSS-v0", "opponent"), ("VSS-v0", "teammates")],
)
def test_a_policy_in_an_option_may_be_a_path(task: str, option: str) -> None:
    made = rsoccer.make_task(task, **{option: Path("chase")})
    assert made == rsoccer.make_task(task, **{option: "chase"})
    assert options_of(made) == {option: "chase"}


def test_wrong_controllers_are_reported_by_the_keys_that_were_given() -> None:
    class Careless(rsoccer.VssSelfPlay):
        def default_controllers(self) -> dict[str, Any]:
            return dict.fromkeys(self.robots, 3)

    with pytest.raises(TypeError, match=r"^controllers\['yellow'\]: expected .*, got 3"):
        rsoccer.Matches("VSSSelfPlay-v0", controllers={"yellow": 3})  # type: ignore[dict-item]
    with pytest.raises(TypeError, match=r"default_controllers: 'blue_0': expected .* got 3"):
        rsoccer.Matches(Careless())


def test_controllers_may_be_paths(tmp_path: Path) -> None:
    task = rsoccer.make_task("VSSSelfPlay-v0")
    layers = [(np.zeros((2, task.layout.size)), np.zeros(2))]
    path = tmp_path / "policy.safetensors"
    Network.from_layers(task, layers).save(path)
    assert rsoccer.Matches(task, controllers={"yellow": path}).agents == (
        "blue_0",
        "blue_1",
        "blue_2",
    )


@pytest.mark.parametrize(
    "call",
    [
        lambda path: rsoccer.evaluate(path, matches=2),
        lambda path: rsoccer.evaluate("ou", path, matches=2),
        lambda path: rsoccer.tournament(["ou", path], matches=2),
        lambda path: rsoccer.Matches("VSS-v0", controllers={"yellow": path}),
        lambda path: rsoccer.Matches("VSSMulti-v0", opponent=path),
        lambda path: Network.load(path),
    ],
)
def test_a_missing_policy_file_is_named(call: Callable[[str], object], tmp_path: Path) -> None:
    """Formerly a bare `[Errno 2]`."""
    path = str(tmp_path / "lost.safetensors")
    with pytest.raises(FileNotFoundError, match=r"^policy: the file .*lost.* does not exist$"):
        call(path)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["watch", "match.rs"], "policy: expected the name of a policy or a task, a policy file"),
        (["watch", "match.rs"], "or in rsoccer watch a replay (*.rsr), got match.rs"),
        (["watch", "lost.rsr"], "replay: the file lost.rsr does not exist"),
        (["watch", "folder.rsr"], "replay: expected a file, got folder.rsr"),
        (["watch", "run"], "it is a folder; the policy file in it is run/policy.safetensors"),
        (["watch", "empty"], "unknown policy 'empty': expected one of"),
        (["watch", "lost.safetensors"], "policy: the file lost.safetensors does not exist"),
        (
            ["watch", "ou", "--opponents", "lost.safetensors:mean"],
            "lost.safetensors does not exist",
        ),
        (["evaluate", "match.rsr"], "expected a policy, got the replay match.rsr: rsoccer watch"),
        (["evaluate", "page.html"], "got page.html"),
        (["evaluate", "ou", "--opponents", "run"], "it is a folder; the policy file in it is"),
        (["evaluate", "--policy", "match.rsr"], "got the replay match.rsr: rsoccer watch plays it"),
        (["evaluate", "ou", "--opponents", "match.rsr"], "got the replay match.rsr"),
        (["watch", "ou", "--opponents", "page.html"], "got page.html"),
        (["tournament", "ou", "match.rsr"], "got the replay match.rsr"),
        (["tournament", "ou", "run"], "it is a folder; the policy file in it is run/policy"),
        (["tournament", "ou", "lost.safetensors"], "the file lost.safetensors does not exist"),
        (["evaluate", "ou", "--task", "VSS-v0", "--task-options", "robot=lost.json"], "lost.json"),
        (["evaluate", "ou", "--task", "VSS-v0", "--task-options", "robot=vs"], "'vss_440rpm'"),
        (["evaluate", "ou", "--task", "VSS-v0", "--task-options", "robot=3"], "robot: expected a"),
        (
            ["evaluate", "ou", "--task", "VSS-v0", "--task-options", "engine=3"],
            "engine: expected 'compact' or 'rapier', got 3",
        ),
    ],
)
def test_commands_name_wrong_files(
    words: list[str],
    message: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    for folder in ("run", "empty", "folder.rsr"):
        Path(folder).mkdir()
    for file in ("run/policy.safetensors", "match.rsr", "page.html"):
        Path(file).write_bytes(b"")
    matches = [] if words[0] == "watch" else ["--matches", "2"]
    assert cli.main([*words, *matches]) == 2
    printed = capsys.readouterr()
    assert message in printed.err
    assert printed.err.count("\n") == 1
    assert printed.out == ""


def test_replays_name_missing_files(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match=r"replay: the file .* does not exist"):
        Replay.load(tmp_path / "lost.rsr")


@pytest.mark.parametrize(
    ("task", "layers", "message"),
    [
        (object(), [], "task: expected a task or its name, got <object"),
        ("VSS-v0", object(), r"layers: expected pairs \(weight, bias\), or modules .* got object"),
        ("VSS-v0", {"actor": 1}, "layers: expected pairs .* got dict"),
        ("VSS-v0", [np.zeros((2, 2))], r"layers: expected pairs \(weight, bias\), got ndarray"),
        ("VSS-v0", [3], r"layers: expected pairs \(weight, bias\), got int"),
    ],
)
def test_from_layers_refuses_other_things_by_name(task: Any, layers: Any, message: str) -> None:  # noqa: ANN401
    """Formerly an AttributeError."""
    with pytest.raises(TypeError, match=message):
        Network.from_layers(task, layers)


def test_from_layers_refuses_a_whole_model() -> None:
    nn = pytest.importorskip("torch.nn")

    class Model(nn.Module):  # type: ignore[misc, name-defined]
        def __init__(self) -> None:
            super().__init__()
            self.actor = nn.Sequential(nn.Linear(3, 2))

    with pytest.raises(TypeError, match="got Model; of a model pass the layers of its actor"):
        Network.from_layers(rsoccer.make_task("VSS-v0"), Model())
    with pytest.raises(
        ValueError, match=r"expected Linear with bias and one of Tanh, .* in turn, got Model"
    ):
        Network.from_layers("VSS-v0", [Model()])


def test_names_of_other_types_are_refused() -> None:
    with pytest.raises(TypeError, match="name: expected text, got 3"):
        rsoccer.register(3, rsoccer.VssSelfPlay)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="task: expected a task or its name, got 3"):
        policies.make_policy("ou", 3)  # type: ignore[arg-type]
    assert policies.make_policy("ou", "VSS-v0").observes == "nothing"


@pytest.mark.parametrize("seconds", ["3", None, True])
def test_a_duration_of_another_type_is_refused_by_name(seconds: Any) -> None:  # noqa: ANN401
    with pytest.raises(TypeError, match="seconds: expected a number"):
        record_replay("VSS-v0", {"all": "zero"}, seconds=seconds)


def test_the_version_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["--version"]) == 0
    physics = rsoccer.build_info()["physics"]
    assert capsys.readouterr().out == f"rsoccer {rsoccer.__version__}, physics {physics}\n"


@pytest.mark.parametrize("command", ["evaluate", "watch", "play", "train", "cooperation"])
def test_all_commands_have_one_word_for_opponents(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        cli.main([command, "--help"])
    words = capsys.readouterr().out.split()
    assert "--opponents" in words
    assert "--opponent" not in words

"""`rsoccer export`."""

from pathlib import Path

import pytest

from rsoccer import cli, policies
from rsoccer.policies.evolved import Evolved
from rsoccer.policies.network import Network
from rsoccer.policies.onnx_policy import OnnxPolicy
from tests.policies.networks import random_network


def error(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    assert cli.main(["export", *arguments]) == cli.WRONG_INPUT
    return capsys.readouterr().err


def test_files_are_named_after_the_policy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    folder = tmp_path / "run"
    folder.mkdir()
    random_network().save(folder / "policy.safetensors")
    assert cli.main(["export", "run/policy.safetensors:mean", "--onnx"]) == 0
    assert cli.main(["export", "best:robust", "--task", "VSS-v0"]) == 0
    assert cli.main(["export", "best", "--task", "VSS-v0", "--onnx", "--out", "a.onnx"]) == 0
    printed = capsys.readouterr().out
    for name in ("run.onnx", "best-robust-VSS-v0.safetensors", "a.onnx"):
        assert f"policy: {name} (" in printed
    assert OnnxPolicy.load("run.onnx").task_name == "VSS-v0"
    best = policies.make_policy("best:robust", "VSS-v0")
    assert isinstance(best, Network)
    assert Network.load("best-robust-VSS-v0.safetensors").metadata == best.metadata


def test_a_policy_is_written_with_another_rate_of_decisions(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for name, repeat in (("a.safetensors", "5"), ("a.onnx", "4")):
        form = ["--onnx"] if name.endswith(".onnx") else []
        arguments = ["best", "--task", "SSLGoToBall-v0", "--action-repeat", repeat, "--out", name]
        assert cli.main(["export", *arguments, *form]) == 0
    best, written = policies.make_policy("best", "SSLGoToBall-v0"), Network.load("a.safetensors")
    assert isinstance(best, Network)
    assert (best.action_repeat, written.action_repeat) == (3, 5)
    assert OnnxPolicy.load("a.onnx").action_repeat == 4
    assert all((written.arrays()[name] == array).all() for name, array in best.arrays().items())
    changed = {"action_repeat": "5"}  # its scores are not known
    assert {**written.metadata, "scores": best.metadata["scores"]} == best.metadata | changed
    assert "scores" not in written.metadata
    assert (
        cli.main(["export", "a.safetensors", "--action-repeat", "5", "--out", "b.safetensors"]) == 0
    )
    assert Path("b.safetensors").read_bytes() == Path("a.safetensors").read_bytes()
    for wrong, words in (("0", "action_repeat: expected at least 1"), ("1000001", "at most")):
        assert words in error(
            ["a.safetensors", "--action-repeat", wrong, "--out", "c.safetensors"], capsys
        )
    assert "with learned tactics, which decides in every control step" in error(
        ["best", "--task", "SSLMatch-v0", "--action-repeat", "2"], capsys
    )
    assert not Path("c.safetensors").exists()


def test_learned_tactics_are_written_as_a_policy_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert cli.main(["export", "best", "--task", "SSLMatch-v0"]) == 0
    best = policies.make_policy("best", "SSLMatch-v0")
    assert isinstance(best, Evolved)
    written = Evolved.load("best-SSLMatch-v0.safetensors")
    assert written.metadata == best.metadata
    assert (written.tactics == best.tactics).all()
    assert "onnx: expected a policy with a network, got best of SSLMatch-v0, a script" in error(
        ["best", "--task", "SSLMatch-v0", "--onnx"], capsys
    )
    with pytest.raises(ValueError, match=r"learned tactics, which .*Evolved\.load reads"):
        Network.load("best-SSLMatch-v0.safetensors")


def test_other_policies_and_files_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    random_network().save("a.safetensors")
    assert "expected best or a policy file" in error(["chase", "--onnx"], capsys)
    assert "name ending in .onnx" in error(
        ["a.safetensors", "--onnx", "--out", "a.safetensors"], capsys
    )
    assert "another file than the policy's own" in error(["a.safetensors"], capsys)
    assert "has observation_size" in error(
        ["a.safetensors", "--task", "SSLGoToBall-v0", "--onnx"], capsys
    )
    assert not list(tmp_path.glob("*.onnx"))

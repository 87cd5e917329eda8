"""Modules for other libraries, without the library."""

import importlib
import sys

import pytest


@pytest.mark.parametrize(
    ("module", "library", "message"),
    [
        (
            "rsoccer.sb3",
            "stable_baselines3",
            'rsoccer.sb3 needs Stable-Baselines3: pip install "stable-baselines3>=2.4"',
        ),
        (
            "rsoccer.torchrl",
            "torchrl.envs",
            'rsoccer.torchrl needs TorchRL: pip install "torchrl>=0.14"',
        ),
        (
            "rsoccer.rllib",
            "ray.rllib",
            'rsoccer.rllib needs RLlib and torch: pip install "ray[rllib]>=2.60" torch',
        ),
    ],
)
def test_a_missing_library_is_named_with_its_command(
    module: str, library: str, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delitem(sys.modules, module, raising=False)
    monkeypatch.setitem(sys.modules, library.split(".")[0], None)
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(ImportError) as raised:
        importlib.import_module(module)
    assert str(raised.value) == message

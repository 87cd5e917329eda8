"""Short names of policies: readable, and different from each other."""

import pytest

from rsoccer.policies.labels import labels
from rsoccer.policies.noise import Zero


@pytest.mark.parametrize(
    ("policies", "expected"),
    [
        (["ou", "scripted:0.5"], ["ou", "scripted:0.5"]),
        (["a/x/policy.safetensors", "a/y/policy.safetensors"], ["x", "y"]),
        (["a/best.safetensors:mean", "a/best.safetensors"], ["best:mean", "best"]),
        (["policy.safetensors"], ["policy"]),
        (
            ["a/x/policy.safetensors", "b/x/policy.safetensors", "ou"],
            ["a/x/policy.safetensors", "b/x/policy.safetensors", "ou"],
        ),
        ([Zero(), Zero(), "zero"], ["Zero 1", "Zero 2", "zero"]),
        ([], []),
    ],
)
def test_names_are_short_and_unique(policies: list[str], expected: list[str]) -> None:
    assert labels(policies) == expected

"""Short names of policies: readable, and different from each other."""

import pytest

from rsoccer.policies.labels import labels
from rsoccer.policies.noise import Zero


@pytest.mark.parametrize(
    ("policies", "expected"),
    [
        (["ou", "scripted:0.5"], ["ou", "scripted:0.5"]),
        (["a/x/policy.safetensors", "a/y/policy.safetensors"], ["x", "y"]),
        (["a/good.safetensors:mean", "a/good.safetensors"], ["good:mean", "good"]),
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


@pytest.mark.parametrize(
    "file",
    [
        "a/ou/policy.safetensors",
        "a/scripted.safetensors",
        "a/best.safetensors:mean",
        "ou.safetensors",
    ],
)
def test_a_file_never_has_the_name_of_a_policy_of_the_package(file: str) -> None:
    """Formerly only where that policy was there, too."""
    assert labels([file, "chase"]) == [file, "chase"]
    assert labels([file, "ou", "scripted", "best:mean"]) == [file, "ou", "scripted", "best:mean"]


def test_an_object_never_has_the_name_of_a_policy_of_the_package() -> None:
    noise = type("ou", (Zero,), {})()
    assert labels([noise, "zero"]) == ["ou 1", "zero"]
    assert labels([noise, "ou"]) == ["ou 1", "ou"]


def test_no_file_has_a_reserved_name() -> None:
    files = ["a/latest/policy.safetensors", "a/past.safetensors", "latest", "a/mine.safetensors"]
    assert labels(files, ("latest", "past")) == [*files[:2], "latest 1", "mine"]
    assert labels(files[:2]) == ["latest", "past"]


def test_numbers_leave_out_names_that_are_taken() -> None:
    file = "a/Zero 1/policy.safetensors"
    assert labels([Zero(), Zero(), file]) == ["Zero 2", "Zero 3", "Zero 1"]

import sys
from pathlib import Path

import pytest
from packaging.version import Version

from tools.lowest_versions import Lowest, declared, lowest_versions, main, pins


def test_the_lowest_version_is_that_of_the_bound_for_this_python() -> None:
    requirements = [
        "NumPy>=1.26",
        f"numpy>=2.1; python_version >= '{sys.version_info.major}.{sys.version_info.minor}'",
        "numpy>=9; python_version < '3'",
        "rsoccer[render,train]",
        "scipy<2,>=1.13",
    ]
    found = {
        name: requirement.version for name, requirement in lowest_versions(requirements).items()
    }
    assert found == {"numpy": Version("2.1"), "scipy": Version("1.13")}


def test_extras_of_dependencies_stay() -> None:
    found = lowest_versions(["minari[hdf5,arrow]>=0.5", "minari>=0.5.3"])
    assert found["minari"].of("minari") == "minari[arrow,hdf5]==0.5.3"
    assert Lowest(Version("1.26")).of("numpy") == "numpy==1.26"


def test_every_dependency_has_a_lower_bound() -> None:
    lowest = lowest_versions(declared())
    assert {"numpy", "gymnasium", "pettingzoo", "pygame-ce", "torch", "tyro"} <= lowest.keys()
    with pytest.raises(ValueError, match=r"expected a lower bound.*'tqdm<5'"):
        lowest_versions(["tqdm<5"])


def test_other_packages_keep_their_versions() -> None:
    assert pins("# why\nPillow==13.0.0\nidna==3.20\n", {"pillow"}) == ["idna==3.20"]


def test_torch_is_an_option(tmp_path: Path) -> None:
    main([str(tmp_path)])
    without = (tmp_path / "lowest.txt").read_text().splitlines()
    main([str(tmp_path), "--torch"])
    torch = set((tmp_path / "lowest.txt").read_text().splitlines()) - set(without)
    assert [line.split("==")[0] for line in torch] == ["torch"]
    assert "pytest" in without
    assert "pytest==" in (tmp_path / "others.txt").read_text()
    assert "numpy==" not in (tmp_path / "others.txt").read_text()

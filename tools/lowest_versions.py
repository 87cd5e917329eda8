"""Requirements with the lowest versions that pyproject.toml allows: `make check-lowest`.

python -m tools.lowest_versions FOLDER [--torch]

`lowest.txt` in the folder has the dependencies of the package and of its extras, each with the
lowest version. `others.txt` has the versions of constraints.txt for all other packages.
"""

import argparse
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Final, NamedTuple

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name
from packaging.version import Version

from tools.paths import ROOT

PINNED_BY_TORCH: Final = ("sympy",)
"""Packages of which torch asks for one version, its own for each release of torch."""
TESTING: Final = ("cloudpickle", "hypothesis", "pytest", "pytest-xdist")
"""Packages that the tests need; their versions are those of constraints.txt."""


class Lowest(NamedTuple):
    """Requirement of a package in its lowest version."""

    version: Version
    extras: frozenset[str] = frozenset()
    """Extras of the package."""

    def of(self, name: str) -> str:
        """Return the requirement as pip reads it.

        Args:
            name: name of the package.
        """
        extras = f"[{','.join(sorted(self.extras))}]" if self.extras else ""
        return f"{name}{extras}=={self.version}"


def lowest_versions(requirements: Iterable[str]) -> dict[str, Lowest]:
    """Return the lowest version of each package that these requirements allow here.

    Args:
        requirements: as in pyproject.toml; those for another Python and those of the package
            itself, which name its extras, are left out.

    Returns:
        Versions and extras by canonical name.

    Raises:
        ValueError: a requirement without a lower bound.
    """
    lowest: dict[str, Lowest] = {}
    for text in requirements:
        requirement = Requirement(text)
        if requirement.name == "rsoccer" or not (
            requirement.marker is None or requirement.marker.evaluate()
        ):
            continue
        name = canonicalize_name(requirement.name)
        bounds = [Version(part.version) for part in requirement.specifier if part.operator == ">="]
        if not bounds:
            raise ValueError(f"pyproject.toml: expected a lower bound (>=), got {text!r}")
        extras = frozenset(requirement.extras)
        if name in lowest:
            bounds.append(lowest[name].version)
            extras |= lowest[name].extras
        lowest[name] = Lowest(max(bounds), extras)
    return lowest


def declared() -> list[str]:
    """Return the requirements of the package and of all its extras."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    extras = project["optional-dependencies"].values()
    return [*project["dependencies"], *(text for extra in extras for text in extra)]


def pins(text: str, without: Iterable[str]) -> list[str]:
    """Return the lines of constraints.txt, without those of some packages.

    Args:
        text: content of constraints.txt.
        without: canonical names of the packages to leave out.
    """
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return [line for line in lines if canonicalize_name(line.split("==")[0]) not in set(without)]


def main(arguments: list[str] | None = None) -> None:
    """Write the files.

    Args:
        arguments: of the command line; None for those of this process.
    """
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="folder of the files")
    parser.add_argument("--torch", action="store_true", help="with torch, a large download")
    options = parser.parse_args(arguments)
    lowest = lowest_versions(declared())
    others = pins((ROOT / "constraints.txt").read_text(), (*lowest, *PINNED_BY_TORCH))
    if not options.torch:
        del lowest["torch"]
    exact = [requirement.of(name) for name, requirement in lowest.items()]
    (options.folder / "lowest.txt").write_text("\n".join([*exact, *TESTING, ""]))
    (options.folder / "others.txt").write_text("\n".join([*others, ""]))


if __name__ == "__main__":
    main()

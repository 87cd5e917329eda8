"""Shows this interpreter the packages of another environment: `make check-libraries`."""

import sys
import sysconfig
from pathlib import Path


def main() -> None:
    """Write a file that adds the packages, with the files of paths among them."""
    own = Path(sysconfig.get_paths()["purelib"])
    others = Path(sys.argv[1]).resolve() / own.relative_to(sys.prefix)
    (own / "packages.pth").write_text(f"import site; site.addsitedir({str(others)!r})\n")


if __name__ == "__main__":
    main()

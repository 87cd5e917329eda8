"""Error messages of the build for missing requirements."""

import os
import shutil
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).parent.parent
SCRIPT = ROOT / "tools" / "make_venv.sh"


def make_venv(folder: Path, **settings: str) -> subprocess.CompletedProcess[str]:
    """Run the script that creates a virtual environment in `folder`."""
    return subprocess.run(
        [shutil.which("sh") or "/bin/sh", str(SCRIPT), str(folder)],
        env={**os.environ, "PYTHON": sys.executable, **settings},
        capture_output=True,
        text=True,
        check=False,
    )


def fake_python(path: Path, body: str) -> str:
    """Write an executable that replaces an interpreter and return its path."""
    path.write_text(f"#!/bin/sh\n{body}\n")
    path.chmod(0o755)
    return str(path)


def test_missing_cargo_is_reported_with_install_instructions(tmp_path: Path) -> None:
    ran = make_venv(tmp_path / "venv", CARGO="no-such-cargo")
    assert ran.returncode != 0
    assert "cargo is missing" in ran.stderr
    assert "Install Rust" in ran.stderr
    assert not (tmp_path / "venv").exists()


def test_an_old_python_is_refused(tmp_path: Path) -> None:
    old = fake_python(tmp_path / "python3", "exit 1")
    ran = make_venv(tmp_path / "venv", PYTHON=old, CARGO="true")
    assert ran.returncode != 0
    assert f"PYTHON must be Python 3.11 or newer, got {old}" in ran.stderr


def test_missing_python_is_reported(tmp_path: Path) -> None:
    ran = make_venv(tmp_path / "venv", PYTHON="", CARGO="true", PATH=str(tmp_path))
    assert ran.returncode != 0
    assert "no Python 3.11 or newer found" in ran.stderr


def test_a_python_without_venv_leaves_no_partial_environment(tmp_path: Path) -> None:
    body = f'case "$1" in -m) mkdir -p "$3"; exit 1;; *) exec "{sys.executable}" "$@";; esac'
    ran = make_venv(tmp_path / "venv", PYTHON=fake_python(tmp_path / "python3", body), CARGO="true")
    assert ran.returncode != 0
    assert "python3-venv" in ran.stderr
    assert not (tmp_path / "venv").exists()


def test_an_installed_torch_is_found(tmp_path: Path) -> None:
    packages = tmp_path / "packages"
    (packages / "torch").mkdir(parents=True)
    (packages / "torch" / "__init__.py").write_text("borrowed = True")
    # -S hides the packages of the environment that runs this test, which may include torch. Pip is
    # not installed because that is slow.
    body = f"""[ "$1" = -c ] && set -- -S "$@"; [ "$1" = -m ] && set -- "$@" --without-pip
    PYTHONPATH="{packages}" exec "{sys.executable}" "$@\""""
    python = fake_python(tmp_path / "python3", body)
    ran = make_venv(tmp_path / "venv", PYTHON=python, CARGO="true")
    assert ran.returncode == 0, ran.stderr
    assert (tmp_path / "venv" / "torch.pth").read_text().strip() == str(packages)


def test_an_environment_sees_the_packages_of_another(tmp_path: Path) -> None:
    own, other = tmp_path / "own", tmp_path / "other"
    venv.create(own)
    folder = f"lib/python{sys.version_info.major}.{sys.version_info.minor}/site-packages"
    (other / folder).mkdir(parents=True)
    (other / folder / "borrowed.py").write_text("number = 3")
    (other / folder / "editable.pth").write_text(f"{tmp_path}\n")
    (tmp_path / "editable.py").write_text("number = 4")
    python = str(own / "bin" / "python")
    script = str(ROOT / "tools" / "see_packages.py")
    subprocess.run([python, script, str(other)], check=True)
    program = "import borrowed, editable; print(borrowed.number + editable.number)"
    command = [python, "-c", program]
    ran = subprocess.run(command, capture_output=True, text=True, check=True)
    assert ran.stdout == "7\n"

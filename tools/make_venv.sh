#!/bin/sh
# Checks the build requirements and creates a virtual environment from Python 3.11 or newer.
# Usage: make_venv.sh FOLDER; the variable PYTHON selects the interpreter, CARGO the cargo command.
set -eu
venv=$1

fail() {
    printf 'rSoccer: %s\n' "$@" >&2
    exit 1
}

is_new_enough() {
    "$1" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null
}

choose_python() {
    for candidate in python3 python3.13 python3.12 python3.11 python; do
        if is_new_enough "$candidate"; then
            echo "$candidate"
            return
        fi
    done
}

command -v "${CARGO:-cargo}" >/dev/null || fail \
    "cargo is missing; the physics is written in Rust." \
    "Install Rust 1.86 or newer (rustup is the usual way), open a new shell and try again."

python=${PYTHON:-$(choose_python)}
[ -n "$python" ] || fail \
    "no Python 3.11 or newer found." \
    "Install it, or give the path of an interpreter: make PYTHON=/path/to/python3 ..."
is_new_enough "$python" || fail \
    "PYTHON must be Python 3.11 or newer, got $python."

"$python" -m venv "$venv" || {
    rm -rf "$venv"
    fail "$python cannot make a virtual environment (on Debian and Ubuntu, install python3-venv)."
}

# An installed torch saves a download of gigabytes. Its folder is added to the path after the tools
# are installed, and last, so that the environment's own packages take precedence. Pip decides
# whether that torch meets the requirement.
find_torch='import pathlib, torch; print(pathlib.Path(torch.__file__).parents[1])'
if "$python" -c "$find_torch" >"$venv/torch.pth" 2>/dev/null; then
    echo "rSoccer: using torch from $(cat "$venv/torch.pth")"
else
    rm "$venv/torch.pth"
fi

#!/bin/sh
# Makes a virtual environment from a Python that is new enough, having checked what a build needs.
# Usage: make_venv.sh FOLDER; PYTHON chooses the interpreter, CARGO the build tool of Rust.
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
    "cargo is missing: the physics is written in Rust." \
    "Install Rust 1.86 or newer (rustup is the usual way), open a new shell and try again."

python=${PYTHON:-$(choose_python)}
[ -n "$python" ] || fail \
    "no Python 3.11 or newer found." \
    "Install one, or name one that is elsewhere: make PYTHON=/path/to/python3 ..."
is_new_enough "$python" || fail \
    "PYTHON=$python is no Python 3.11 or newer that runs here."

"$python" -m venv "$venv" || {
    rm -rf "$venv"
    fail "$python cannot make a virtual environment (on Debian and Ubuntu, install python3-venv)."
}

# A torch that is there already saves a download of gigabytes. Its folder is put on the path only
# once the tools are installed, and last: the environment's own packages win, and pip judges
# whether that torch will do.
find_torch='import pathlib, torch; print(pathlib.Path(torch.__file__).parents[1])'
if "$python" -c "$find_torch" >"$venv/torch.pth" 2>/dev/null; then
    echo "rSoccer: there is a torch in $(cat "$venv/torch.pth")"
else
    rm "$venv/torch.pth"
fi

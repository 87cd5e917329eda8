"""The notebooks run, and show something."""

import json
from pathlib import Path

import pytest

from tools import notebooks

QUICK = {"MATCHES": 4, "SAMPLES": 10_000}
"""Numbers of matches and samples that take seconds."""
PATHS = notebooks.files()


def test_there_are_notebooks() -> None:
    assert [path.stem for path in PATHS] == ["first_match", "train_and_watch"]


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_a_notebook_runs(path: Path) -> None:
    pytest.importorskip("pygame")
    pytest.importorskip("torch")
    ran = notebooks.executed(notebooks.read(path), QUICK)
    outputs = [part for cell in ran["cells"] for part in cell.get("outputs", [])]
    kinds = {kind for part in outputs for kind in part.get("data", {})}
    assert {"text/html", "text/plain"} <= kinds
    assert (
        sum(
            notebooks.PAGE in part["data"].get("text/html", "")
            for part in outputs
            if "data" in part
        )
        >= 1
    ), "a replay shows its page"


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_a_stored_notebook_has_outputs_and_is_small(path: Path) -> None:
    notebook = notebooks.read(path)
    shown = [cell for cell in notebook["cells"] if cell.get("outputs")]
    assert len(shown) >= 4
    assert path.stat().st_size < 200_000
    assert path.read_text() == notebooks.text_of(notebook)
    assert len({cell["id"] for cell in notebook["cells"]}) == len(notebook["cells"])
    assert notebook["nbformat"] == 4


def made(*cells: str) -> notebooks.Notebook:
    return {"cells": [{"cell_type": "code", "source": [cell], "outputs": []} for cell in cells]}


def test_cells_share_names_and_show_their_last_expression() -> None:
    ran = notebooks.executed(
        made("%pip install x\nN = 5\nprint(N)", "N + 1", "N = 9", "N"), {"N": 7}
    )
    first, second, _, last = (cell["outputs"] for cell in ran["cells"])
    assert first == [{"name": "stdout", "output_type": "stream", "text": "7\n"}]
    assert second[0]["data"] == {"text/plain": "8"}
    assert last[0]["data"] == {"text/plain": "7"}
    json.dumps(ran)


def test_an_error_in_a_cell_is_raised() -> None:
    with pytest.raises(ZeroDivisionError):
        notebooks.executed(made("1 / 0"))

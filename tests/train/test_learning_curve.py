"""Learning curve: the PNG file and its title."""

import json
from pathlib import Path

import pytest

from rsoccer.train import Args
from rsoccer.train.args import SETTINGS_FILE
from rsoccer.train.learning_curve import plot_learning_curve
from rsoccer.train.log import Logger
from tests.train.log_rows import write_rows


def test_the_plot_is_a_png_file_even_with_gaps(tmp_path: Path) -> None:
    write_rows(Logger(Args(out=tmp_path, progress=False), 0, 0), 0, 30)
    path = plot_learning_curve(tmp_path, tmp_path / "curve.png")
    content = path.read_bytes()
    assert content.startswith(b"\x89PNG") and len(content) > 10_000


@pytest.mark.parametrize(
    ("task", "title"),
    [
        ("VSSMulti-v0", "Learning to play VSSMulti-v0, 3 v 3"),
        ("SSLPassEndurance-v0", "Learning to play SSLPassEndurance-v0, 2 v 0"),
    ],
)
def test_the_title_names_the_task(
    task: str, title: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The title of every run was "three a side"."""
    from matplotlib.figure import Figure

    args = Args(task, tmp_path, progress=False)
    write_rows(Logger(args, 0, 0), 0, 3)
    (tmp_path / SETTINGS_FILE).write_text(json.dumps(args.to_json()))
    figures: list[Figure] = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, path: figures.append(figure))
    plot_learning_curve(tmp_path, tmp_path / "curve.png")
    assert figures[0].axes[0].get_title() == title


def test_a_log_without_rows_is_refused(tmp_path: Path) -> None:
    Logger(Args(out=tmp_path, progress=False), 0, 0).close()
    with pytest.raises(ValueError, match="no rows yet"):
        plot_learning_curve(tmp_path, tmp_path / "curve.png")

"""Learning curve: the PNG file and its title."""

import json
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from rsoccer.registry import make_task
from rsoccer.train import Args
from rsoccer.train.args import SETTINGS_FILE
from rsoccer.train.run.learning_curve import plot_learning_curve
from tests.train.log_rows import new_logger, write_rows

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def test_the_plot_is_a_png_file_even_with_gaps(tmp_path: Path) -> None:
    write_rows(new_logger(tmp_path), 0, 30)
    path = plot_learning_curve(tmp_path, tmp_path / "curve.png")
    content = path.read_bytes()
    assert content.startswith(b"\x89PNG") and len(content) > 10_000


@pytest.mark.parametrize(
    ("task", "title"),
    [
        ("VSSMulti-v0", "Learning to play VSSMulti-v0, 3 v 3"),
        ("SSLPassEndurance-v1", "Learning to play SSLPassEndurance-v1, 2 v 0"),
    ],
)
def test_the_title_names_the_task(
    task: str, title: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The title of every run was "three a side"."""
    from matplotlib.figure import Figure

    write_rows(new_logger(tmp_path), 0, 3)
    (tmp_path / SETTINGS_FILE).write_text(json.dumps(Args(task).to_json()))
    figures: list[Figure] = []
    monkeypatch.setattr(Figure, "savefig", lambda figure, path: figures.append(figure))
    plot_learning_curve(tmp_path, tmp_path / "curve.png")
    assert figures[0].axes[0].get_title() == title


def plotted(folder: Path, rows: list[dict[str, float]], task: str) -> "Axes":
    """Return the axes of the plot of a log with these rows."""
    from matplotlib.figure import Figure

    logger = new_logger(folder)
    for update, row in enumerate(rows):
        logger.write(100 * update, {"samples": 1e6 * update, "reward": 0.0, **row})
    logger.close()
    (folder / SETTINGS_FILE).write_text(json.dumps(Args(task).to_json()))
    figures: list[Figure] = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Figure, "savefig", lambda figure, path: figures.append(figure))
        plot_learning_curve(folder, folder / "curve.png", window=1)
    return figures[0].axes[0]


def test_the_curve_shows_the_ladder_and_not_moving_opponents(tmp_path: Path) -> None:
    nan = float("nan")
    rows = [
        {"ladder_ou_goal_score": a, "ladder_zero_goal_score": b, "episode_past/goal_score": 0.1}
        for a, b in ((-0.5, 0.0), (nan, nan), (0.5, 0.25))
    ]
    axes = plotted(tmp_path, rows, "VSSSelfPlay-v0")
    legend = axes.get_legend()
    assert legend is not None
    assert [text.get_text() for text in legend.get_texts()] == ["ou", "zero"]
    assert np.array(axes.get_lines()[0].get_xydata()).tolist() == [[0.0, -0.5], [2.0, 0.5]]
    assert "exploring" not in axes.get_ylabel()


def test_without_a_ladder_the_curve_shows_the_opponents_in_training(tmp_path: Path) -> None:
    axes = plotted(tmp_path, [{"episode_past/goal_score": 0.1}] * 2, "VSSSelfPlay-v0")
    assert axes.get_lines()[0].get_label() == "past policies"
    assert "while exploring" in axes.get_ylabel()


@pytest.mark.parametrize("ladder", [True, False])
def test_tasks_for_one_team_show_their_metric(ladder: bool, tmp_path: Path) -> None:
    values = {"ladder_passes": 3.0} if ladder else {}
    rows = [{**values, "episode/passes": 2.0}] * 2
    axes = plotted(tmp_path, rows, "SSLPassEnduranceMulti-v1")
    (line,) = axes.get_lines()
    assert np.array(line.get_ydata()).tolist() == [3.0 if ladder else 2.0] * 2
    assert axes.get_ylabel() == ("passes" if ladder else "passes while exploring")
    assert axes.get_legend() is None


@pytest.mark.parametrize(
    ("task", "limits"),
    [
        ("VSSSelfPlay-v0", (-1.05, 1.05)),
        ("SSLDribbling-v0", (0.0, 1.05 * 7.0)),  # seven gates
        ("SSLGoToBall-v0", (0.0, 1.05)),
    ],
)
def test_scores_are_shown_on_their_whole_scale(
    task: str, limits: tuple[float, float], tmp_path: Path
) -> None:
    metric = make_task(task).success
    axes = plotted(tmp_path, [{f"ladder_{metric}": 0.5}] * 2, task)
    assert axes.get_ylim() == pytest.approx(limits)


def test_goal_differences_of_matches_have_no_limits(tmp_path: Path) -> None:
    axes = plotted(tmp_path, [{"ladder_goal_score": score} for score in (-4.0, 9.0)], "VSSMatch-v0")
    low, high = axes.get_ylim()
    assert low < -4.0 and high > 9.0
    assert axes.get_ylabel() == "goal score"


def test_a_log_without_rows_is_refused(tmp_path: Path) -> None:
    new_logger(tmp_path).close()
    with pytest.raises(ValueError, match="no rows yet"):
        plot_learning_curve(tmp_path, tmp_path / "curve.png")

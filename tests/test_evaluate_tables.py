"""Evaluations of two-sided tasks as text and as JSON."""

import json
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer.evaluate import Evaluation, cooperation, evaluate, table, tournament
from rsoccer.tasks import VssSelfPlay
from tests.test_evaluate import Decided


def test_columns_are_aligned() -> None:
    results = [
        evaluate("zero", opponent, matches=4, task=Decided()) for opponent in ("ou", "uniform")
    ]
    header, *rows = table(results).splitlines()
    assert [row.split()[1] for row in rows] == ["ou", "uniform"]
    for title in ("matches", "goal score", "as blue"):
        end = header.index(title) + len(title)
        assert all(row[end - 1] != " " and row[end : end + 1] in ("", " ") for row in rows)
    assert str(results[0]).splitlines()[0].split() == header.split()


@pytest.mark.parametrize(
    "measure",
    [
        lambda **numbers: evaluate("zero", "zero", task=Decided(), **numbers),
        lambda **numbers: tournament(["zero", "chase"], task=Decided(), **numbers),
        lambda **numbers: cooperation("zero", task=VssSelfPlay(max_steps=20), **numbers),
    ],
    ids=["evaluate", "tournament", "cooperation"],
)
def test_results_with_numbers_of_numpy_go_into_json(measure: Callable[..., Any]) -> None:
    two, seed = np.int64(2), np.int64(0)
    found = measure(matches=two, seed=seed, worlds=two, threads=np.int64(1)).as_dict()
    plain = measure(matches=2, seed=0, worlds=2, threads=1).as_dict()
    assert json.dumps(found) == json.dumps(plain)


def test_results_go_into_json() -> None:
    result = evaluate("zero", "zero", matches=4, task=Decided())
    loaded = json.loads(json.dumps(result.as_dict()))
    assert loaded["matches"] == 4
    assert loaded["sides"]["blue"]["wins"] == result.sides["blue"].wins
    assert loaded["seed"] == 0
    assert set(loaded) >= {"wins", "draws", "losses", "score", "low", "high", "seconds_to_decision"}


def test_the_package_offers_the_function() -> None:
    assert rsoccer.evaluate is evaluate
    assert isinstance(rsoccer.evaluate("zero", "zero", 2, task=Decided()), Evaluation)


def test_a_notebook_shows_the_cells_of_the_table() -> None:
    result = evaluate("zero", "ou", matches=4, task=Decided())
    shown = result._repr_html_()
    assert shown.count("<table>") == 1
    for cell in str(result).split():
        assert cell in shown
    assert "<script" not in replace(result, policy="<script>")._repr_html_()
    assert "&lt;script&gt;" in replace(result, policy="<script>")._repr_html_()

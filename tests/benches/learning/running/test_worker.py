from typing import Any

from benches.learning.running.worker import comparison

ROW = {"opponent": "ou", "mode": "sample", "score": 0.5}


def result(score: float) -> dict[str, Any]:
    return {"evaluations": [ROW, {**ROW, "score": score}]}


def test_the_first_evaluation_that_differs_is_named() -> None:
    same = result(float("nan"))
    assert comparison([], same, same) == "the same evaluations as in the earlier result"
    other = result(0.25)
    text = comparison([], same, other)
    assert "NaN" in text
    assert "0.25" in text
    assert comparison([], {"evaluations": []}, other).startswith("other evaluations")


def test_a_result_of_other_conditions_is_not_compared() -> None:
    text = comparison(["samples was 1, now 2"], result(0.25), result(0.5))
    assert text == "replaces a result of other conditions: samples was 1, now 2"

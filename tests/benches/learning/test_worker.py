from benches.learning.worker import comparison

ROW = {"opponent": "ou", "mode": "sample", "score": 0.5}


def test_the_first_evaluation_that_differs_is_named() -> None:
    same = {"evaluations": [ROW, {**ROW, "score": float("nan")}]}
    assert comparison(same, same) == "the same evaluations as in the earlier result"
    other = {"evaluations": [ROW, {**ROW, "score": 0.25}]}
    text = comparison(same, other)
    assert "NaN" in text
    assert "0.25" in text
    assert comparison({"evaluations": []}, other).startswith("other evaluations")

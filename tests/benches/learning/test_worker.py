from typing import Any

from benches.learning.worker import comparison

ROW = {"opponent": "ou", "mode": "sample", "score": 0.5}


def result(score: float, samples: int = 100) -> dict[str, Any]:
    settings = {"samples": samples}
    rows = [ROW, {**ROW, "score": score}]
    same = {"protocol": {"starts": 500}, "physics": 6, "needs": {}}
    return {"settings": settings, **same, "evaluations": rows}


def test_the_first_evaluation_that_differs_is_named() -> None:
    same = result(float("nan"))
    assert comparison(same, same) == "the same evaluations as in the earlier result"
    other = result(0.25)
    text = comparison(same, other)
    assert "NaN" in text
    assert "0.25" in text
    assert comparison({**other, "evaluations": []}, other).startswith("other evaluations")


def test_a_result_of_other_settings_is_not_compared() -> None:
    assert comparison(result(0.25, 200), result(0.5)) == "replaces a result of other settings"

from benches.result_files import Figure
from tools.library_speed import NOT_MEASURED, libraries, library_rows


def figure(variant: str, quantity: str, median: float) -> Figure:
    values = {"median": median, "minimum": median, "maximum": 2 * median}
    sizes = {"worlds": 8, "threads": 1, "rounds": 3}
    names = {"group": "libraries", "scenario": "VSS-v0", "engine": "rapier", "unit": ""}
    return Figure(variant=variant, quantity=quantity, **names, **sizes, **values)  # type: ignore[arg-type]


def test_a_row_has_speed_and_ratio_to_matches() -> None:
    figures = [
        figure("Matches", "speed", 10_000.0),
        figure("SB3 SoccerVecEnv", "speed", 9_000.0),
        figure("SB3 SoccerVecEnv / Matches", "ratio", 0.9),
    ]
    assert library_rows(figures) == [
        ("SB3 SoccerVecEnv", "`VSS-v0`", "8", "9,000", "0.9x (0.9x to 1.8x)")
    ]
    assert library_rows(figures[:2]) == []


def test_there_is_a_text_before_the_first_measurement() -> None:
    assert libraries().strip()
    assert NOT_MEASURED.startswith("`make bench`")

from pathlib import Path

import pytest

from benches.result_files import format_number, format_ratio, load, store
from tests.benches.figures import MACHINE, RSOCCER


def test_a_stored_table_is_loaded(tmp_path: Path) -> None:
    path = store(RSOCCER[:3], MACHINE, tmp_path / "new")
    assert path.name == "some-cpu-2-5ghz-2-cores.csv"
    assert load(path) == (MACHINE, RSOCCER[:3])


def test_an_older_table_of_the_machine_is_replaced(tmp_path: Path) -> None:
    store(RSOCCER[:3], MACHINE, tmp_path)
    path = store(RSOCCER[:1], MACHINE, tmp_path)
    assert list(tmp_path.iterdir()) == [path]
    assert load(path)[1] == RSOCCER[:1]


def test_an_empty_table_is_refused(tmp_path: Path) -> None:
    (tmp_path / "empty.csv").write_text("")
    with pytest.raises(ValueError, match=r"at least one row in .*empty\.csv"):
        load(tmp_path / "empty.csv")


def test_numbers_have_the_digits_that_repeat() -> None:
    assert [format_number(x) for x in (48_512.0, 1234.0, 312.4, 1.8765, 0.00123)] == [
        *("48,500", "1,230", "312", "1.88", "0.00123"),
    ]
    assert [format_number(x, 2) for x in (258.8, 3.96, 0.131)] == ["260", "4", "0.13"]
    ratios = (0.607, 1.987, 30.24, 99.6, 102.3)
    assert [format_ratio(x) for x in ratios] == ["0.607x", "1.99x", "30x", "100x", "102x"]

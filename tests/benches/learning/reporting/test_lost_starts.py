import json
from pathlib import Path

from benches.learning.reporting.lost_starts import sentences
from benches.learning.run_files import LOST_STARTS, Folders


def test_the_result_in_words(tmp_path: Path) -> None:
    folders = Folders(tmp_path, tmp_path)
    assert sentences(folders) == ""
    row = {"opponent": "chase", "policies": 4, "starts": 80, "lost_by_all": 0.031}
    rows = [row | {"least_lost_by_one": 0.08, "highest_score": 0.938}]
    result = {"runs": {}, "seconds": 1.5, "rows": rows}
    (tmp_path / LOST_STARTS).write_text(json.dumps(result))
    text = sentences(folders)
    assert "80 starts are lost within 1.5 s by all of 4 policies" in text
    assert "- Against `chase` all lose 3.1% of them, and the best policy loses 8.0%" in text
    assert "above 0.94 needs" in text

import json
from pathlib import Path

from benches.learning.reporting.tournament import section
from benches.learning.run_files import TOURNAMENT, Folders
from benches.learning.running import trained_tournament


def test_the_published_tournament_is_of_the_policies_in_the_package() -> None:
    """After another policy, `python -m benches.learning.running.trained_tournament` again."""
    published = json.loads((Folders().results / TOURNAMENT).read_text())
    files = trained_tournament.file_digests()
    assert len(files) == 3
    assert published["files"] == files


def test_the_trained_policies_play_the_scripts(tmp_path: Path) -> None:
    folders = Folders(tmp_path, tmp_path)
    assert section(folders) == ""
    result = trained_tournament.measure(2, tmp_path / "picture.png")
    assert (tmp_path / "picture.png").is_file()
    assert result["files"] == trained_tournament.file_digests()
    labels = [row["label"] for row in result["standings"]]
    assert len(labels) == len(set(labels)) == 3 + len(trained_tournament.SCRIPTS)
    text = json.dumps(result)
    assert str(Path(__file__).parents[3]) not in text, "no path of this machine"
    (tmp_path / TOURNAMENT).write_text(text)
    lines = section(folders).splitlines()
    assert [line.split("`")[1] for line in lines[2:9]] == labels

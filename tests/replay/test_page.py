import base64
import json
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from rsoccer._core import Field, SimConfig
from rsoccer.render import palette
from rsoccer.replay import Replay, ReplayError, page
from rsoccer.replay.page import scene, to_frame, to_html
from tests.replay.conftest import ssl, vss


def embedded(html: str, name: str) -> str:
    found = re.search(rf'<script type="[\w/]+" id="{name}">(.*?)</script>', html, re.DOTALL)
    assert found
    return found[1]


def test_the_page_holds_the_replay_without_snapshots(replay: Replay) -> None:
    content = base64.b64decode(embedded(to_html(replay), "replay"))
    assert content == replay.to_bytes(snapshots=False)


def test_the_page_needs_nothing_else(replay: Replay) -> None:
    html = to_html(replay)
    code = html.replace(embedded(html, "replay"), "")
    for word in (
        "http:",
        "https:",
        "fetch(",
        "XMLHttpRequest",
        "import ",
        "src=",
        "href=",
        "@import",
    ):
        assert word not in code
    assert "{{" not in code
    assert html == to_html(replay)


def test_names_cannot_break_the_page() -> None:
    evil = '</script><script>alert("1")</script>'
    html = to_html(replace(vss(), names=(evil, "{{script}}"), task=evil))
    assert evil not in html
    assert html.count("<script") == to_html(vss()).count("<script")
    assert "<title>&lt;/script&gt;" in html


def test_a_notebook_shows_the_page_in_a_frame() -> None:
    frame = vss()._repr_html_()
    assert frame == to_frame(vss())
    assert frame.startswith("<iframe ")
    assert frame.count("<") == 2
    assert "srcdoc=" in frame


@pytest.mark.parametrize("field", Field.PRESETS)
def test_the_scene_has_the_shapes_of_the_pictures(field: str) -> None:
    config = SimConfig(field, 2, 1)
    drawn = scene(config)
    assert {shape[0] for shape in drawn["field"]} >= {"polygon", "line", "arc", "circle"}
    assert drawn["robots"] == [0, 0, 0]
    assert len(drawn["outlines"]) == 1
    assert drawn["outlines"][0]["size"] > 0.05
    assert json.loads(json.dumps(drawn)) == drawn
    left, bottom, right, top = drawn["bounds"]
    assert left == -right < -config.field.half_length
    assert bottom == -top < -config.field.half_width


def test_robots_of_several_models_have_outlines_of_their_own() -> None:
    config = SimConfig("ssl_b", 2, 1, robot=["ssl_generic", "ssl_erforce", "ssl_generic"])
    assert scene(config)["robots"] == [0, 1, 0]


def test_the_page_has_the_colors_of_the_pictures() -> None:
    red, green, blue, _ = palette.BLUE
    assert f"--blue: rgba({red},{green},{blue},1.0);" in to_html(vss())
    used = set(re.findall(r"colors(?:\.(\w+)|\[\"([\w-]+)\"\])", page.web_part("field.js")))
    names = {first or second for first, second in used}
    assert {"orange", "dribbler-lit"} <= names <= set(scene(ssl().config)["colors"])
    variables = set(re.findall(r"var\(--([\w-]+)\)", page.web_part("style.css")))
    own = set(re.findall(r"--([\w-]+):", page.web_part("style.css")))
    assert variables <= own | set(scene(ssl().config)["colors"])


def test_the_page_needs_no_pygame(tmp_path: Path) -> None:
    code = (
        "import sys; sys.modules['pygame'] = sys.modules['PIL'] = sys.modules['torch'] = None\n"
        "from rsoccer.replay import record_replay\n"
        "record_replay(controllers={'all': 'zero'}, seconds=0.1).save_html(sys.argv[1])\n"
    )
    file = tmp_path / "match.html"
    command = [sys.executable, "-c", code, str(file)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert file.stat().st_size > 20_000


def test_a_page_is_an_html_file(tmp_path: Path) -> None:
    with pytest.raises(ReplayError, match=r"ending in \.html"):
        vss().save_html(tmp_path / "match.txt")


def test_every_part_of_the_page_is_used() -> None:
    html = to_html(vss())
    for name in page.SCRIPTS:
        assert page.web_part(name) in html
    identifiers = set(re.findall(r"\$\(\"([\w-]+)\"\)", page.web_part("player.js")))
    assert len(identifiers) > 15
    for identifier in identifiers:
        assert f'id="{identifier}"' in html

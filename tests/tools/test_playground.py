"""The page of the playground without its module: `make check-wasm` tests it with one."""

import base64
import json
import re
from pathlib import Path

import numpy as np
import pytest

import rsoccer
from rsoccer.human import keyboard
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import VALUE
from rsoccer.policies.trained import FOLDER, load_file
from tools.playground.keys import key_words, keys
from tools.playground.page import LEAGUES, SCRIPTS, WEB, data, to_html, web_part
from tools.site import playground


def test_a_page_needs_no_other_file() -> None:
    page = to_html("bW9kdWxl")
    assert "{{" not in page.replace("{{{", "")
    assert not re.search(r'(?:src|href)="(?!data:)', page)
    assert page.count("<script") == 3
    assert ">bW9kdWxl</script>" in page
    assert len(page) < 1_000_000  # the module may have two thirds of 3 MB


def test_all_scripts_of_the_folder_are_on_the_page() -> None:
    assert sorted(SCRIPTS) == sorted(path.name for path in WEB.glob("*.js"))
    page = to_html("")
    assert all(web_part(name) in page for name in SCRIPTS)


def plays_alike(file: bytes, shipped: Path, folder: Path) -> bool:
    """Whether a file is that of a shipped policy, of a network without its value network."""
    (folder / "a.safetensors").write_bytes(file)
    one, other = load_file(folder / "a.safetensors"), load_file(shipped)
    if not isinstance(one, Network):
        return file == shipped.read_bytes()
    assert isinstance(other, Network)
    assert one.value is None
    rest = {name: text for name, text in other.metadata.items() if name != VALUE}
    arrays = {name: a for name, a in other.arrays().items() if not name.startswith(VALUE)}
    equal = [np.array_equal(a, arrays[name]) for name, a in one.arrays().items()]
    return one.metadata == rest and len(equal) == len(arrays) and all(equal)


def test_choices_have_scenes_and_policies_of_the_package(tmp_path: Path) -> None:
    values = json.loads(json.dumps(data()))
    assert len(values["leagues"]) == len(LEAGUES) >= 5
    for league, given in zip(LEAGUES, values["leagues"], strict=True):
        assert values["scenes"][league.field]["bounds"]
        assert values["areas"][league.field]
        assert league.task in rsoccer.list_tasks()
        assert given["scripted"] is league.field.startswith("ssl")
        for policy, shown in zip(league.policies, given["policies"], strict=True):
            file = base64.b64decode(values["files"][shown["file"]])
            if (FOLDER / policy.file).exists():
                assert plays_alike(file, FOLDER / policy.file, tmp_path)
                continue
            (tmp_path / "a.safetensors").write_bytes(file)
            network = Network.load(tmp_path / "a.safetensors")
            robots = {"n_blue": league.robots, "n_yellow": league.robots}
            task = rsoccer.make_task(league.task, field=league.field, **robots)
            network.check_fits(task, task.layout.size)
            assert network.needs_forecast is (policy.id == "robust")
        assert (given["play"] == "self_play") == league.task.endswith("SelfPlay-v0")
    assert sum(len(league.policies) for league in LEAGUES) >= 3
    assert {league.play for league in LEAGUES} == {"match", "self_play"}


def test_keys_are_those_of_play() -> None:
    given = keys()
    assert [given["pass"], given["chip"]] == [keyboard.PASS, keyboard.CHIP]
    assert given["kick"] == " "
    assert given["slow"] == ["shift"]
    assert given["commands"] == {"next_robot": "tab", "pause": "p", "reset": "r"}
    assert given["passKick"] == keyboard.PASS_KICK
    assert len(given["moves"]) == len(keyboard.MOVES)
    assert given["moves"]["arrowup"] == keyboard.MOVES["up"]
    assert data()["keys"] == given
    assert f"{key_words()}," in to_html("")
    text = (Path(__file__).parents[2] / "docs" / "playground.md").read_text()
    assert f"{key_words()}," in " ".join(text.split())


def test_the_site_shows_the_playground_where_it_was_built(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = f"# Title\n\n{playground.MARK}\n"
    assert "make playground" in playground.shown(text, built=False)
    assert f'src="{playground.PLACE}"' in playground.shown(text, built=True)
    docs = Path(__file__).parents[2] / "docs" / "playground.md"
    assert docs.read_text().count(playground.MARK) == 1
    monkeypatch.setattr(playground, "PAGE", tmp_path / "none.html")
    playground.copy(tmp_path)
    assert not (tmp_path / playground.PLACE).exists()
    (tmp_path / "none.html").write_text("page")
    playground.copy(tmp_path)
    assert (tmp_path / playground.PLACE).read_text() == "page"

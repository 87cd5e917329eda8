"""The pages of the documentation site, without Sphinx: what they say and what they cover."""

import inspect
import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import rsoccer
from benches.solvers import SOLVERS
from rsoccer._core import BALL_COLUMNS, build_info
from rsoccer.registry import list_options
from tools.paths import DOCS
from tools.site import api, docstrings, matches, meanings, solved, source, stub, task_docs, tasks
from tools.whole_matches import WHOLE_MATCHES, WholeMatch

TASKS = rsoccer.list_tasks()


@pytest.mark.parametrize("name", TASKS)
def test_every_task_has_a_page_with_all_sections(name: str) -> None:
    page = tasks.page(name)
    for title in (
        "Initial state",
        "Observation",
        "Action",
        "Reward",
        "End of an episode",
        "Options",
        "Metrics",
    ):
        assert f"\n## {title}\n" in page
    assert f"# {name}\n" in page
    assert f"]({name}.png)" in page


def test_every_task_shows_a_match(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(matches, "SECONDS", 1.0)
    monkeypatch.setattr(matches, "WHOLE_SECONDS", 1.0)
    matches.write(tmp_path)
    written = sorted(tmp_path.iterdir())
    assert [path.stem for path in written] == TASKS
    for path in written:
        assert 20_000 < path.stat().st_size < 400_000
        assert f'src="../{matches.FOLDER}/{path.name}"' in tasks.page(path.stem)


def test_a_match_is_played_by_the_solver_of_its_task() -> None:
    replay = matches.record("SSLGoToBall-v0")
    assert set(replay.controllers.values()) == {SOLVERS["SSLGoToBall-v0"]}
    assert replay.names == ("FETCH", "")
    assert replay.seconds == matches.SECONDS
    assert {event.kind for event in replay.events} >= {"touch", "end"}


def test_whole_matches_are_recorded_to_their_end(monkeypatch: pytest.MonkeyPatch) -> None:
    short = WholeMatch("scripted", "chase", {"half_seconds": 1.0, "halves": 1})
    monkeypatch.setitem(WHOLE_MATCHES, "VSSMatch-v0", short)
    replay = matches.record("VSSMatch-v0")
    states = replay.referee_states
    assert states is not None
    assert [state.is_over for state in states[-2:]] == [False, True]
    assert replay.names == ("SCRIPTED", "CHASE")
    assert replay.seconds < matches.WHOLE_SECONDS


@pytest.mark.parametrize("name", TASKS)
def test_parts_fill_every_block(name: str) -> None:
    task = rsoccer.make_task(name)
    for title, block in task.layout.blocks.items():
        sizes = sum(part.size for part in tasks.parts(title, block))
        assert sizes in (0, block.size, block.shape[-1]), title


@pytest.mark.parametrize("name", TASKS)
def test_every_number_of_an_action_is_described(name: str) -> None:
    task = rsoccer.make_task(name)
    assert len(tasks.actions(task)) == len(tasks.action_scales(task)) == task.action_size


def test_every_task_has_a_solver_and_no_other() -> None:
    assert set(SOLVERS) == set(TASKS)


def test_texts_cover_every_block_and_no_others() -> None:
    blocks = {block for name in TASKS for block in rsoccer.make_task(name).layout.blocks}
    assert {*meanings.BLOCKS, "ball"} == blocks


@pytest.mark.parametrize("name", TASKS)
def test_docstrings_describe_every_part_of_a_task(name: str) -> None:
    task = rsoccer.make_task(name)
    assert task_docs.summary(task).endswith(".")
    for label in ("Goal of the task", "Initial state", "Source"):
        assert task_docs.paragraph(task, label), label
    assert set(task_docs.reward_terms(task)) == set(tasks.weights(name))
    assert all(meaning and unit for meaning, unit in task_docs.reward_terms(task).values())
    assert set(task_docs.metrics(task)) == set(tasks.metrics(task))
    assert set(list_options(type(task))) <= set(task_docs.options(task))
    assert task_docs.events(task)


def test_an_inherited_paragraph_is_that_of_the_base_class() -> None:
    single, match = rsoccer.make_task("VSS-v0"), rsoccer.make_task("VSSSelfPlay-v0")
    for label in ("Initial state", "Termination", "Metric"):
        assert task_docs.paragraph(single, label) == task_docs.paragraph(match, label)
    assert task_docs.paragraph(single, "Color") == ""


def test_an_exception_of_a_task_is_shown() -> None:
    contested = rsoccer.make_task("SSLContestedPossession-v0")
    assert "0.5 m/s" in task_docs.exceptions(contested)
    assert task_docs.exceptions(rsoccer.make_task("VSS-v0")) == ""


def test_rows_of_a_table_join_their_lines() -> None:
    terms = task_docs.reward_terms(rsoccer.make_task("VSS-v0"))
    assert terms["ball_to_goal"][1] == "m"
    assert terms["ball_to_goal"][0].count("  ") == 0
    assert "own goal" in terms["ball_to_goal"][0]


def test_solutions_are_of_this_physics() -> None:
    kept = solved.load()
    assert kept["physics"] == build_info()["physics"], "run `make docs`"
    assert {task: found["policy"] for task, found in kept["tasks"].items()} == SOLVERS


def test_a_solution_is_measured_again_alike() -> None:
    kept = solved.load()["tasks"]["SSLPassEndurance-v1"]
    assert solved.measured("SSLPassEndurance-v1", "passer") == kept


def test_some_tasks_are_measured_and_the_results_of_others_stay(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    before = solved.load()
    monkeypatch.setattr(solved, "FILE", tmp_path / "solved.json")
    solved.FILE.write_text(json.dumps(before))
    monkeypatch.setattr(solved, "measured", lambda *names: {"measured": names})
    solved.main(["--only", "VSS-v0"])
    tasks = solved.load()["tasks"]
    assert tasks.pop("VSS-v0") == {"measured": ["VSS-v0", "scripted"]}
    assert tasks == {name: kept for name, kept in before["tasks"].items() if name != "VSS-v0"}
    solved.main([])
    assert all(list(kept) == ["measured"] for kept in solved.load()["tasks"].values())


def test_every_public_name_has_its_place_in_the_reference() -> None:
    for name in api.public_names():
        assert api.home(name).rpartition(".")[0] in api.modules()


def test_every_module_is_in_the_reference_or_private() -> None:
    listed = api.modules()
    assert len(listed) == len(set(listed))
    found = set(api.found())
    assert set(listed) <= found
    private = {name for name in api.PRIVATE if not name.endswith(".*")}
    assert private <= found
    assert not private & set(listed)
    packages = tuple(name.removesuffix("*") for name in api.PRIVATE if name.endswith(".*"))
    unknown = {name for name in found - set(listed) - private if not name.startswith(packages)}
    assert not unknown, "add them to GROUPS or PRIVATE of tools/site/api.py"


def test_the_reference_starts_with_the_names_of_the_package() -> None:
    page = api.index(rust=False)
    for name in api.public_names():
        assert f"rsoccer.{name} <{api.home(name)}>" in page
    assert "rsim_core/index.html" not in page


@pytest.mark.parametrize(
    ("page", "link", "led_to"),
    [
        (
            "tutorials/new-task.md",
            "../../CONTRIBUTING.md#a-new-task",
            "../contributing.md#a-new-task",
        ),
        ("speed.md", "../README.md#speed", "index.md"),
        ("speed.md", "physics.md#presets", "physics.md#presets"),
        ("speed.md", "../benches/results/a.png", "results/a.png"),
        ("speed.md", "tasks", "tasks/index.md"),
        ("tutorials/train.md", "../tasks#VSS-v0", "../tasks/VSS-v0.md"),
        ("tutorials/train.md", "../../examples", "../examples.md"),
        ("tutorials/train.md", "../../python/rsoccer/task.py", "../api/rsoccer.task.md"),
        ("tutorials/train.md", "../../python/rsoccer/_core.pyi", "../api/rsoccer._core.md"),
        ("index.md", "../python/rsoccer", "api/index.md"),
        ("CONTRIBUTING.md", "docs/physics.md", "physics.md"),
        ("CONTRIBUTING.md", "ARCHITECTURE.md", "architecture.md"),
        ("index.md", "https://example.org/x.md", "https://example.org/x.md"),
    ],
)
def test_links_lead_to_pages_of_the_site(page: str, link: str, led_to: str) -> None:
    assert source.linked(f"see [this]({link}).", Path(page)) == f"see [this]({led_to})."


def test_all_links_between_laid_out_pages_lead_somewhere(tmp_path: Path) -> None:
    folder = tmp_path / "pages"
    source.lay_out(folder, rust=False)
    pages = list(folder.rglob("*.md"))
    assert len(pages) > 20 + len(TASKS)
    missing = [
        f"{page.relative_to(folder)}: {link}"
        for page in pages
        for link in links(page.read_text())
        if not (page.parent / link).exists()
    ]
    assert not missing


def links(text: str) -> Iterator[str]:
    """Targets of relative links outside code."""
    for target in re.findall(
        r"\]\(([^)#\s]+)[^)]*\)", re.sub(r"```.*?```", "", text, flags=re.DOTALL)
    ):
        if "://" not in target:
            yield target


def test_every_hand_written_page_is_in_a_table_of_contents() -> None:
    listed = (DOCS / "index.md").read_text()
    for page in DOCS.rglob("*.md"):
        name = page.relative_to(DOCS).with_suffix("").as_posix()
        assert name == "index" or re.search(rf"^{re.escape(name)}$", listed, re.MULTILINE), name


def test_types_of_arrays_are_short() -> None:
    long = "dict[str, ~numpy.ndarray[tuple[~typing.Any, ...], ~numpy.dtype[~numpy.float32]]]"
    assert docstrings.short(long) == "dict[str, NDArray[float32]]"
    assert docstrings.short("") == ""


def test_stars_of_shapes_are_no_emphasis() -> None:
    assert docstrings.restructured(["float32 (n, *shape)"]) == [r"float32 (n, \*shape)"]
    assert docstrings.restructured(["an *important* word"]) == ["an *important* word"]


def test_tables_of_markdown_become_directives() -> None:
    rows = ["| column | unit |", "| --- | --- |", "| `x` | m |", "| | rad |"]
    found = docstrings.restructured(["Columns.", "", *rows, "", "More."])
    directive = [".. list-table::", "   :header-rows: 1", ""]
    cells = ["   * - column", "     - unit", "   * - `x`", "     - m", "   * - ", "     - rad"]
    assert found == ["Columns.", "", "", *directive, *cells, "", "", "More."]


def test_the_stub_has_the_values_of_the_compiled_module() -> None:
    module = stub.load()
    assert module.BALL_COLUMNS == BALL_COLUMNS
    assert module.Simulator is not rsoccer.Simulator
    assert "active" in inspect.signature(module.Simulator.step).parameters

"""The pages of the documentation site, without Sphinx: what they say and what they cover."""

import inspect
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

import rsoccer
from rsoccer._core import BALL_COLUMNS, build_info
from rsoccer.registry import list_options
from tools.site import api, docstrings, meanings, solved, source, stub, tasks

TASKS = rsoccer.list_tasks()


def described(table: dict[str, str]) -> set[str]:
    """Names without the task or league that stands before some of them."""
    return {key.rpartition(":")[2] for key in table}


@pytest.mark.parametrize("name", TASKS)
def test_every_task_has_a_page_with_all_sections(name: str) -> None:
    page = tasks.page(name)
    for title in ("Observation", "Action", "Reward", "End of an episode", "Options", "Metrics"):
        assert f"\n## {title}\n" in page
    assert f"# {name}\n" in page
    assert f"]({name}.png)" in page


@pytest.mark.parametrize("name", TASKS)
def test_parts_fill_every_block(name: str) -> None:
    task = rsoccer.make_task(name)
    for title, block in task.blocks.items():
        sizes = sum(part.size for part in tasks.parts(title, block))
        assert sizes in (0, block.size, block.shape[-1]), title


@pytest.mark.parametrize("name", TASKS)
def test_every_number_of_an_action_is_described(name: str) -> None:
    task = rsoccer.make_task(name)
    assert len(tasks.actions(task)) == len(tasks.action_scales(task)) == task.action_size


def test_texts_cover_every_task_and_no_others() -> None:
    for table in (meanings.PAGES, meanings.ENDS, meanings.SOLVERS):
        assert set(table) == set(TASKS)


def test_texts_cover_every_block_and_no_others() -> None:
    blocks = {block for name in TASKS for block in rsoccer.make_task(name).blocks}
    assert {*meanings.BLOCKS, "ball"} == blocks


def test_texts_cover_every_reward_term_and_no_others() -> None:
    terms = {(name, term) for name in TASKS for term in tasks.weights(name)}
    assert all(meanings.text(meanings.REWARDS, name, term) for name, term in terms)
    assert described(meanings.REWARDS) == {term for _, term in terms}


def test_texts_cover_every_option_and_no_others() -> None:
    found = {
        (name, option) for name in TASKS for option in list_options(type(rsoccer.make_task(name)))
    }
    assert all(meanings.text(meanings.OPTIONS, name, option) for name, option in found)
    assert described(meanings.OPTIONS) == {option for _, option in found}


def test_texts_cover_every_metric_and_no_others() -> None:
    found = {metric for name in TASKS for metric in tasks.metrics(rsoccer.make_task(name))}
    assert set(meanings.METRICS) == found


@pytest.mark.parametrize("table", [meanings.REWARDS, meanings.OPTIONS])
def test_texts_of_one_task_name_a_task(table: dict[str, str]) -> None:
    owners = {key.rpartition(":")[0] for key in table}
    assert owners <= {"", "VSS", "SSL", *TASKS}


def test_a_missing_text_is_named() -> None:
    with pytest.raises(KeyError, match="VSS-v0: no text for 'beauty'"):
        meanings.text(meanings.REWARDS, "VSS-v0", "beauty")


def test_the_text_of_a_task_precedes_that_of_its_league() -> None:
    table = {"x": "all", "SSL:x": "league", "SSLSelfPlay-v0:x": "task"}
    assert meanings.text(table, "SSLSelfPlay-v0", "x") == "task"
    assert meanings.text(table, "SSLGoToBall-v0", "x") == "league"
    assert meanings.text(table, "VSS-v0", "x") == "all"


def test_solutions_are_of_this_physics() -> None:
    kept = solved.load()
    assert kept["physics"] == build_info()["physics"], "run `make docs`"
    assert {task: found["policy"] for task, found in kept["tasks"].items()} == meanings.SOLVERS


def test_a_solution_is_measured_again_alike() -> None:
    kept = solved.load()["tasks"]["SSLPassEndurance-v0"]
    assert solved.measured("SSLPassEndurance-v0", "passer") == kept


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
    listed = (source.DOCS / "index.md").read_text()
    for page in source.DOCS.rglob("*.md"):
        name = page.relative_to(source.DOCS).with_suffix("").as_posix()
        assert name == "index" or re.search(rf"^{re.escape(name)}$", listed, re.MULTILINE), name


@dataclass
class Commented:
    """A dataclass with a comment."""

    speed: float  # m/s
    name: str = ""


def test_comments_of_fields_are_read() -> None:
    assert docstrings.field_comments(Commented) == {"speed": "m/s"}
    assert docstrings.field_comments(rsoccer.Matches) == {}
    lines = ["A dataclass with a comment."]
    docstrings.docstring(None, "class", "Commented", Commented, None, lines)
    assert ":ivar speed: m/s" in lines


def test_types_of_arrays_are_short() -> None:
    long = "dict[str, ~numpy.ndarray[tuple[~typing.Any, ...], ~numpy.dtype[~numpy.float32]]]"
    assert docstrings.short(long) == "dict[str, NDArray[float32]]"
    assert docstrings.short("") == ""


def test_stars_of_shapes_are_no_emphasis() -> None:
    assert docstrings.restructured(["float32 (n, *shape)"]) == [r"float32 (n, \*shape)"]
    assert docstrings.restructured(["an *important* word"]) == ["an *important* word"]


def test_the_stub_has_the_values_of_the_compiled_module() -> None:
    module = stub.load()
    assert module.BALL_COLUMNS == BALL_COLUMNS
    assert module.Simulator is not rsoccer.Simulator
    assert "active" in inspect.signature(module.Simulator.step).parameters

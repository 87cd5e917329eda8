import pytest

from tools.check_installs import INSTALLS, LINE, documented, program_of


def test_every_documented_line_is_tried() -> None:
    """`make check-installs` tries the table; a line on a page has to be in it, and vice versa."""
    found = documented()
    assert found.keys() == INSTALLS.keys()
    assert {"docs/libraries.md", "docs/scaling.md"} <= found['"ray[rllib]>=2.60" torch']
    assert "README.md" in found["'.[all]'"]


@pytest.mark.parametrize(
    ("text", "arguments"),
    [
        ("pip install '.[all]'   # in a clone", "'.[all]'"),
        ('It needs RLlib: `pip install "ray[rllib]>=2.60" torch`.', '"ray[rllib]>=2.60" torch'),
        ("pip install --no-deps a==2.0.2 b==0.23.0\n", "--no-deps a==2.0.2 b==0.23.0"),
    ],
)
def test_lines_are_found_as_they_are_written(text: str, arguments: str) -> None:
    assert LINE.findall(text) == [arguments]


@pytest.mark.parametrize("line", INSTALLS)
def test_every_line_has_a_program(line: str) -> None:
    program = program_of(INSTALLS[line])
    assert "import" in program
    compile(program, line, "exec")

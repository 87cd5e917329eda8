"""Custom fields, robots and balls, and their configurations: errors and representations."""

import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest

import rsoccer
from rsoccer._core import (
    AreaShield,
    AttackShield,
    BallModel,
    Field,
    Forecaster,
    Referee,
    RobotModel,
    ScriptedTeam,
    Sensing,
    SimConfig,
    Simulator,
    VisionTracker,
)
from rsoccer.registry import list_options, task_class
from rsoccer.tasks import VssSelfPlay

HEAVY = RobotModel("vss_440rpm", mass=0.2)
MIXED = SimConfig(robot=["vss_440rpm", "vss_650rpm"], n_blue=1, n_yellow=1)
UNORDERED_WHEELS = RobotModel("ssl_generic").to_json().replace("[60.0", "[160.0")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Field("vss_3v3", gaol_width=1.0), 'no "gaol_width"; its numbers are length, '),
        (lambda: BallModel("vss_rsim", size=1.0), 'vss_rsim has no "size"; its numbers are '),
        (
            lambda: RobotModel("vss_440rpm", radius=0.1),
            'vss_440rpm has no "radius".* side_length, ',
        ),
        (
            lambda: Field("ssl_b", goal_depth=5.0),
            "must fit into .*goal_line_margin of 0.3 m, got 5",
        ),
        (
            lambda: RobotModel("ssl_generic", front_distance=0.2),
            "front_distance must not be beyond .*, got 0.2 m",
        ),
        (lambda: RobotModel.from_json(UNORDERED_WHEELS), r"in rising order.*, got \[160.0, 135.0"),
        (lambda: Field.from_json("{}"), "text is not a Field: missing field `name`"),
        (lambda: SimConfig(robot=[RobotModel("vss_440rpm")]), "each of 6 robots, got 1"),
        (lambda: MIXED.robot, "robots differ: use `robots`"),
        (lambda: SimConfig(n_blue=0, n_yellow=0).robot, "there are no robots"),
        (lambda: Simulator(SimConfig(Field("vss_3v3", length=0.1))), "teams do not fit"),
    ],
)
def test_invalid_models_are_refused_by_name(make: Callable[[], object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        make()


def test_a_robot_has_only_the_parameters_of_its_drive() -> None:
    vss = RobotModel("vss_440rpm")
    assert not hasattr(vss, "radius")
    assert not hasattr(vss, "wheel_angles")
    assert hasattr(RobotModel("ssl_generic"), "wheel_angles")


def test_a_robot_of_a_file_without_numbers_of_tipping_does_not_tip() -> None:
    parts = json.loads(RobotModel("vss_firasim").to_json())
    drive = parts["drive"]["Differential"]
    assert drive.pop("tipping_friction") > 0.0
    assert drive.pop("skid_slip") > 0.0
    model = RobotModel.from_json(json.dumps(parts))
    assert (model.tipping_friction, model.skid_slip) == (0.0, 0.0)


def test_representations() -> None:
    assert "ssl_generic" in repr(RobotModel("ssl_generic"))
    assert repr(SimConfig()).startswith('SimConfig("vss_3v3", 3, 3, robot="vss_440rpm", ')
    assert 'robot=["vss_440rpm", "vss_650rpm"]' in repr(MIXED)
    assert repr(Simulator(MIXED, 2)) == "Simulator(2 worlds, 1 threads)"


@pytest.mark.parametrize(
    ("model", "equal", "other"),
    [
        (Field("ssl_b"), Field("ssl_b"), Field("ssl_b", width=5.0)),
        (BallModel("vss_rsim"), BallModel("vss_rsim"), BallModel("ssl_tigers")),
        (
            RobotModel("vss_440rpm", mass=0.2),
            RobotModel("vss_440rpm", mass=0.2),
            RobotModel("vss_440rpm"),
        ),
    ],
)
def test_equal_models_have_equal_hashes(model: object, equal: object, other: object) -> None:
    assert hash(model) == hash(equal)
    assert {model, equal, other} == {model, other}


def test_a_model_can_be_the_default_of_a_dataclass() -> None:
    @dataclass(frozen=True)
    class Heavy(VssSelfPlay):
        robot: str | RobotModel = HEAVY

    assert Heavy().config.robot.mass == 0.2


def test_a_number_of_another_type_is_refused_by_name() -> None:
    with pytest.raises(TypeError, match="mass: expected a number, got 'heavy'"):
        RobotModel("vss_440rpm", mass="heavy")  # type: ignore[arg-type]


@pytest.mark.parametrize("path", [str, Path])
def test_files_of_models_are_taken_everywhere(path: Callable[[Path], Any], tmp_path: Path) -> None:
    robot, ball, field = (tmp_path / f"{name}.json" for name in ("robot", "ball", "field"))
    robot.write_text('{"preset": "vss_440rpm", "mass": 0.2}')
    ball.write_text(BallModel("vss_rsim").to_json())
    field.write_text(Field("vss_3v3", goal_width=0.5).to_json())
    config = SimConfig(path(field), robot=path(robot), ball=path(ball))
    assert config == SimConfig(Field("vss_3v3", goal_width=0.5), robot=HEAVY)
    assert SimConfig(n_blue=1, n_yellow=1, robot=[path(robot), "vss_440rpm"]).robots[0] == HEAVY
    assert RobotModel(path(robot)) == HEAVY
    assert BallModel(path(ball)) == BallModel("vss_rsim")
    assert rsoccer.make_task("VSS-v0", robot=path(robot)).config.robot == HEAVY


def test_a_text_has_numbers_that_differ(tmp_path: Path) -> None:
    assert RobotModel("vss_440rpm, mass=0.2") == RobotModel(" vss_440rpm , mass = 2e-1") == HEAVY
    path = tmp_path / "robot.json"
    path.write_text(HEAVY.to_json())
    assert RobotModel(f"{path}, height=0.07") == RobotModel("vss_440rpm", mass=0.2, height=0.07)
    assert RobotModel("vss_440rpm, mass=0.3", mass=0.2) == HEAVY, (
        "numbers replace those of the text"
    )
    assert SimConfig(robot="vss_440rpm, mass=0.2") == SimConfig(robot=HEAVY)
    task = rsoccer.make_task("VSS-v0", robot="vss_440rpm, mass=0.2")
    assert task.config.robot == HEAVY


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("mass=0.2", 'must be one of .*, got "mass=0.2"'),
        ("nothing, mass=0.2", 'must be one of .*, got "nothing"'),
        ("vss_440rpm, mas=0.2", 'has no "mas"; its numbers are'),
        ("vss_440rpm, mass=heavy", 'number=value .*, got "mass=heavy" in'),
        ("vss_440rpm, mass=0.2, heavy", 'number=value .*, got "heavy" in'),
        ("vss_440rpm, mass=0.2,", 'number=value .*, got "" in'),
        ("vss_440rpm, mass=-1", "mass must be"),
        ("vss_440rpm, mass=nan", "mass must be"),
    ],
)
def test_numbers_of_a_text_are_refused_by_name(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        RobotModel(text)
    with pytest.raises(ValueError, match=f"robot: .*{message}"):
        rsoccer.make_task("VSS-v0", robot=text)


class BytesPath:
    """A path of bytes, which names no model."""

    def __fspath__(self) -> bytes:
        return b"heavy.json"

    def __repr__(self) -> str:
        return "BytesPath()"


@pytest.mark.parametrize("value", [3, 3.5, {}, BytesPath()])
@pytest.mark.parametrize(
    ("argument", "kind"), [("field", "Field"), ("robot", "RobotModel"), ("ball", "BallModel")]
)
def test_what_is_no_model_is_refused_by_the_name_of_the_argument(
    argument: str,
    kind: str,
    value: Any,  # noqa: ANN401
) -> None:
    """Formerly the words of the binding, such as `failed to extract enum Robots`."""
    expected = f"{argument}: expected a preset's name, the path of a .json file or a {kind}, got"
    for make in (SimConfig, lambda **options: rsoccer.make_task("SSLGoToBall-v0", **options)):
        with pytest.raises(TypeError, match=f"^{re.escape(f'{expected} {value!r}')}$"):
            make(**{argument: value})


@pytest.mark.parametrize("argument", ["robot", "ball"])
def test_none_is_no_model_of_a_task(argument: str) -> None:
    names = [name for name in rsoccer.list_tasks() if argument in list_options(task_class(name))]
    assert "SSLGoToBall-v0" in names
    for name in names:
        with pytest.raises(TypeError, match=f"^{argument}: expected a preset's name, .*, got None"):
            rsoccer.make_task(name, **{argument: None})


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"ball": []}, r"ball: expected a preset's name, .* or a BallModel, got \[\]"),
        ({"field": None}, "field: expected a preset's name, .* or a Field, got None"),
        ({"robot": [3] * 6}, "robot: expected a preset's name, .* or a RobotModel, got 3"),
        ({"n_blue": 3.5}, "n_blue: expected a whole number, got 3.5"),
        ({"n_yellow": None}, "n_yellow: expected a whole number, got None"),
        ({"time_step": "short"}, "time_step: expected a number, got 'short'"),
        ({"tick": None}, "tick: expected a number, got None"),
        ({"engine": 3}, "engine: expected 'compact' or 'rapier', got 3"),
    ],
)
def test_arguments_of_another_type_are_refused_by_name(
    arguments: dict[str, Any], message: str
) -> None:
    with pytest.raises(TypeError, match=f"^{message}$"):
        SimConfig(**arguments)


def test_a_file_of_senses_needs_no_preset(tmp_path: Path) -> None:
    file = tmp_path / "late.json"
    file.write_text('{"delay": 0.1}')
    assert Sensing(str(file)) == Sensing(delay=0.1)


@pytest.mark.parametrize(
    ("kind", "text", "message"),
    [
        (Sensing, '{"delay": -1}', r"sensing\.delay must be .*, got -1"),
        (Sensing, '{"dela": 1}', r"none has no \"dela\"; its numbers are"),
        (Sensing, '{"preset": 3}', "preset: expected a preset's name, got 3"),
        (Sensing, "{}", "text is not a Sensing: missing field"),
        (RobotModel, '{"mass": 0.2}', "text is not a RobotModel: missing field"),
    ],
)
def test_a_wrong_file_is_refused_by_what_is_wrong(
    kind: Callable[[str], object], text: str, message: str, tmp_path: Path
) -> None:
    file = tmp_path / "late.json"
    file.write_text(text)
    with pytest.raises(ValueError, match=rf"late\.json: {message}"):
        kind(str(file))


@pytest.mark.parametrize("kind", [Field, BallModel, RobotModel])
def test_a_preset_that_is_no_text_is_refused_by_name(kind: Any) -> None:  # noqa: ANN401
    message = r"^name: expected a preset's name or the path of a \.json file, got 3$"
    with pytest.raises(TypeError, match=message):
        kind(3)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Sensing.preset(cast(str, 5)), "name: expected a preset's name, got 5"),
        (lambda: Sensing.from_json(cast(str, 5)), "text: expected JSON of a Sensing, got 5"),
        (lambda: RobotModel.from_json(cast(str, 5)), "text: expected JSON of a RobotModel, got 5"),
        (lambda: SimConfig.from_json(cast(str, 5)), "text: expected JSON of a SimConfig, got 5"),
        (
            lambda: MIXED.with_sensing(cast(Sensing, "rc2021")),
            "sensing: expected a Sensing or None, got 'rc2021'",
        ),
        (lambda: Simulator(MIXED, cast(int, 1.5)), "worlds: expected a whole number, got 1.5"),
    ],
)
def test_arguments_without_defaults_are_refused_by_name(
    make: Callable[[], object], message: str
) -> None:
    with pytest.raises(TypeError, match=f"^{message}"):
        make()


@pytest.mark.parametrize("kind", [Simulator, Forecaster])
def test_threads_and_snapshots_are_refused_by_name(kind: type[Simulator | Forecaster]) -> None:
    with pytest.raises(TypeError, match=r"^threads: expected a whole number or Threads, got 'x'"):
        kind(MIXED, 1, cast(int, "x"))
    with pytest.raises(TypeError, match=r"^snapshot: expected bytes, got 5"):
        kind(MIXED).restore(cast(bytes, 5))


@pytest.mark.parametrize(
    "make",
    [
        AreaShield,
        AttackShield,
        partial(Referee, rules=""),
        partial(ScriptedTeam, skill=1.0),
        Simulator,
        Forecaster,
        VisionTracker,
    ],
)
def test_a_text_is_no_configuration(make: Callable[[SimConfig], object]) -> None:
    with pytest.raises(TypeError, match=r"^config: expected a SimConfig, got 'ssl_b'"):
        make(cast(SimConfig, "ssl_b"))


@pytest.mark.parametrize("wrong", [True, np.False_], ids=["bool", "numpy"])
@pytest.mark.parametrize(
    ("kind", "name", "number"),
    [
        (Sensing, "rc2021", "delay"),
        (RobotModel, "vss_440rpm", "mass"),
        (BallModel, "vss_rsim", "mass"),
        (Field, "ssl_b", "length"),
    ],
)
def test_numbers_are_no_bools(
    kind: Callable[..., object], name: str, number: str, wrong: object
) -> None:
    with pytest.raises(TypeError, match=f"^{number}: expected a number, got .*(True|False)"):
        kind(name, **{number: wrong})
    assert getattr(kind(name, **{number: np.float32(0.5)}), number) == 0.5


@pytest.mark.parametrize(
    ("kind", "text"),
    [
        (Sensing, '{"delay": 0.1, "delay": 0.2}'),
        (Sensing, '{"preset": "rc2021", "delay": 0.1, "delay": 0.2}'),
        (Sensing, '{"sensing": {"delay": 0.1, "delay": 0.2}}'),
        (RobotModel, '{"preset": "vss_440rpm", "mass": 0.1, "mass": 0.2}'),
        (BallModel, '{"preset": "vss_rsim", "mass": 0.1, "mass": 0.2}'),
        (Field, '{"preset": "ssl_b", "length": 9, "length": 12}'),
    ],
)
def test_a_text_that_names_a_number_twice_is_refused(
    kind: type[Sensing | RobotModel | BallModel | Field], text: str
) -> None:
    name = next(part for part in ("delay", "mass", "length") if part in text)
    message = f"text is not a {kind.__name__}: duplicate field `{name}`"
    with pytest.raises(ValueError, match=message):
        kind.from_json(text)


@pytest.mark.parametrize("name", rsoccer.list_tasks())
def test_tasks_name_the_engine(name: str) -> None:
    with pytest.raises(TypeError, match=r"^engine: expected 'compact' or 'rapier', got 3$"):
        rsoccer.make_task(name, engine=3)

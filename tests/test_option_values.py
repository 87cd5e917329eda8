"""Models of robots, balls and fields as options: by name, by file, as objects, and as JSON."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import BallModel, Field, RobotModel, Sensing, SimConfig
from rsoccer.option_values import decoded, encoded
from rsoccer.policies import trained_on
from rsoccer.policies.network import Network
from rsoccer.replay import Replay
from rsoccer.replay.recorder import record_replay
from rsoccer.task import Task
from rsoccer.train import Args

HEAVY = RobotModel("vss_440rpm", mass=0.21)


@pytest.fixture
def heavy(tmp_path: Path) -> str:
    path = tmp_path / "heavy.json"
    path.write_text('{"preset": "vss_440rpm", "mass": 0.21}')
    return str(path)


def mass(task: Task) -> float:
    return task.config.robots[0].mass


def test_a_file_has_all_numbers_or_those_that_differ_from_a_preset(tmp_path: Path) -> None:
    for text in (HEAVY.to_json(), '{"preset": "vss_440rpm", "mass": 0.21}'):
        path = tmp_path / "heavy.json"
        path.write_text(text)
        assert RobotModel.from_json(text) == HEAVY
        assert rsoccer.make_task("VSS-v0", robot=str(path)).config.robot == HEAVY
        assert rsoccer.VssSelfPlay(robot=str(path)).robot == HEAVY
        assert SimConfig(robot=str(path)).robot == HEAVY


def test_fields_and_balls_may_be_files_too(tmp_path: Path) -> None:
    field, ball = tmp_path / "narrow.json", tmp_path / "smooth.json"
    field.write_text('{"preset": "ssl_b", "width": 5}')
    ball.write_text(BallModel("ssl_tigers", rolling_deceleration=0.3).to_json())
    task = rsoccer.make_task("SSLSelfPlay-v0", field=str(field), ball=str(ball))
    assert task.config.field == Field("ssl_b", width=5.0)
    assert task.config.ball.rolling_deceleration == 0.3


def test_a_file_may_hold_several_models(tmp_path: Path) -> None:
    path = tmp_path / "several.json"
    parts = {
        "robot": {"preset": "ssl_generic", "mass": 2.2},
        "ball": json.loads(BallModel("ssl_tigers", mass=0.05).to_json()),
        "sensing": {"preset": "rc2021", "delay": 0.1},
        "notes": {"mass": 3.0},
    }
    path.write_text(json.dumps(parts))
    file = str(path)
    task = rsoccer.make_task("SSLSelfPlay-v0", robot=file, ball=file)
    assert task.config.robots[0] == RobotModel("ssl_generic", mass=2.2)
    assert task.config.ball == BallModel("ssl_tigers", mass=0.05)
    sensing = Sensing("rc2021", delay=0.1)
    assert SimConfig("ssl_b", robot=file, ball=file, sensing=file).sensing == sensing
    assert Sensing.from_json(json.dumps(parts)) == sensing
    for name, kind in (("robot", "RobotModel"), ("ball", "BallModel"), ("sensing", "Sensing")):
        assert list(encoded(name, file)) == [kind]
    with pytest.raises(ValueError, match="missing field"):
        Field(file)
    path.write_text('{"robot": {"preset": "ssl_generic", "mass": -1}}')
    with pytest.raises(ValueError, match=r"robot: .*mass"):
        RobotModel(file)


def saved(path: Path, task: Task, **arguments: Any) -> Path:  # noqa: ANN401
    """The file of a policy for a task."""
    size = (task.action_size, task.layout.size)
    layers = [(np.zeros(size, np.float32), np.zeros(size[0], np.float32))]
    Network.from_layers(task, layers, **arguments).save(path)
    return path


@pytest.mark.parametrize("robot", [HEAVY, [HEAVY] * 6])
def test_settings_and_policies_record_models(robot: Any, tmp_path: Path) -> None:  # noqa: ANN401
    """Formerly "not JSON serializable"."""
    args = Args("VSSSelfPlay-v0", task_options={"robot": robot})
    restored = Args.from_json(json.loads(json.dumps(args.to_json())))
    assert restored == args
    assert mass(restored.make_task()) == 0.21
    path = tmp_path / "policy.safetensors"
    task = rsoccer.make_task("VSSSelfPlay-v0", robot=robot)
    found = trained_on(saved(path, task, task_options={"robot": robot}))
    assert found is not None
    assert mass(found) == 0.21


def test_a_policy_records_the_options_of_its_task(tmp_path: Path) -> None:
    """Formerly they had to be given twice."""
    path = tmp_path / "policy.safetensors"
    found = trained_on(saved(path, rsoccer.make_task("VSSSelfPlay-v0", robot=HEAVY, n_yellow=2)))
    assert found is not None
    assert (mass(found), found.n_yellow) == (0.21, 2)


def test_records_hold_the_content_of_a_file(heavy: str) -> None:
    args = Args("VSSSelfPlay-v0", task_options={"robot": heavy})
    task = rsoccer.make_task("VSSSelfPlay-v0", robot=heavy)
    replay = record_replay(task, {"all": "zero"}, seconds=0.1, snapshot_interval=1.0)
    Path(heavy).unlink()
    assert mass(args.make_task()) == 0.21
    assert mass(Replay.from_bytes(replay.to_bytes()).resume(0).task) == 0.21


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("lost.json", None, "robot: the file .*lost.json does not exist"),
        ("wrong.json", "{", "robot: .*wrong.json holds no model .*RobotModel: text is not a Robot"),
        ("wrong.json", "5", "robot: .*wrong.json holds no model"),
        ("field.json", '{"preset": "ssl_b"}', "robot: .*field.json holds no model .*ssl_b"),
        (
            "wrong.json",
            '{"preset": "vss_440rpm", "weight": 1}',
            "vss_440rpm has no .weight.; its numbers are",
        ),
        ("wrong.json", '{"preset": "vss_440rpm", "mass": "1"}', "mass: expected a number, got .1"),
        ("wrong.json", '{"preset": "vss_440rpm", "mass": -1}', "mass"),
        ("heavy.yaml", "", "robot: expected one of .*, or the path of a .json file, got .*yaml"),
        (".json", "folder", "robot: cannot read"),
    ],
)
def test_a_wrong_file_is_named(
    name: str, content: str | None, message: str, tmp_path: Path
) -> None:
    path = tmp_path / name
    if content == "folder":
        path.mkdir()
    elif content is not None:
        path.write_text(content)
    with pytest.raises((OSError, ValueError), match=message):
        rsoccer.make_task("VSS-v0", robot=str(path))
    if name.endswith(".json") and "ssl_b" not in str(content):
        with pytest.raises(ValueError, match=r"task_options: robot"):
            Args("VSS-v0", task_options={"robot": str(path)})
    if name.endswith(".json"):
        with pytest.raises((OSError, ValueError)):
            SimConfig(robot=str(path))


def test_other_objects_are_refused_by_name() -> None:
    with pytest.raises(
        ValueError, match=r"task_options: robot: expected a number, a text, a model"
    ):
        Args("VSS-v0", task_options={"robot": object()})
    with pytest.raises(
        TypeError, match=r"robot: expected a preset's name, the path of a .json fil"
    ):
        rsoccer.make_task("VSS-v0", robot=3)
    with pytest.raises(ValueError, match="ball_speed: expected a finite number, got nan"):
        Args("VSS-v0", task_options={"ball_speed": float("nan")})


@pytest.mark.parametrize(
    "value", [HEAVY, Field("ssl_b"), BallModel("vss_rsim"), None, True, 3, 0.5, "text"]
)
def test_values_survive_json(value: object) -> None:
    for each in (value, [value, value], {"a": value}):
        assert decoded("x", json.loads(json.dumps(encoded("x", each)))) == each


def test_a_damaged_model_is_refused_by_name() -> None:
    with pytest.raises(ValueError, match="robot: text is not a RobotModel"):
        rsoccer.make_task("VSS-v0", robot={"RobotModel": {"mass": 3}})

"""`run_benchmark`: rows of all opponents and conditions, and measurements that go on."""

import dataclasses
import hashlib
import json
from pathlib import Path

import numpy as np
import pytest

import rsoccer
from rsoccer.arrays import Floats
from rsoccer.benchmark import CONDITIONS, Entry, Row, read_entry, report, rows_of, run_benchmark
from rsoccer.policies import make_policy, names
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.policies.trained import list_trained
from rsoccer.rng import WorldRng

TASK = "SSLGoToBall-v0"


def measure(**options: object) -> Entry:
    values = {"tasks": [TASK], "matches": 20, "threads": 1, "robust": False, **options}
    return run_benchmark("fetch", **values)  # type: ignore[arg-type]


def test_a_row_is_the_evaluation_of_the_policy() -> None:
    entry = measure()
    (row,) = entry.tasks[TASK]
    played = rsoccer.evaluate("fetch", matches=20, seed=31, task=TASK, threads=1)
    assert (row.score, row.low, row.high) == (played.score, played.low, played.high)
    assert (row.wins, row.metric, row.matches) == (played.wins, "reached", 20)
    assert entry.versions["package"] == rsoccer.__version__
    assert entry.machine["cores"]
    assert "fetch: 20 matches a row, seed 31" in report(entry)


def test_conditions_are_played_and_change_what_a_policy_scores() -> None:
    entry = measure(robust=True)
    rows = {row.condition: row for row in entry.tasks[TASK]}
    assert list(rows) == list(CONDITIONS)
    assert len({row.seconds for row in rows.values()}) > 5, "conditions differ"
    assert "frames 90 ms late" in report(entry)


def test_two_sided_tasks_have_a_row_for_each_opponent() -> None:
    assert rows_of("VSS-v0", robust=False) == [
        (name, "truth") for name in ("ou", "zero", "chase", "scripted")
    ]
    robust = rows_of("SSLSelfPlay-v0", robust=True)
    assert robust[:3] == [("ou", "truth"), ("zero", "truth"), ("strike", "truth")]
    assert robust[3:] == [("ou", name) for name in CONDITIONS if name != "truth"]


def test_tasks_that_a_policy_cannot_play_are_named_with_the_reason() -> None:
    entry = measure(tasks=[TASK, "VSS-v0"])
    assert list(entry.tasks) == [TASK]
    assert "dribbler" in entry.refused["VSS-v0"]
    assert "VSS-v0 is left out" in report(entry)
    with pytest.raises(ValueError, match="expected one that plays one of the tasks"):
        measure(tasks=["VSS-v0"])


def test_a_measurement_goes_on_where_it_stopped(tmp_path: Path) -> None:
    seen: list[tuple[Entry, Row]] = []
    whole = measure(robust=True, on_row=lambda entry, task, row: seen.append((entry, row)))
    assert [row for _, row in seen] == list(whole.tasks[TASK])
    path = seen[3][0].save(tmp_path / "entry.json")
    begun = read_entry(path, partial=True)
    again: list[Row] = []
    resumed = measure(robust=True, begun=begun, on_row=lambda entry, task, row: again.append(row))
    assert [row.condition for row in again] == [row.condition for _, row in seen[4:]]
    scores = [(row.score, row.low, row.seconds) for row in whole.tasks[TASK]]
    assert [(row.score, row.low, row.seconds) for row in resumed.tasks[TASK]] == scores


def test_what_refused_a_task_is_tried_again() -> None:
    whole = measure()
    begun = dataclasses.replace(whole, tasks={}).without(TASK, "OSError: a disk was full")
    resumed = measure(begun=begun)
    assert not resumed.refused
    assert [row.score for row in resumed.tasks[TASK]] == [row.score for row in whole.tasks[TASK]]


def test_an_entry_of_another_machine_does_not_go_on() -> None:
    begun = dataclasses.replace(measure(), machine={"processor": "another one"})
    with pytest.raises(ValueError, match="begun: expected an entry whose machine is"):
        measure(begun=begun)


def test_an_entry_of_another_protocol_or_policy_does_not_go_on() -> None:
    begun = measure()
    with pytest.raises(ValueError, match="begun: expected an entry whose matches is 22, got 20"):
        measure(matches=22, begun=begun)
    with pytest.raises(ValueError, match="whose policy is 'hold', got 'fetch'"):
        run_benchmark("hold", [TASK], matches=20, robust=False, begun=begun)


def test_a_name_stays_unless_another_one_is_given() -> None:
    begun = measure(name="Mine")
    assert measure(begun=begun).name == "Mine"
    assert measure(begun=begun, name="Other").name == "Other"
    assert measure().name == "fetch"


def test_code_that_has_changed_does_not_go_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    source = tmp_path / "code_to_measure.py"
    source.write_text(
        "from rsoccer.policies import make_policy\n"
        "def player(task):\n    return make_policy('fetch', task)\n"
    )
    begun = run_benchmark("code_to_measure:player", [TASK], matches=20, threads=1, robust=False)
    assert begun.digest == hashlib.sha256(source.read_bytes()).hexdigest()
    with source.open("a") as file:
        file.write("# Another policy.\n")
    with pytest.raises(ValueError, match="begun: expected an entry whose digest is"):
        run_benchmark("code_to_measure:player", [TASK], matches=20, robust=False, begun=begun)


def test_a_file_is_named_by_its_content(tmp_path: Path) -> None:
    best = list_trained()[TASK]
    copy = tmp_path / "policy.safetensors"
    copy.write_bytes(best.read_bytes())
    entry = run_benchmark(copy, [TASK], matches=20, threads=1, robust=False)
    assert len(entry.digest) == 64
    assert json.loads(entry.to_json())["digest"] == entry.digest
    assert measure().digest == ""
    named = run_benchmark(make_policy("fetch", TASK), [TASK], matches=20, threads=1, robust=False)
    assert (named.policy, named.digest) == ("Fetch", "")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"tasks": ["VSSMatch-v0"]}, "tasks: expected some of .*VSSMatch-v0"),
        ({"tasks": TASK}, "tasks: expected some of"),
        ({"matches": 10}, "matches: expected .* 20"),
        ({"link": "my page"}, "link: expected an address .*, got 'my page'"),
        ({"matches": 21}, "matches: expected an even number, got 21"),
    ],
)
def test_other_options_are_refused(options: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        measure(**options)


class Kicker(Policy):
    """A script for robots with kickers, which does not say so."""

    observes = "nothing"

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        actions = np.zeros(inputs.action_shape, np.float32)
        actions[..., 3] = 1.0
        return actions


def test_tasks_whose_robots_a_script_cannot_drive_are_left_out_with_the_reason() -> None:
    entry = run_benchmark(Kicker(), ["VSS-v0", TASK], matches=20, threads=1, robust=False)
    assert list(entry.tasks) == [TASK]
    assert "IndexError: index 3 is out of bounds" in entry.refused["VSS-v0"]
    with pytest.raises(ValueError, match="expected one that plays one of the tasks"):
        run_benchmark(Kicker(), ["VSS-v0"], matches=20, threads=1, robust=False)


def test_conditions_are_added_to_an_entry_without_them_and_not_taken_away() -> None:
    plain, robust = measure(), measure(robust=True)
    more = measure(robust=True, begun=plain)
    assert more.robust
    kept = [dataclasses.replace(row, wall_clock=0.0) for row in more.tasks[TASK]]
    assert kept == [dataclasses.replace(row, wall_clock=0.0) for row in robust.tasks[TASK]]
    with pytest.raises(ValueError, match="robust is False, got one with them"):
        measure(begun=robust)


def test_a_registered_policy_is_named_by_the_file_with_its_code(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setitem(names._MAKERS, "kicker_to_measure", lambda task: Kicker())
    entry = run_benchmark("kicker_to_measure", [TASK], matches=20, threads=1, robust=False)
    assert entry.digest == hashlib.sha256(Path(__file__).read_bytes()).hexdigest()

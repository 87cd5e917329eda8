import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rsoccer.policies.network import Network

EXAMPLES = Path(__file__).parent.parent / "examples"
QUICK = {
    "01_hello.py": [],
    "02_new_task.py": ["2000"],
    "03_many_worlds.py": ["32", "200"],
    "05_gymnasium.py": [],
    "06_gymnasium_vector.py": [],
    "07_mixed_side.py": [],
    "08_arrays.py": [],
    "09_old_simulator.py": [],
    "11_turns.py": [],
    "12_entities.py": [],
    "15_network_simulator.py": [],
    "13_ppo.py": ["--task", "VSSMulti-v0", "--samples", "1", "--central"],
}


def run(name: str, arguments: list[str], folder: Path) -> str:
    """Run an example in an empty folder with warnings as errors and return its output."""
    command = [sys.executable, "-W", "error", str(EXAMPLES / name), *arguments]
    ran = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


@pytest.mark.parametrize("name", QUICK)
def test_examples_run_and_print(name: str, tmp_path: Path) -> None:
    assert run(name, QUICK[name], tmp_path).strip()


def test_the_policy_of_13_ppo_normalizes_observations(tmp_path: Path) -> None:
    run("13_ppo.py", ["--samples", "1"], tmp_path)
    policy = Network.load(tmp_path / "ppo.safetensors")
    assert np.abs(policy.mean).max() > 0.1
    assert np.ptp(policy.std) > 0.1


def test_every_example_is_tested() -> None:
    # 04 trains for a minute, and tests/train covers its parts. 10 and 14 need the dependencies
    # of tests/wrappers.
    tested_elsewhere = {"04_self_play.py", "10_stable_baselines3.py", "14_ray_league.py"}
    assert {path.name for path in EXAMPLES.glob("*.py")} == {*QUICK, *tested_elsewhere}

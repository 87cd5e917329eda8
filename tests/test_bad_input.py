"""Every task refuses invalid input by name, without a change of state.

Exact messages and rarer input are in the tests of each interface.
"""

import contextlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches, policies
from rsoccer.envs.parallel import SoccerParallelEnv, parallel_env
from rsoccer.envs.single import single_env
from rsoccer.envs.vector import vector_env
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import FORMAT
from rsoccer.registry import list_options
from tests.helpers import comparable
from tests.parallel_matches import TASKS, random_actions
from tests.single_learner import learner_options

CONFIGS = {name: rsoccer.make_task(name).config for name in TASKS}

every_task = pytest.mark.parametrize("name", TASKS)


def with_option(*options: str) -> list[tuple[str, str]]:
    """Tasks that have one of these options, with the option."""
    known = {name: list_options(type(rsoccer.make_task(name))) for name in TASKS}
    return [(name, option) for name in TASKS for option in options if option in known[name]]


def constructors(name: str) -> list[Callable[..., object]]:
    """Functions that create a task by name with options, one per interface."""
    return [
        lambda **options: rsoccer.make_task(name, **options),
        lambda **options: parallel_env(name, **options),
        lambda **options: rsoccer.env(name, **options),
        lambda **options: single_env(name, **learner_options(name), **options),
        lambda **options: vector_env(name, 2, **learner_options(name), **options),
    ]


# -- Options ----------------------------------------------------------------------------------


@every_task
def test_an_unknown_option_is_named_with_the_valid_ones(name: str) -> None:
    for make in constructors(name):
        with pytest.raises(TypeError, match=rf"{name}: got .* argument .umpire.; .*.max_steps."):
            make(umpire=True)


@pytest.mark.parametrize(("name", "option"), with_option("scenario"))
def test_an_unknown_scenario_is_named(name: str, option: str) -> None:
    for make in constructors(name):
        for wrong in (0, 99, "hard"):
            with pytest.raises((TypeError, ValueError), match="scenario: expected"):
                make(**{option: wrong})


@pytest.mark.parametrize(("name", "option"), with_option("n_blue", "n_yellow", "n_opponents"))
def test_too_many_robots_are_refused(name: str, option: str) -> None:
    team = "yellow" if option == "n_opponents" else option.removeprefix("n_")
    for make in constructors(name):
        with pytest.raises(ValueError, match=rf"({option}|n_{team})\D+at most \d+"):
            make(**{option: 99})


@every_task
def test_a_policy_of_the_wrong_task_is_refused(name: str) -> None:
    wrong = "chase" if name.startswith("SSL") else "strike"
    for make in (parallel_env, Matches):
        with pytest.raises(ValueError, match=f"{wrong}.*{name}|{name}.*{wrong}"):
            make(name, controllers={"blue_0": wrong})


def network_of(name: str) -> Network:
    """Network with the sizes of a task, as after training."""
    task = rsoccer.make_task(name)
    sizes = {"observation_size": task.layout.size, "action_size": task.action_size}
    arrays = {
        "layers.0.weight": np.zeros((task.action_size, task.layout.size), np.float32),
        "layers.0.bias": np.zeros(task.action_size, np.float32),
        "mean": np.zeros(task.layout.size, np.float32),
        "std": np.ones(task.layout.size, np.float32),
    }
    metadata = {"format": FORMAT, "task": name, "activation": "tanh", "clip": "10"}
    return Network(arrays, metadata | {size: str(number) for size, number in sizes.items()})


@every_task
def test_a_network_of_a_task_of_other_sizes_is_refused(name: str) -> None:
    assert Matches(name, controllers={"blue_0": network_of(name)}).assignment.groups
    other = "VSS-v0" if name.startswith("SSL") else "SSLGoToBall-v0"
    for make in (parallel_env, Matches):
        with pytest.raises(ValueError, match=rf"trained on '{other}' has .* but task '{name}'"):
            make(name, controllers={"blue_0": network_of(other)})


# -- Actions ----------------------------------------------------------------------------------


def wrong_actions(match: SoccerParallelEnv) -> dict[str, Any]:
    """Invalid actions of a match by the kind of mistake."""
    size = match.task.action_size
    valid: dict[str, Any] = {agent: np.zeros(size, np.float32) for agent in match.agents}
    last = match.agents[-1]
    others = {agent: action for agent, action in valid.items() if agent != last}
    return {
        "missing": others,
        "unknown": {**valid, "red_0": valid[last]},
        "too long": {**valid, last: np.zeros(size + 1, np.float32)},
        "extra axis": {**valid, last: np.zeros((1, size), np.float32)},
        "integers": {**valid, last: np.zeros(size, int)},
        "NaN": {**valid, last: np.full(size, np.nan, np.float32)},
        "infinite": {**valid, last: np.full(size, np.inf, np.float32)},
        "None": None,
    }


@every_task
def test_wrong_actions_change_nothing(name: str) -> None:
    match, twin = parallel_env(name), parallel_env(name)
    match.reset(seed=0)
    twin.reset(seed=0)
    for actions in wrong_actions(match).values():
        with pytest.raises((TypeError, ValueError), match="actions"):
            match.step(actions)
    given, expected = (
        each.step(random_actions(each, np.random.default_rng(0))) for each in (match, twin)
    )
    assert comparable(given) == comparable(expected)


@every_task
@pytest.mark.parametrize("discrete", [False, True])
def test_wrong_actions_of_one_learner_change_nothing(name: str, discrete: bool) -> None:
    task = rsoccer.make_task(name, discrete=discrete)
    wrong: list[Any] = [np.full(task.action_size, np.nan), np.zeros(task.action_size + 1), None]
    if task.action_table is not None:
        wrong += [len(task.action_table), -1, 0.5]
    made: list[list[Any]] = [
        [single_env(task, **learner_options(name)) for _ in range(2)],
        [vector_env(task, 2, **learner_options(name)) for _ in range(2)],
    ]
    for envs, twin in made:
        envs.reset(seed=0)
        twin.reset(seed=0)
        for action in wrong:
            given = action if not hasattr(envs, "num_envs") else np.array([action] * 2)
            with pytest.raises((TypeError, ValueError), match="actions"):
                envs.step(given)
        valid = envs.action_space.sample()
        assert comparable(envs.step(valid)) == comparable(twin.step(valid))


@every_task
def test_a_step_before_reset_or_after_the_end_is_refused(name: str) -> None:
    match = parallel_env(name, max_cycles=1)
    env = single_env(name, max_steps=1, **learner_options(name))
    envs = vector_env(name, 2, max_steps=1, autoreset_mode="disabled", **learner_options(name))
    still = np.zeros(match.task.action_size, np.float32)
    steps: list[tuple[Any, Callable[[], object]]] = [
        (match, lambda: match.step(dict.fromkeys(match.possible_agents, still))),
        (env, lambda: env.step(still)),
        (envs, lambda: envs.step(np.stack([still] * 2))),
    ]
    for made, step in steps:
        with pytest.raises(RuntimeError, match="step before reset"):
            step()
        made.reset(seed=0)
        step()
        rows = made._matches.frame.rows.copy()
        with pytest.raises(RuntimeError, match="step after the end of the episode"):
            step()
        assert np.array_equal(made._matches.frame.rows, rows)
        made.reset()
        step()


# -- Resets -----------------------------------------------------------------------------------


@every_task
def test_a_wrong_reset_changes_nothing(name: str) -> None:
    size = rsoccer.make_task(name).config.row_size
    wrong: list[dict[str, Any]] = [
        {"options": {"frame": np.zeros(size - 1, np.float32)}},
        {"options": {"frame": np.full(size, np.nan, np.float32)}},
        {"options": {"frame": np.zeros(size, np.float32)}},  # headings are not unit vectors
        {"options": {"frame": "center"}},
        {"options": {"frames": np.zeros(size, np.float32)}},  # formerly ignored
        {"options": {"Frame": None}},
        {"options": [1]},
        {"seed": -1},
        {"seed": "one"},
    ]
    wrong_masks: list[Any] = [[True, False], np.ones(3, np.bool_), np.zeros(2, np.bool_)]
    pairs: list[list[Any]] = [
        [parallel_env(name) for _ in range(2)],
        [single_env(name, **learner_options(name)) for _ in range(2)],
        [vector_env(name, 2, **learner_options(name)) for _ in range(2)],
    ]
    for made, twin in pairs:
        for each in (made, twin):
            each.reset(seed=3)
        masks = wrong_masks if hasattr(made, "num_envs") else []
        for arguments in [*wrong, *({"options": {"reset_mask": mask}} for mask in masks)]:
            with pytest.raises((TypeError, ValueError), match=r"options|seed|unit vector"):
                made.reset(**{"seed": 4, **arguments})
        assert np.array_equal(made._matches.frame.rows, twin._matches.frame.rows)
        assert comparable(made.reset()) == comparable(twin.reset()), (
            "its random streams have gone on"
        )


def task_policies() -> list[tuple[str, str]]:
    """Policies that are bound to a field and teams, each with a task they can play."""
    found: dict[str, str] = {}
    for name in TASKS:
        task = rsoccer.make_task(name)
        for policy in policies.list_policies():
            with contextlib.suppress(ValueError):
                if policies.make_policy(policy, task)._built_for is not None:
                    found.setdefault(policy, name)
    return sorted(found.items())


def test_some_policies_are_bound_to_a_task() -> None:
    assert {"chase", "scripted", "fetch"} <= dict(task_policies()).keys()


@pytest.mark.parametrize(("policy", "name"), task_policies())
def test_a_policy_made_for_another_field_is_refused(policy: str, name: str) -> None:
    made = policies.make_policy(policy, rsoccer.make_task(name))
    others = [other for other in TASKS if rsoccer.make_task(other).config != CONFIGS[name]]
    assert others
    for other in others:
        with pytest.raises(ValueError, match=f"for the field, robots and teams of {other}"):
            Matches(other, controllers={"all": made})


@pytest.mark.parametrize("name", TASKS)
def test_a_network_with_another_observation_layout_is_refused(name: str) -> None:
    task = rsoccer.make_task(name)
    zeros = np.zeros(task.layout.size, np.float32)
    arrays = {
        "layers.0.weight": np.zeros((task.action_size, task.layout.size), np.float32),
        "layers.0.bias": np.zeros(task.action_size, np.float32),
        **{"mean": zeros, "std": zeros + 1},
    }
    metadata = {
        **{"format": FORMAT, "task": name, "activation": "tanh"},
        **{"observation_size": str(task.layout.size), "action_size": str(task.action_size)},
        "layout": task.layout.text,
    }
    network = Network(arrays, metadata)
    assert policies.make_policy(network, task) is network
    others = [
        make for make in map(rsoccer.make_task, TASKS) if make.layout.text != task.layout.text
    ]
    assert others
    for other in others:
        with pytest.raises(ValueError, match=f"a network trained on '{name}'"):
            policies.make_policy(network, other)


def test_equal_sizes_do_not_make_equal_layouts() -> None:
    sizes = {make.layout.size: make.layout.text for make in map(rsoccer.make_task, TASKS)}
    layouts = {make.layout.text for make in map(rsoccer.make_task, TASKS)}
    assert len(sizes) < len(layouts), "sizes alone do not distinguish the tasks"


@every_task
def test_an_unknown_engine_is_refused(name: str) -> None:
    for make in constructors(name):
        for wrong in ("box2d", 3):
            with pytest.raises((TypeError, ValueError), match="engine"):
                make(engine=wrong)

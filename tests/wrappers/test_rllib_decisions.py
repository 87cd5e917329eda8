"""Decisions of RLlib's runner: held actions, the shield, policies that play teams, the league."""

import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rsoccer.matches import Matches
from rsoccer.task import LEARN
from rsoccer.train import Args

pytest.importorskip("torch")
pytest.importorskip("ray.rllib")

from ray.rllib.algorithms.ppo import PPOConfig
from ray.rllib.core.rl_module.default_model_config import DefaultModelConfig

from rsoccer.rllib import League, MatchesEnvRunner, SoccerMultiAgentEnv
from rsoccer.rllib.decisions import FixedTeams

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")

EXAMPLE = Path(__file__).parents[2] / "examples" / "14_ray_league.py"
TASK, WORLDS, LIMIT, SEED = "VSSSelfPlay-v0", 3, 7, 5
BLUE = ("blue_0", "blue_1", "blue_2")


def against_script(agent_id: str, episode: Any, **kwargs: Any) -> str:  # noqa: ANN401
    return "main" if agent_id.startswith("blue") else "fixed_0"


def against_script_alone(agent_id: str, episode: Any, **kwargs: Any) -> str:  # noqa: ANN401
    return "fixed_0" if agent_id == "yellow_0" else "main"


def runner_of(mapping: Any = against_script, **env_config: Any) -> Any:  # noqa: ANN401
    config = (
        PPOConfig()
        .environment(
            SoccerMultiAgentEnv, env_config={"task": TASK, "max_steps": LIMIT, **env_config}
        )
        .env_runners(
            env_runner_cls=MatchesEnvRunner,
            num_env_runners=0,
            num_envs_per_env_runner=WORLDS,
            rollout_fragment_length=LIMIT,
        )
        .multi_agent(policies={"main"}, policy_mapping_fn=mapping)
        .rl_module(model_config=DefaultModelConfig(fcnet_hiddens=[16]))
        .debugging(seed=SEED)
    )
    return MatchesEnvRunner(config=config)


def by_world(episodes: list[Any], first: np.ndarray[Any, Any]) -> list[Any]:
    """The first episode of each match, found by blue_0's first observation."""
    found = {
        tuple(episode.agent_episodes["blue_0"].observations.data[0].tolist()): episode
        for episode in episodes
    }
    return [found[tuple(row.tolist())] for row in first[:, 0]]


@pytest.mark.parametrize("repeat", [1, 3])
def test_a_script_plays_as_in_matches_and_actions_are_held(repeat: int) -> None:
    runner = runner_of(fixed={"fixed_0": "chase"}, action_repeat=repeat)
    episodes = runner.sample(num_episodes=WORLDS)
    decisions = -(-LIMIT // repeat)
    twin = Matches(
        TASK, WORLDS, SEED, max_steps=LIMIT, controllers={"yellow": "chase"}, autoreset="disabled"
    )
    chosen = by_world(episodes, twin.reset())
    for episode in chosen:
        assert set(episode.agent_episodes) == set(BLUE)
        assert (len(episode), episode.is_truncated) == (decisions, True)
    for decision in range(decisions):
        actions = np.array(
            [[e.agent_episodes[name].actions.data[decision] for name in BLUE] for e in chosen]
        )
        rewards = np.zeros((WORLDS, len(BLUE)), np.float32)
        for _ in range(min(repeat, LIMIT - decision * repeat)):
            outcome = twin.step(actions)
            rewards += outcome.rewards
        for world, episode in enumerate(chosen):
            for robot, name in enumerate(BLUE):
                part = episode.agent_episodes[name]
                assert part.rewards.data[decision] == pytest.approx(rewards[world, robot])
                seen = part.observations.data[decision + 1]
                assert np.array_equal(seen, outcome.final_observations[world, robot])
    assert runner.get_metrics()["task_metrics"]["steps"].peek() == LIMIT


def test_the_script_of_a_match_follows_the_mapping() -> None:
    league = League(1, 0.4, 1, 0.2, {"zero": 1.0, "scripted": 1.0})
    assert league.shares == pytest.approx([0.4, 0.2, 0.2, 0.2])
    counts = drawn(league)
    assert counts == pytest.approx(
        {"main": 0.4, "past_0": 0.2, "fixed_0": 0.2, "fixed_1": 0.2}, abs=0.04
    )


def drawn(league: League, **custom_data: Any) -> dict[str, float]:  # noqa: ANN401
    """Shares of yellow's opponents in many matches."""
    episodes = [
        type("Episode", (), {"id_": f"{i:x}", "custom_data": custom_data}) for i in range(2000)
    ]
    names = [league.choose("yellow_0", episode) for episode in episodes]
    return {name: names.count(name) / len(names) for name in set(names)}


def test_past_selves_are_drawn_by_their_win_rates() -> None:
    league = League(3, 0.2, 1, 0.6, {"zero": 1.0})
    assert drawn(league, win_rates=[]) == pytest.approx({"main": 0.8, "fixed_0": 0.2}, abs=0.04)
    shares = drawn(league, win_rates=[1.0, 0.5])
    assert shares == pytest.approx(
        {"main": 0.2, "past_0": 0.06, "past_1": 0.54, "fixed_0": 0.2}, abs=0.04
    )


def test_results_against_frozen_opponents_are_reported() -> None:
    runner = runner_of(fixed={"fixed_0": "chase"})
    scores = []
    log = runner._log_result

    def logged(running: Any, info: Any) -> None:  # noqa: ANN401
        scores.append(info["goal_score"])
        log(running, {**info, "goal_score": (2.0, 0.0, -1.0)[len(scores) % 3]})

    runner._log_result = logged
    runner.sample(num_episodes=WORLDS)
    against = runner.get_metrics()["results_against"]["fixed_0"]
    assert {name: stat.peek() for name, stat in against.items()} == {"matches": 3.0, "points": 1.5}
    assert scores == [0.0] * WORLDS
    runner = runner_of(lambda *_, **__: "main")
    runner.sample(num_episodes=WORLDS)
    assert "results_against" not in runner.get_metrics()


def test_equal_seeds_give_equal_matches_of_scripts() -> None:
    seen = []
    for _ in range(2):
        runner = runner_of(fixed={"fixed_0": "ou"}, task="VSSMatch-v0", shield="vsss")
        runner.sample(num_timesteps=0, random_actions=True)
        for _ in range(LIMIT):
            actions = np.zeros((WORLDS, 6, 2), np.float32)
            outcome = runner._play(runner._observations, actions)
        seen.append(outcome.final_observations)
    assert np.array_equal(*seen)


def test_what_cannot_be_played_is_refused() -> None:
    runner = runner_of(against_script_alone, fixed={"fixed_0": "chase"})
    with pytest.raises(ValueError, match="expected one module in yellow"):
        runner.sample(num_timesteps=1)
    with pytest.raises(ValueError, match="fixed: expected a task in which all robots learn"):
        runner_of(fixed={"fixed_0": "chase"}, task="VSS-v0")
    with pytest.raises(ValueError, match="action_repeat"):
        runner_of(action_repeat=0)
    with pytest.raises(ValueError, match="shield: expected one of"):
        runner_of(shield="unknown")
    with pytest.raises(ValueError, match="league: expected latest_fraction"):
        League(fixed={"chase": 1.0})


def test_the_league_has_the_shares_of_the_trainer() -> None:
    league = League.of(Args.for_task("VSSSelfPlay-v0").opponents)
    assert list(league.fixed_modules.values()) == ["chase", "ou", "scripted", "zero"]
    fixed = [0.8 * share / 7.0 for share in (2.0, 1.0, 3.0, 1.0)]
    assert league.shares == pytest.approx([0.1, *[0.1 / 8] * 8, *fixed])
    assert list(League.of(Args.for_task("VSSMatch-v0").opponents).fixed) == ["ou"]
    assert sum(League(size=4).shares) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("task", "options", "shield"),
    [
        ("VSSMatch-v0", ["half_seconds=1"], "vsss"),
        ("SSLMatch-v0", ["n_blue=2", "n_yellow=2", "division=A"], None),
    ],
)
def test_the_example_plays_matches_under_a_referee(
    task: str, options: list[str], shield: str | None
) -> None:
    example = runpy.run_path(str(EXAMPLE))
    words = ["--task", task, "--runners", "0", "--matches", "2", "--horizon", "8"]
    args = example["parsed"]([*words, "--task-options", *options])
    config = example["configure"](args)
    assert config.env_config["shield"] == shield
    runner = MatchesEnvRunner(config=config)
    episodes = runner.sample()
    assert sum(map(len, episodes)) == 2 * 8
    played = runner.matches.task
    for name, value in (option.split("=") for option in options):
        assert str(getattr(played, name)) == value


def test_policies_play_teams_of_which_the_task_lets_others_learn() -> None:
    """In `VSS-v0` one robot learns by default, and noise drives the others."""
    matches = Matches("VSS-v0", 2, SEED, controllers={"all": LEARN}, autoreset="disabled")
    observations = matches.reset()
    fixed = FixedTeams(matches, {"fixed_0": "chase"}, SEED)
    modules = {robot: "fixed_0" if "yellow" in robot else "main" for robot in matches.agents}
    for world in range(2):
        fixed.begin(world, modules)
    actions = np.zeros((2, 6, 2), np.float32)
    fixed.act(observations, actions)
    assert not actions[:, :3].any()
    twin = Matches("VSS-v0", 2, SEED, controllers={"blue": LEARN, "yellow": "chase"})
    twin.reset()
    twin.step(np.zeros((2, 3, 2), np.float32))
    np.testing.assert_array_equal(actions[:, 3:], twin.play.actions[:, 3:])

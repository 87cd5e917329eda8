"""`rsoccer.rllib`: its environment, its runner against RLlib's own, and PPO with a league."""

import os
import runpy
import signal
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rsoccer.matches import Matches
from tests.ray_start import patiently
from tests.simulators import Still

torch = pytest.importorskip("torch")
ray = pytest.importorskip("ray")
pytest.importorskip("ray.rllib")

from ray.rllib.algorithms.ppo import PPOConfig  # noqa: E402
from ray.rllib.callbacks.callbacks import RLlibCallback  # noqa: E402
from ray.rllib.core.rl_module.default_model_config import DefaultModelConfig  # noqa: E402
from ray.rllib.env.multi_agent_env_runner import MultiAgentEnvRunner  # noqa: E402

from rsoccer.rllib import (  # noqa: E402
    League,
    MatchesEnvRunner,
    MetricsCallback,
    SoccerMultiAgentEnv,
)

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")

EXAMPLES = Path(__file__).parents[2] / "examples"
TASK = "VSSSelfPlay-v0"
WORLDS, LIMIT, FRAGMENT = 4, 7, 10
LEAGUE = League(size=2, every=2)


def shared(agent_id: str, episode: Any, **kwargs: Any) -> str:  # noqa: ANN401
    return "shared"


def by_team(agent_id: str, episode: Any, **kwargs: Any) -> str:  # noqa: ANN401
    return agent_id.split("_", maxsplit=1)[0]


def config_of(
    modules: set[str] | None = None,
    mapping: Callable[..., str] = shared,
    runner: type = MatchesEnvRunner,
    runners: int = 0,
    **env_config: Any,  # noqa: ANN401
) -> Any:  # noqa: ANN401
    """PPO on short matches, with small networks."""
    env_config = {"task": TASK, "max_steps": LIMIT, **env_config}
    return (
        PPOConfig()
        .environment(SoccerMultiAgentEnv, env_config=env_config)
        .env_runners(
            env_runner_cls=runner,
            num_env_runners=runners,
            num_envs_per_env_runner=WORLDS,
            rollout_fragment_length=FRAGMENT,
        )
        .multi_agent(policies=modules or {"shared"}, policy_mapping_fn=mapping)
        .rl_module(model_config=DefaultModelConfig(fcnet_hiddens=[16]))
        .training(
            train_batch_size_per_learner=WORLDS * FRAGMENT * max(runners, 1),
            minibatch_size=32,
            num_epochs=1,
        )
        .debugging(seed=3)
    )


@pytest.mark.parametrize("source", [Still, "tests.simulators:still"])
def test_the_simulator_and_the_senses_are_those_that_are_named(source: Any) -> None:  # noqa: ANN401
    given = {"simulator": source, "sensing": "tests.simulators:Blind", "learner": "blue_1"}
    runner = MatchesEnvRunner(config=config_of(**given))
    runner.sample(num_timesteps=WORLDS, random_actions=True)
    single = SoccerMultiAgentEnv({"task": TASK, **given})
    single.reset()
    for matches in (runner.matches, single.matches):
        assert matches.agents == ("blue_1",)
        assert isinstance(matches._simulator, Still)
        assert matches.play.frame.ball.position.any()
        assert not matches.play.sensed.ball.position.any()


def runner_of(**options: Any) -> Any:  # noqa: ANN401
    config = config_of(**options)
    return config.env_runner_cls(config=config)


@pytest.fixture(scope="module")
def cluster() -> Iterator[None]:
    """Ray with two processors and little memory."""
    size = {"num_cpus": 2, "object_store_memory": 200e6}
    patiently(lambda: ray.init(**size, include_dashboard=False, log_to_driver=False), ray.shutdown)
    yield
    ray.shutdown()


def test_the_environment_reports_common_ends_and_metrics() -> None:
    env = SoccerMultiAgentEnv({"task": TASK, "max_steps": 2})
    twin = Matches(TASK, max_steps=2)
    observations, infos = env.reset(seed=5)
    assert np.array_equal(np.stack(list(observations.values())), twin.reset(seed=5)[0])
    assert infos == {}
    actions = {agent: env.action_spaces[agent].sample() for agent in env.agents}
    for truncated in (False, True):
        observations, rewards, terminateds, truncateds, infos = env.step(actions)
        outcome = twin.step(np.stack(list(actions.values()))[None])
        assert np.array_equal(np.stack(list(observations.values())), outcome.final_observations[0])
        assert list(rewards.values()) == outcome.rewards[0].tolist()
        assert (terminateds, truncateds) == ({"__all__": False}, {"__all__": truncated})
    assert infos["yellow_2"] == {"goal_score": 0.0, "free_balls": 0.0, "steps": 2.0}


def test_the_runner_samples_stacked_observations() -> None:
    runner = runner_of(history=2)
    size = runner.matches.observation_size
    o = runner.matches.task.layout.size
    assert size == 2 * o + 2
    episodes = runner.sample(num_timesteps=WORLDS * LIMIT, random_actions=True)
    played = [part for episode in episodes for part in episode.agent_episodes.values()]
    assert played
    for part in played:
        observations, actions = part.get_observations(), part.get_actions()
        assert np.array_equal(observations[1:, o : 2 * o], observations[:-1, :o])
        np.testing.assert_allclose(observations[1:, 2 * o :], np.clip(actions, -1, 1), atol=1e-6)


def test_the_environment_names_what_it_refuses() -> None:
    with pytest.raises(ValueError, match="env_config: expected a 'task'"):
        SoccerMultiAgentEnv({})
    with pytest.raises(TypeError, match=r"env_config: expected values by name, .* got 'VSS-v0'"):
        SoccerMultiAgentEnv("VSS-v0")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="unexpected keyword argument 'unknown'"):
        SoccerMultiAgentEnv({"task": TASK, "unknown": 1})


def test_a_shield_needs_continuous_actions() -> None:
    with pytest.raises(ValueError, match="shield: expected a task with continuous actions"):
        runner_of(task="VSS-v0", discrete=True, shield="vsss")


def test_rllibs_own_runner_reports_metrics_by_the_callback() -> None:
    config = config_of(runner=MultiAgentEnvRunner).callbacks(MetricsCallback)
    runner = MultiAgentEnvRunner(config=config)
    episodes = runner.sample(num_timesteps=WORLDS * LIMIT + WORLDS)
    assert any(episode.is_truncated and not episode.is_terminated for episode in episodes)
    assert runner.get_metrics()["task_metrics"]["steps"].peek() == LIMIT


def part_of(chain: list[Any], step: int) -> tuple[list[Any], int]:
    """The parts of an episode from the one with a step on, and the step's index in it."""
    while step - chain[0].env_t_started >= len(chain[0]):
        chain = chain[1:]
    return chain, step - chain[0].env_t_started


def replayed(episodes: list[Any], seed: int) -> int:
    """Play the actions of consecutive samples on `Matches`, compare all else; return the ends."""
    matches = Matches(TASK, WORLDS, seed, max_steps=LIMIT)
    first = matches.reset()
    parts: dict[str, list[Any]] = {}
    for episode in episodes:
        parts.setdefault(episode.id_, []).append(episode)
    by_start = {
        tuple(chain[0].agent_episodes["blue_0"].observations.data[0].tolist()): chain
        for chain in parts.values()
    }
    current = [by_start[tuple(row.tolist())] for row in first[:, 0]]
    position, ends = [0] * WORLDS, 0
    steps = sum(len(episode) for episode in episodes) // WORLDS
    for _ in range(steps):
        actions = np.zeros((WORLDS, len(matches.agents), matches.action_size), np.float32)
        for world in range(WORLDS):
            current[world], index = part_of(current[world], position[world])
            part = current[world][0]
            for agent, name in enumerate(matches.agents):
                actions[world, agent] = part.agent_episodes[name].actions.data[index]
        outcome = matches.step(actions)
        for world in range(WORLDS):
            part = current[world][0]
            index = position[world] - part.env_t_started
            for agent, name in enumerate(matches.agents):
                robot = part.agent_episodes[name]
                assert robot.rewards.data[index] == outcome.rewards[world, agent]
                last = outcome.final_observations[world, agent]
                assert np.array_equal(robot.observations.data[index + 1], last)
            position[world] += 1
            is_last = index + 1 == len(part)
            assert (part.is_done and is_last) == outcome.ended[world]
            if outcome.ended[world]:
                ends += 1
                assert part.is_terminated == outcome.terminated[world]
                position[world] = 0
                start = tuple(outcome.observations[world, 0].tolist())
                current[world] = by_start.get(start, [])
    return ends


@pytest.mark.parametrize(
    ("modules", "mapping"), [({"shared"}, shared), ({"blue", "yellow"}, by_team)]
)
def test_its_episodes_are_the_matches_that_were_played(
    modules: set[str], mapping: Callable[..., str]
) -> None:
    runner = runner_of(modules=modules, mapping=mapping)
    episodes = [episode for _ in range(3) for episode in runner.sample()]
    assert sum(map(len, episodes)) == 3 * WORLDS * FRAGMENT
    assert replayed(episodes, 3) == WORLDS * (3 * FRAGMENT // LIMIT)
    for episode in episodes:
        episode.validate()
        assert {r.module_id for r in episode.agent_episodes.values()} == modules


def test_its_episodes_have_the_form_of_rllibs_own() -> None:
    ours, theirs = (runner_of(runner=cls) for cls in (MatchesEnvRunner, MultiAgentEnvRunner))
    lengths = [[(len(e), e.env_t_started, e.is_done) for e in r.sample()] for r in (ours, theirs)]
    assert lengths[0] == lengths[1]
    mine, other = ours.sample()[0], theirs.sample()[0]
    assert mine.is_numpy and other.is_numpy
    assert (mine.env_t_started, mine.env_t) == (other.env_t_started, other.env_t)
    assert mine.agent_t_started == other.agent_t_started
    for name, robot in other.agent_episodes.items():
        same = mine.agent_episodes[name]
        assert (same.t_started, same.t, same.module_id) == (robot.t_started, robot.t, "shared")
        for part in ("observations", "actions", "rewards", "infos"):
            assert len(getattr(same, part)) == len(getattr(robot, part))
        columns = {"action_dist_inputs", "action_logp"}
        assert set(same.extra_model_outputs) == columns == set(robot.extra_model_outputs) & columns
        assert same.get_observations().shape == robot.get_observations().shape
        assert same.get_actions().dtype == robot.get_actions().dtype
    ours_names, theirs_names = (set(r.get_metrics()) for r in (ours, theirs))
    about_connectors = {name for name in theirs_names if "module" in name or "timer" in name}
    assert theirs_names - ours_names <= about_connectors


def test_the_log_probabilities_are_those_of_the_actions() -> None:
    runner = runner_of()
    robot = runner.sample()[0].agent_episodes["yellow_1"]
    outputs = {name: torch.from_numpy(b.data) for name, b in robot.extra_model_outputs.items()}
    module = runner.module["shared"]
    given = module.forward_exploration({"obs": torch.from_numpy(robot.observations.data[:-1])})
    assert torch.allclose(given["action_dist_inputs"], outputs["action_dist_inputs"], atol=1e-5)
    distribution = module.get_exploration_action_dist_cls().from_logits(given["action_dist_inputs"])
    expected = distribution.logp(torch.from_numpy(robot.actions.data))
    assert torch.allclose(expected, outputs["action_logp"], atol=1e-4)


def test_whole_episodes_and_greedy_or_random_actions_can_be_sampled() -> None:
    runner = runner_of()
    for options in ({"explore": False}, {"random_actions": True}, {}):
        episodes = runner.sample(num_episodes=5, **options)
        assert len(episodes) >= 5
        assert {(len(e), e.is_terminated, e.is_truncated) for e in episodes} == {
            (LIMIT, False, True)
        }
    greedy = runner.sample(num_episodes=1, explore=False)[0].agent_episodes["blue_0"]
    means = greedy.extra_model_outputs["action_dist_inputs"].data[:, :2]
    assert np.array_equal(greedy.actions.data, means)


def test_a_discrete_task_is_played() -> None:
    runner = runner_of(task="VSS-v0", discrete=True)
    robot = runner.sample()[0].agent_episodes["blue_0"]
    assert robot.actions.data.dtype == np.int64
    assert robot.actions.data.max() < runner.matches.action_space.n
    assert runner.sample(random_actions=True)


def test_frozen_modules_play_and_are_not_returned() -> None:
    runner = runner_of(modules={"blue", "yellow"}, mapping=by_team, frozen=["yellow"])
    for episode in runner.sample():
        assert set(episode.agent_episodes) == {"blue_0", "blue_1", "blue_2"}
    counts = runner.get_metrics()["num_module_steps_sampled"]
    assert {name: stat.peek() for name, stat in counts.items()} == {
        "blue": 3 * WORLDS * FRAGMENT,
        "yellow": 3 * WORLDS * FRAGMENT,
    }


def test_the_policy_mapping_is_asked_at_each_start() -> None:
    runner = runner_of(modules=LEAGUE.modules, mapping=LEAGUE.choose)
    runner.set_state({"win_rates": [0.5, 0.5]})
    opponents = set()
    for _ in range(8):
        for episode in runner.sample():
            modules = {n: r.module_id for n, r in episode.agent_episodes.items()}
            assert {modules[f"blue_{i}"] for i in range(3)} == {"main"}
            yellow = {modules[f"yellow_{i}"] for i in range(3)}
            assert len(yellow) == 1
            opponents |= yellow
    assert opponents == {"main", "past_0", "past_1"}


class Lengths(RLlibCallback):  # type: ignore[misc]
    """Records the lengths of episodes, with their earlier parts."""

    seen: list[int] = []  # noqa: RUF012  (shared by intention)

    def on_episode_end(self, **given: Any) -> None:  # noqa: ANN401
        parts = [given["episode"], *given["prev_episode_chunks"]]
        self.seen.append(sum(map(len, parts)))


def test_callbacks_at_ends_are_called_and_others_refused() -> None:
    config = config_of().callbacks(Lengths)
    runner = MatchesEnvRunner(config=config)
    for _ in range(3):
        runner.sample()
    assert Lengths.seen == [LIMIT] * WORLDS * (3 * FRAGMENT // LIMIT)

    class Steps(RLlibCallback):  # type: ignore[misc]
        def on_episode_step(self, **kwargs: Any) -> None:  # noqa: ANN401
            pass

    with pytest.raises(ValueError, match="does not call on_episode_step"):
        MatchesEnvRunner(config=config_of().callbacks(Steps))


def test_connectors_and_recurrent_modules_are_refused() -> None:
    config = config_of().env_runners(env_to_module_connector=lambda *_, **__: [])
    with pytest.raises(ValueError, match="env_to_module_connector"):
        MatchesEnvRunner(config=config)
    config = config_of().rl_module(model_config=DefaultModelConfig(use_lstm=True))
    with pytest.raises(ValueError, match="recurrent"):
        MatchesEnvRunner(config=config)


def weights(runner: Any) -> dict[str, float]:  # noqa: ANN401
    """A digest of the weights of each module."""
    return {
        name: float(
            sum((np.asarray(part, float) ** 2).sum() for part in module.get_state().values())
        )
        for name, module in runner.module.items()
    }


def test_ppo_trains_one_policy_for_all(cluster: None) -> None:
    algorithm = config_of().build_algo()
    before = weights(algorithm.env_runner)
    results = [algorithm.train() for _ in range(2)]
    assert weights(algorithm.env_runner) != before
    algorithm.stop()
    runners = [result["env_runners"] for result in results]
    assert [r["num_env_steps_sampled_lifetime"] for r in runners] == [40, 80]
    assert runners[1]["episode_len_mean"] == LIMIT
    assert "goal_score" in runners[1]["task_metrics"]
    # RLlib fills up the last minibatch.
    assert results[1]["learners"]["shared"]["num_module_steps_trained"] >= 6 * WORLDS * FRAGMENT


def test_a_league_freezes_past_selves_and_is_restored(cluster: None, tmp_path: Path) -> None:
    config = config_of(LEAGUE.modules, LEAGUE.choose, frozen=LEAGUE.past)
    config.multi_agent(policies_to_train=["main"]).callbacks(on_train_result=LEAGUE.freeze)
    algorithm = config.build_algo()
    random = weights(algorithm.env_runner)
    mains = {}
    for iteration in range(1, 6):
        result = algorithm.train()
        assert set(result["learners"]) - {"__all_modules__"} <= LEAGUE.modules
        mains[iteration] = weights(algorithm.env_runner)["main"]
        if iteration == 3:
            assert weights(algorithm.env_runner)["past_1"] == random["past_1"]
    kept = weights(algorithm.env_runner)
    assert kept == {"main": mains[5], "past_0": mains[2], "past_1": mains[4]}
    assert len({*mains.values()}) == 5
    assert len(algorithm.env_runner.win_rates) == 2
    algorithm.env_runner.win_rates = [0.25, 0.75]
    path = algorithm.save_to_path(str(tmp_path))
    algorithm.stop()
    restored = type(algorithm).from_checkpoint(path)
    assert weights(restored.env_runner) == kept
    assert restored.env_runner.win_rates == [0.25, 0.75]
    result = restored.train()
    assert result["training_iteration"] == 6
    assert result["env_runners"]["num_env_steps_sampled_lifetime"] == 6 * WORLDS * FRAGMENT
    slot = LEAGUE.slots(6).index(6)
    after = weights(restored.env_runner)
    assert after[f"past_{slot}"] == after["main"] != mains[5]
    assert restored.env_runner.win_rates[slot] == 0.5
    restored.stop()


def test_a_league_records_results() -> None:
    league = League(size=2, every=2)
    local = SimpleNamespace(win_rates=[0.5])
    group = SimpleNamespace(sent=[])

    def foreach_env_runner(function: Callable[[Any], Any], **given: Any) -> None:  # noqa: ANN401
        group.sent.append(given)
        function(SimpleNamespace(set_state=lambda state: local.__dict__.update(state)))

    group.foreach_env_runner = foreach_env_runner
    algorithm = SimpleNamespace(iteration=3, env_runner=local, env_runner_group=group)
    counts = {"matches": 4.0, "points": 3.5}
    league.freeze(algorithm, {"env_runners": {"results_against": {"past_0": counts}}})
    assert local.win_rates == [pytest.approx(0.5 + (1.0 - 0.95**4) * (3.5 / 4.0 - 0.5))]
    local.win_rates = [0.25]
    counts = dict.fromkeys(counts, float("nan"))  # RLlib's sum of nothing
    league.freeze(algorithm, {"env_runners": {"results_against": {"past_0": counts}}})
    assert local.win_rates == [0.25]
    local.win_rates = []
    league.freeze(algorithm, {"env_runners": {}})
    assert local.win_rates == [0.5]  # of a checkpoint without win rates
    assert group.sent == [{"timeout_seconds": 0.0}] * 3


def test_the_example_continues_from_its_newest_checkpoint(
    cluster: None,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    options = "--runners 0 --matches 2 --horizon 8 --league 1 --freeze-every 1 --save-every 1"
    for iterations in (2, 4):
        words = ["example", *options.split(), "--iterations", str(iterations)]
        monkeypatch.setattr(sys, "argv", [*words, "--folder", str(tmp_path)])
        runpy.run_path(str(EXAMPLES / "14_ray_league.py"), run_name="__main__")
        assert (tmp_path / "policy.safetensors").exists()
        names = sorted(path.name for path in tmp_path.glob("iteration_*"))
        assert names[-1] == f"iteration_{iterations:06}"
        assert len(names) == min(iterations, 3)
    lines = [line for line in capsys.readouterr().out.splitlines() if "iteration " in line]
    assert [line.split(":")[0] for line in lines] == [f"iteration {i}" for i in (1, 2, 3, 4)]
    assert "64 steps of matches" in lines[-1]


def test_a_run_survives_the_death_of_a_runner(cluster: None) -> None:
    config = config_of(LEAGUE.modules, LEAGUE.choose, runners=1, frozen=LEAGUE.past)
    config.multi_agent(policies_to_train=["main"]).callbacks(on_train_result=LEAGUE.freeze)
    config.env_runners(sample_timeout_s=5).fault_tolerance(restart_failed_env_runners=True)
    algorithm = config.build_algo()
    group = algorithm.env_runner_group

    def played(function: Callable[[Any], Any]) -> Any:  # noqa: ANN401
        return group.foreach_env_runner(function, local_env_runner=False)[0]

    def learned() -> dict[str, float]:
        found = algorithm.learner_group.foreach_learner(
            lambda learner: {
                name: sum((np.asarray(p, float) ** 2).sum() for p in state.values())
                for name in learner.module.keys()  # noqa: SIM118  (no mapping)
                for state in [learner.module[name].get_state(inference_only=True)]
            }
        )
        weights: dict[str, float] = found.result_or_errors[0].get()
        return weights

    for _ in range(2):
        algorithm.train()
    before, process = learned(), played(lambda _: os.getpid())
    assert played(weights) == before
    os.kill(process, signal.SIGKILL)
    algorithm.train()  # without samples
    assert learned() == before
    sampled, patience = 0, time.monotonic() + 300.0
    # A call without a runner may return at once; the new process needs long on a busy machine.
    while sampled < 4 * WORLDS * FRAGMENT and time.monotonic() < patience:
        result = algorithm.train()
        sampled = result["env_runners"]["num_env_steps_sampled_lifetime"]
        time.sleep(0.5)
    assert sampled >= 4 * WORLDS * FRAGMENT
    assert played(lambda _: os.getpid()) != process
    assert played(weights) == learned() != before
    win_rates = algorithm.env_runner.win_rates
    assert len(win_rates) > 0
    assert played(lambda runner: runner.win_rates) == win_rates
    algorithm.stop()


def test_win_rates_reach_all_runners_and_are_restored(cluster: None, tmp_path: Path) -> None:
    league = League(size=1, latest_fraction=0.0, every=1)
    config = config_of(league.modules, league.choose, runners=1, frozen=league.past)
    config.multi_agent(policies_to_train=["main"]).callbacks(on_train_result=league.freeze)
    algorithm = config.build_algo()
    results = [algorithm.train()["env_runners"].get("results_against") for _ in range(3)]
    # Matches begin in steps 0, 7, 14 and 21 of 30. The first past self plays from step 10 on.
    assert results[:2] == [None, None]
    assert results[2] == {"past_0": {"matches": 2 * WORLDS, "points": WORLDS}}
    algorithm.env_runner.win_rates = [0.25]
    path = algorithm.save_to_path(str(tmp_path))
    algorithm.stop()
    restored = type(algorithm).from_checkpoint(path)
    league.restore(restored)
    known = restored.env_runner_group.foreach_env_runner(lambda runner: runner.win_rates)
    assert known == [[0.25], [0.25]]
    restored.stop()

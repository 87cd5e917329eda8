"""Stable-Baselines3: its checker, training on one match, and `SoccerVecEnv`."""

import copy
import importlib
import pickle
import runpy
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cloudpickle  # type: ignore[import-untyped]
import gymnasium
import numpy as np
import pytest

import rsoccer
from rsoccer.replay import Recorder
from tests.simulators import Still
from tests.single_learner import TASKS

stable_baselines3 = pytest.importorskip("stable_baselines3")
env_checker = pytest.importorskip("stable_baselines3.common.env_checker")

gymnasium.register_envs(rsoccer)

MAX_STEPS = 20
EXAMPLE = Path(__file__).parents[2] / "examples" / "10_stable_baselines3.py"


def short_match(**options: Any) -> gymnasium.Env[Any, Any]:  # noqa: ANN401
    """A short match by id."""
    return gymnasium.make("rsoccer/VSS-v0", max_steps=MAX_STEPS, **options)


@pytest.mark.parametrize("options", [{}, {"discrete": True}, {"render_mode": "rgb_array"}])
def test_its_checker_accepts_the_env(options: dict[str, Any]) -> None:
    if "render_mode" in options:
        pytest.importorskip("pygame")
    env_checker.check_env(short_match(**options))


def learned(seed: int) -> Any:  # noqa: ANN401  (types only where it is installed)
    """PPO after some episodes."""
    model = stable_baselines3.PPO(
        "MlpPolicy", short_match(), n_steps=64, batch_size=32, n_epochs=1, seed=seed, device="cpu"
    )
    return model.learn(128)


def test_ppo_trains_the_same_from_the_same_seed() -> None:
    model, again, other = learned(0), learned(0), learned(1)
    episodes = [episode["l"] for episode in model.ep_info_buffer]
    assert sum(episodes) > 128 - MAX_STEPS
    assert max(episodes) == MAX_STEPS
    observation = np.zeros(model.observation_space.shape, np.float32)
    actions = [each.predict(observation, deterministic=True)[0] for each in (model, again, other)]
    np.testing.assert_array_equal(actions[0], actions[1])
    assert (actions[0] != actions[2]).any()


def test_the_time_limit_truncates_for_bootstrapped_values() -> None:
    model = stable_baselines3.PPO("MlpPolicy", short_match(), n_steps=8, batch_size=8, device="cpu")
    envs = model.get_env()
    envs.reset()
    ended = [envs.step(np.zeros((1, 2), np.float32))[2:] for _ in range(MAX_STEPS)][-1]
    assert ended[0].tolist() == [True]
    assert ended[1][0]["TimeLimit.truncated"]
    assert ended[1][0]["steps"] == MAX_STEPS
    assert ended[1][0]["terminal_observation"].shape == envs.observation_space.shape


# -- Many matches ------------------------------------------------------------------------------


def many(name: str = "VSS-v0", worlds: int = 3, **options: Any) -> Any:  # noqa: ANN401
    """Short matches."""
    sb3 = importlib.import_module("rsoccer.sb3")
    return sb3.SoccerVecEnv(name, worlds, **{"max_steps": MAX_STEPS, **options})


def drawn(envs: Any, rng: np.random.Generator) -> Any:  # noqa: ANN401
    return rng.uniform(-1.0, 1.0, (envs.num_envs, *envs.action_space.shape)).astype(np.float32)


def updated(model: Any, steps: int) -> None:  # noqa: ANN401
    """Learn for some steps, and assert that the weights changed and are finite."""
    before = [weight.detach().clone() for weight in model.policy.parameters()]
    model.learn(steps)
    after = list(model.policy.parameters())
    assert model.num_timesteps == steps
    assert all(bool(weight.isfinite().all()) for weight in after)
    assert any(bool((a != b).any()) for a, b in zip(before, after, strict=True))


@pytest.mark.parametrize("discrete", [False, True])
@pytest.mark.parametrize("name", TASKS)
def test_ppo_makes_a_first_update_on_every_task(name: str, discrete: bool) -> None:
    envs = many(name, discrete=discrete)
    assert envs.num_envs == 3 * len(rsoccer.make_task(name).agents)
    model = stable_baselines3.PPO(
        "MlpPolicy", envs, n_steps=24, batch_size=36, n_epochs=1, seed=0, device="cpu"
    )
    updated(model, 24 * envs.num_envs)
    assert len(model.ep_info_buffer) >= envs.num_envs
    assert rsoccer.make_task(name).success in model.ep_info_buffer[0]
    envs.close()


def test_the_seed_of_an_algorithm_seeds_the_matches() -> None:
    found = []
    for seed in (3, 3, 4):
        model = stable_baselines3.PPO(
            "MlpPolicy", many(), n_steps=24, batch_size=36, n_epochs=1, seed=seed, device="cpu"
        )
        model.learn(72)
        found.append(np.concatenate([part.detach().ravel() for part in model.policy.parameters()]))
    np.testing.assert_array_equal(found[0], found[1])
    assert (found[0] != found[2]).any()


@pytest.mark.parametrize("algorithm", ["SAC", "TD3", "DQN", "A2C"])
def test_other_algorithms_make_updates(algorithm: str) -> None:
    envs = many("VSSMulti-v0", 2, discrete=algorithm == "DQN")
    settings: dict[str, Any] = {} if algorithm == "A2C" else {"learning_starts": 12}
    learner = getattr(stable_baselines3, algorithm)
    updated(learner("MlpPolicy", envs, seed=0, device="cpu", **settings), 240)


@pytest.mark.parametrize("name", ["VSS-v0", "VSSSelfPlay-v0"])
def test_rows_equal_single_environments(name: str) -> None:
    """Of one learner, bit for bit those of Stable-Baselines3's own vector environment."""
    agents = rsoccer.make_task(name).agents
    ours = many(name)
    robots = rsoccer.robots_vector_env(
        name, worlds=3, max_steps=MAX_STEPS, autoreset_mode="same_step"
    )
    ours.seed(5)
    np.testing.assert_array_equal(ours.reset(), robots.reset(seed=5)[0])
    assert ours.robots == agents
    rng = np.random.default_rng(0)
    returns = np.zeros(ours.num_envs)
    for _ in range(MAX_STEPS):
        actions = drawn(ours, rng)
        observations, rewards, ended, infos = ours.step(actions)
        expected = robots.step(actions)
        np.testing.assert_array_equal(observations, expected[0])
        np.testing.assert_array_equal(rewards, expected[1])
        np.testing.assert_array_equal(ended, expected[2] | expected[3])
        returns += rewards
        rewards[:] = 1e9  # PPO adds values to the rewards in place
    assert ended.all()
    last = expected[4]
    for row, info in enumerate(infos):
        np.testing.assert_array_equal(info["terminal_observation"], last["final_obs"][row])
        assert info["TimeLimit.truncated"] is True
        for key in ("goal_score", "steps"):
            assert info[key] == last["final_info"][key][row]
        assert info["episode"]["r"] == pytest.approx(returns[row], abs=1e-5)
        assert info["episode"]["l"] == MAX_STEPS
        assert info["episode"]["goal_score"] == info["goal_score"]
    assert len(
        np.unique(np.stack([info["terminal_observation"] for info in infos]), axis=0)
    ) == len(infos)


def test_matches_equal_the_librarys_own_vector_environment() -> None:
    make_vec_env = pytest.importorskip("stable_baselines3.common.env_util").make_vec_env
    theirs = make_vec_env("rsoccer/VSS-v0", 3, seed=5, env_kwargs={"max_steps": MAX_STEPS})
    ours = many()
    ours.seed(5)
    np.testing.assert_array_equal(ours.reset(), theirs.reset())
    rng = np.random.default_rng(0)
    for _ in range(MAX_STEPS):
        actions = drawn(ours, rng)
        given, expected = ours.step(actions), theirs.step(actions)
        np.testing.assert_array_equal(given[1], expected[1])
        assert given[2].tolist() == expected[2].tolist()
    for info, reference in zip(given[3], expected[3], strict=True):
        np.testing.assert_array_equal(
            info["terminal_observation"], reference["terminal_observation"]
        )
        for name in ("TimeLimit.truncated", "goal_score", "steps"):
            assert info[name] == reference[name]
        for name in ("r", "l"):
            assert info["episode"][name] == pytest.approx(reference["episode"][name], abs=1e-5)


def test_an_end_by_the_task_is_not_bootstrapped() -> None:
    envs = many("SSLPassEndurance-v1", 4, max_steps=300)
    envs.reset()
    rng = np.random.default_rng(0)
    found: list[Any] = []
    while len(found) < 4:
        *_, ended, infos = envs.step(drawn(envs, rng))
        found += [infos[row] for row in np.flatnonzero(ended)]
    assert all(info["TimeLimit.truncated"] is False for info in found)


def test_seeds_are_those_of_matches_and_hold_for_one_reset() -> None:
    envs = many("VSSMulti-v0", 2)
    assert envs.seed(7) == [7, 7, 7, 8, 8, 8]
    first = envs.reset()
    again = envs.reset()
    assert (first != again).any()
    envs.seed(7)
    np.testing.assert_array_equal(envs.reset(), first)
    matches = rsoccer.Matches("VSSMulti-v0", 2)
    np.testing.assert_array_equal(first.reshape(2, 3, -1), matches.reset(seed=7))
    assert len(envs.seed()) == 6
    with pytest.raises(TypeError, match="seed: expected a whole number"):
        envs.seed(1.5)


def test_unseeded_environments_and_copies_play_different_matches() -> None:
    envs = many()
    every = [envs, many(), copy.deepcopy(envs), cloudpickle.loads(cloudpickle.dumps(envs))]
    assert len({each.reset().tobytes() for each in every}) == 4
    twin = pickle.loads(pickle.dumps(envs))
    np.testing.assert_array_equal(envs.reset(), twin.reset())


@pytest.mark.parametrize("source", [Still, "tests.simulators:still"])
def test_the_simulator_and_the_senses_are_those_that_are_named(source: Any) -> None:  # noqa: ANN401
    envs = many(simulator=source, sensing="tests.simulators:Blind")
    envs.seed(3)
    envs.reset()
    play = envs._matches.play
    assert isinstance(envs._matches._simulator, Still)
    assert play.frame.ball.position.any() and not play.sensed.ball.position.any()
    twin = pickle.loads(pickle.dumps(envs))
    assert twin._matches._simulator is not envs._matches._simulator
    np.testing.assert_array_equal(envs.reset(), twin.reset())


def test_options_set_the_start_of_the_next_reset() -> None:
    matches = rsoccer.Matches("VSSMulti-v0", 3)
    matches.reset(seed=1)
    row = matches.frame.rows[0].copy()
    envs = many("VSSMulti-v0", 3)
    envs.set_options({"frame": row})
    given = envs.reset()
    for match in range(3):
        np.testing.assert_array_equal(given[3 * match : 3 * match + 3], given[:3])
    assert (envs.reset() != given).any(), "options hold once"
    envs.set_options([{"frame": row} if match == 1 else {} for match in (0, 1, 2) for _ in "abc"])
    envs.seed(4)
    mixed = envs.reset()
    np.testing.assert_array_equal(mixed[3:6], given[:3])
    envs.seed(4)
    np.testing.assert_array_equal(mixed[[0, 6]], envs.reset()[[0, 6]])


def test_refused_options_reset_no_match() -> None:
    """Formerly matches without a frame of their own were reset before it was refused."""
    envs = many("VSSMulti-v0", 3)
    envs.seed(4)
    envs.reset()
    row = envs._matches.frame.rows[0].copy()
    wrong, before = row + 99.0, envs._matches.state_dict()
    for options, message in (
        ([{"frame": row}], "^options: expected .* each of 9 rows, got 1"),
        (
            [{"frame": wrong} if match == 1 else {} for match in (0, 1, 2) for _ in "abc"],
            "^world 1: `absent` of blue_0 must be 0 or 1, got 99",
        ),
    ):
        envs.set_options(options)
        with pytest.raises(ValueError, match=message):
            envs.reset()
        after = envs._matches.state_dict()
        for name, array in before.items():
            np.testing.assert_array_equal(after[name], array)


def test_attributes_and_methods_are_by_row() -> None:
    envs = many("VSSMulti-v0", 2)
    envs.reset()
    assert envs.get_attr("render_mode") == [None] * 6
    assert envs.get_attr("task", [0, 3])[1].name == "VSSMulti-v0"
    assert not envs.has_attr("action_masks")
    assert envs.env_is_wrapped(gymnasium.Wrapper, 0) == [False]
    states = envs.env_method("state", indices=[0, 3])
    np.testing.assert_array_equal(states[1], envs.states()[5])
    assert (states[0] != states[1]).any()
    with pytest.raises(AttributeError, match="rows have no method 'reset'; they have"):
        envs.env_method("reset")
    with pytest.raises(TypeError, match="state: expected no arguments"):
        envs.env_method("state", 1)
    with pytest.raises(AttributeError, match="task: attributes of matches cannot be set, except"):
        envs.set_attr("task", None)


def test_options_change_while_matches_run() -> None:
    envs = many("VSSMulti-v0", 2)
    envs.reset()
    zeros = np.zeros((6, 2), np.float32)
    envs.set_attr("max_steps", 2)
    assert [envs.step(zeros)[2].all() for _ in range(4)] == [False, True, False, True]
    envs.set_attr("controllers", {"yellow": "zero"})
    envs.step(zeros)
    assert not envs.matches.play.actions[:, 3:].any()
    row = envs.frame.rows[0].copy()
    envs.matches.start_from(row)
    envs.step(zeros)
    np.testing.assert_array_equal(envs.frame.rows, [row, row])
    with pytest.raises(ValueError, match=r"expected all 6 rows, .* got \[0, 1\]"):
        envs.set_attr("max_steps", 3, indices=[0, 1])
    with pytest.raises(ValueError, match="expected ones that leave sizes"):
        envs.set_attr("n_yellow", 2)


def test_a_recorder_runs_beside_a_training(tmp_path: Path) -> None:
    envs = many("VSS-v0", 2)
    recorder = Recorder(envs.matches, 1, attach=True)
    model = stable_baselines3.PPO("MlpPolicy", envs, n_steps=50, batch_size=50, device="cpu")
    model.learn(100)
    lengths = [each.stop - each.start for each in recorder.replay().episodes]
    assert len(lengths) > 1
    assert max(lengths) <= MAX_STEPS + 1
    assert recorder.replay().save_html(tmp_path / "match.html").exists()


def test_a_notebook_shows_the_first_match() -> None:
    pytest.importorskip("pygame")
    shown = many()
    assert shown._repr_png_() is None
    shown.reset()
    assert shown._repr_png_().startswith(b"\x89PNG")


def test_images_are_of_matches() -> None:
    pytest.importorskip("pygame")
    envs = many("VSSMulti-v0", 2, render_mode="rgb_array")
    envs.reset()
    images = envs.get_images()
    assert len(images) == 2
    tiled = envs.render()
    assert tiled.shape[0] * tiled.shape[1] == 2 * images[0].shape[0] * images[0].shape[1]
    np.testing.assert_array_equal(envs.env_method("render", indices=4)[0], images[1])
    assert many().get_images() == [None] * 3


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (lambda: many(worlds=0), ValueError, "worlds: expected at least 1, got 0"),
        (lambda: many(learner="red_0"), ValueError, "learner: expected one of"),
        (lambda: many(bal_speed=1.0), TypeError, "unexpected keyword argument 'bal_speed'"),
        (lambda: many(render_mode="ansi"), ValueError, "render_mode: expected one of"),
        (lambda: many(controllers={"all": "ou"}), ValueError, "at least one learner"),
    ],
)
def test_bad_arguments_are_named(
    make: Callable[[], object], error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        make()


def test_bad_steps_are_refused() -> None:
    envs = many()
    with pytest.raises(RuntimeError, match="step before reset"):
        envs.step(np.zeros((3, 2), np.float32))
    envs.reset()
    with pytest.raises(RuntimeError, match="step_wait before step_async"):
        envs.step_wait()
    with pytest.raises(ValueError, match=r"actions: expected shape \(3, 2\), got \(2, 2\)"):
        envs.step(np.zeros((2, 2), np.float32))
    envs.close()
    with pytest.raises(gymnasium.error.ClosedEnvironmentError):
        envs.reset()


def test_one_robot_may_learn_among_others() -> None:
    envs = many("VSSSelfPlay-v0", 2, learner="yellow_1")
    assert (envs.robots, envs.num_envs) == (("yellow_1",), 2)


def test_a_model_is_saved_with_normalized_observations(tmp_path: Path) -> None:
    vec_env = importlib.import_module("stable_baselines3.common.vec_env")
    envs = vec_env.VecNormalize(vec_env.VecMonitor(many(), info_keywords=("goal_score",)))
    model = stable_baselines3.PPO(
        "MlpPolicy", envs, n_steps=32, batch_size=48, n_epochs=1, seed=0, device="cpu"
    )
    updated(model, 96)
    assert {"r", "l", "t", "goal_score"} <= set(model.ep_info_buffer[0])
    model.save(tmp_path / "model")
    envs.save(str(tmp_path / "statistics"))
    loaded_envs = vec_env.VecNormalize.load(str(tmp_path / "statistics"), many())
    loaded = stable_baselines3.PPO.load(tmp_path / "model", env=loaded_envs, device="cpu")
    observations = loaded_envs.reset()
    np.testing.assert_array_equal(
        model.predict(observations, deterministic=True)[0],
        loaded.predict(observations, deterministic=True)[0],
    )
    loaded.learn(96)


def normalized(ours: bool, **settings: Any) -> Any:  # noqa: ANN401
    """Monitored matches in the class of this package, or in the library's."""
    vec_env = importlib.import_module("stable_baselines3.common.vec_env")
    sb3 = importlib.import_module("rsoccer.sb3")
    wrapper = sb3.SoccerVecNormalize if ours else vec_env.VecNormalize
    return wrapper(vec_env.VecMonitor(many("VSSMulti-v0", 4)), **settings)


def expect_close(pair: list[Any], *, rtol: float, atol: float = 0.0) -> None:
    """Expect two arrays to be equal within tolerances."""
    ours, theirs = pair
    np.testing.assert_allclose(ours, theirs, rtol=rtol, atol=atol)


@pytest.mark.parametrize(
    "settings",
    [
        {},
        {"training": False},
        {"norm_reward": False, "gamma": 0.5},
        {"norm_obs": False},
        {"clip_obs": 0.5, "clip_reward": 0.1},
    ],
)
def test_normalized_rollouts_equal_those_of_the_library(settings: dict[str, Any]) -> None:
    pair = [normalized(ours, **settings) for ours in (True, False)]
    for envs in pair:
        envs.seed(3)
    first = [envs.reset() for envs in pair]
    expect_close(first, rtol=1e-5, atol=1e-5)
    rng = np.random.default_rng(0)
    ended = 0
    for _ in range(3 * MAX_STEPS):
        actions = drawn(pair[0], rng)
        (ours, theirs) = ((*envs.step(actions),) for envs in pair)
        assert [part.dtype for part in ours[:3]] == [part.dtype for part in theirs[:3]]
        # A column that never varied is divided by 1e-4, and rounding of its mean with it.
        np.testing.assert_allclose(ours[0], theirs[0], rtol=1e-4, atol=2e-3)
        np.testing.assert_allclose(ours[1], theirs[1], rtol=1e-5, atol=1e-6)
        np.testing.assert_array_equal(ours[2], theirs[2])
        for info, reference in zip(ours[3], theirs[3], strict=True):
            assert info.keys() == reference.keys()
            if info:
                ended += 1
                assert info["terminal_observation"].dtype == np.float32
                np.testing.assert_allclose(
                    info["terminal_observation"],
                    reference["terminal_observation"],
                    rtol=1e-4,
                    atol=2e-3,
                )
                assert info["episode"]["r"] == pytest.approx(reference["episode"]["r"], abs=1e-6)
        originals = [envs.get_original_obs() for envs in pair]
        np.testing.assert_array_equal(*originals)
        np.testing.assert_array_equal(*[envs.get_original_reward() for envs in pair])
        expect_close([envs.returns for envs in pair], rtol=1e-12)
        if settings.get("norm_obs", True):
            again = [envs.normalize_obs(originals[0]) for envs in pair]
            np.testing.assert_allclose(again[0], ours[0])
            moments = [envs.obs_rms for envs in pair]
            expect_close([each.mean for each in moments], rtol=1e-5, atol=1e-6)
            expect_close([each.var for each in moments], rtol=1e-5, atol=1e-6)
            assert moments[0].count == moments[1].count
        moments = [envs.ret_rms for envs in pair]
        expect_close([each.mean for each in moments], rtol=1e-9)
        expect_close([each.var for each in moments], rtol=1e-9)
        assert moments[0].count == moments[1].count
        ours[0][:] = ours[1][:] = 1e9  # results belong to the caller
    assert ended == 3 * pair[0].num_envs


def test_normalized_matches_train_are_saved_and_are_continued(tmp_path: Path) -> None:
    vec_env = importlib.import_module("stable_baselines3.common.vec_env")
    envs = normalized(True)
    model = stable_baselines3.PPO(
        "MlpPolicy", envs, n_steps=32, batch_size=48, n_epochs=1, seed=0, device="cpu"
    )
    updated(model, 32 * envs.num_envs)
    assert model.get_vec_normalize_env() is envs
    envs.save(str(tmp_path / "statistics"))
    loaded = vec_env.VecNormalize.load(str(tmp_path / "statistics"), many("VSSMulti-v0", 4))
    assert type(loaded) is type(envs)
    observations = envs.get_original_obs()
    np.testing.assert_array_equal(
        loaded.normalize_obs(observations), envs.normalize_obs(observations)
    )
    loaded.reset()
    loaded.step(drawn(loaded, np.random.default_rng(0)))
    assert loaded.obs_rms.count == envs.obs_rms.count + 2 * envs.num_envs


def test_observations_that_are_no_vectors_are_not_normalized() -> None:
    sb3 = importlib.import_module("rsoccer.sb3")
    vec_env = importlib.import_module("stable_baselines3.common.vec_env")
    envs = many()
    envs.observation_space = gymnasium.spaces.Box(-1.0, 1.0, (2, 2))
    with pytest.raises(ValueError, match=r"expected Box \(o,\) float32, got Box"):
        sb3.SoccerVecNormalize(vec_env.VecMonitor(envs))


def test_policies_are_evaluated_by_the_library() -> None:
    evaluation = importlib.import_module("stable_baselines3.common.evaluation")
    vec_env = importlib.import_module("stable_baselines3.common.vec_env")
    model = stable_baselines3.PPO("MlpPolicy", many(), n_steps=8, batch_size=8, device="cpu")
    envs = vec_env.VecMonitor(many("VSS-v0", 2))
    returns, lengths = evaluation.evaluate_policy(
        model, envs, n_eval_episodes=4, return_episode_rewards=True
    )
    assert lengths == [MAX_STEPS] * 4
    assert np.isfinite(returns).all()


def test_the_example_runs(capsys: pytest.CaptureFixture[str]) -> None:
    runpy.run_path(str(EXAMPLE))["main"](2, 256)
    assert "256 steps; goal score" in capsys.readouterr().out

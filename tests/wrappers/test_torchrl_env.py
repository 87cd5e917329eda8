"""`rsoccer.torchrl.SoccerEnv` against `Matches`, and in TorchRL's collector and PPO loss."""

import warnings
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer.global_state import StateEncoder
from rsoccer.matches import Matches
from tests.parallel_matches import TASKS
from tests.simulators import Still

torch = pytest.importorskip("torch")
pytest.importorskip("torchrl")

from torchrl.envs import RewardSum, TransformedEnv  # noqa: E402
from torchrl.envs.utils import MarlGroupMapType, check_env_specs  # noqa: E402

from rsoccer.torchrl import SoccerEnv  # noqa: E402

WORLDS = 3
STEPS = 40
TASK = "VSSSelfPlay-v0"


def actions_of(env: SoccerEnv, rng: np.random.Generator) -> Any:  # noqa: ANN401
    """Random actions (n, agents, action)."""
    shape = (WORLDS, len(env.matches.agents), env.matches.action_size)
    return rng.uniform(-1.0, 1.0, shape).astype(np.float32)


@pytest.mark.parametrize("name", TASKS)
def test_every_task_passes_the_checks_of_the_library(name: str) -> None:
    env = SoccerEnv(name, WORLDS, state=True, max_steps=4)
    check_env_specs(env, seed=1)
    learners = [name for names in env.group_map.values() for name in names]
    assert learners == list(rsoccer.make_task(name).agents)


def test_a_discrete_task_passes_the_checks() -> None:
    env = SoccerEnv("VSS-v0", WORLDS, discrete=True)
    check_env_specs(env)
    assert env.full_action_spec["blue", "action"].shape == (WORLDS, 1)


@pytest.mark.parametrize(
    "groups",
    [
        None,
        MarlGroupMapType.ALL_IN_ONE_GROUP,
        {"mixed": ["blue_0", "yellow_1"], "rest": ["yellow_0", "blue_2", "blue_1", "yellow_2"]},
    ],
)
def test_it_plays_the_matches_of_the_same_seed_bit_for_bit(groups: Any) -> None:  # noqa: ANN401
    env = SoccerEnv(TASK, WORLDS, group_map=groups, state=True, max_steps=7)
    twin = Matches(rsoccer.make_task(TASK, max_steps=7), WORLDS, autoreset="disabled")
    encode = StateEncoder(twin.task.config).encode
    env.set_seed(3)
    data = env.reset()
    expected, rng, resets = twin.reset(seed=3), np.random.default_rng(0), 0
    for _ in range(STEPS):
        actions = actions_of(env, rng)
        for group, names in env.group_map.items():
            columns = [twin.agents.index(name) for name in names]
            assert np.array_equal(data[group, "observation"].numpy(), expected[:, columns])
            data[group, "action"] = torch.from_numpy(actions[:, columns])
        before, data = env.step_and_maybe_reset(data)
        outcome = twin.step(actions)
        after = before["next"]
        assert np.array_equal(after["state"].numpy(), encode(twin.frame.rows))
        assert np.array_equal(after["terminated"].numpy()[:, 0], outcome.terminated)
        assert np.array_equal(after["truncated"].numpy()[:, 0], outcome.truncated)
        goals = after["metrics", "goal_score"].numpy()[:, 0]
        assert np.array_equal(goals, outcome.metrics["goal_score"])
        for group, names in env.group_map.items():
            columns = [twin.agents.index(name) for name in names]
            last = outcome.final_observations[:, columns]
            assert np.array_equal(after[group, "observation"].numpy(), last)
            assert np.array_equal(
                after[group, "reward"].numpy()[..., 0], outcome.rewards[:, columns]
            )
            assert (after[group, "done"] == after["done"][:, None]).all()
        expected = outcome.observations
        if outcome.ended.any():
            resets += 1
            expected = twin.reset(mask=outcome.ended)
            assert not data["done"].any()
    assert resets >= STEPS // 7


def test_a_goal_terminates_and_the_time_limit_truncates() -> None:
    torch.manual_seed(0)
    env = SoccerEnv(TASK, 64, seed=0, max_steps=400)
    rollout = env.rollout(800, break_when_any_done=False)
    terminated, truncated = rollout["next", "terminated"], rollout["next", "truncated"]
    assert terminated.any()
    assert truncated.any()
    assert not (terminated & truncated).any()
    goals = rollout["next", "metrics", "goal_score"][terminated]
    assert (goals.abs() == 1.0).all()


def test_a_match_that_is_done_waits_and_remains_done() -> None:
    env = SoccerEnv(TASK, WORLDS, seed=0, max_steps=2)
    data = env.reset()
    ends = []
    for _ in range(4):
        data = env.rand_step(data)["next"]
        ends.append(bool(data["truncated"].all()))
    assert ends == [False, True, True, True]


def test_a_reset_of_some_matches_keeps_the_metrics_of_others() -> None:
    env = SoccerEnv("SSLGoToBall-v0", WORLDS, seed=0)
    env.reset()
    played = env.rand_step()["next"]
    seconds = played["metrics", "seconds"].clone()
    assert (seconds > 0.0).all()
    mask = torch.zeros(WORLDS, 1, dtype=torch.bool)
    mask[1] = True
    again = env.reset(played.clone().set("_reset", mask))
    assert again["metrics", "seconds"][mask].item() == 0.0
    assert torch.equal(again["metrics", "seconds"][~mask], seconds[~mask])
    assert torch.equal(played["metrics", "seconds"], seconds), "it was given before"
    places = {value.data_ptr() for value in again["metrics"].values()}
    assert len(places) == len(again["metrics"].keys())


def test_a_rollout_without_a_seed_differs() -> None:
    first, second = (SoccerEnv(TASK, WORLDS).reset()["blue", "observation"] for _ in range(2))
    assert not torch.equal(first, second)


def test_seeds_are_repeatable_and_later_resets_continue() -> None:
    env = SoccerEnv(TASK, WORLDS)
    env.set_seed(5)
    starts = []
    for _ in range(2):
        env.set_seed(5)
        starts.append([env.reset()["blue", "observation"] for _ in range(2)])
    assert torch.equal(starts[0][0], starts[1][0])
    assert torch.equal(starts[0][1], starts[1][1])
    assert not torch.equal(starts[0][0], starts[0][1])


@pytest.mark.parametrize("source", [Still, "tests.simulators:still"])
def test_the_simulator_and_the_senses_are_those_that_are_named(source: Any) -> None:  # noqa: ANN401
    env = SoccerEnv(TASK, WORLDS, simulator=source, sensing="tests.simulators:Blind")
    env.reset()
    play = env.matches.play
    assert isinstance(env.matches._simulator, Still)
    assert play.frame.ball.position.any() and not play.sensed.ball.position.any()


def test_one_learner_may_be_named_and_none_is_refused() -> None:
    env = SoccerEnv(TASK, WORLDS, learner="yellow_1")
    assert env.group_map == {"yellow": ["yellow_1"]}
    with pytest.raises(ValueError, match=r"^controllers: expected at least one learner"):
        SoccerEnv(TASK, controllers={"all": "zero"})


def test_bad_arguments_are_named() -> None:
    with pytest.raises(ValueError, match="worlds"):
        SoccerEnv(TASK, 0)
    with pytest.raises(TypeError, match="state"):
        SoccerEnv(TASK, state="yes")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"^group_map: .*blue_1"):
        SoccerEnv(TASK, group_map={"one": ["blue_0"]})
    for device in ("nope", 1.5):
        with pytest.raises(ValueError, match=f"^device: expected a torch device, got .*{device}"):
            SoccerEnv(TASK, device=device)
    with pytest.raises(TypeError, match=r"^group_map: expected names of learners by .*'x'"):
        SoccerEnv(TASK, group_map="x")
    with pytest.raises(TypeError, match=r"^group_map\['one'\]: expected names of learners, got 'b"):
        SoccerEnv(TASK, group_map={"one": "blue_0"})
    learners = list(rsoccer.make_task(TASK).agents)
    for name in ("state", "done", "terminated", "truncated", "metrics", "next", "_reset"):
        with pytest.raises(ValueError, match=f"^group_map: expected other names .*'{name}'"):
            SoccerEnv(TASK, group_map={name: learners})
    for task in (TASK, rsoccer.make_task(TASK)):
        with pytest.raises(TypeError, match=r"'unknwon'.* \['worlds', 'seed', 'threads', 'contr"):
            SoccerEnv(task, unknwon=1)


@pytest.mark.parametrize("argument", ["options", "frame", "seed"])
def test_a_reset_refuses_other_arguments_than_its_own(argument: str) -> None:
    """Formerly they were ignored, and the start was left to chance."""
    env = SoccerEnv(TASK, WORLDS)
    for each in (env, TransformedEnv(env, RewardSum())):
        with pytest.raises(TypeError, match=f"^reset: expected no arguments .*'{argument}'"):
            each.reset(**{argument: 1})


@pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")
def test_a_central_critic_trains_in_a_collector() -> None:
    from tensordict.nn import NormalParamExtractor, TensorDictModule
    from torch import nn

    with warnings.catch_warnings():  # of the import
        warnings.simplefilter("ignore", DeprecationWarning)
        from torchrl.collectors import Collector
    from torchrl.modules import MultiAgentMLP, ProbabilisticActor, TanhNormal
    from torchrl.modules.tensordict_module import ValueOperator
    from torchrl.objectives import ClipPPOLoss, ValueEstimators

    torch.manual_seed(0)
    env = SoccerEnv("VSSMulti-v0", 4, seed=0, state=True, max_steps=9)
    (group,) = env.group_map
    o, a, k = env.matches.observation_size, env.matches.action_size, len(env.group_map[group])
    body = nn.Sequential(
        MultiAgentMLP(o, 2 * a, k, centralized=False, share_params=True, depth=1, num_cells=16),
        NormalParamExtractor(),
    )
    keys = [(group, "loc"), (group, "scale")]
    actor = ProbabilisticActor(
        TensorDictModule(body, in_keys=[(group, "observation")], out_keys=keys),
        in_keys=keys,
        out_keys=[(group, "action")],
        distribution_class=TanhNormal,
        return_log_prob=True,
        log_prob_key=(group, "log_prob"),
    )
    size = env.observation_spec["state"].shape[-1]
    network = nn.Sequential(
        nn.Linear(size, 16), nn.Tanh(), nn.Linear(16, k), nn.Unflatten(-1, (k, 1))
    )
    critic = ValueOperator(network, in_keys=["state"], out_keys=[(group, "state_value")])
    loss = ClipPPOLoss(actor, critic, normalize_advantage=False)
    loss.set_keys(
        reward=(group, "reward"),
        action=(group, "action"),
        value=(group, "state_value"),
        done=(group, "done"),
        terminated=(group, "terminated"),
        sample_log_prob=(group, "log_prob"),
    )
    loss.make_value_estimator(ValueEstimators.GAE, gamma=0.99, lmbda=0.95)
    collector = Collector(
        env, actor, frames_per_batch=80, total_frames=160, auto_register_policy_transforms=False
    )
    before = [part.clone() for part in loss.parameters()]
    optimizer = torch.optim.Adam(loss.parameters(), 1e-2)
    batches = 0
    for data in collector:
        batches += 1
        assert data.batch_size == (4, 20)
        assert data["next", "truncated"].any()
        with torch.no_grad():
            loss.value_estimator(
                data,
                params=loss.critic_network_params,
                target_params=loss.target_critic_network_params,
            )
        values = loss(data.reshape(-1))
        total = sum(values[name] for name in ("loss_objective", "loss_critic", "loss_entropy"))
        assert torch.isfinite(total)
        optimizer.zero_grad()
        total.backward()
        optimizer.step()
    collector.shutdown()
    assert batches == 2
    moved = [not torch.equal(old, new) for old, new in zip(before, loss.parameters(), strict=True)]
    assert all(moved)

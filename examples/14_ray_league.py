"""Self-play on a Ray cluster: runners with many matches each, the trainer's league, checkpoints.

    python examples/14_ray_league.py --runners 2 --iterations 200 --folder out/league
    python examples/14_ray_league.py --task VSSMatch-v0 --task-options half_seconds=30
    python examples/14_ray_league.py --task SSLMatch-v0 --task-options n_blue=3 n_yellow=3

The recommended settings of the task (`Args.for_task`) give opponents, discount and network. On one
machine it starts Ray itself; on a cluster run it on the head node, with a folder that all machines
see. Started again with the same folder it continues from the newest checkpoint. It needs
`pip install "ray[rllib]>=2.60" torch`; `docs/scaling.md` explains the numbers.
"""

import argparse
import math
import shutil
from pathlib import Path

import ray
import torch
from ray.rllib.algorithms.algorithm import Algorithm
from ray.rllib.algorithms.algorithm_config import AlgorithmConfig
from ray.rllib.algorithms.ppo import PPOConfig
from ray.rllib.core.rl_module.default_model_config import DefaultModelConfig

from rsoccer.lineup import learning_team
from rsoccer.option_words import parse_options
from rsoccer.policies.libraries import from_rllib
from rsoccer.policies.network import Network
from rsoccer.rllib import League, MatchesEnvRunner, SoccerMultiAgentEnv
from rsoccer.train import Args
from rsoccer.train.ppo.discount import discount_per_decision
from rsoccer.train.run.folder import POLICY_FILE


def settings_of(args: argparse.Namespace) -> Args:
    """Return the trainer's recommended settings of the task, with the given options of it."""
    options = parse_options("task_options", args.task_options)
    recommended = Args.for_task(args.task, seed=args.seed)
    return Args.for_task(
        args.task, seed=args.seed, task_options={**recommended.task_options, **options}
    )


def league_of(args: argparse.Namespace) -> League:
    """Return the trainer's league of the task, frozen as often as the arguments say."""
    league = League.of(settings_of(args).opponents)
    size, every = args.league or league.size, args.freeze_every or league.every
    return League(size, league.latest_fraction, every, league.past_fraction, league.fixed)


def configure(args: argparse.Namespace) -> AlgorithmConfig:
    """Return PPO with a league: blue learns, yellow is the same policy, a past self or a script."""
    settings, league, runners = settings_of(args), league_of(args), max(args.runners, 1)
    ppo, repeat = settings.ppo, settings.rollout.action_repeat
    matches = args.matches or math.ceil(settings.rollout.worlds / runners)
    horizon = args.horizon or settings.rollout.horizon
    steps = matches * horizon * runners
    # Blue learns from all steps, yellow where it plays the same policy.
    robots = len(learning_team(settings.make_task())) * (1.0 + league.latest_fraction)
    minibatch = math.ceil(steps * robots / ppo.n_minibatches / max(args.learners, 1))
    rate, end = ppo.learning_rate, args.iterations * steps
    return (
        PPOConfig()
        .environment(
            SoccerMultiAgentEnv,
            env_config={
                "task": args.task,
                **settings.task_options,
                "frozen": league.past,
                "fixed": league.fixed_modules,
                "action_repeat": repeat,
                "shield": settings.network.shield,
            },
        )
        .env_runners(
            env_runner_cls=MatchesEnvRunner,
            num_env_runners=args.runners,
            num_envs_per_env_runner=matches,
            rollout_fragment_length=horizon,
            sample_timeout_s=60,  # a machine that is gone holds the others up no longer
        )
        .learners(num_learners=args.learners)
        .multi_agent(
            policies=league.modules,
            policies_to_train=["main"],
            policy_mapping_fn=league.choose,
        )
        .callbacks(on_train_result=league.freeze)
        .fault_tolerance(restart_failed_env_runners=True)
        .rl_module(
            model_config=DefaultModelConfig(
                fcnet_hiddens=list(settings.network.hidden_sizes),
                vf_share_layers=False,
                free_log_std=True,
            )
        )
        .training(
            train_batch_size_per_learner=steps // max(args.learners, 1),
            minibatch_size=minibatch,
            # The KL divergence ends the trainer's passes after 2 to 3; RLlib makes all of them.
            num_epochs=min(ppo.n_epochs, 3),
            lr=[[0, rate], [end, 0.1 * rate]],
            gamma=discount_per_decision(ppo, repeat, 0.0),
            lambda_=ppo.gae_lambda,
            clip_param=0.2,
            vf_loss_coeff=0.5,
            vf_clip_param=1e3,
            grad_clip=0.5,
            entropy_coeff=0.0,
        )
        .debugging(seed=args.seed)
    )


def policy_of(algorithm: Algorithm, args: argparse.Namespace) -> Network:
    """Return the policy that learns, which plays wherever policy files do."""
    settings = settings_of(args)
    return from_rllib(
        algorithm,
        settings.make_task(),
        module="main",
        action_repeat=settings.play_action_repeat,
        shield=settings.network.shield,
    )


def newest(folder: Path) -> Path | None:
    """Return the newest complete checkpoint."""
    return max(folder.glob("iteration_*"), default=None)


def save(algorithm: Algorithm, folder: Path, keep: int = 3) -> None:
    """Write a checkpoint under another name, then rename it: it is complete or absent."""
    unfinished, path = folder / "unfinished", folder / f"iteration_{algorithm.iteration:06}"
    shutil.rmtree(unfinished, ignore_errors=True)
    algorithm.save_to_path(str(unfinished.resolve()))
    unfinished.rename(path)
    for old in sorted(folder.glob("iteration_*"))[:-keep]:
        shutil.rmtree(old)


def begin(args: argparse.Namespace) -> Algorithm:
    """Start Ray, and return the run in the folder, or a new one."""
    args.folder.mkdir(parents=True, exist_ok=True)
    # As in the trainer: threads of small networks wait for each other, and for runners.
    torch.set_num_threads(settings_of(args).torch_threads)
    if not ray.is_initialized():
        ray.init(num_cpus=args.cpus, include_dashboard=False, log_to_driver=False)
    path = newest(args.folder)
    if path is not None:
        algorithm = Algorithm.from_checkpoint(str(path.resolve()))
        league_of(args).restore(algorithm)
        return algorithm
    return configure(args).build_algo()


def parsed(words: list[str] | None = None) -> argparse.Namespace:
    """Return the arguments of words, or of the command line."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--task", default="VSSSelfPlay-v0")
    parser.add_argument("--task-options", nargs="*", default=[], metavar="NAME=VALUE")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--runners", type=int, default=2, help="processes that play")
    parser.add_argument("--learners", type=int, default=0, help="processes that learn; 0: this one")
    parser.add_argument("--matches", type=int, help="matches of each runner")
    parser.add_argument("--horizon", type=int, help="decisions of a match per iteration")
    parser.add_argument("--iterations", type=int, default=200)
    parser.add_argument("--league", type=int, help="number of past selves")
    parser.add_argument("--freeze-every", type=int, help="iterations")
    parser.add_argument("--save-every", type=int, default=20, help="iterations")
    parser.add_argument("--folder", type=Path, default=Path("out/league"))
    parser.add_argument("--cpus", type=int, help="processors of a local Ray; all by default")
    return parser.parse_args(words)


def main() -> None:
    """Train, and save checkpoints and the policy."""
    args = parsed()
    algorithm = begin(args)
    while algorithm.iteration < args.iterations:
        result = algorithm.train()
        runners = result["env_runners"]
        goals = runners.get("task_metrics", {}).get("goal_score", float("nan"))
        print(
            f"iteration {algorithm.iteration}: "
            f"{runners.get('num_env_steps_sampled_lifetime', 0):,.0f} steps of matches, "
            f"goals of blue minus yellow a match {goals:+.2f}"
        )
        if algorithm.iteration % args.save_every == 0:
            save(algorithm, args.folder)
            policy_of(algorithm, args).save(args.folder / POLICY_FILE)
    algorithm.stop()


if __name__ == "__main__":
    main()

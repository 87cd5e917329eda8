"""Self-play on a Ray cluster: runners with many matches each, a league of past selves, checkpoints.

    python examples/14_ray_league.py --runners 2 --iterations 200 --folder out/league

On one machine it starts Ray itself; on a cluster run it on the head node, with a folder that all
machines see. Started again with the same folder it continues from the newest checkpoint. It needs
`pip install "ray[rllib]>=2.60" torch`; `docs/scaling.md` explains the numbers.
"""

import argparse
import shutil
from pathlib import Path

import ray
from ray.rllib.algorithms.algorithm import Algorithm
from ray.rllib.algorithms.algorithm_config import AlgorithmConfig
from ray.rllib.algorithms.ppo import PPOConfig
from ray.rllib.core.rl_module.default_model_config import DefaultModelConfig

from rsoccer.rllib import League, MatchesEnvRunner, SoccerMultiAgentEnv


def configure(args: argparse.Namespace) -> AlgorithmConfig:
    """Return PPO with a league: blue learns, yellow is the same policy or a past self."""
    batch = args.matches * args.horizon * max(args.runners, 1) // max(args.learners, 1)
    league = League(size=args.league, every=args.freeze_every)
    return (
        PPOConfig()
        .environment(SoccerMultiAgentEnv, env_config={"task": args.task, "frozen": league.past})
        .env_runners(
            env_runner_cls=MatchesEnvRunner,
            num_env_runners=args.runners,
            num_envs_per_env_runner=args.matches,
            rollout_fragment_length=args.horizon,
            sample_timeout_s=30,  # a machine that is gone holds the others up no longer
        )
        .learners(num_learners=args.learners)
        .multi_agent(
            policies=league.modules,
            policies_to_train=["main"],
            policy_mapping_fn=league.choose,
        )
        .callbacks(on_train_result=league.freeze)
        .fault_tolerance(restart_failed_env_runners=True)
        .rl_module(model_config=DefaultModelConfig(fcnet_hiddens=[128, 128]))
        .training(
            train_batch_size_per_learner=batch,
            minibatch_size=min(4096, batch),
            num_epochs=4,
            lr=3e-4,
            gamma=0.99,
            lambda_=0.95,
            entropy_coeff=0.003,
        )
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


def main() -> None:
    """Train, and save checkpoints."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--task", default="VSSSelfPlay-v0")
    parser.add_argument("--runners", type=int, default=2, help="processes that play")
    parser.add_argument("--learners", type=int, default=0, help="processes that learn; 0: this one")
    parser.add_argument("--matches", type=int, default=32, help="matches of each runner")
    parser.add_argument("--horizon", type=int, default=64, help="steps of a match per iteration")
    parser.add_argument("--iterations", type=int, default=200)
    parser.add_argument("--league", type=int, default=8, help="number of past selves")
    parser.add_argument("--freeze-every", type=int, default=20, help="iterations")
    parser.add_argument("--save-every", type=int, default=20, help="iterations")
    parser.add_argument("--folder", type=Path, default=Path("out/league"))
    parser.add_argument("--cpus", type=int, help="processors of a local Ray; all by default")
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)

    if not ray.is_initialized():
        ray.init(num_cpus=args.cpus, include_dashboard=False, log_to_driver=False)
    path = newest(args.folder)
    algorithm = (
        Algorithm.from_checkpoint(str(path.resolve())) if path else configure(args).build_algo()
    )
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
    algorithm.stop()


if __name__ == "__main__":
    main()

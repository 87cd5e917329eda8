"""PPO in one file, in the manner of CleanRL; `--central` gives the critic the whole match.

One policy learns for all robots that learn, and is written to a policy file. A match that ends
waits for the end of the decision, so the observations after it are the last ones of its episode.
"""

import argparse
from collections.abc import Iterator
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn
from torch.distributions import Normal

from rsoccer import Matches
from rsoccer.policies.network import Network

HORIZON, REPEAT, EPOCHS, MINIBATCHES = 16, 3, 6, 4  # a decision is held for REPEAT steps
GAMMA, LAMBDA, CLIP, ENTROPY, TARGET_KL, RATE = 0.97**REPEAT, 0.9, 0.2, 0.002, 0.02, 2e-3
TRUNCATION = 0.01  # share of matches that start again after a decision, which ends stalemates


def network(inputs: int, outputs: int, gain: float) -> nn.Sequential:
    """Return a perceptron with two hidden layers; `gain` scales the weights of its last one."""
    first, second, last = nn.Linear(inputs, 64), nn.Linear(64, 64), nn.Linear(64, outputs)
    for layer, scale in ((first, 2**0.5), (second, 2**0.5), (last, gain)):
        nn.init.orthogonal_(layer.weight, scale)
        nn.init.zeros_(layer.bias)
    return nn.Sequential(first, nn.Tanh(), second, nn.Tanh(), last)


def train(matches: Matches, updates: int, central: bool) -> Iterator[tuple[Network, float]]:  # noqa: C901
    """Learn; after each update yield the policy and the mean success of the last 200 matches."""
    success, scores = matches.task.success, [0.0]
    o, k = matches.observation_size, len(matches.agents)
    size = o + central * matches.state_size
    actor = network(o, matches.action_size, gain=0.01)  # the first actions are noise around zero
    critic = network(size, 1, gain=1.0)
    log_std = nn.Parameter(torch.full((matches.action_size,), 0.6).log())
    parameters = [*actor.parameters(), *critic.parameters(), log_std]
    optimiser = torch.optim.Adam(parameters, RATE, eps=1e-5, foreach=True)
    mean, variance, return_variance = torch.zeros(size), torch.ones(size), torch.zeros(())

    def inputs(observations: np.ndarray) -> np.ndarray:  # of the critic; the actor sees the first o
        states = matches.states()[:, None].repeat(k, axis=1)
        return np.concatenate([observations, states], -1) if central else observations

    def normalise(given: Tensor) -> Tensor:
        return ((given - mean) / (variance + 1e-4).sqrt()).clamp(-10, 10)

    def policy(given: Tensor) -> Any:  # noqa: ANN401  (a Normal: its methods have no types)
        return Normal(actor(given[..., :o]), log_std.exp(), validate_args=False)

    observations, returns = matches.reset(), np.zeros((matches.worlds, k), np.float32)
    for update in range(updates):
        decisions = []
        for _ in range(HORIZON):
            seen = inputs(observations)  # (worlds, k, size)
            with torch.no_grad():
                drawn = policy(normalise(torch.from_numpy(seen))).sample().numpy()
            paid, terminated = np.zeros_like(returns), matches.done
            for _ in range(REPEAT):
                outcome = matches.step(drawn)
                paid += outcome.rewards
                terminated |= outcome.terminated
                if outcome.episodes is not None and success is not None:
                    scores.extend(outcome.episodes.metrics[success])
            ended = matches.done | (torch.rand(matches.worlds) < TRUNCATION).numpy()
            returns, following = GAMMA * returns + paid, inputs(outcome.observations)
            decisions.append((seen, drawn, paid, returns, following, terminated, ended))
            observations, returns = matches.reset(mask=ended), returns * ~ended[:, None]

        stacked = (torch.from_numpy(np.stack(part)) for part in zip(*decisions, strict=True))
        raw, actions, rewards, discounted, after, terminal, ends = stacked
        return_variance += (discounted.var() - return_variance) / (update + 1)  # mean over updates
        with torch.no_grad():  # generalised advantages; the value at a time limit is bootstrapped
            given = normalise(raw)
            values, log_probs = critic(given)[..., 0], policy(given).log_prob(actions).sum(-1)
            errors = GAMMA * critic(normalise(after))[..., 0] * ~terminal[..., None] - values
            errors += rewards / (return_variance + 1e-8).sqrt()
        mean += (raw.mean((0, 1, 2)) - mean) / (update + 1)
        variance += ((raw - mean).square().mean((0, 1, 2)) - variance) / (update + 1)
        advantages, last = torch.zeros_like(errors), torch.zeros_like(errors[0])
        for t in reversed(range(HORIZON)):
            last = advantages[t] = errors[t] + GAMMA * LAMBDA * ~ends[t, :, None] * last
        parts = (given, actions, log_probs, advantages, advantages + values)
        batch = [part.flatten(0, 2) for part in parts]

        optimiser.param_groups[0]["lr"] = RATE * (1 - 0.9 * update / updates)
        for _ in range(EPOCHS):
            divergence = 0.0  # KL from the policy that played, mean over the minibatches
            for rows in torch.randperm(len(batch[0])).chunk(MINIBATCHES):
                x, action, old_log_prob, advantage, target = (part[rows] for part in batch)
                advantage = (advantage - advantage.mean()) / (advantage.std() + 1e-8)
                log_ratio = policy(x).log_prob(action).sum(-1) - old_log_prob
                ratio = log_ratio.exp()
                clipped = ratio.clamp(1 - CLIP, 1 + CLIP) * advantage
                loss: Any = -torch.minimum(ratio * advantage, clipped).mean()
                loss += 0.5 * (critic(x)[:, 0] - target).square().mean() - ENTROPY * log_std.sum()
                optimiser.zero_grad()
                loss.backward()
                nn.utils.clip_grad_norm_(parameters, 0.5)
                optimiser.step()
                divergence += (ratio - 1 - log_ratio).mean().item() / MINIBATCHES
            if divergence > TARGET_KL:  # the policy has changed enough
                break
        weights, std = list(actor.state_dict().values()), (variance + 1e-4).sqrt()
        layers, action_std = zip(weights[::2], weights[1::2], strict=True), log_std.detach().exp()
        trained = Network.from_layers(
            matches.task, layers, action_std, action_repeat=REPEAT, mean=mean[:o], std=std[:o]
        )
        yield trained, float(np.mean(scores[-200:]))


def main() -> None:
    """Train, print the success from time to time, and write the policy."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--central", action="store_true")
    options = {"task": "VSS-v0", "worlds": 256, "samples": 1_500_000, "threads": 2, "seed": 0}
    for name, default in {**options, "out": "ppo.safetensors"}.items():
        parser.add_argument(f"--{name}", type=type(default), default=default)
    args = parser.parse_args()
    torch.manual_seed(args.seed)
    torch.set_num_threads(1)
    matches = Matches(args.task, args.worlds, args.seed, args.threads, autoreset="disabled")
    size = HORIZON * args.worlds * len(matches.agents)
    updates = -(-args.samples // size)
    for update, (policy, score) in enumerate(train(matches, updates, args.central), 1):
        if update % 50 == 0 or update == updates:
            print(f"{update * size:,} decisions, {matches.task.success} {score:+.2f}")
            policy.save(args.out)


if __name__ == "__main__":
    main()

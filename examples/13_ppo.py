"""PPO in one file, in the manner of CleanRL; `--central` gives the critic the whole match.

One policy learns for all robots that learn, and is written to a policy file. A match that ends
waits for the end of the decision, so the observations after it are the last ones of its episode.
"""

import argparse
import time
from collections import deque
from collections.abc import Iterator
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn
from torch.distributions import Normal

from rsoccer import Matches
from rsoccer.policies.network import Network

HORIZON, REPEAT, EPOCHS, MINIBATCHES = 16, 3, 6, 4  # a decision is held for REPEAT steps
GAMMA, LAMBDA, CLIP, ENTROPY, TARGET_KL, RATE = 0.91, 0.9, 0.2, 0.002, 0.02, 2e-3


def network(inputs: int, outputs: int, gain: float) -> nn.Sequential:
    """Return a perceptron with two hidden layers; `gain` scales the weights of its last one."""
    first, second, last = nn.Linear(inputs, 64), nn.Linear(64, 64), nn.Linear(64, outputs)
    last.weight.data *= gain
    return nn.Sequential(first, nn.Tanh(), second, nn.Tanh(), last)


def train(matches: Matches, updates: int, central: bool) -> Iterator[tuple[Network, float]]:  # noqa: C901
    """Learn; after each update yield the policy and the mean score of the last 200 matches."""
    o, k, scores = matches.observation_size, len(matches.agents), deque([0.0], maxlen=200)
    actor = network(o, matches.action_size, gain=0.01)  # the first actions are noise around zero
    critic = network(o + central * matches.state_size, 1, gain=1.0)
    log_std = nn.Parameter(torch.full((matches.action_size,), -0.5))
    parameters = [*actor.parameters(), *critic.parameters(), log_std]
    optimiser = torch.optim.Adam(parameters, RATE, eps=1e-5, foreach=True)

    def inputs(observations: np.ndarray) -> np.ndarray:  # of the critic; the actor sees the first o
        states = matches.states()[:, None].repeat(k, axis=1)
        return np.concatenate([observations, states], -1) if central else observations

    def policy(given: Tensor) -> Any:  # noqa: ANN401  (a Normal: its methods have no types)
        return Normal(actor(given[..., :o]), log_std.exp(), validate_args=False)

    observations = matches.reset()  # (worlds, k, o)
    for update in range(updates):
        optimiser.param_groups[0]["lr"] = RATE * (1 - 0.9 * update / updates)
        decisions = []
        for _ in range(HORIZON):
            seen = inputs(observations)
            with torch.no_grad():
                drawn = policy(torch.from_numpy(seen)).sample().numpy()
            paid, terminated = np.zeros(drawn.shape[:2], np.float32), matches.done
            for _ in range(REPEAT):
                outcome = matches.step(drawn)
                paid += outcome.rewards
                terminated |= outcome.terminated
                if outcome.episodes is not None:
                    scores.extend(outcome.episodes.metrics["goal_score"])
            ended, following = matches.done, inputs(outcome.observations)
            observations = matches.reset(mask=ended)
            decisions.append((seen, drawn, paid, following, terminated[:, None], ended[:, None]))

        parts = (torch.from_numpy(np.stack(part)) for part in zip(*decisions, strict=True))
        given, actions, rewards, after, terminal, end = parts
        with torch.no_grad():  # generalised advantages; the value at a time limit is bootstrapped
            values, log_probs = critic(given)[..., 0], policy(given).log_prob(actions).sum(-1)
            errors = rewards + GAMMA * critic(after)[..., 0] * ~terminal - values
        advantages, last = torch.zeros_like(errors), torch.zeros_like(errors[0])
        for t in reversed(range(HORIZON)):
            last = advantages[t] = errors[t] + GAMMA * LAMBDA * ~end[t] * last
        samples = (given, actions, log_probs, advantages, advantages + values)
        batch = [part.flatten(0, 2) for part in samples]

        for _ in range(EPOCHS):
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
            if (ratio - 1 - log_ratio).mean() > TARGET_KL:  # the policy has changed enough
                break
        weights = list(actor.state_dict().values())
        layers, std = zip(weights[::2], weights[1::2], strict=True), log_std.detach().exp()
        trained = Network.from_layers(matches.task, layers, std, action_repeat=REPEAT)
        yield trained, float(np.mean(scores))


def main() -> None:
    """Train, print speed and score from time to time, and write the policy."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--central", action="store_true")
    options = {"task": "VSS-v0", "worlds": 256, "samples": 1_500_000, "threads": 2}
    for name, default in {**options, "out": "ppo.safetensors"}.items():
        parser.add_argument(f"--{name}", type=type(default), default=default)
    args = parser.parse_args()
    torch.manual_seed(0)
    torch.set_num_threads(1)
    matches = Matches(args.task, args.worlds, 0, args.threads, autoreset="disabled")
    size, start = HORIZON * args.worlds * len(matches.agents), time.perf_counter()
    updates = -(-args.samples // size)
    for update, (policy, score) in enumerate(train(matches, updates, args.central), 1):
        if update % 50 == 0 or update == updates:
            speed = update * size / (time.perf_counter() - start)
            print(f"{update * size:,} decisions, {speed:,.0f} a second, goal score {score:+.2f}")
            policy.save(args.out)


if __name__ == "__main__":
    main()

"""PPO in one file on `Matches`, in the manner of CleanRL; `--central` adds a central critic."""

import argparse
import time
from itertools import pairwise

import numpy as np
import torch
from torch import Tensor, nn

from rsoccer import Matches

HORIZON, REPEAT, EPOCHS, MINIBATCHES = 16, 3, 6, 4  # a decision is held for REPEAT steps
GAMMA, LAMBDA, CLIP, ENTROPY, TARGET_KL = 0.91, 0.9, 0.2, 0.002, 0.03


def network(*sizes: int, gain: float) -> nn.Sequential:
    """Return linear layers with tanh between them; `gain` scales the last one."""
    layers: list[nn.Module] = []
    for inputs, outputs in pairwise(sizes):
        layer = nn.Linear(inputs, outputs)
        nn.init.orthogonal_(layer.weight, gain if outputs == sizes[-1] else 2**0.5)
        layers += [layer, nn.Tanh()]
    return nn.Sequential(*layers[:-1])


class PPO:
    """One policy for all robots that learn."""

    def __init__(self, matches: Matches, central: bool) -> None:
        """Begin the matches, which have no automatic resets."""
        self.matches, self.central, self.scores = matches, central, list[float]()
        self.observations, size = matches.reset(), matches.observation_size
        self.actor = network(size, 64, 64, matches.action_size, gain=0.01)
        self.critic = network(size + central * matches.state_size, 64, 64, 1, gain=1.0)
        self.log_std = nn.Parameter(torch.full((matches.action_size,), -0.5))
        self.parameters = [*self.actor.parameters(), *self.critic.parameters(), self.log_std]
        self.optimiser = torch.optim.Adam(self.parameters, 1e-3, eps=1e-5, foreach=True)

    def log_prob(self, means: Tensor, actions: Tensor) -> Tensor:
        """Return the log density of the actions, without its constant."""
        return (-0.5 * ((actions - means) / self.log_std.exp()) ** 2 - self.log_std).sum(-1)

    def inputs(self) -> Tensor:
        """Return inputs of the critic: observations and, if it is central, the whole match."""
        if not self.central:
            return torch.tensor(self.observations)
        states = np.repeat(self.matches.states()[:, None], len(self.matches.agents), axis=1)
        return torch.tensor(np.concatenate([self.observations, states], axis=-1))

    def decide(self) -> tuple[Tensor, ...]:
        """Hold actions for some steps. A match that ends waits, and then begins anew."""
        inputs = self.inputs()
        means = self.actor(inputs[..., : self.matches.observation_size])
        actions = means + self.log_std.exp() * torch.randn(means.shape)
        rewards, terminated = np.zeros(means.shape[:2], np.float32), self.matches.done
        for _ in range(REPEAT):
            outcome = self.matches.step(actions.numpy())
            rewards += outcome.rewards
            terminated |= outcome.terminated
            if outcome.episodes is not None:
                self.scores += outcome.episodes.metrics["goal_score"].tolist()
        self.observations, ended = outcome.observations, self.matches.done
        next_inputs = self.inputs()  # where an episode ended its last ones
        if ended.any():
            self.observations = self.matches.reset(mask=ended)
        ends = [torch.tensor(each)[:, None].expand(means.shape[:2]) for each in (terminated, ended)]
        log_probs = self.log_prob(means, actions)
        return inputs, actions, log_probs, torch.tensor(rewards), next_inputs, *ends

    @torch.no_grad()
    def collect(self) -> list[Tensor]:
        """Play; return inputs, actions, log densities, advantages and returns of all samples."""
        decisions = [self.decide() for _ in range(HORIZON)]
        inputs, actions, log_probs, rewards, next_inputs, terminated, ended = (
            torch.stack(parts) for parts in zip(*decisions, strict=True)
        )
        values, next_values = self.critic(inputs)[..., 0], self.critic(next_inputs)[..., 0]
        errors = rewards + GAMMA * next_values * ~terminated - values  # the limit is bootstrapped
        advantages, last = torch.zeros_like(errors), torch.zeros_like(errors[0])
        for t in reversed(range(HORIZON)):
            last = advantages[t] = errors[t] + GAMMA * LAMBDA * ~ended[t] * last
        parts = (inputs, actions, log_probs, advantages, advantages + values)
        return [part.flatten(0, 2) for part in parts]

    def learn(self, samples: list[Tensor]) -> None:
        """Update both networks, until the policy has changed enough."""
        for _ in range(EPOCHS):
            order = torch.randperm(len(samples[0])).chunk(MINIBATCHES)
            changes = [self.update([part[chosen] for part in samples]) for chosen in order]
            if torch.stack(changes).mean() > TARGET_KL:
                break

    def update(self, samples: list[Tensor]) -> Tensor:
        """Update both networks on a minibatch; return the KL divergence from the old policy."""
        inputs, actions, log_probs, advantages, returns = samples
        advantages = (advantages - advantages.mean()) / (advantages.std() + 1e-8)
        means = self.actor(inputs[:, : self.matches.observation_size])
        log_ratio = self.log_prob(means, actions) - log_probs
        ratio = log_ratio.exp()
        clipped = ratio.clamp(1 - CLIP, 1 + CLIP)
        policy_loss = -torch.minimum(ratio * advantages, clipped * advantages).mean()
        value_loss = (self.critic(inputs)[:, 0] - returns).square().mean()
        self.optimiser.zero_grad()
        (policy_loss + 0.5 * value_loss - ENTROPY * self.log_std.sum()).backward()
        nn.utils.clip_grad_norm_(self.parameters, 0.5)
        self.optimiser.step()
        return (ratio - 1 - log_ratio).mean().detach()


def main() -> None:
    """Train, and print the mean score of the last matches from time to time."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--task", default="VSS-v0")
    parser.add_argument("--worlds", type=int, default=256)
    parser.add_argument("--samples", type=int, default=1_000_000)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--central", action="store_true")
    args = parser.parse_args()
    torch.manual_seed(0)
    torch.set_num_threads(1)
    matches = Matches(args.task, args.worlds, 0, args.threads, autoreset="disabled")
    ppo, start, size = PPO(matches, args.central), time.perf_counter(), 0
    updates = -(-args.samples // (HORIZON * args.worlds * len(matches.agents)))
    for update in range(1, updates + 1):
        samples = ppo.collect()
        ppo.learn(samples)
        size += len(samples[0])
        if update % 50 == 0 or update == updates:
            rate, score = size * REPEAT / (time.perf_counter() - start), "none"
            if ppo.scores:
                score = f"{np.mean(ppo.scores[-200:]):+.2f}"
            print(f"{size:,} decisions, {rate:,.0f} agent-steps/s, goal score {score}", flush=True)


if __name__ == "__main__":
    main()

"""PPO in one file, in the manner of CleanRL; `--central` gives the critic the state of the match.

One policy learns for all robots that learn, and is written to a file for `rsoccer evaluate` and
`rsoccer watch`. Arrays have the shape (..., worlds, robots, numbers). As CleanRL takes wrappers
from Gymnasium, this file takes running statistics and the loop that holds an action from rsoccer.
"""

from typing import Any

import numpy as np
import torch
import tyro
from torch import Tensor, nn
from torch.distributions import Normal

from rsoccer import Matches
from rsoccer.policies.network import Network
from rsoccer.train.rollout.running_mean_std import RunningMeanStd
from rsoccer.train.rollout.transition import repeat_action

HORIZON, REPEAT, EPOCHS, MINIBATCHES = 16, 3, 4, 8  # a decision is held for REPEAT steps
GAMMA, LAMBDA, CLIP, ENTROPY, RATE = 0.985**REPEAT, 0.9, 0.2, 0.002, 2e-3
TRUNCATION = 0.002  # share of matches that start again after a decision, which ends stalemates


def perceptron(inputs: int, outputs: int) -> nn.Sequential:
    """Return a network with two hidden layers."""
    hidden = [nn.Linear(inputs, 128), nn.Tanh(), nn.Linear(128, 128), nn.Tanh()]
    return nn.Sequential(*hidden, nn.Linear(128, outputs))


def train(matches: Matches, samples: int, central: bool) -> Network:  # noqa: C901
    """Learn from a number of decisions of robots, and return the policy."""
    o, size = matches.observation_size, matches.observation_size + central * matches.state_size
    actor, critic = perceptron(o, matches.action_size), perceptron(size, 1)
    log_std = nn.Parameter(torch.full((matches.action_size,), 0.6).log())
    parameters = [*actor.parameters(), *critic.parameters(), log_std]
    optimizer = torch.optim.Adam(parameters, RATE, eps=1e-5)
    input_rms, return_rms = RunningMeanStd(size), RunningMeanStd(1, min_std=1e-6)

    def read(observations: np.ndarray) -> Tensor:
        """Return normalized inputs of the critic; the actor reads the first `o` numbers."""
        states = matches.states()[:, None].repeat(len(matches.agents), axis=1)
        inputs = np.concatenate([observations, states], axis=-1)[..., :size]
        input_rms.update(inputs.reshape(-1, size))
        mean, std = input_rms.as_float32()
        return torch.from_numpy((inputs - mean) / std).clamp(-10, 10)

    def policy(inputs: Tensor) -> Any:  # noqa: ANN401  (a Normal: its methods have no types)
        return Normal(actor(inputs[..., :o]), log_std.exp(), validate_args=False)

    inputs, success, scores = read(matches.reset()), str(matches.task.success), [0.0]
    returns = np.zeros(inputs.shape[:2], np.float32)
    n_updates = -(-samples // (HORIZON * returns.size))
    for update in range(n_updates):
        rollout = []
        for _ in range(HORIZON):
            with torch.no_grad():
                actions = policy(inputs).sample()
            # A match that ends waits for its reset, so `decision` and `after` are of the old one.
            decision = repeat_action(matches, actions.numpy(), REPEAT)
            scores.extend(decision.metrics[success][decision.ended])
            ended = decision.ended | (torch.rand(matches.worlds) < TRUNCATION).numpy()
            returns = GAMMA * returns + decision.rewards
            return_rms.update(returns.reshape(-1, 1))
            scaled = decision.rewards / return_rms.as_float32()[1]
            after = read(decision.observations)
            ends = decision.terminated[:, None], ended[:, None]
            rollout.append((inputs, actions, scaled, after, *ends))
            inputs, returns = read(matches.reset(mask=ended)), returns * ~ended[:, None]

        tensors = (torch.from_numpy(np.stack(part)) for part in zip(*rollout, strict=True))
        x, actions, rewards, after, terminated, ended = tensors
        with torch.no_grad():
            values, future = critic(x)[..., 0], critic(after)[..., 0]
            log_probs = policy(x).log_prob(actions).sum(-1)
        advantages = rewards + GAMMA * future * ~terminated - values  # a time limit has a future
        for t in reversed(range(HORIZON - 1)):  # generalized advantage estimation
            advantages[t] += GAMMA * LAMBDA * ~ended[t] * advantages[t + 1]
        parts = (x, actions, log_probs, advantages, advantages + values)
        batch = [part.flatten(0, 2) for part in parts]

        optimizer.param_groups[0]["lr"] = RATE * (1 - 0.9 * update / n_updates)
        for _ in range(EPOCHS):
            for rows in torch.randperm(len(batch[0])).chunk(MINIBATCHES):
                x, action, old_log_prob, advantage, target = (part[rows] for part in batch)
                advantage = (advantage - advantage.mean()) / (advantage.std() + 1e-8)
                ratio = (policy(x).log_prob(action).sum(-1) - old_log_prob).exp()
                clipped = ratio.clamp(1 - CLIP, 1 + CLIP)
                loss: Any = -torch.minimum(ratio * advantage, clipped * advantage).mean()
                loss += 0.5 * (critic(x)[:, 0] - target).square().mean() - ENTROPY * log_std.sum()
                optimizer.zero_grad()
                loss.backward()
                nn.utils.clip_grad_norm_(parameters, 0.5)
                optimizer.step()
        if update % 20 == 0:
            print(f"update {update} of {n_updates}, {success} {np.mean(scores[-200:]):+.2f}")

    mean, std = (statistics[:o] for statistics in input_rms.as_float32())
    action_std = log_std.detach().exp()
    return Network.from_layers(
        matches.task, actor, action_std, action_repeat=REPEAT, mean=mean, std=std
    )


def main(
    task: str = "VSS-v0", samples: int = 1_500_000, seed: int = 0, central: bool = False
) -> None:
    """Train on a task, and write the policy to ppo.safetensors."""
    torch.manual_seed(seed)
    matches = Matches(task, worlds=256, seed=seed, threads=2, autoreset="disabled")
    train(matches, samples, central).save("ppo.safetensors")


if __name__ == "__main__":
    tyro.cli(main)

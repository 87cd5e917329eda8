"""Many matches for Stable-Baselines3, which has vector environments of its own: PPO on VSSS."""

import sys
from collections.abc import Iterable, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecEnv, VecMonitor

import rsoccer  # noqa: F401  (makes the ids known)


class StableMatches(VecEnv):  # type: ignore[misc]
    """What `gymnasium.make_vec` makes, as Stable-Baselines3 wants it."""

    def __init__(self, ident: str, matches: int, **options: Any) -> None:  # noqa: ANN401
        """`matches` of a task by its id; `options` are those of `rsoccer.vector_env`."""
        mode = AutoresetMode.SAME_STEP  # what Stable-Baselines3 expects
        self.envs = gymnasium.make_vec(ident, matches, autoreset_mode=mode, **options)
        spaces = self.envs.single_observation_space, self.envs.single_action_space
        super().__init__(matches, *spaces)

    def reset(self) -> Any:  # noqa: ANN401
        """Begin all matches, from the seeds that `seed` was given."""
        observations, _ = self.envs.reset(seed=self._seeds)
        self._reset_seeds()
        return observations

    def step_async(self, actions: np.ndarray) -> None:
        """Keep the actions for `step_wait`."""
        self.actions = actions

    def step_wait(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[dict[str, Any]]]:
        """Step; where a match ends, its info has the facts, the last view, and how it ended."""
        observations, rewards, terminated, truncated, infos = self.envs.step(self.actions)
        ended, told = terminated | truncated, [dict[str, Any]() for _ in range(self.num_envs)]
        for match in np.flatnonzero(ended):
            facts = infos["final_info"].items()
            told[match] = {name: fact[match] for name, fact in facts if name[0] != "_"}
            told[match]["terminal_observation"] = infos["final_obs"][match]
            told[match]["TimeLimit.truncated"] = bool(truncated[match] and not terminated[match])
        return observations, rewards.astype(np.float32), ended, told

    def close(self) -> None:
        """Close the matches."""
        self.envs.close()

    def get_attr(self, name: str, indices: int | Iterable[int] | None = None) -> list[Any]:
        """An attribute of the matches, once for each that is asked for."""
        return [getattr(self.envs, name)] * len(list(self._get_indices(indices)))

    def set_attr(self, name: str, value: Any, indices: Any = None) -> None:  # noqa: ANN401
        """Matches are made with their options, and keep them."""
        raise NotImplementedError("make the matches with other options")

    def env_method(self, name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:  # noqa: ANN401
        """One match has no methods of its own."""
        raise NotImplementedError("call the method on `envs`")

    def env_is_wrapped(self, wrapper_class: type, indices: Any = None) -> Sequence[bool]:  # noqa: ANN401
        """No match is wrapped by itself."""
        return [False] * len(list(self._get_indices(indices)))


def main(matches: int = 64, steps: int = 200_000) -> None:
    """Train for a while, and say how often the last matches were won."""
    envs = VecMonitor(
        StableMatches("rsoccer/VSS-v0", matches, threads=2), info_keywords=("goal_score",)
    )
    model = PPO(
        "MlpPolicy", envs, n_steps=128, batch_size=32 * matches, n_epochs=5, seed=0, device="cpu"
    )
    model.learn(steps)
    scores = [episode["goal_score"] for episode in model.ep_info_buffer]
    score = f"{np.mean(scores):+.2f}" if scores else "unknown, as no match ended"
    print(f"{model.num_timesteps:,} steps; goal score of the last {len(scores)} matches: {score}")
    envs.close()


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))

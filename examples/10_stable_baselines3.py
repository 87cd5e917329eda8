"""PPO of Stable-Baselines3 on VSSS: an adapter to its own kind of vector environment."""

import sys
from collections.abc import Iterable, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecEnv, VecMonitor

import rsoccer  # noqa: F401  (registers the environment ids)


class StableMatches(VecEnv):  # type: ignore[misc]
    """Adapter of `gymnasium.make_vec` to the vector environments of Stable-Baselines3."""

    def __init__(self, ident: str, matches: int, **options: Any) -> None:  # noqa: ANN401
        """Create the matches.

        Args:
            ident: Gymnasium id of the task.
            matches: Number of matches.
            options: Options of `rsoccer.vector_env`.
        """
        mode = AutoresetMode.SAME_STEP  # required by Stable-Baselines3
        self.envs = gymnasium.make_vec(ident, matches, autoreset_mode=mode, **options)
        spaces = self.envs.single_observation_space, self.envs.single_action_space
        super().__init__(matches, *spaces)

    def reset(self) -> Any:  # noqa: ANN401
        """Reset all matches with the seeds set by `seed`; return observations."""
        observations, _ = self.envs.reset(seed=self._seeds)
        self._reset_seeds()
        return observations

    def step_async(self, actions: np.ndarray) -> None:
        """Store the actions for `step_wait`."""
        self.actions = actions

    def step_wait(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, list[dict[str, Any]]]:
        """Step all matches.

        The info of an ended match has its metrics, its last observation and how it ended.
        """
        observations, rewards, terminated, truncated, infos = self.envs.step(self.actions)
        ended, ended_infos = (
            terminated | truncated,
            [dict[str, Any]() for _ in range(self.num_envs)],
        )
        for match in np.flatnonzero(ended):
            metrics = infos["final_info"].items()
            ended_infos[match] = {name: values[match] for name, values in metrics if name[0] != "_"}
            ended_infos[match]["terminal_observation"] = infos["final_obs"][match]
            time_limit = bool(truncated[match] and not terminated[match])
            ended_infos[match]["TimeLimit.truncated"] = time_limit
        return observations, rewards.astype(np.float32), ended, ended_infos

    def close(self) -> None:
        """Close the matches."""
        self.envs.close()

    def get_attr(self, name: str, indices: int | Iterable[int] | None = None) -> list[Any]:
        """Return an attribute of the matches, once per requested index."""
        return [getattr(self.envs, name)] * len(list(self._get_indices(indices)))

    def set_attr(self, name: str, value: Any, indices: Any = None) -> None:  # noqa: ANN401
        """Refuse to set attributes: options are fixed at construction."""
        raise NotImplementedError("attributes cannot be set; pass options to the constructor")

    def env_method(self, name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:  # noqa: ANN401
        """Refuse to call methods of single matches."""
        raise NotImplementedError("single matches have no methods; call the method on `envs`")

    def env_is_wrapped(self, wrapper_class: type, indices: Any = None) -> Sequence[bool]:  # noqa: ANN401
        """Return False for each index: single matches have no wrappers."""
        return [False] * len(list(self._get_indices(indices)))


def main(matches: int = 64, steps: int = 200_000) -> None:
    """Train for a while and print the mean goal score of the last matches."""
    envs = VecMonitor(
        StableMatches("rsoccer/VSS-v0", matches, threads=2), info_keywords=("goal_score",)
    )
    model = PPO(
        "MlpPolicy", envs, n_steps=128, batch_size=32 * matches, n_epochs=5, seed=0, device="cpu"
    )
    model.learn(steps)
    scores = [episode["goal_score"] for episode in model.ep_info_buffer]
    score = f"{np.mean(scores):+.2f}" if scores else "unknown (no match ended)"
    print(f"{model.num_timesteps:,} steps; goal score of the last {len(scores)} matches: {score}")
    envs.close()


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))

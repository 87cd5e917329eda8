"""Recommended settings by task, where they differ from the defaults of `Args`.

`rsoccer train --task` and `Args.for_task` start from them; a setting that is given replaces the
recommended one as a whole. Values are results of measurements. Every trained policy of the package
was made with the settings of its task, and a test compares both.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from rsoccer.registry import list_aliases

M: Final = 1_000_000

_SSL: Final[dict[str, Any]] = {
    # A pass or a shot pays off seconds later, and no SSL task here has stalemates to break up.
    "ppo.gamma": 0.99,
    "ppo.gae_lambda": 0.95,
    "rollout.random_truncation": 0.0,
    # Full speed is 3.7 m/s: with the default spread a robot shakes the ball off its dribbler.
    "network.action_std": 0.15,
    "network.final_action_std": 0.04,
    "ppo.learning_rate": 1e-3,
    "ppo.learning_rate_schedule": "adaptive",
    "ppo.n_epochs": 4,
    "rollout.worlds": 512,
}
"""Settings of all SSL tasks with one learning team."""

_VSSS: Final[dict[str, Any]] = {
    # Twice as much is learned from a sample at first. In the end VSSMulti-v0 is a little better,
    # VSSSelfPlay-v0 is not.
    "ppo.mirror_augmentation": True,
    # Exploring needs actions that last. A policy that has learned so plays better if it decides
    # more often: docs/learning-tried.md has the scores.
    "network.play_action_repeat": 2,
}
"""Settings of all VSSS tasks."""

_TEAM: Final[dict[str, Any]] = {
    **_VSSS,
    # In a team the rewards of a robot follow from the actions of all. With 12,000 samples an update
    # teams stop improving against scripts, with 49,000 they go on.
    "rollout.worlds": 1024,
    "ppo.n_minibatches": 16,
    "opponents.solo_fraction": 0.2,
    # In matches under a referee; the tasks with a single goal have none.
    "network.shield": "vsss",
}
"""Settings of VSSS tasks in which a whole team learns."""

_KEEP_BALL: Final = (0.0, 0.0, 0.0, -0.2, 0.3)
"""Initial action of robots that start with the ball or must not lose it: dribble, seldom kick."""

_STATIC_DEFENDERS: Final[dict[str, Any]] = {
    **_SSL,
    # With .99 a shot at once that often fails is worth more than a sure one a second later.
    "ppo.final_gamma": 0.9985,
    "network.final_action_std": 0.02,
    "network.initial_action": _KEEP_BALL,
    "network.robot_units": 16,
    # Learning takes most of the time, so few passes over many samples.
    "rollout.worlds": 2048,
    "ppo.n_minibatches": 16,
    "ppo.n_epochs": 2,
    # With reflected samples, seeds that are slow at first catch up.
    "ppo.mirror_augmentation": True,
}
"""Settings of `SSLStaticDefenders-v0` for any number of opponents."""

TASK_SETTINGS: Final[Mapping[str, Mapping[str, Any]]] = {
    "VSS-v0": {**_VSSS, "samples": 10 * M, "rollout.worlds": 512},
    "VSSMulti-v0": {
        **_TEAM,
        "samples": 20 * M,
        # A team that has met nothing but noise loses to sides that defend and shoot.
        "opponents.fixed": {"ou": 2.0, "scripted": 2.0, "chase": 1.0},
    },
    # Nothing was found that makes the policy of VSSSelfPlay-v0 better in matches.
    "VSSMatch-v0": {
        **_TEAM,
        "network.play_action_repeat": 1,
        "network.initial_policy": "VSSSelfPlay-v0",
    },
    "VSSSelfPlay-v0": {
        **_TEAM,
        "network.play_action_repeat": 1,
        "samples": 20 * M,
        # Opponents that stand still or defend well are rare in self-play, and a policy that never
        # met them draws against them.
        "opponents.fixed": {"ou": 1.0, "zero": 1.0, "chase": 2.0, "scripted": 3.0},
        "opponents.latest_fraction": 0.1,
        "opponents.past_fraction": 0.1,
    },
    "SSLGoToBall-v0": {**_SSL, "samples": 3 * M, "network.action_std": 0.3},
    "SSLPassEndurance-v1": {
        **_SSL,
        "samples": 30 * M,
        "network.action_std": 0.3,
        "network.final_action_std": 0.02,
        "network.initial_action": _KEEP_BALL,
        # A pass has to meet a mouth of some centimeters from meters away, so aiming takes long.
        "ppo.mirror_augmentation": True,
        # With the defaults of 1 and -1 policies kick at once, in about the right direction.
        "task_options": {"reward_weights": {"failed": -0.5, "ball_to_teammate": 0.3}},
    },
    "SSLStaticDefenders-v0": {
        **_STATIC_DEFENDERS,
        "samples": 40 * M,
        # Half of the failures of a policy without it are touches of opponents.
        "network.shield": "ssl_attack",
        # With .3 two of five seeds never scored from the corner beside the goalkeeper.
        "task_options": {
            "random_start": True,
            "scenario_fraction": 0.5,
            "reward_weights": {"failed": -0.3},
        },
    },
    # The same without opponents, so without scenarios.
    "SSLGoToBallShoot-v0": {
        **_STATIC_DEFENDERS,
        "samples": 5 * M,
        "task_options": {"random_start": True, "reward_weights": {"failed": -0.3}},
    },
    "SSLContestedPossession-v0": {
        **_SSL,
        "samples": 30 * M,
        # With .997 from the start policies wait. With .985 to the end they hurry, and fail in twice
        # as many episodes: a goal a second later is worth half.
        "ppo.gamma": 0.985,
        "ppo.final_gamma": 0.9985,
        "network.final_action_std": 0.02,
        "network.initial_action": _KEEP_BALL,
        # With the default of -1 policies learn to stay away from the opponent.
        "task_options": {"random_start": True, "reward_weights": {"failed": -0.3}},
    },
    "SSLDribbling-v0": {
        **_SSL,
        "samples": 3 * M,
        "network.action_std": 0.1,
        "network.final_action_std": 0.03,
        "ppo.learning_rate": 5e-4,
        "network.initial_action": (0.0, 0.0, 0.0, -0.5, 0.5),
        "rollout.worlds": 128,
        "rollout.horizon": 32,
        # From the first gate alone policies learn to stop behind it: with the default of -2 for a
        # failure the next gate is not worth the risk until it can be crossed.
        "task_options": {"random_start": True, "reward_weights": {"failed": -0.3}},
    },
    "SSLPassEnduranceMulti-v1": {
        **_SSL,
        "samples": 20 * M,
        "network.action_std": 0.3,
        "network.initial_action": _KEEP_BALL,
        # Both robots learn from the start: beside the script `passer`, which goes to any pass, a
        # robot learns passes that a copy of itself never receives.
        "opponents.solo_fraction": 0.0,
        # With it three seeds make 34.6 passes, without it five make 28.6; the intervals overlap.
        "network.central_critic": True,
        # With the default of 1 for the distance the robots walk up to each other instead of
        # passing, and with -1 for a failure the first passes, which fail, are not worth a try.
        "task_options": {"reward_weights": {"failed": -0.2, "ball_to_teammate": 0.2}},
    },
    "SSLKeepaway-v0": {
        **_SSL,
        "samples": 20 * M,
        "network.action_std": 0.3,
        "network.initial_action": _KEEP_BALL,
        # A keeper alone has nobody to pass to, and takers that move at random teach it nothing.
        "opponents.solo_fraction": 0.0,
        # The robots of a team see the same ball, and are rewarded alike.
        "network.central_critic": True,
        "ppo.n_minibatches": 16,
        "ppo.mirror_augmentation": True,
    },
    "SSLSelfPlay-v0": {
        **_SSL,
        "samples": 20 * M,
        "rollout.random_truncation": 0.002,
        "network.action_std": 0.3,
        "network.initial_action": _KEEP_BALL,
        "ppo.n_minibatches": 16,
        "opponents.solo_fraction": 0.2,
        "opponents.fixed": {"ou": 1.0, "zero": 1.0, "strike": 3.0},
        "opponents.latest_fraction": 0.1,
        "opponents.past_fraction": 0.1,
    },
}
"""Values of settings by the names that `Args.from_json` takes, by the name of the task."""


_BEHIND_FORECAST: Final[dict[str, Any]] = {
    "network.initial_policy": "best",
    "network.action_std": 0.1,
    "network.final_action_std": 0.02,
    # 95 ms in all. A forecast knows the middle of the delays, as that of a team that has identified
    # its robots: with an expected 0 for delays of 0 to 60 ms 5.2 instead of 6.9 gates were crossed.
    "sensing": "rc2021, forecast=1, command_delay=0.05",
    "randomization": {
        "sensing.command_delay": [0.0375, 0.0625],
        "robot.mass": [0.85, 1.15],
        "robot.acceleration": [0.85, 1.15],
        "robot.speed": [0.9, 1.1],
        "robot.traction": [0.85, 1.15],
        "ball.rolling_deceleration": [0.15, 0.35],
    },
}
"""Settings of a training that goes on from `best` behind a forecast."""

ROBUST_SETTINGS: Final[Mapping[str, Mapping[str, Any]]] = {
    "SSLGoToBall-v0": {
        "samples": 4 * M,
        "network.initial_policy": "best",
        "network.action_std": 0.15,
        "network.final_action_std": 0.03,
        "sensing": "rc2021, forecast=1",
        # Wider than what teams measure of their own: other simulators are farther away.
        "randomization": {
            "sensing.command_delay": [0.0, 0.06],
            "robot.mass": [0.8, 1.25],
            "robot.acceleration": [0.6, 1.5],
            "robot.speed": [0.8, 1.1],
            "robot.traction": [0.7, 1.2],
            "ball.rolling_deceleration": [0.15, 0.7],
        },
    },
    "SSLContestedPossession-v0": {**_BEHIND_FORECAST, "samples": 30 * M},
    "SSLDribbling-v0": {
        **_BEHIND_FORECAST,
        "samples": 8 * M,
        # A ball that noise shakes off ends an episode that has no need to hurry.
        "ppo.gamma": 0.995,
        "ppo.gae_lambda": 0.97,
        "task_options": {"random_start": True, "reward_weights": {"failed": -1.0}},
    },
    "SSLPassEnduranceMulti-v1": {**_BEHIND_FORECAST, "samples": 20 * M},
}
"""Settings, beside those of the task, of a training that goes on from `best` with senses, by the
name of the task: those of policies `best:robust` that are not distilled."""


def recommended_settings(task: str) -> dict[str, Any]:
    """Return the recommended settings for a task; {} where the defaults are.

    Args:
        task: a registered name or an alias, which has the settings of its task unless
            `TASK_SETTINGS` has some for the alias.
    """
    alias = list_aliases().get(task)
    if task not in TASK_SETTINGS and alias is not None:
        return recommended_settings(alias.task)
    return dict(TASK_SETTINGS.get(task, {}))

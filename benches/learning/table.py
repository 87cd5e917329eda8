"""The experiments of the study: tasks, algorithms and variants with their settings.

Change a line, and `python -m benches.learning --list` shows the runs that it makes stale.
"""

from __future__ import annotations

from typing import Any, Final

from benches.learning import ablation
from benches.learning.experiments import SB3, Experiment, Study
from rsoccer.train.args import Args
from rsoccer.train.task_settings import recommended_settings

M: Final = 1_000_000

SAMPLES: Final = {
    "VSS-v0": 10 * M,
    "VSSMulti-v0": 20 * M,
    "VSSSelfPlay-v0": 20 * M,
    "SSLGoToBall-v0": 3 * M,
    "SSLPassEndurance-v0": 5 * M,
    "SSLContestedPossession-v0": 10 * M,
    "SSLStaticDefenders-v0": 10 * M,
    "SSLDribbling-v0": 10 * M,
    "SSLPassEnduranceMulti-v0": 20 * M,
    "SSLSelfPlay-v0": 20 * M,
}
"""Samples of a PPO run, where the recommended settings of the task set no number."""

PPO_SETTINGS: Final[dict[str, dict[str, Any]]] = {
    task: {"samples": samples, **recommended_settings(task)} for task, samples in SAMPLES.items()
}
"""Settings of each task: those that the package recommends, `rsoccer.train.task_settings`."""

PPO_RUNS: Final = tuple(
    Experiment("ppo", task, task, settings=settings, text=f"PPO on {task}")
    for task, settings in PPO_SETTINGS.items()
)

SHARED_WITH_PPO: Final = ("hidden_sizes", "gamma", "action_repeat", "task_options")

BASELINES: Final = tuple(
    Experiment(
        "baselines",
        f"{task}-{algorithm}",
        task,
        algorithm,
        settings={name: Args.for_task(task).to_json()[name] for name in SHARED_WITH_PPO},
        seeds=3,
        needs=(f"ppo/{task}",),
    )
    for task in PPO_SETTINGS
    if "SelfPlay" not in task
    for algorithm in SB3
)
"""The time of PPO's run, and PPO's network, discount and decision rate."""

CALIBRATION: Final = tuple(
    Experiment(
        "baselines",
        f"VSS-v0-{algorithm}-paper",
        "VSS-v0",
        algorithm,
        settings={
            "seconds": 3600,
            "hidden_sizes": sizes,
            "learning_rate": 1e-4,
            "tau": 1e-3,
            "gamma": 0.95,
            "action_repeat": 1,
            "n_steps": 3,
            "task_options": {"reward_weights": "paper"},
        },
        seeds=1,
    )
    for algorithm, sizes in (("ddpg", [400, 300]), ("sac", [256, 256]))
)
"""The paper's sizes and settings, for an hour; its runs had 2 M gradient steps."""

ABLATION: Final = ablation.experiments("VSS-v0", samples=3 * M, seeds=3)

TEAM: Final = "VSSMulti-v0"
PASSES: Final = "SSLPassEnduranceMulti-v0"
VSSS_OPPONENTS: Final = ("ou", "zero", "chase", "scripted")

COOPERATION: Final = (
    Experiment(
        "cooperation",
        "team-against-clones",
        TEAM,
        "clones",
        settings={"policy": f"@ppo/{TEAM}"},
        opponents=("@ppo/VSS-v0",),
        needs=(f"ppo/{TEAM}", "ppo/VSS-v0"),
        text="shared policy, learned as a team, against three clones of one robot's policy",
    ),
    Experiment(
        "cooperation",
        "team-against-clones-with-free-balls",
        "VSSSelfPlay-v0",
        "clones",
        settings={"policy": f"@ppo/{TEAM}"},
        opponents=("@ppo/VSS-v0",),
        needs=(f"ppo/{TEAM}", "ppo/VSS-v0"),
        text="the same policies where a ball that is stuck leads to a free ball",
    ),
    Experiment(
        "cooperation",
        "one-learner-against-team",
        "VSS-v0",
        "clones",
        settings={"policy": "@ppo/VSS-v0"},
        opponents=(f"@ppo/{TEAM}",),
        needs=(f"ppo/{TEAM}", "ppo/VSS-v0"),
        text="one robot's policy and two robots of noise against the shared policy",
    ),
    Experiment(
        "cooperation",
        "clones",
        TEAM,
        "clones",
        settings={"policy": "@ppo/VSS-v0"},
        opponents=VSSS_OPPONENTS,
        needs=("ppo/VSS-v0",),
        text="three clones of one robot's policy",
    ),
    *(
        Experiment(
            "cooperation",
            f"{task}-central-critic",
            task,
            settings={**PPO_SETTINGS[task], "central_critic": True},
            seeds=3,
            opponents=VSSS_OPPONENTS if task == TEAM else None,
            text="a central critic on the state of the match",
        )
        for task in (TEAM, PASSES)
    ),
    Experiment(
        "cooperation",
        f"{TEAM}-team-only",
        TEAM,
        settings={**PPO_SETTINGS[TEAM], "solo_fraction": 0.0},
        seeds=3,
        text="all learn as a team from the start, without a part with one learner",
    ),
)

STUDY: Final = Study((*PPO_RUNS, *COOPERATION, *ABLATION, *BASELINES, *CALIBRATION))

"""The experiments of the study: tasks, algorithms and variants.

Settings of PPO are those that the package recommends, `rsoccer/train/task_settings.py`. After a
change there or here `python -m benches.learning --list` shows the runs that it makes stale.
"""

from __future__ import annotations

from typing import Final

from benches.learning import ablation
from benches.learning.experiments import Experiment, Study
from benches.learning.robust import ROBUST
from rsoccer.benchmark.protocol import VSSS
from rsoccer.train.args import Args
from rsoccer.train.task_settings import recommended_settings

M: Final = 1_000_000

TASKS: Final = (
    *("VSS-v0", "VSSMulti-v0", "VSSSelfPlay-v0"),
    *("SSLGoToBall-v0", "SSLPassEndurance-v1", "SSLContestedPossession-v0"),
    *("SSLStaticDefenders-v0", "SSLDribbling-v0", "SSLPassEnduranceMulti-v1", "SSLSelfPlay-v0"),
)
"""Tasks in the order of the tables."""

PPO: Final = {
    task: Experiment(
        "ppo",
        task,
        task,
        settings={**recommended_settings(task), "network.central_critic": False},
        text=f"PPO on {task}",
    )
    for task in TASKS
}
"""The experiment of PPO by task, with a critic that reads what the policy reads. A centralized one
is a variant in the group `cooperation`, also where the recommended settings have it."""

SHARED_WITH_PPO: Final = {
    "hidden_sizes": "network.hidden_sizes",
    "gamma": "ppo.gamma",
    "action_repeat": "rollout.action_repeat",
    "task_options": "task_options",
}
"""Settings of the baselines that are those of PPO, by its name for them."""

IN_TIME_OF_PPO: Final[dict[str, dict[str, int]]] = {
    "VSS-v0": {"ddpg": 1_100_000, "sac": 700_000},
    "VSSMulti-v0": {"ddpg": 1_700_000, "sac": 1_000_000},
    "SSLGoToBall-v0": {"ddpg": 180_000, "sac": 110_000},
    "SSLPassEndurance-v1": {"ddpg": 2_000_000, "sac": 1_300_000},
    "SSLContestedPossession-v0": {"ddpg": 2_300_000, "sac": 1_600_000},
    "SSLStaticDefenders-v0": {"ddpg": 2_900_000, "sac": 1_900_000},
    "SSLDribbling-v0": {"ddpg": 300_000, "sac": 180_000},
    "SSLPassEnduranceMulti-v1": {"ddpg": 1_300_000, "sac": 700_000},
}
"""Samples of DDPG and SAC in the time of PPO's run, by task.

Products of PPO's samples and the ratio of the speeds, which
`python -m benches.learning.running.pace` measures in turn. A limit in seconds would depend on what
else the machine does.
"""

BASELINES: Final = tuple(
    Experiment(
        "baselines",
        f"{task}-{algorithm}",
        task,
        algorithm,
        settings={
            "samples": samples,
            **{name: Args.for_task(task).to_json()[own] for name, own in SHARED_WITH_PPO.items()},
        },
        seeds=3,
    )
    for task, row in IN_TIME_OF_PPO.items()
    for algorithm, samples in row.items()
)
"""Samples that the time of PPO's run allows, and PPO's network, discount and decision rate."""

CALIBRATION: Final = tuple(
    Experiment(
        "calibration",
        f"VSS-v0-{algorithm}",
        "VSS-v0",
        algorithm,
        settings={
            "samples": 2 * M,
            "hidden_sizes": sizes,
            "learning_rate": 1e-4,
            "tau": 1e-3,
            "gamma": 0.95,
            "action_repeat": 1,
            "n_steps": 3,
            "task_options": {"reward_weights": "paper"},
            "masked_observations": list(ablation.PAPER_MASK),
        },
        seeds=1,
    )
    for algorithm, sizes in (("ddpg", [400, 300]), ("sac", [256, 256]))
)
"""The paper's sizes, settings and observations, for 0.2 M gradient steps; the paper had 2 M."""

ABLATION: Final = ablation.experiments("VSS-v0", samples=3 * M, seeds=3)

TEAM: Final = "VSSMulti-v0"
PASSES: Final = "SSLPassEnduranceMulti-v1"

COOPERATION: Final = (
    Experiment(
        "cooperation",
        "team-against-clones",
        TEAM,
        "clones",
        settings={"policy": f"@ppo/{TEAM}"},
        opponents=("@ppo/VSS-v0",),
        needs=(PPO[TEAM], PPO["VSS-v0"]),
        text="shared policy, learned as a team, against three clones of one robot's policy",
    ),
    Experiment(
        "cooperation",
        "team-against-clones-with-free-balls",
        "VSSSelfPlay-v0",
        "clones",
        settings={"policy": f"@ppo/{TEAM}"},
        opponents=("@ppo/VSS-v0",),
        needs=(PPO[TEAM], PPO["VSS-v0"]),
        text="the same policies where a ball that is stuck leads to a free ball",
    ),
    Experiment(
        "cooperation",
        "one-learner-against-team",
        "VSS-v0",
        "clones",
        settings={"policy": "@ppo/VSS-v0"},
        opponents=(f"@ppo/{TEAM}",),
        needs=(PPO[TEAM], PPO["VSS-v0"]),
        text="one robot's policy and two robots of noise against the shared policy",
    ),
    Experiment(
        "cooperation",
        "clones",
        TEAM,
        "clones",
        settings={"policy": "@ppo/VSS-v0"},
        opponents=VSSS,
        needs=(PPO["VSS-v0"],),
        text="three clones of one robot's policy",
    ),
    *(
        Experiment(
            "cooperation",
            f"{task}-central-critic",
            task,
            settings={**PPO[task].settings, "network.central_critic": True},
            seeds=3,
            text="a centralized critic, on the state of the match",
        )
        for task in (TEAM, PASSES)
    ),
    Experiment(
        "cooperation",
        f"{TEAM}-team-only",
        TEAM,
        settings={**PPO[TEAM].settings, "opponents.solo_fraction": 0.0},
        seeds=3,
        text="all learn as a team from the start, without a part with one learner",
    ),
)

STUDY: Final = Study((*PPO.values(), *COOPERATION, *ABLATION, *BASELINES, *CALIBRATION, *ROBUST))

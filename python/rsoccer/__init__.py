"""Robot soccer for reinforcement learning: thousands of parallel matches, physics in Rust.

    >>> import rsoccer
    >>> matches = rsoccer.Matches("VSSSelfPlay-v0", worlds=1024, seed=0, threads=2)
    >>> observations = matches.reset()  # (1024, 6, o)

`Matches` steps many matches as arrays. `parallel_env` and `env` are PettingZoo's environments,
`single_env` and `vector_env` Gymnasium's for one learner, `robots_vector_env` its vector
environment with a row for each robot. A `Task` defines observations, actions, rewards and the ends
of episodes, a `Policy` controls robots that do not learn.
"""

from rsoccer import interrupts  # noqa: F401  (first, as it acts while the others are imported)
from rsoccer._core import (
    BALL_PARAMETERS,
    ROBOT_PARAMETERS,
    BallModel,
    Field,
    Forecaster,
    RobotModel,
    Sensing,
    SimConfig,
    Simulator,
    build_info,
)
from rsoccer.envs.aec import env
from rsoccer.envs.parallel import parallel_env
from rsoccer.envs.robots_vector import robots_vector_env
from rsoccer.envs.single import single_env
from rsoccer.envs.vector import vector_env
from rsoccer.evaluate import cooperation, evaluate, tournament
from rsoccer.frame import Frame
from rsoccer.matches import Matches, Outcome
from rsoccer.policies.base import CommandPolicy, Policy
from rsoccer.policies.names import register_policy
from rsoccer.registry import list_tasks, make_task, register
from rsoccer.rng import WorldRng
from rsoccer.rules import Restart, Rule
from rsoccer.task import LEARN, Play, Task
from rsoccer.tasks import (
    SslContestedPossession,
    SslDribbling,
    SslGoToBall,
    SslKeepaway,
    SslPassEndurance,
    SslPassEnduranceMulti,
    SslSelfPlay,
    SslStaticDefenders,
    VssMulti,
    VssSelfPlay,
    VssSingle,
)
from rsoccer.view import View

__all__ = [
    "BALL_PARAMETERS",
    "LEARN",
    "ROBOT_PARAMETERS",
    "BallModel",
    "CommandPolicy",
    "Field",
    "Forecaster",
    "Frame",
    "Matches",
    "Outcome",
    "Play",
    "Policy",
    "Restart",
    "RobotModel",
    "Rule",
    "Sensing",
    "SimConfig",
    "Simulator",
    "SslContestedPossession",
    "SslDribbling",
    "SslGoToBall",
    "SslKeepaway",
    "SslPassEndurance",
    "SslPassEnduranceMulti",
    "SslSelfPlay",
    "SslStaticDefenders",
    "Task",
    "View",
    "VssMulti",
    "VssSelfPlay",
    "VssSingle",
    "WorldRng",
    "__version__",
    "build_info",
    "cooperation",
    "env",
    "evaluate",
    "list_tasks",
    "make_task",
    "parallel_env",
    "register",
    "register_policy",
    "robots_vector_env",
    "single_env",
    "tournament",
    "vector_env",
]

__version__ = str(build_info()["version"])

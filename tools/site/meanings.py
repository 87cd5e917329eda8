"""Texts about tasks that the code does not hold in a form that a program can read.

`tests/tools/test_site.py` compares every table with the registered tasks: a block, an option, a
reward term, a metric or a task without a text fails the tests, and so does a text without use.
"""

from typing import Final, NamedTuple

ROBOT: Final = "robot"
"""Marks a block whose rows are robots: `ROBOT_PARTS` says what one row holds."""


class Part(NamedTuple):
    """Neighbouring numbers of an observation block."""

    size: int
    meaning: str
    unit: str


LENGTH: Final = "half field lengths"
SPEED: Final = "top speeds"

ROBOT_PARTS: Final = (
    Part(2, "position x, y", LENGTH),
    Part(2, "heading: cosine, sine", "1"),
    Part(2, "velocity x, y", SPEED),
    Part(1, "turn rate, positive to the left", "top turn rates"),
    Part(1, "break beam: 1 while the ball interrupts it, else 0", "0 or 1"),
)
"""One robot of an observation; robots without a break beam lack the last part."""

BLOCKS: Final[dict[str, tuple[Part, ...] | str]] = {
    "ego": ROBOT,
    "teammates": ROBOT,
    "opponents": ROBOT,
    "ball_polar": (
        Part(1, "distance from the robot to the ball", LENGTH),
        Part(2, "bearing of the ball from the robot's heading: cosine, sine", "1"),
    ),
    "goal_polar": (
        Part(1, "distance from the robot to the middle of the goal it attacks", LENGTH),
        Part(2, "bearing of that goal from the robot's heading: cosine, sine", "1"),
    ),
    "shot": (
        Part(2, "bearing of the goal from the ball, in the robot's frame: cosine, sine", "1"),
        Part(1, "nearness of the ball: 1 at the robot, 0.38 at 12 cm, 0 far away", "1"),
        Part(1, "nearness times the cosine between ball and goal directions", "1"),
    ),
    "body_velocities": (
        Part(2, "own velocity forward, left", SPEED),
        Part(2, "velocity of the ball forward, left", SPEED),
    ),
    "body_positions": (
        Part(2, "forward and left offsets: of the ball, each teammate, each opponent", LENGTH),
    ),
    "action": (Part(0, "last action of the robot, 0 after a reset", "1"),),
    "gate": (
        Part(2, "offset of the next gate's middle, forward and left", LENGTH),
        Part(1, "direction of the crossing: +1 or -1", "1"),
        Part(1, "share of all gates that are crossed", "1"),
    ),
}
"""Parts of each block, in the order of its last axis. `BALL_PARTS` has those of the ball."""

BALL_PARTS: Final = {
    4: (Part(2, "position x, y", LENGTH), Part(2, "velocity x, y", SPEED)),
    6: (
        Part(3, "position x, y and height of the lowest point", LENGTH),
        Part(3, "velocity x, y and upward", SPEED),
    ),
}
"""Parts of the block `ball` by its size: robots with a break beam get its height too."""

ROWS: Final = {"teammates": "teammate", "opponents": "opponent"}
"""Noun for one row of a block with a row for each robot."""


class Number(NamedTuple):
    """One number of an action."""

    name: str
    meaning: str
    unit: str


ACTIONS: Final = {
    "differential": (
        Number("left wheel", "wheel speed, a share of the top wheel speed", "rad/s"),
        Number("right wheel", "wheel speed, a share of the top wheel speed", "rad/s"),
    ),
    "omni": (
        Number(
            "velocity x", 'towards the goal attacked; forward with `velocity_frame="robot"`', "m/s"
        ),
        Number(
            "velocity y",
            'to the left of it; left of the robot with `velocity_frame="robot"`',
            "m/s",
        ),
        Number("turn rate", "positive to the left", "rad/s"),
        Number("kick", "speed of a straight kick; no kick at or below 0", "m/s"),
        Number("dribbler", "dribbler speed as a share; off at or below 0", "1"),
    ),
}
"""Numbers of an action by kind of drive, each in [-1, 1]."""

REWARDS: Final[dict[str, str]] = {
    "goal": "+1 for a goal of the robot's team, -1 for one of the opponents.",
    "ball_to_goal": "Metres by which the ball came closer to the goal attacked and away from the "
    "own goal: the mean of both.",
    "approach": "Metres by which the ball came closer to the robot's mouth.",
    "energy": "Minus the mean magnitude of the robot's action.",
    "failed": "1 in the step that ends the episode as a failure.",
    "reached": "1 when the ball interrupts the robot's break beam.",
    "left_field": "1 when the robot leaves the field.",
    "gate": "1 for each gate that is crossed in the right direction.",
    "progress": "Metres by which the ball came closer to the middle of the next gate.",
    "received": "1 when blue_1 receives the pass.",
    "ball_to_teammate": "Metres by which the ball came closer to the receiver.",
    "passes": "1 for each completed pass.",
    "VSS:approach": "Metres by which the robot came closer to a point 8 cm behind the ball, seen "
    "from the goal attacked.",
    "VSS:ball_to_goal": "Metres by which the ball came closer to the goal attacked and away from "
    "the own goal: the mean of both. Only the robot of each team that was nearest to the ball.",
    "SSLSelfPlay-v0:ball_to_goal": "Metres by which the ball came closer to the goal attacked and "
    "away from the own goal: the mean of both. Only the robot of each team that was nearest to "
    "the ball.",
    "SSLSelfPlay-v0:approach": "Metres by which the ball came closer to the robot's mouth. Only "
    "the robot of each team that was nearest to the ball.",
    "SSLPassEnduranceMulti-v0:approach": "Metres by which the ball came closer to the mouth of "
    "the robot that did not have it last.",
}
"""Reward terms before their weights. `TASK:term` or `VSS:term` precedes the plain name."""

_MATCH: Final = ("a goal of either team",)
_ATTACK: Final = (
    "a goal",
    "the ball outside the opponents' half, other than through the goal",
    "the attacker outside the opponents' half (0.2 m of tolerance at the middle line) or inside "
    "their goal area",
)
ENDS: Final[dict[str, tuple[str, ...]]] = {
    "SSLContestedPossession-v0": (
        *_ATTACK,
        "contact of the attacker with the opponent above 0.5 m/s; any contact with "
        "`strict_contact=True`",
    ),
    "SSLDribbling-v0": (
        "all gates crossed",
        "contact of blue_0 with another robot",
        "blue_0 outside the bounds of the course",
        "the ball outside the field",
        "a gate crossed in the wrong direction",
    ),
    "SSLGoToBall-v0": ("the ball in the break beam of blue_0", "blue_0 outside the field"),
    "SSLPassEndurance-v0": (
        "the ball in the break beam of blue_1",
        "a pass that cannot arrive: the kicked ball below 0.1 m/s, or above 0.3 m/s on a way "
        "leading away from blue_1",
        "the ball outside the field",
    ),
    "SSLPassEnduranceMulti-v0": (
        "a pass that cannot arrive: the kicked ball below 0.1 m/s, or above 0.3 m/s on a way "
        "leading away from the receiver",
        "the ball outside the field",
    ),
    "SSLSelfPlay-v0": _MATCH,
    "SSLStaticDefenders-v0": (*_ATTACK, "contact of the attacker with an opponent"),
    "VSS-v0": _MATCH,
    "VSSMulti-v0": _MATCH,
    "VSSSelfPlay-v0": _MATCH,
}
"""Events that terminate an episode of each task."""

OPTIONS: Final[dict[str, str]] = {
    "n_blue": "robots of the team that attacks +x",
    "n_yellow": "robots of the other team",
    "max_steps": "control steps of 25 ms until the time limit truncates the episode",
    "ball_speed": "largest speed of the ball at the start, m/s",
    "reward_weights": 'weights by reward term that replace the defaults, or `"paper"` for the '
    "paper's weights",
    "robot": "robot preset; see [Physics](../physics.md#presets)",
    "ball": "ball preset; see [Physics](../physics.md#presets)",
    "field": "field preset; see [Physics](../physics.md#presets)",
    "discrete": "actions are one of a few choices instead of numbers",
    "velocity_frame": 'frame of the velocities in an action: `"field"` (as the team sees the '
    'field, attacking +x) or `"robot"`',
    "n_opponents": "opponents that stand still, 0 to 6",
    "scenario": "one of the official scenarios instead of a random start",
    "strict_contact": "any contact with the opponent ends the episode, as in the paper",
    "teammates": "policy of the teammates: a name or a file",
    "opponent": "policy of the opponents: a name or a file",
    "SSLDribbling-v0:scenario": 'course: `"paper"` (seven crossings) or `"official"` (six)',
    "SSLContestedPossession-v0:scenario": "official scenario 1 to 5 instead of a random start",
    "SSLStaticDefenders-v0:scenario": "official scenario 1 to 10 instead of a random start",
}
"""Options of tasks. `TASK:option` precedes the plain name."""

METRICS: Final[dict[str, str]] = {
    "goal_score": "+1 if blue scored, -1 if yellow scored, else 0",
    "reached": "1 if blue_0 has the ball, else 0",
    "seconds": "duration of the episode, s",
    "gates": "number of gates crossed",
    "received": "1 if the pass was received, else 0",
    "inverse_distance": "1 / (distance between ball and receiver), 1/m: the paper's metric",
    "passes": "number of completed passes of at least 1.5 m",
}
"""Metrics that tasks report at the end of an episode."""

PAGES: Final[dict[str, str]] = {
    "SSLContestedPossession-v0": "Win the ball from an opponent that holds it, then score. This is "
    "hardware challenge 2 of the SSL of 2021.",
    "SSLDribbling-v0": "Keep the ball on the dribbler through gates between standing robots. This "
    "is hardware challenge 3 of the SSL of 2021.",
    "SSLGoToBall-v0": "Drive to the ball and face it. This is the first skill of an SSL robot, and "
    "a good first task for training.",
    "SSLPassEndurance-v0": "Turn to a teammate and pass the ball. This is one pass of hardware "
    "challenge 4 of the SSL of 2021.",
    "SSLPassEnduranceMulti-v0": "Pass the ball to and fro between two learners. This is hardware "
    "challenge 4 of the SSL of 2021.",
    "SSLSelfPlay-v0": "Play a match of the SSL in which both teams learn. There is no referee.",
    "SSLStaticDefenders-v0": "Get the ball and score past opponents that stand still. This is "
    "hardware challenge 1 of the SSL of 2021.",
    "VSS-v0": "Learn as one robot in a match of three against three. This is the single-agent "
    "task of the paper.",
    "VSSMulti-v0": "Learn as a team of three against a team that follows a policy. This is the "
    "multi-agent task of the paper.",
    "VSSSelfPlay-v0": "Play a match of the VSSS in which both teams learn. The demo trains on it.",
}
"""Introduction of each task's page. Its first sentence stands in the list of tasks."""

SOLVERS: Final[dict[str, str]] = {
    "SSLContestedPossession-v0": "strike",
    "SSLDribbling-v0": "weave",
    "SSLGoToBall-v0": "fetch",
    "SSLPassEndurance-v0": "passer",
    "SSLPassEnduranceMulti-v0": "passer",
    "SSLSelfPlay-v0": "strike",
    "SSLStaticDefenders-v0": "strike",
    "VSS-v0": "scripted",
    "VSSMulti-v0": "scripted",
    "VSSSelfPlay-v0": "scripted",
}
"""Shipped policy that plays each task best."""


def text(table: dict[str, str], task: str, name: str) -> str:
    """Return the text for `name`: that of the task, of its league's prefix, or the general one.

    Args:
        table: Texts by name, some of them prefixed as in "VSS:approach".
        task: Name of a registered task.
        name: Name of a term or an option.

    Returns:
        The text; a KeyError names what has none.
    """
    league = "VSS" if task.startswith("VSS") else "SSL"
    for key in (f"{task}:{name}", f"{league}:{name}", name):
        if key in table:
            return table[key]
    raise KeyError(f"{task}: no text for {name!r} in tools/site/meanings.py")


def first_sentence(page: str) -> str:
    """Return the first sentence of an introduction."""
    return page.split(". ")[0].rstrip(".") + "."

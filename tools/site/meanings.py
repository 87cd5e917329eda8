"""Parts of observation blocks and actions, for the task pages.

`tests/tools/test_site.py` compares them with the registered tasks: a missing entry fails the tests,
and so does one without use. `task_docs` reads the other content of the pages from docstrings.
"""

from typing import Final, NamedTuple

ROBOT: Final = "robot"
"""Marks a block whose rows are robots: `ROBOT_PARTS` lists the parts of a row."""


class Part(NamedTuple):
    """Neighboring numbers of an observation block."""

    size: int
    meaning: str
    unit: str


LENGTH: Final = "half field lengths"
SPEED: Final = "top speeds"

ROBOT_PARTS: Final = (
    Part(2, "position x, y", LENGTH),
    Part(2, "heading: cosine, sine", "1"),
    Part(2, "velocity x, y", SPEED),
    Part(1, "angular velocity, counterclockwise positive", "top angular velocities"),
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
    "own_goal_polar": (
        Part(1, "distance from the robot to the middle of its own goal", LENGTH),
        Part(2, "bearing of that goal from the robot's heading: cosine, sine", "1"),
    ),
    "own_goal_shot": (
        Part(2, "bearing of the own goal from the ball, in the robot's frame: cosine, sine", "1"),
        Part(1, "nearness of the ball times the cosine between ball and own goal directions", "1"),
    ),
    "body_velocities": (
        Part(2, "own velocity forward, left", SPEED),
        Part(2, "velocity of the ball forward, left", SPEED),
    ),
    "body_positions": (
        Part(2, "forward and left offsets: of the ball, each teammate, each opponent", LENGTH),
    ),
    "presence": (
        Part(0, "1 if the robot, each teammate, each opponent is on the field, else 0", "0 or 1"),
    ),
    "game": (
        Part(
            12,
            "command of the referee, one of these is 1: halt; stop; ball in play; kick-off, "
            "penalty kick, free kick and ball placement, each of the own team and of the "
            "opponents; free ball",
            "0 or 1",
        ),
        Part(
            7,
            "command after a stop or a placement, at most one of these is 1: kick-off, penalty "
            "kick and free kick, each of the own team and of the opponents; free ball",
            "0 or 1",
        ),
        Part(1, "1 if the robot may touch the ball, else 0", "0 or 1"),
        Part(1, "1 if the robot is the keeper of its team, else 0", "0 or 1"),
        Part(1, "way that the robot has dribbled", "what the rules allow"),
        Part(1, "time until the command ends or the kick has to be taken", "10 s"),
        Part(2, "offset to the place of the next kick, x and y; 0 in play", LENGTH),
        Part(1, "goals of the own team less those of the opponents, -1 to 1", "5 goals"),
        Part(1, "share of the half that is left", "1"),
        Part(2, "share of the robots on the field: own team, opponents", "1"),
    ),
    "action": (Part(0, "last action of the robot, 0 after a reset", "1"),),
    "nearness": (
        Part(
            3,
            "for each opponent, at a gap g between the robots: nearness exp(-g / 0.25 m); the same "
            "times the direction to the opponent, x and y",
            "1",
        ),
    ),
    "possession": (
        Part(1, "time for which the takers have had the ball", "`taking_seconds`"),
        Part(1, "time since the last pass", "`pass_seconds`"),
    ),
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
        Number("left wheel", "wheel speed, as a fraction of the top wheel speed", "rad/s"),
        Number("right wheel", "wheel speed, as a fraction of the top wheel speed", "rad/s"),
    ),
    "omni": (
        Number(
            "velocity x", 'toward the goal attacked; forward with `velocity_frame="robot"`', "m/s"
        ),
        Number(
            "velocity y",
            'to the left of it; left of the robot with `velocity_frame="robot"`',
            "m/s",
        ),
        Number("angular velocity", "counterclockwise positive", "rad/s"),
        Number("kick", "speed of a straight kick; no kick at or below 0", "m/s"),
        Number("dribbler", "dribbler speed, as a fraction of its maximum; off at or below 0", "1"),
        Number("chip", "above 0 a kick is a chip at 45 degrees, else it is flat", "1"),
    ),
}
"""Numbers of an action by kind of drive, each in [-1, 1]; the last one only with `chip_kick`."""

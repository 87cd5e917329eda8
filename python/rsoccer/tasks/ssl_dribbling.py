"""`SSLDribbling-v0`: dribble the ball through gates between robots. Hardware challenge 3."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks, rewards
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.markers import Gate, Marker
from rsoccer.rng import WorldRng
from rsoccer.task import LEARN, Learn, Play
from rsoccer.tasks.courses import COURSES, Course
from rsoccer.tasks.ssl import Ssl, ball_at_mouth
from rsoccer.vectors import rotate_into_body

RANDOM_START_FRACTION: Final = 0.5
"""Fraction of the episodes that start before a random gate with the option `random_start`."""
NEAR_GATE: Final = 0.25
"""Least distance from a gate to the robot in a random initial state, m."""
FAR_GATE: Final = 0.45
"""Greatest distance from a gate to the robot in a random initial state, m."""
MAX_START_TURN: Final = 0.5
"""Greatest difference between a random initial heading and the course's, rad."""


@dataclass(frozen=True)
class SslDribbling(Ssl):
    """SSL slalom in which blue_0 dribbles the ball through the gates between robots at rest.

    Goal of the task: cross all gates of the course in order, each in its direction.

    Initial state: fixed by the course, with the ball in the mouth of blue_0. With `random_start`,
    half of the episodes start before a gate drawn at random, with the crossings before it made.

    The observation has one block more than `Soccer`, "gate" (4,), limit 3: offset from the robot to
    the middle of the next gate, ahead and left, in half field lengths; direction of the crossing,
    +1 or -1; fraction of the crossings made.

    Reward terms, unweighted:

    ============  ==================================================================  =========
    Term          Meaning                                                             Unit
    ============  ==================================================================  =========
    gate          1 if the ball crossed the next gate in its direction                crossings
    progress      decrease of the ball's distance to the next gate                    m
    approach      decrease of the distance between the ball and the mouth             m
    failed        1 if the episode terminates with gates left, else 0                 episodes
    energy        negative mean magnitude of the action                               steps
    ============  ==================================================================  =========

    Termination: all gates crossed; the next gate crossed in the wrong direction; a robot touched;
    blue_0 outside the bounds of the course; the ball off the field. Truncation: after `max_steps`.

    Metric: `gates`, the number of crossings.

    Source: SSL hardware challenges 2021, challenge 3 ("official"), and the rSoccer paper, 2021
    ("paper").
    """

    max_steps: int = 4800
    """Control steps of 25 ms until truncation, at least 1; 4800 are 120 s."""
    scenario: str = "paper"
    """Course: "paper" (seven crossings) or "official" (six)."""
    random_start: bool = False
    """True: start before a random gate in half of the episodes, as training needs all gates."""

    training_options = (*Ssl.training_options, "random_start")
    """Options that change how a policy learns, not how it plays."""
    success = "gates"
    """Metric that measures the success of an episode."""

    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "gate": 5.0,
        "progress": 1.0,
        "approach": 0.5,
        "failed": -2.0,
        "energy": 0.0002,
    }
    """Default weight of each reward term."""
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "gate": 1.0,
        "progress": 0.0,
        "approach": 0.0,
        "failed": 0.0,
        "energy": 0.0,
    }
    """Weights of the rSoccer paper (2021) in these terms."""

    def __post_init__(self) -> None:
        """Validate the options."""
        if self.scenario not in COURSES:
            raise ValueError(f"scenario: expected one of {list(COURSES)}, got {self.scenario!r}")
        checks.boolean("random_start", self.random_start)
        super().__post_init__()

    @property
    def course(self) -> Course:
        """Robots and gates of the scenario."""
        return COURSES[self.scenario]

    @property
    def full_success(self) -> float:
        """Number of crossings of the course."""
        return float(len(self.course.gates))

    @property
    def symmetry(self) -> None:
        """None: each gate has its direction, so the reflected course is another one."""
        return None

    def team_sizes(self) -> tuple[int, int]:
        """Return one dribbling robot and the number of robots that form the gates."""
        return 1, len(self.course.opponents)

    def default_controllers(self) -> dict[str, str | Learn]:
        """Return `LEARN` for blue_0 and "zero" for the others."""
        return dict.fromkeys(self.robots, "zero") | {"blue_0": LEARN}

    def new_memory(self, n: int) -> dict[str, Array]:
        """Create `passed`, (n,) the number of gates crossed."""
        return {"passed": np.zeros(n, np.int64)}

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Place the robots by the course and the ball in the mouth of blue_0."""
        frame = Frame.empty(len(rng), *self.team_sizes())
        x, y, heading = self.course.start
        frame.blue.position[:] = [x, y]
        frame.blue.heading[:] = [np.cos(heading), np.sin(heading)]
        frame.yellow.position[:] = self.course.opponents
        if self.random_start:
            self._place_before_gates(frame, rng)
        frame.ball.position[:] = ball_at_mouth(frame, 0, self.mouth_offset)
        return frame

    def start_episode(self, play: Play) -> None:
        """Draw the crossings made, in `random_start`, from those that lead to the gate ahead."""
        if not self.random_start:
            return
        ahead = self._gates_ahead(play.frame.ball.position)  # (n, gates)
        rank = np.floor(play.rng.uniform(0.0, 1.0) * ahead.sum(axis=1))  # 0 is the first of them
        chosen = ahead & (np.cumsum(ahead, axis=1) == rank[:, None] + 1.0)
        play.memory["passed"][:] = chosen.argmax(axis=1)  # 0 where no gate is ahead

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        """Compute the blocks of `Soccer` and the block "gate" (n, observers, 4)."""
        gate = self._next_gate(play.memory["passed"])
        ego = play.sensed_view.ego
        offset = self._gate_middle(gate)[:, None] - ego.position  # (n, observers, 2)
        ahead, left = rotate_into_body(offset[..., 0], offset[..., 1], ego.heading)
        scale = self.position_scale
        fraction = play.memory["passed"].astype(np.float32) / np.float32(len(self.course.gates))
        ones = np.ones_like(ahead)  # (n, observers)
        columns = [ahead * scale, left * scale]
        columns += [gate[:, 2:] * ones, fraction[:, None] * ones]
        return super().frame_to_observations(play) | {"gate": np.stack(columns, axis=-1)}

    def observation_limits(self) -> dict[str, float]:
        """Return the bounds of `Soccer` and of the block "gate"."""
        return {**super().observation_limits(), "gate": 3.0}

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Compute the reward terms of the class's table; the last gate or a failure terminates."""
        passed = play.memory["passed"]
        gate = self._next_gate(passed)
        before, now = play.last_frame.ball.position, play.frame.ball.position
        forward, backward = self.course.crossed(gate, before, now)
        failed = backward | self._failed(play.frame)
        passed += forward & ~failed
        progress = self.course.gate_distance(gate, before) - self.course.gate_distance(gate, now)
        terms = {
            "gate": rewards.of_blue(play, forward & ~failed),
            "progress": rewards.of_blue(play, progress),
            "approach": rewards.approach_mouth(play, self.config),
            "failed": rewards.of_blue(play, failed),
            "energy": rewards.energy(play),
        }
        complete = passed >= len(self.course.gates)
        return rewards.weighted_terms(terms, self.term_weights), failed | complete

    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        """Return each gate once, in the direction of its next crossing, done after its last."""
        passed = int(play.memory["passed"][world])
        # In reverse order, so that a gate keeps its first crossing of those left.
        gates = {
            (low, high): self._marker(low, high, direction, index < passed)
            for index, (low, high, direction) in reversed(list(enumerate(self.course.gates)))
            if index >= passed
        }
        for low, high, direction in self.course.gates[:passed]:
            gates.setdefault((low, high), self._marker(low, high, direction, True))
        return tuple(gates.values())

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Compute `gates`, (n,) the number of crossings."""
        return {"gates": play.memory["passed"].astype(np.float32)}

    def _place_before_gates(self, frame: Frame, rng: WorldRng) -> None:
        """Move blue_0 before a random gate, about as it faces at the start, in half of the worlds.

        The draws cover a strip from `NEAR_GATE` to `FAR_GATE` before the gate, which is clear of
        the posts.
        """
        course = self.course
        moved = rng.uniform(0.0, 1.0) < RANDOM_START_FRACTION
        gate = course.table[rng.integers(len(course.gates))]
        distance = rng.uniform(NEAR_GATE, FAR_GATE)
        turn = course.start[2] + rng.uniform(-MAX_START_TURN, MAX_START_TURN)
        position = self._gate_middle(gate)
        position[:, course.crosses] -= gate[:, 2] * distance
        frame.blue.position[moved, 0] = position[moved]
        frame.blue.heading[moved, 0] = np.stack([np.cos(turn), np.sin(turn)], axis=-1)[moved]

    def _gates_ahead(self, ball: Floats) -> Mask:
        """(n, gates) gates that balls at (n, 2) can cross in their direction on a straight line."""
        low, high, direction = self.course.table.T
        along, across = ball[:, 1 - self.course.crosses], ball[:, self.course.crosses]
        between = (low < along[:, None]) & (along[:, None] < high)
        before = direction * (across[:, None] - np.float32(self.course.line)) < 0.0
        ahead: Mask = np.logical_and(between, before)
        return ahead

    def _marker(self, low: float, high: float, direction: float, done: bool) -> Gate:
        """Marker of a gate. Toward +x the left post has the greater y, toward +y the lesser x."""
        if self.course.crosses == 0:
            lower, upper = (self.course.line, low), (self.course.line, high)
            return Gate(upper, lower, done) if direction > 0 else Gate(lower, upper, done)
        lower, upper = (low, self.course.line), (high, self.course.line)
        return Gate(lower, upper, done) if direction > 0 else Gate(upper, lower, done)

    def _next_gate(self, passed: Array) -> Floats:
        """(n, 3) rows of the next gates; of the last gate after all crossings."""
        table = self.course.table
        gate: Floats = table[np.minimum(passed, len(table) - 1)]
        return gate

    def _gate_middle(self, gate: Floats) -> Floats:
        """(n, 2) middles of gates, m."""
        middle = np.full((len(gate), 2), self.course.line, np.float32)
        middle[:, 1 - self.course.crosses] = np.float32(0.5) * (gate[:, 0] + gate[:, 1])
        return middle

    def _failed(self, frame: Frame) -> Mask:
        """(n,) whether blue_0 left its bounds or touched a robot, or the ball left the field."""
        (x_min, y_min), (x_max, y_max) = np.array(self.course.bounds, np.float32)
        x, y = frame.blue.position[:, 0].T
        outside = (x < x_min) | (x > x_max) | (y < y_min) | (y > y_max)
        ball_out = self.is_off_field(frame.ball.position)
        failed: Mask = outside | ball_out | (frame.blue.touched_opponent[:, 0] > 0.5)
        return failed

"""`SSLDribbling-v0`: the ball through gates between robots that stand. Hardware challenge 3."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from rsoccer import rewards
from rsoccer.frame import Array, Floats, Frame, Mask
from rsoccer.markers import Gate, Marker
from rsoccer.rng import WorldRng
from rsoccer.task import LEARN, Learn, Play
from rsoccer.tasks.courses import COURSES, Course
from rsoccer.tasks.ssl import Ssl, ball_at_mouth


@dataclass(frozen=True)
class SslDribbling(Ssl):
    """blue_0 starts with the ball on its dribbler; all gates crossed ends it.

    So do: a robot touched, the dribbler out of its bounds, the ball out of the field, and a gate
    crossed the wrong way. `scenario` is "paper" (seven crossings) or "official" (six).
    """

    max_steps: int = 4800  # 120 s
    scenario: str = "paper"

    success = "gates"

    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "gate": 5.0,
        "progress": 1.0,
        "approach": 0.5,
        "failed": -2.0,
        "energy": 0.0002,
    }
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "gate": 1.0,
        "progress": 0.0,
        "approach": 0.0,
        "failed": 0.0,
        "energy": 0.0,
    }

    def __post_init__(self) -> None:
        """Refuse options that make no task, by name."""
        if self.scenario not in COURSES:
            raise ValueError(f"scenario: expected one of {list(COURSES)}, got {self.scenario!r}")
        super().__post_init__()

    @property
    def course(self) -> Course:
        """Robots and gates."""
        return COURSES[self.scenario]

    @property
    def full_success(self) -> float:
        """All gates."""
        return float(len(self.course.gates))

    def team_sizes(self) -> tuple[int, int]:
        """One among those that make the gates."""
        return 1, len(self.course.opponents)

    def default_controllers(self) -> dict[str, str | Learn]:
        """blue_0 learns, the others stand."""
        return dict.fromkeys(self.robots, "zero") | {"blue_0": LEARN}

    def new_memory(self, n: int) -> dict[str, Array]:
        """`passed`: gates crossed so far."""
        return {"passed": np.zeros(n, np.int64)}

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Everything where the course has it, the ball at the dribbler."""
        frame = Frame.empty(len(rng), *self.team_sizes())
        x, y, heading = self.course.start
        frame.blue.position[:] = [x, y]
        frame.blue.heading[:] = [np.cos(heading), np.sin(heading)]
        frame.yellow.position[:] = self.course.opponents
        frame.ball.position[:] = ball_at_mouth(frame, 0, self.reach)
        return frame

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        """Also the next gate: its middle from the robot, its way, and how many are done."""
        gate = self._gate(play.memory["passed"])
        middle = self._points(gate)
        to_gate = middle[:, None] - play.view.ego.position  # (n, observers, 2)
        cos, sin = play.view.ego.heading[..., 0], play.view.ego.heading[..., 1]
        x, y = to_gate[..., 0], to_gate[..., 1]
        per_metre = self.per_metre
        done = play.memory["passed"].astype(np.float32) / np.float32(len(self.course.gates))
        observers = np.ones_like(x)
        parts = [(x * cos + y * sin) * per_metre, (y * cos - x * sin) * per_metre]
        parts += [gate[:, 2:] * observers, done[:, None] * observers]
        return {**super().frame_to_observations(play), "gate": np.stack(parts, axis=-1)}

    def observation_limits(self) -> dict[str, float]:
        """The next gate in half lengths of the field."""
        return {**super().observation_limits(), "gate": 3.0}

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Gates count most; bringing the ball nearer to the next one is paid, keeping it too."""
        passed = play.memory["passed"]
        gate = self._gate(passed)
        before, now = play.last_frame.ball.position, play.frame.ball.position
        right, wrong = self.course.crossed(gate, before, now)
        failed = wrong | self._failed(play.frame)
        passed += right & ~failed
        progress = self.course.way_to_go(gate, before) - self.course.way_to_go(gate, now)
        terms = {
            "gate": (right & ~failed)[:, None].astype(np.float32),
            "progress": progress[:, None],
            "approach": rewards.to_mouth(play, self.config),
            "failed": failed[:, None].astype(np.float32),
            "energy": rewards.energy(play),
        }
        complete = passed >= len(self.course.gates)
        return rewards.weighted(terms, self.reward_weights), failed | complete

    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        """The gates, each once, as its next crossing has it; done when none is left."""
        passed = int(play.memory["passed"][world])
        # From the last crossing back: what stays of each gate is its first crossing that is left.
        gates = {
            (first, last): self._marker(first, last, way, place < passed)
            for place, (first, last, way) in reversed(list(enumerate(self.course.gates)))
            if place >= passed
        }
        for first, last, way in self.course.gates[:passed]:
            gates.setdefault((first, last), self._marker(first, last, way, True))
        return tuple(gates.values())

    def _marker(self, first: float, last: float, way: float, done: bool) -> Gate:
        """A gate of the course; who crosses x upward has greater y to the left, y: lesser x."""
        if self.course.crosses == 0:
            low, high = (self.course.line, first), (self.course.line, last)
            return Gate(high, low, done) if way > 0 else Gate(low, high, done)
        low, high = (first, self.course.line), (last, self.course.line)
        return Gate(low, high, done) if way > 0 else Gate(high, low, done)

    def metrics(self, play: Play) -> dict[str, Floats]:
        """`gates`: how many were crossed."""
        return {"gates": play.memory["passed"].astype(np.float32)}

    def _gate(self, passed: Array) -> Floats:
        """(n, 3) the gate to cross next; the last one once all are."""
        table = self.course.table
        gate: Floats = table[np.minimum(passed, len(table) - 1)]
        return gate

    def _points(self, gate: Floats) -> Floats:
        """(n, 2) middles of gates."""
        points = np.full((len(gate), 2), self.course.line, np.float32)
        points[:, 1 - self.course.crosses] = np.float32(0.5) * (gate[:, 0] + gate[:, 1])
        return points

    def _failed(self, frame: Frame) -> Mask:
        (x_min, y_min), (x_max, y_max) = np.array(self.course.bounds, np.float32)
        x, y = frame.blue.position[:, 0].T
        outside = (x < x_min) | (x > x_max) | (y < y_min) | (y > y_max)
        out = self.is_off_field(frame.ball.position)
        failed: Mask = outside | out | (frame.blue.touched_foe[:, 0] > 0.5)
        return failed

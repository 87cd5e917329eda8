"""`SSLKeepaway-v0`: a team keeps the ball from another one, in an area without goals."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks, rewards, spawn
from rsoccer._core import Field
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame, robot_names
from rsoccer.game import BLUE, YELLOW, EventKind
from rsoccer.markers import Area, Marker
from rsoccer.reflection import Reflection, Symmetry
from rsoccer.rng import WorldRng
from rsoccer.rules import Crossings, Possession, Rule
from rsoccer.task import LEARN, Learn, Play
from rsoccer.tasks import options
from rsoccer.tasks.ssl import Ssl, ball_at_mouth

MIN_PASS_LENGTH: Final = 0.5
"""Least length of a pass, m: more than two robots side by side."""
KEEPER_RING: Final = 0.75
"""Distance of the keepers from the center in the initial state, in half sizes of the area."""
TAKER_BOX: Final = 0.3
"""Half size of the box in which the takers start, in half sizes of the area."""
MIN_TAKER_DISTANCE: Final = 0.3
"""Least distance between takers in the initial state, m."""
MAX_START_ANGLE: Final = np.pi / 2
"""Greatest angle between a keeper's heading and the center in the initial state, radians."""
LEAST_AREA: Final = 1.0
"""Least length and width of the area, m."""
SCRIPTS: Final = {"keepers": "take", "takers": "keep"}
"""Policy of the other team by the team that learns."""
LEARNERS: Final = (*SCRIPTS, "both")
"""Values of the option `learners`."""


@dataclass(frozen=True)
class SslKeepaway(Ssl):
    """SSL task in which blue robots, the keepers, pass to keep the ball from yellow takers.

    Goal of the task: the keepers keep the ball in the area for as long as possible; the takers end
    that. The area is a rectangle around the center of the field, which robots may leave. There are
    no goals.

    Initial state: the keepers on a ring around the center, evenly from a random angle on, at 0.75
    of the way to the border of the area, each turned up to 90 degrees from the center, the ball in
    the mouth of blue_0; the takers at random positions near the center, with random headings.

    The observation has one more block than `Soccer`, `possession` (2 numbers): the share of
    `taking_seconds` for which the takers have had the ball, and the share of `pass_seconds` that
    has gone by without a pass.

    Reward terms, unweighted:

    ============  ==================================================================  ========
    Term          Meaning                                                             Unit
    ============  ==================================================================  ========
    kept          time for which the ball is kept, negative for takers                s
    lost          -1 for keepers that lose the ball, 1 for takers                     episodes
    passes        1 for a pass of the keepers that arrives, to all keepers; its       passes
                  default weight is 0
    approach      decrease of the distance between the ball and the mouth, for each   m
                  team's robot nearest to the ball
    energy        negative mean magnitude of the action                               steps
    ============  ==================================================================  ========

    Termination: the takers have the ball, that is, it interrupts the break beam of takers for
    `taking_seconds` in a row, also if a keeper has it in its mouth, too; the ball is outside the
    area; or no pass of the keepers has arrived for more than `pass_seconds`. Truncation: after
    `max_steps`.

    Metrics: `possession`, time for which the keepers kept the ball, s; `passes`, passes of the
    keepers over at least 0.5 m that arrived; `interceptions`, passes that a taker caught; `taken`,
    1 if the takers got the ball; `left_area`, 1 if it left the area; `no_pass`, 1 if no pass
    arrived in time; `lost`, 1 if any of these ended the episode.

    Source: P. Stone, R. S. Sutton and G. Kuhlmann, "Reinforcement Learning for RoboCup Soccer
    Keepaway" (2005), for the game and its sizes, 3 keepers against 2 takers and 4 against 3; here
    with the robots and the ball of the SSL. A keeper with a dribbler outruns the takers, so that
    the limit to the time without a pass is what makes a team of it.

    Raises:
        TypeError: an option of a wrong type.
        ValueError: an option outside its range, or an area without space for the initial state.
    """

    field: str | Field = "ssl_b"
    """SSL field: "ssl_challenge" (6 x 4 m), "ssl_b" (9 x 6 m), "ssl_a" (12 x 9 m), a .json file or
    a `Field`."""
    n_keepers: int = 3
    """Robots of team blue, 2 to 11."""
    n_takers: int = 2
    """Robots of team yellow, 1 to 11."""
    area_length: float = 5.0
    """Length of the area along x, m, 1 to the length of the field."""
    area_width: float = 5.0
    """Width of the area along y, m, 1 to the width of the field."""
    learners: str = "keepers"
    """Team that learns: "keepers", "takers" or "both"."""
    opponent: str | None = None
    """Policy of the team that does not learn: a policy's name or the path of a policy file; None
    for the script of its part, "take" or "keep"."""
    taking_seconds: float = 0.25
    """Time in a row for which takers must have the ball, s, above 0 to 10."""
    pass_seconds: float = 4.0
    """Longest time in which no pass arrives, from the beginning and from each pass on, s, above 0
    to 1000."""
    max_steps: int = 2400
    """Control steps of 25 ms until truncation, at least 1; 2400 are 60 s."""

    success = "possession"
    """Metric that measures the success of an episode; "lost" if the takers alone learn."""
    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "kept": 1.0,
        "lost": 2.0,
        "passes": 0.0,
        "approach": 0.2,
        "energy": 0.0002,
    }
    """Default weight of each reward term."""
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = REWARD_WEIGHTS
    """The default weights: the paper has no such task."""

    def __post_init__(self) -> None:
        """Validate the options."""
        checks.integer_in_range("n_keepers", self.n_keepers, 2, 11)
        checks.integer_in_range("n_takers", self.n_takers, 1, 11)
        if self.learners not in LEARNERS:
            raise ValueError(f"learners: expected one of {LEARNERS}, got {self.learners!r}")
        if self.opponent is not None:
            options.set_policies(self, "opponent")
        checks.number_in_range("taking_seconds", self.taking_seconds, 1e-3, 10.0)
        checks.number_in_range("pass_seconds", self.pass_seconds, 1e-3, 1000.0)
        super().__post_init__()
        if self.learners == "takers":
            object.__setattr__(self, "success", "lost")
        self._check_starts("n_takers, area_length, area_width")

    def _check_starts(self, option: str) -> None:
        """Raise ValueError unless the area fits into the field, and the initial state into it."""
        field = self.config.field
        checks.number_in_range("area_length", self.area_length, LEAST_AREA, field.length)
        checks.number_in_range("area_width", self.area_width, LEAST_AREA, field.width)
        super()._check_starts(option)

    def team_sizes(self) -> tuple[int, int]:
        """Return the numbers of keepers and of takers."""
        return self.n_keepers, self.n_takers

    @property
    def two_sided(self) -> bool:
        """False: the parts of the teams differ."""
        return False

    @property
    def full_success(self) -> float | None:
        """Value of the metric `success` at full success: the time limit for keepers."""
        if self.success == "lost":
            return 1.0
        return float(np.float32(self.max_steps * self.config.time_step))

    @cached_property
    def rules(self) -> Sequence[Rule]:
        """The lines, and possession with passes of at least 0.5 m."""
        return Crossings(), Possession(MIN_PASS_LENGTH)

    def default_controllers(self) -> dict[str, str | Learn]:
        """Return `LEARN` for the robots of the option `learners`, and a policy for the others."""
        own = self.opponent
        other: str | Learn = SCRIPTS.get(self.learners, LEARN) if own is None else own
        keepers = other if self.learners == "takers" else LEARN
        takers = other if self.learners == "keepers" else LEARN
        controllers: dict[str, str | Learn] = {}
        controllers.update(dict.fromkeys(robot_names(self.n_keepers, 0), keepers))
        controllers.update(dict.fromkeys(robot_names(0, self.n_takers), takers))
        return controllers

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Place the keepers on the ring, the takers near the center, and the ball with blue_0."""
        frame = Frame.empty(len(rng), self.n_keepers, self.n_takers)
        angle = rng.uniform(-np.pi, np.pi)[:, None]
        angle = angle + np.arange(self.n_keepers, dtype=np.float32) * (2 * np.pi / self.n_keepers)
        direction = np.stack([np.cos(angle), np.sin(angle)], axis=-1).astype(np.float32)
        reach = (self.half_area / np.maximum(np.abs(direction), np.float32(1e-6))).min(axis=-1)
        frame.blue.position[:] = direction * (np.float32(KEEPER_RING) * reach)[..., None]
        turn = angle + np.pi + rng.uniform(-MAX_START_ANGLE, MAX_START_ANGLE, (self.n_keepers,))
        frame.blue.heading[:] = np.stack([np.cos(turn), np.sin(turn)], axis=-1)
        box = np.float32(TAKER_BOX) * self.half_area
        radii = [self.config.robot.bounding_radius] * self.n_takers
        frame.yellow.position[:] = spawn.positions_in_box(
            rng, (-box, box), radii, MIN_TAKER_DISTANCE
        )
        frame.yellow.heading[:] = spawn.headings(rng, self.n_takers)
        frame.ball.position[:] = ball_at_mouth(frame, 0, self.mouth_offset)
        return frame

    def new_memory(self, n: int) -> dict[str, Array]:
        """Create the state of possession.

        `since_pass` (n,) are the steps since the last pass, or the beginning; `taken` (n,) those
        for which takers have had the ball.
        """
        return {"since_pass": np.zeros(n, np.int64), "taken": np.zeros(n, np.int64)}

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        """Compute the blocks of `Soccer` and the block `possession`, each (n, observers, ...)."""
        waited, taken = play.memory["since_pass"], play.memory["taken"]
        shares = np.stack([taken / self._taking_steps, waited / self._pass_steps], axis=-1)
        shape = (len(play.frame), len(play.observers), 2)
        possession = np.broadcast_to(shares[:, None].astype(np.float32), shape)
        return super().frame_to_observations(play) | {"possession": possession}

    @property
    def symmetry(self) -> Symmetry | None:
        """Return the reflections of actions and of all blocks."""
        symmetry = super().symmetry
        if symmetry is None:
            return None
        blocks = {**symmetry.blocks, "possession": Reflection.of([1, 1])}
        return Symmetry(symmetry.action, blocks)

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Compute the reward terms of the class's table; the loss of the ball terminates."""
        passes = play.events.by_team(EventKind.PASS)
        self._update_possession(play, passes[:, BLUE] > 0)
        lost = np.logical_or.reduce(list(self._losses(play).values()))
        sign = play.viewpoint.signs  # keepers are blue
        kept = np.full((len(lost), 1), self.config.time_step, np.float32)
        nearest = rewards.nearest_to_ball(play)
        terms = {
            "kept": kept * sign,
            "lost": lost[:, None].astype(np.float32) * -sign,
            "passes": passes[:, play.viewpoint.teams].astype(np.float32)
            * (play.viewpoint.teams == BLUE),
            "approach": rewards.approach_mouth(play, self.config) * nearest,
            "energy": rewards.energy(play),
        }
        return rewards.weighted_terms(terms, self.term_weights), lost

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Compute the metrics of the class's documentation, each (n,)."""
        losses = self._losses(play)
        counts = {
            "passes": play.game.passes[:, BLUE],
            "interceptions": play.game.interceptions[:, YELLOW],
            **losses,
            "lost": np.logical_or.reduce(list(losses.values())),
        }
        possession = (play.steps * self.config.time_step).astype(np.float32)
        counted = {name: values.astype(np.float32) for name, values in counts.items()}
        return {"possession": possession, **counted}

    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        """Return the area."""
        x, y = self.half_area.tolist()
        return (Area((-x, -y), (x, y)),)

    @cached_property
    def half_area(self) -> Floats:
        """(2,) half length and half width of the area, m."""
        return np.array([self.area_length / 2.0, self.area_width / 2.0], np.float32)

    @cached_property
    def _taking_steps(self) -> int:
        """Control steps for which takers must have the ball."""
        return max(1, round(self.taking_seconds / self.config.time_step))

    @cached_property
    def _pass_steps(self) -> int:
        """Control steps in which a pass has to arrive."""
        return max(1, round(self.pass_seconds / self.config.time_step))

    def _losses(self, play: Play) -> dict[str, Mask]:
        """(n,) whether the keepers have lost the ball, by the way in which they did."""
        outside = np.abs(play.frame.ball.position) > self.half_area
        return {
            "taken": play.memory["taken"] >= self._taking_steps,
            "left_area": np.logical_or(outside[:, 0], outside[:, 1]),
            "no_pass": play.memory["since_pass"] > self._pass_steps,
        }

    def _update_possession(self, play: Play, passed: Mask) -> None:
        """Count the steps without a pass, and those for which the takers have had the ball."""
        memory = play.memory
        memory["since_pass"][:] = np.where(passed, 0, memory["since_pass"] + 1)
        takes = np.any(play.frame.yellow.infrared > 0.5, axis=1)
        memory["taken"][:] = np.where(takes, memory["taken"] + 1, 0)

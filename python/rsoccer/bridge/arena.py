"""The match that is served: simulator, senses and referee, one tick at a time."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from rsoccer._core import GAME_COLUMNS, RobotModel, Sensing, SimConfig, Simulator
from rsoccer.arrays import Floats
from rsoccer.bridge.match_tasks import TICK
from rsoccer.frame import Frame
from rsoccer.game import Command
from rsoccer.new_play import initial_rows, new_play, new_viewpoint
from rsoccer.play import Play
from rsoccer.protocols.placing import Placement
from rsoccer.rng import WorldRng
from rsoccer.rules.referee import RefereeRule
from rsoccer.sensing_text import with_number
from rsoccer.simulated_senses import SimulatedSenses
from rsoccer.tasks.match import Match
from rsoccer.view import SIDES

FRAME_RATE: Final = 60.0
"""Frame rate of cameras without `sensing`, Hz."""
_WORLD: Final = np.zeros(1, np.intp)
_MASK: Final = np.ones(1, np.bool_)


class CameraFrame(NamedTuple):
    """Detections of all cameras at one instant, once they have arrived."""

    number: int
    """Number of the frame."""
    seconds: float
    """Time of the exposure, in simulated seconds since the start."""
    balls: Floats
    """(k, 4) index of the camera, position x, y and height, m, of each detected ball."""
    robots: Floats
    """(m, 6) index of the camera, index in a state row, position x and y (m), and cosine and sine
    of the heading of each detected robot."""


class Arena:
    """A match between two teams.

    Attributes:
        task: the task of the match, with steps of one tick.
        play: state of the match; `play.sensed` is current after `sense_for_policies`.
        sensing: senses of the robots.
        config: configuration of the simulator.
        ticks: ticks since the start.
        referee: the referee; None if nobody or somebody else decides.
        camera_frames: frames of the cameras that arrived in the last tick.
    """

    def __init__(
        self,
        task: Match,
        sensing: Sensing | None = None,
        seed: int = 0,
        *,
        referee: str = "own",
        observers: list[int] | None = None,
        forecasting: tuple[str, ...] = (),
    ) -> None:
        """Line the teams up for the first kick-off.

        Args:
            task: the match, from `rsoccer.bridge.match_tasks.make_match`.
            sensing: senses of the robots; None for exact ones at `FRAME_RATE`.
            seed: seed of the first kick-off and of the senses.
            referee: who decides, one of `rsoccer.bridge.settings.REFEREES`; with "off" the ball is
                free for both teams all the time.
            observers: robots with a policy, in the order of a state row; None for none.
            forecasting: teams, "blue" or "yellow", whose policies play from a forecast.

        Raises:
            ValueError: senses that forecast for all, or cameras of each team's own.
        """
        self.task = task
        self.sensing = Sensing(frame_rate=FRAME_RATE) if sensing is None else sensing
        if self.sensing.forecast:
            # All ports tell the same state; only a team itself knows what it has sent.
            raise ValueError("sensing.forecast: expected 0 in a served match, whose teams forecast")
        if self.sensing.own_cameras:
            raise ValueError("sensing.own_cameras: expected 0 in a served match, with one vision")
        self.config = task.config.with_sensing(self.sensing)
        self._forecasting = tuple(SIDES.index(team) for team in forecasting)
        rng = WorldRng.seeded(seed, 1)
        viewpoint = new_viewpoint(task, [] if observers is None else observers)
        self.play: Play = new_play(task, 1, viewpoint, rng.split("task"))
        self._senses_rng = rng.split("senses")
        self.rule = next(rule for rule in task.rules if isinstance(rule, RefereeRule))
        self.referee = self.rule if referee == "own" else None
        self.ticks = 0
        self.camera_frames: list[CameraFrame] = []
        self._frames = 0
        self._is_sensed = False
        rows = initial_rows(task, rng.split("start"))
        self._build(self.config, rows)
        self.play.start(rows)
        self.rule.begin(self.play, _WORLD)
        task.start_episode(self.play)
        if referee == "off":
            self._free_ball()

    def _free_ball(self) -> None:
        """Let both teams play the ball from now on, as nobody starts or stops the match."""
        game = self.play.game
        game.referee[0, GAME_COLUMNS.index("command")] = Command.FORCE_START
        game.referee[0, GAME_COLUMNS.index("in_play")] = 1.0
        game.may_touch[:] = True

    def _build(self, config: SimConfig, rows: Floats) -> None:
        """Make the simulator, with all bodies placed and new senses."""
        simulated = config
        if self._forecasting:
            simulated = config.with_sensing(with_number(self.sensing, "forecast", 1.0))
        simulator = Simulator(simulated, 1, 1)
        simulator.place(_MASK, rows, rows.copy())
        self.simulator, self.config = simulator, config
        frame, rng = Frame(rows, config.n_blue, config.n_yellow), self._senses_rng
        self._known = SimulatedSenses.new(simulator, 1, None, (), frame, rng)
        self._known.begin(frame, _WORLD)
        self.play.senses = self._known
        if self._forecasting:
            known = SimulatedSenses.new(simulator, 1, None, self._forecasting, frame, rng)
            known.sense(frame)
            self.play.senses = known
        self._senses_begun = self.seconds
        self._is_sensed = True

    @property
    def seconds(self) -> float:
        """Simulated time since the start, s."""
        return self.ticks * TICK

    @property
    def frame(self) -> Frame:
        """True state, frame of one world."""
        return self.play.frame

    def sense(self) -> Frame:
        """Return what the robots and trackers know, frame of one world."""
        if not self._is_sensed:
            self._known.sense(self.play.frame)
            self._is_sensed = True
        return self._known.frame

    def sense_for_policies(self) -> None:
        """Bring `play.sensed` up to date: what policies know, by a forecast where they need one."""
        self.sense()
        if self._forecasting:
            self.play.senses.sense(self.play.frame)  # type: ignore[union-attr]  # set by `_build`

    def step(self, commands: Floats) -> None:
        """Advance by one tick, and let the referee decide.

        Args:
            commands: (robots, command) commands of all robots, finite.
        """
        play = self.play
        play.commands[0] = commands
        self.simulator.step(play.commands, play.last_frame.rows)
        play.advance()
        play.steps += 1
        self.ticks += 1
        self._is_sensed = False
        self._take_frames()
        play.events.forget()
        if self.referee is not None:
            restart = self.referee.judge(play)
            if restart is not None:
                self._restart(restart.rows)

    def _take_frames(self) -> None:
        self.camera_frames = []
        for seconds, balls, robots in self.simulator.camera_frames():
            at = self._senses_begun + seconds
            self.camera_frames.append(CameraFrame(self._frames, at, balls, robots))
            self._frames += 1

    def _restart(self, rows: Floats | None) -> None:
        """Put all bodies where the referee has them."""
        assert rows is not None, "the referee restarts with states of all bodies"
        self.simulator.restart(_MASK, rows, self.play.frame.rows)
        self._moved()

    def _moved(self) -> None:
        """Take note of bodies that were put somewhere."""
        play = self.play
        play.last_frame.rows[:] = play.frame.rows
        play.expire_views()
        self._is_sensed = False
        if self.referee is not None:
            self.referee.begin(play, _WORLD)

    def place(self, placement: Placement) -> None:
        """Put ball and robots where a message has them.

        Args:
            placement: the state, and what of it moved.

        Raises:
            ValueError: bodies that overlap or are outside. Nothing has changed.
        """
        rows, out = placement.frame.rows, self.play.frame.rows
        if not (placement.ball or placement.robots.any()):
            return
        if placement.safely:
            self.simulator.place_estimates(_MASK, rows, out)
        elif not placement.robots.any():
            self.simulator.reposition_balls(_MASK, placement.frame.ball.data, out)
        elif not placement.ball:
            self.simulator.reposition_robots(_MASK, placement.robots[None], rows, out)
        else:
            self.simulator.restart(_MASK, rows, out)
        self._moved()

    def exchange_robots(self, models: dict[int, RobotModel]) -> None:
        """Go on with other robots.

        Args:
            models: new models by index in a state row.

        Raises:
            ValueError: robots that overlap, or that the league does not allow. Nothing has changed.
        """
        old = self.config
        robots = [models.get(slot, model) for slot, model in enumerate(old.robots)]
        config = SimConfig(
            old.field,
            old.n_blue,
            old.n_yellow,
            robot=robots,
            ball=old.ball,
            time_step=TICK,
            tick=TICK,
            engine=old.engine,
            sensing=self.sensing,
        )
        self._build(config, self.play.frame.rows.copy())
        self.rule = RefereeRule(config, self.rule.rules)
        self.referee = None if self.referee is None else self.rule
        self._moved()

"""A session: a match in a window, in which a person drives one robot at a time."""

from __future__ import annotations

import math
from typing import Final, Self

import numpy as np

from rsoccer.controllers import Controllers
from rsoccer.frame import team_of
from rsoccer.game import EventKind
from rsoccer.human import screen
from rsoccer.human.controls import Controls
from rsoccer.human.devices import Devices
from rsoccer.human.driver import Driver, human_controllers
from rsoccer.matches import Matches
from rsoccer.randomization import Ranges
from rsoccer.render.announcer import Announcer, named_events
from rsoccer.render.effects import Effects
from rsoccer.render.ghosts import sensed_overlay
from rsoccer.render.image import Image, Renderer, default_width
from rsoccer.render.overlay import task_overlay
from rsoccer.render.referee_state import referee_of, referee_state
from rsoccer.render.scoreboard import GOAL_PAUSE
from rsoccer.render.shapes import Shape
from rsoccer.render.video import MIN_WIDTH
from rsoccer.render.window import Window
from rsoccer.render.words import NOTHING
from rsoccer.sources import SensingSource, SimulatorSource, is_shared
from rsoccer.task import Task

SPEEDS: Final = (0.25, 0.5, 1.0, 2.0, 4.0)
"""Speeds that the keys choose from; 1 is real time."""
DIGIT_PAUSE: Final = 0.8
"""Longest time between the two digits of a robot's number, seconds."""


class Session:
    """A match with a person; `run` plays it in a window, and a `with` statement closes it.

    Attributes:
        driver: the person's robot and controls.
        devices: keyboard and gamepad.
        matches: the match.
        score: goals of blue and of yellow since the session began.
        clock: seconds of play since the session began.
        speed: 1 is real time, 2 is twice as fast.
        paused: the match waits.
        shows_help: the panel with the keys is shown, and the match waits for any input.
        window: the window.
    """

    def __init__(
        self,
        task: Task,
        controllers: Controllers,
        robot: str | None = None,
        *,
        seed: int = 0,
        speed: float = 1.0,
        width: int | None = None,
        names: tuple[str, str] = ("BLUE", "YELLOW"),
        devices: Devices | None = None,
        simulator: SimulatorSource | None = None,
        sensing: SensingSource | None = None,
        randomization: Ranges | None = None,
    ) -> None:
        """Begin the first episode; the window opens with the first image.

        Args:
            task: the task that is played.
            controllers: policies as `Matches` takes them, for all robots; the driven robot
                follows its own again once the person drives another.
            robot: name of the robot to drive first; by default the first learner.
            seed: seed of starts and policies.
            speed: speed of play, above 0: 1 is real time.
            width: width of the picture, 64 to 4096 pixels; by default 720, or more on a large
                field.
            names: names of blue and of yellow on the score board.
            devices: keyboard and gamepad; by default those of this machine.
            simulator: moves the robots, as for `Matches`.
            sensing: what robots know of the true state, as for `Matches`.
            randomization: numbers that each episode draws, as for `Matches`.

        Raises:
            ImportError: a text "module:name" whose module or name does not exist.
            ValueError: a speed that is not positive, an unknown robot, a robot without a policy,
                or a task of neither league.
        """
        if not 0.0 < speed < math.inf:
            raise ValueError(f"speed: expected a positive number, got {speed}")
        self.driver = Driver(task, robot)
        self.devices = Devices() if devices is None else devices
        self.score = (0, 0)
        self.clock = 0.0
        self.speed = speed
        self.paused = False
        self.shows_help = True
        config = task.config
        self.window = Window(task.name, listener=self.devices.handle_event)
        self._renderer = Renderer(
            config,
            default_width(config, MIN_WIDTH) if width is None else width,
            has_referee=referee_of(task) is not None,
        )
        self._effects = Effects(config)
        self._announcer = Announcer(config.field)
        self.matches = Matches(
            task,
            seed=seed,
            controllers=human_controllers(self.driver, controllers),
            autoreset="disabled",
            simulator=simulator,
            sensing=sensing,
            randomization=randomization,
        )
        self._closes_matches = not is_shared(simulator)
        self._events: tuple[Shape, ...] = ()
        self._announcement = NOTHING
        self._names = names
        self._caption = ""
        self._caption_left = 0.0  # seconds until the caption ends
        self._debt = 0.0  # steps that are due
        self._digit = 0  # the last one that was pressed
        self._digit_left = 0.0  # seconds in which a second one may follow
        self.reset()

    def __enter__(self) -> Self:
        """Return the session, which is closed at the end of the `with` statement."""
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the window, and the simulator unless it was given itself."""
        self.window.close()
        if self._closes_matches:
            self.matches.close()

    def run(self, seconds: float = math.inf) -> None:
        """Play until the window is closed.

        Args:
            seconds: longest duration, seconds of the wall clock, counted in images.

        Raises:
            RuntimeError: there is no display.
            ValueError: `seconds` is not above 0.
        """
        if not seconds > 0.0:
            raise ValueError(f"seconds: expected a positive number, got {seconds}")
        time_step = self.matches.task.config.time_step
        shown = 0.0
        while shown < seconds and self.window.show(self.image()):
            # Slow motion shows each step once; a faster match has several steps for an image.
            fraction = min(1.0, self.speed)
            self.window.fps = fraction / time_step
            shown += time_step / fraction
            self.advance(time_step / fraction)
        self.window.close()

    def reset(self) -> None:
        """Begin a new episode; the score stays."""
        self.matches.reset()
        self._effects.clear()
        self._announcer.clear()
        self._events = ()
        self._announcement = NOTHING
        self._caption = ""
        self._debt = 0.0

    def advance(self, seconds: float) -> None:
        """Read the devices, and play as many steps as are due.

        Args:
            seconds: time since the last call.
        """
        commands = self.devices.take_commands()
        controls = self.driver.controls = self.devices.controls()
        if commands != ["help"] and (commands or controls != Controls()):
            self.shows_help = False
        self._digit_left -= seconds
        for command in commands:
            self._obey(command)
        if self._caption:
            self._caption_left -= seconds
            if self._caption_left <= 0.0:
                self._end_caption()
            return
        if self.paused or self.shows_help:
            return
        self._debt += self.speed * seconds / self.matches.task.config.time_step
        while self._debt >= 1.0 - 1e-6 and not self._caption:
            self._debt -= 1.0
            self.step()

    def step(self) -> None:
        """Play one control step; a goal or the end of an episode is shown for a moment."""
        matches = self.matches
        config = matches.task.config
        outcome = matches.step(np.zeros((1, 0, matches.action_size), np.float32))
        self.clock += config.time_step
        self._events = self._effects.update(
            matches.frame.rows[0], self.clock, matches.play.commands[0]
        )
        events = named_events(matches.task, matches.play.events.of_world(0))
        self._announcement = self._announcer.update(events, self.clock)
        blue, yellow = matches.play.events.by_team(EventKind.GOAL)[0].tolist()
        self.score = self.score[0] + blue, self.score[1] + yellow
        if blue or yellow:
            self._caption = "goal"
        elif outcome.ended[0]:
            self._caption = "time" if outcome.truncated[0] else "end"
        else:
            return
        self._caption_left = GOAL_PAUSE

    def image(self) -> Image:
        """Return the current picture.

        Returns:
            (height, width, 3) uint8.
        """
        config = self.matches.task.config
        driver = self.driver
        robots = self.matches.frame.robots
        x, y = robots.position[0, driver.index].tolist()
        model = config.robots[driver.index]
        lines = screen.OMNI_HELP if driver.has_kicker else screen.DIFFERENTIAL_HELP
        return self._renderer.draw(
            self.matches.frame.rows[0],
            score=self.score,
            clock=self.clock,
            names=self._names,
            caption=self._caption,
            referee=referee_state(self.matches.task, self.matches.play),
            announcement=self._announcement,
            extras=(
                *task_overlay(self.matches.task, self.matches.play),
                *sensed_overlay(config, self.matches.play),
                *self._events,
                *(() if self._is_out else screen.selection_shapes(config.field, model, (x, y))),
            ),
            overlay=(
                *screen.status_shapes(config.field, self._left_status(), self._right_status()),
                *(screen.help_shapes(config.field, lines) if self.shows_help else ()),
            ),
        )

    def _end_caption(self) -> None:
        """Go on after the moment in which a caption was shown."""
        if self.matches.done[0]:
            self.reset()
        self._caption = ""

    def _left_status(self) -> list[str]:
        """The driven robot and the state of its switches."""
        driver = self.driver
        name = f"{team_of(driver.robot)} {driver.robot.rpartition('_')[2]}".upper()
        if self._is_out:
            return [name, "off the field"]
        if not driver.has_kicker:
            return [name]
        dribbler = "on" if driver.controls.dribble else "off"
        return [f"{name}, {driver.frame} axes", f"dribbler {dribbler}"]

    @property
    def _is_out(self) -> bool:
        """Whether the driven robot is off the field, after a card say."""
        return bool(self.matches.frame.robots.absent[0, self.driver.index] > 0.0)

    def _right_status(self) -> list[str]:
        """Pause and speed, and the key of the help."""
        return ["PAUSED" if self.paused else f"speed {self.speed:g}", "H: help"]

    def _obey(self, command: str) -> None:
        """Execute a command of the keyboard or the gamepad."""
        if command.startswith("robot_"):
            self._choose(int(command.removeprefix("robot_")))
        elif command in ("faster", "slower"):
            self._change_speed(faster=command == "faster")
        else:
            actions = {
                "next_robot": self.driver.choose_next,
                "pause": self._toggle_pause,
                "step": self._step_once,
                "reset": self.reset,
                "frame": self.driver.change_frame,
                "help": self._toggle_help,
            }
            actions[command]()

    def _choose(self, digit: int) -> None:
        """Drive the robot with this number, or with two digits that follow each other."""
        follows = self._digit_left > 0.0 and self._digit > 0
        if not (follows and self.driver.choose_number(10 * self._digit + digit)):
            self.driver.choose_number(digit)
        self._digit, self._digit_left = digit, DIGIT_PAUSE

    def _change_speed(self, *, faster: bool) -> None:
        """Take the next speed of the list above or below the current one."""
        if faster:
            self.speed = next((s for s in SPEEDS if s > self.speed), self.speed)
        else:
            self.speed = next((s for s in reversed(SPEEDS) if s < self.speed), self.speed)

    def _toggle_pause(self) -> None:
        self.paused = not self.paused

    def _toggle_help(self) -> None:
        self.shows_help = not self.shows_help

    def _step_once(self) -> None:
        if self.paused and not self._caption:
            self.step()

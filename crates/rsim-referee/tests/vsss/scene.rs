//! A match whose bodies are moved by hand between its steps.

use rsim_referee::codes::Command;
use rsim_referee::config::RefereeConfig;
use rsim_referee::events::{Event, EventKind};
use rsim_referee::game::Game;
use rsim_referee::pitch::Pitch;
use rsim_referee::sight::{Layout, Robot};
use rsim_referee::statistics::Statistics;
use rsim_referee::{Decisions, Referee, Team, Vector};

use crate::pitches::{Size, TIME_STEP};

/// Columns of a row, in another order than that of the rules.
const BALL: [&str; 13] = [
    "last_touch",
    "x",
    "y",
    "z",
    "spin_x",
    "spin_y",
    "spin_z",
    "v_x",
    "v_y",
    "v_z",
    "seconds_since_touch",
    "speed_after_touch",
    "height_since_touch",
];
const ROBOT: [&str; 12] = [
    "absent",
    "x",
    "y",
    "v_x",
    "v_y",
    "cos",
    "sin",
    "v_theta",
    "infrared",
    "touched_ball",
    "touched_opponent",
    "collision_speed",
];

/// A match of a size, with the bodies where a test puts them.
pub(crate) struct Scene {
    pub(crate) referee: Referee,
    pub(crate) game: Game,
    /// State from which the next step begins.
    before: Vec<f32>,
    /// The same with what was moved by hand since: the end of the next step.
    pub(crate) row: Vec<f32>,
    /// Whether the last step ended with a restart.
    pub(crate) restarts: bool,
    statistics: Statistics,
    decisions: Decisions,
}

impl Scene {
    /// A match before its kick-off by blue, with the robots of the league, and the bodies at the center.
    pub(crate) fn new(size: Size) -> Self {
        Self::with(size.config(), size.pitch(), [size.robots(); 2])
    }

    pub(crate) fn with(config: RefereeConfig, pitch: Pitch, robots: [usize; 2]) -> Self {
        let layout = Layout::new(&BALL, &ROBOT, robots[0], robots[1]).expect("all columns");
        let mut row = vec![0.0; layout.row_size()];
        row[0] = -1.0;
        for robot in row[BALL.len()..].chunks_mut(ROBOT.len()) {
            robot[column(&ROBOT, "cos")] = 1.0;
        }
        let referee = Referee::new(config, pitch, layout).expect("valid rules");
        Self {
            referee,
            game: Game::new(Team::Blue),
            before: row.clone(),
            row,
            restarts: false,
            statistics: Statistics::default(),
            decisions: Decisions::default(),
        }
    }

    /// A match in its first half with the ball in play and all robots out of the way, in their own halves.
    pub(crate) fn in_play(size: Size) -> Self {
        Self::new(size).kicked_off()
    }

    /// The same with other rules.
    pub(crate) fn in_play_with(size: Size, config: RefereeConfig) -> Self {
        Self::with(config, size.pitch(), [size.robots(); 2]).kicked_off()
    }

    fn kicked_off(mut self) -> Self {
        self.wait_for(Command::NormalStart);
        self.park();
        self.roll([0.0, 0.0], [1.0, 0.0]);
        self.step();
        self
    }

    /// Puts all robots in lines beside the touch line at -y, out of all areas.
    pub(crate) fn park(&mut self) {
        let y = 0.1 - self.referee.pitch().lines.half_width;
        for team in Team::BOTH {
            for nth in 0..self.referee.layout().team_size(team) {
                let x = team.own_side() * (0.1 + 0.1 * as_number(nth));
                self.robot(team, nth, [x, y]);
            }
        }
    }

    /// Moves the ball, at rest.
    pub(crate) fn ball(&mut self, place: [f32; 2]) {
        self.roll(place, [0.0, 0.0]);
    }

    /// Moves the ball and sets its velocity.
    pub(crate) fn roll(&mut self, [x, y]: [f32; 2], [v_x, v_y]: [f32; 2]) {
        for (name, value) in [("x", x), ("y", y), ("v_x", v_x), ("v_y", v_y)] {
            self.row[column(&BALL, name)] = value;
        }
    }

    /// Sets the height of the ball's lowest point.
    pub(crate) fn lift(&mut self, height: f32) {
        self.row[column(&BALL, "z")] = height;
    }

    /// Moves a robot.
    pub(crate) fn robot(&mut self, team: Team, nth: usize, [x, y]: [f32; 2]) {
        self.set(team, nth, "x", x);
        self.set(team, nth, "y", y);
    }

    /// Sets a column of a robot.
    pub(crate) fn set(&mut self, team: Team, nth: usize, name: &str, value: f32) {
        let index = self.index(team, nth);
        self.row[BALL.len() + index * ROBOT.len() + column(&ROBOT, name)] = value;
    }

    /// Lets a robot touch the ball in the next step.
    pub(crate) fn touch(&mut self, team: Team, nth: usize) {
        self.set(team, nth, "touched_ball", 1.0);
        self.row[column(&BALL, "last_touch")] = as_number(self.index(team, nth));
    }

    /// Index of a robot in the order of a row.
    pub(crate) fn index(&self, team: Team, nth: usize) -> usize {
        match team {
            Team::Blue => nth,
            Team::Yellow => self.referee.layout().team_size(Team::Blue) + nth,
        }
    }

    /// Ends a step, and goes on from the restart if there is one. Returns its events.
    pub(crate) fn step(&mut self) -> Vec<Event> {
        let mut restart = vec![f32::NAN; self.row.len()];
        self.referee
            .judge(
                &self.before,
                &self.row,
                &mut self.game,
                &mut self.statistics,
                &mut restart,
                &mut self.decisions,
            )
            .expect("rows of this layout");
        self.restarts = self.decisions.restarts;
        if self.restarts {
            self.row = restart;
        }
        self.let_go();
        self.before.clone_from(&self.row);
        self.decisions.events.clone()
    }

    /// Ends the touches of the last step.
    fn let_go(&mut self) {
        for team in Team::BOTH {
            for nth in 0..self.referee.layout().team_size(team) {
                self.set(team, nth, "touched_ball", 0.0);
            }
        }
    }

    /// Lets time pass with all bodies where they are. Returns all events.
    pub(crate) fn run(&mut self, seconds: f32) -> Vec<Event> {
        (0..steps(seconds)).flat_map(|_| self.step()).collect()
    }

    /// The same up to the first event. Returns it and the number of steps; fails if another one comes with it.
    pub(crate) fn first_event(&mut self, seconds: f32) -> Option<(usize, Event)> {
        (1..=steps(seconds)).find_map(|nth| {
            let events = self.step();
            assert!(events.len() <= 1, "more than one decision: {events:?}");
            events.first().map(|event| (nth, *event))
        })
    }

    /// Lets time pass up to a command. Returns the number of steps.
    pub(crate) fn wait_for(&mut self, command: Command) -> usize {
        let found = (1..=steps(60.0)).find(|_| {
            self.step();
            self.game.command == command
        });
        found.unwrap_or_else(|| panic!("no {command:?}, but {:?}", self.game))
    }

    /// The only event of a step.
    pub(crate) fn step_to(&mut self, kind: EventKind) -> Event {
        let events = self.step();
        let [event] = events[..] else { panic!("expected {kind:?}, got {events:?}") };
        assert_eq!(event.kind, kind);
        event
    }

    /// Robots on the field.
    pub(crate) fn robots(&self) -> Vec<Robot> {
        self.referee.layout().sight(&self.row).expect("its row").robots().collect()
    }

    /// Position of a robot.
    pub(crate) fn position(&self, team: Team, nth: usize) -> Vector {
        let sight = self.referee.layout().sight(&self.row).expect("its row");
        sight.robot(self.index(team, nth)).expect("it is on the field").position
    }

    /// Position of the ball.
    pub(crate) fn ball_position(&self) -> Vector {
        self.referee.layout().sight(&self.row).expect("its row").ball().position
    }
}

/// A place in coordinates in which a team attacks +x, as one of the field; left stays left.
pub(crate) fn seen_by(team: Team, [x, y]: [f32; 2]) -> [f32; 2] {
    [-team.own_side() * x, y]
}

/// Steps in a time, s.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few thousand
pub(crate) fn steps(seconds: f32) -> usize {
    (seconds / TIME_STEP).round() as usize
}

/// A small index as a number of a row.
#[allow(clippy::cast_precision_loss)]
fn as_number(index: usize) -> f32 {
    index as f32
}

fn column(names: &[&str], name: &str) -> usize {
    names.iter().position(|other| *other == name).expect("a column")
}

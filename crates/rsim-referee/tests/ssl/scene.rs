//! Scenes of a match without physics: a test places ball and robots, says who touches what, and judges steps.
//!
//! A scene is told from the side of one team, "us", that attacks the goal at +x. [`views`] gives the same scene
//! for both teams, and reflected across the field, so that every test covers all sides.

use rsim_referee::codes::{Command, Stage};
use rsim_referee::config::{Placement, RefereeConfig};
use rsim_referee::events::EventKind;
use rsim_referee::game::Game;
use rsim_referee::pitch::Pitch;
use rsim_referee::sight::{Layout, Placed, Robot, Sight};
use rsim_referee::statistics::Statistics;
use rsim_referee::{Decisions, Lines, Referee, Team, Vector};

pub(crate) const BALL: [&str; 10] =
    ["x", "y", "z", "v_x", "v_y", "v_z", "spin_x", "spin_y", "spin_z", "last_touch"];
pub(crate) const ROBOT: [&str; 12] = [
    "x",
    "y",
    "cos",
    "sin",
    "v_x",
    "v_y",
    "v_theta",
    "infrared",
    "touched_ball",
    "touched_opponent",
    "collision_speed",
    "absent",
];

/// Duration of a step, s.
pub(crate) const TIME_STEP: f32 = 0.025;
/// Radius of a robot, m.
pub(crate) const ROBOT_RADIUS: f32 = 0.09;
/// Radius of the ball, m.
pub(crate) const BALL_RADIUS: f32 = 0.0215;

/// Division of SSL.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Division {
    A,
    B,
}
pub(crate) use Division::{A, B};

/// Team, as the scene sees it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Us,
    Them,
}
pub(crate) use Side::{Them, Us};

impl Side {
    pub(crate) const BOTH: [Self; 2] = [Us, Them];

    pub(crate) fn opponent(self) -> Self {
        if self == Us { Them } else { Us }
    }
}

/// A robot of a team by its number; 0 is the keeper.
pub(crate) type Bot = (Side, usize);

/// An event, as the scene sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Seen {
    pub(crate) kind: EventKind,
    pub(crate) side: Option<Side>,
    pub(crate) bot: Option<Bot>,
    pub(crate) at: (f32, f32),
}

/// Lines of a field of division A or B. Source: ssl-rules 4300196, chapter "Playing Environment".
pub(crate) fn lines(division: Division) -> Lines {
    let b = Lines {
        half_length: 4.5,
        half_width: 3.0,
        half_goal_width: 0.5,
        goal_height: 0.16,
        area_depth: 1.0,
        half_area_width: 1.0,
        inner_area_depth: 0.0,
        half_inner_area_width: 0.0,
        line_width: 0.01,
        corner_leg: 0.0,
        goal_wall_thickness: 0.02,
        center_circle_radius: 0.5,
        penalty_mark_distance: 6.0,
        boundary_x: 4.8,
        boundary_y: 3.3,
        free_ball_x: 0.0,
        free_ball_y: 0.0,
    };
    match division {
        B => b,
        A => Lines {
            half_length: 6.0,
            half_width: 4.5,
            half_goal_width: 0.9,
            area_depth: 1.8,
            half_area_width: 1.8,
            penalty_mark_distance: 8.0,
            boundary_x: 6.6,
            boundary_y: 4.8,
            ..b
        },
    }
}

/// A referee of a division.
pub(crate) fn referee(division: Division, change: impl FnOnce(&mut RefereeConfig)) -> Referee {
    let (preset, size) = match division {
        A => ("ssl_2026_a", 11),
        B => ("ssl_2026_b", 6),
    };
    let mut config = RefereeConfig::preset(preset).expect("a preset");
    change(&mut config);
    let pitch = Pitch {
        lines: lines(division),
        robot_radius: ROBOT_RADIUS,
        ball_radius: BALL_RADIUS,
        time_step: TIME_STEP,
    };
    let layout = Layout::new(&BALL, &ROBOT, size, size).expect("all columns");
    Referee::new(config, pitch, layout).expect("a valid configuration")
}

/// A match in the hands of a test.
pub(crate) struct Scene {
    pub(crate) referee: Referee,
    pub(crate) game: Game,
    us: Team,
    /// 1, or -1 in a scene that is reflected across the field.
    aside: f32,
    before: Vec<f32>,
    row: Vec<f32>,
    decisions: Decisions,
    events: Vec<Seen>,
    pub(crate) restarted: bool,
}

/// The same scene for both teams, and reflected. Robots stand in the line-up of a kick-off, the ball in the
/// center; the first half has begun, and the ball is free for all.
pub(crate) fn views(division: Division) -> impl Iterator<Item = Scene> {
    views_with(division, |_| {})
}

/// The same, with other numbers or switches of the rules.
pub(crate) fn views_with(
    division: Division,
    change: impl Fn(&mut RefereeConfig),
) -> impl Iterator<Item = Scene> {
    Team::BOTH
        .into_iter()
        .flat_map(|us| [1.0, -1.0].map(|aside| (us, aside)))
        .map(move |(us, aside)| Scene::new(referee(division, &change), us, aside))
}

/// The same, where robots place the ball.
pub(crate) fn views_with_placement(division: Division) -> impl Iterator<Item = Scene> {
    views_with(division, |config| config.placement = Placement::Robots)
}

impl Scene {
    fn new(referee: Referee, us: Team, aside: f32) -> Self {
        let mut row = vec![0.0; referee.layout().row_size()];
        row[BALL.len() - 1] = -1.0;
        referee.line_up(&mut row).expect("a row of this layout");
        let mut scene = Self {
            referee,
            game: Game::new(us),
            us,
            aside,
            before: row.clone(),
            row,
            decisions: Decisions::default(),
            events: Vec::new(),
            restarted: false,
        };
        scene.game.stage = Stage::FirstHalf;
        scene.game.stage_steps_left = scene.steps(300.0);
        scene.free();
        scene
    }

    // Teams, places and times.

    /// Team of a side.
    pub(crate) fn team(&self, side: Side) -> Team {
        if side == Us { self.us } else { self.us.opponent() }
    }

    fn side(&self, team: Team) -> Side {
        if team == self.us { Us } else { Them }
    }

    fn index(&self, (side, number): Bot) -> usize {
        let first = if self.team(side) == Team::Blue { 0 } else { self.size() };
        assert!(number < self.size(), "no such robot");
        first + number
    }

    /// Robots of a team.
    pub(crate) fn size(&self) -> usize {
        self.referee.layout().team_size(Team::Blue)
    }

    /// A place of the scene on the field; it is its own inverse.
    fn turn(&self, (x, y): (f32, f32)) -> Vector {
        let ahead = -self.us.own_side();
        Vector::new(ahead * x, ahead * self.aside * y)
    }

    fn back(&self, place: Vector) -> (f32, f32) {
        let turned = self.turn((place.x, place.y));
        (turned.x, turned.y)
    }

    /// Steps in a time.
    pub(crate) fn steps(&self, seconds: f32) -> i32 {
        self.referee.pitch().steps(seconds)
    }

    // Bodies.

    fn robot_column(&mut self, bot: Bot, name: &str) -> &mut f32 {
        let first = BALL.len() + self.index(bot) * ROBOT.len();
        let place = ROBOT.iter().position(|column| *column == name).expect("a column");
        &mut self.row[first + place]
    }

    /// Puts the ball somewhere, at rest.
    pub(crate) fn ball(&mut self, x: f32, y: f32) {
        let place = self.turn((x, y));
        let touch = self.row[BALL.len() - 1];
        self.row[..BALL.len()].fill(0.0);
        (self.row[0], self.row[1]) = (place.x, place.y);
        self.row[BALL.len() - 1] = touch;
    }

    /// Gives the ball a velocity.
    pub(crate) fn ball_velocity(&mut self, x: f32, y: f32, up: f32) {
        let velocity = self.turn((x, y));
        (self.row[3], self.row[4], self.row[5]) = (velocity.x, velocity.y, up);
    }

    /// Lifts the ball.
    pub(crate) fn ball_height(&mut self, height: f32) {
        self.row[2] = height;
    }

    /// Place of the ball.
    pub(crate) fn ball_at(&self) -> (f32, f32) {
        self.back(Vector::new(self.row[0], self.row[1]))
    }

    /// Puts a robot somewhere, at rest.
    pub(crate) fn robot(&mut self, bot: Bot, x: f32, y: f32) {
        let placed = Placed { robot: self.index(bot), position: self.turn((x, y)), faces: None };
        self.referee.layout().put_robot(&mut self.row, &placed);
    }

    /// Gives a robot a velocity.
    pub(crate) fn robot_velocity(&mut self, bot: Bot, x: f32, y: f32) {
        let velocity = self.turn((x, y));
        *self.robot_column(bot, "v_x") = velocity.x;
        *self.robot_column(bot, "v_y") = velocity.y;
    }

    /// Place of a robot; `None` for one that is absent.
    pub(crate) fn robot_at(&self, bot: Bot) -> Option<(f32, f32)> {
        self.sight().robot(self.index(bot)).map(|robot| self.back(robot.position))
    }

    /// Takes a robot off the field, as its team does.
    pub(crate) fn take_out(&mut self, bot: Bot) {
        *self.robot_column(bot, "absent") = 1.0;
    }

    /// Robots of a team on the field.
    pub(crate) fn count(&self, side: Side) -> usize {
        self.sight().count(self.team(side))
    }

    /// A robot touches the ball in the next step.
    pub(crate) fn touch(&mut self, bot: Bot) {
        *self.robot_column(bot, "touched_ball") = 1.0;
        self.row[BALL.len() - 1] = f32::from(u8::try_from(self.index(bot)).expect("few robots"));
    }

    /// A robot has the ball between its jaws in the next step, without touching it.
    pub(crate) fn hold(&mut self, bot: Bot) {
        *self.robot_column(bot, "infrared") = 1.0;
    }

    /// Two opponents touch each other in the next step, with a closing speed.
    pub(crate) fn collide(&mut self, first: Bot, second: Bot, speed: f32) {
        for bot in [first, second] {
            *self.robot_column(bot, "touched_opponent") = 1.0;
            *self.robot_column(bot, "collision_speed") = speed;
        }
    }

    /// The bodies as a row.
    pub(crate) fn row(&self) -> &[f32] {
        &self.row
    }

    /// Takes over the bodies of another scene.
    pub(crate) fn take_state(&mut self, other: &Self) {
        self.row.clone_from(&other.row);
        self.before.clone_from(&other.before);
    }

    /// The state of the bodies.
    pub(crate) fn sight(&self) -> Sight<'_> {
        self.referee.layout().sight(&self.row).expect("a row of this layout")
    }

    /// All robots on the field.
    pub(crate) fn robots(&self) -> Vec<Robot> {
        self.sight().robots().collect()
    }

    // The match.

    /// Goes on as after a force start.
    pub(crate) fn free(&mut self) {
        self.game.kick = Some(Command::ForceStart);
        self.game.give(Command::ForceStart, None);
        self.game.in_play = true;
        self.settle();
    }

    /// A team may take a free kick from where the ball is.
    pub(crate) fn free_kick(&mut self, side: Side) {
        self.allow(Command::DirectFree(self.team(side)));
        self.game.give(Command::DirectFree(self.team(side)), None);
    }

    /// A team may take its kick-off.
    pub(crate) fn kickoff(&mut self, side: Side) {
        self.ball(0.0, 0.0);
        self.allow(Command::PrepareKickoff(self.team(side)));
        self.game.give(Command::NormalStart, None);
    }

    /// A team may take a penalty kick. All others are behind the ball, the keepers in their goals.
    pub(crate) fn penalty(&mut self, side: Side) {
        self.stop(Command::PreparePenalty, side, self.penalty_mark(side));
        self.run(30.0, |scene| scene.game.command == Command::NormalStart);
        self.game.command_steps = 0;
    }

    /// The mark of the penalty kick of a team.
    pub(crate) fn penalty_mark(&self, side: Side) -> (f32, f32) {
        let lines = &self.referee.pitch().lines;
        let x = lines.half_length - lines.penalty_mark_distance;
        (if side == Us { x } else { -x }, 0.0)
    }

    fn allow(&mut self, kick: Command) {
        self.game.kick = Some(kick);
        self.game.in_play = false;
        let (x, y) = self.ball_at();
        self.game.designated_position = self.turn((x, y));
        self.game.kick_position = self.game.designated_position;
        self.settle();
    }

    /// Stops play, before a command for a team with the ball at a place.
    pub(crate) fn stop(&mut self, next: fn(Team) -> Command, side: Side, place: (f32, f32)) {
        self.stop_for(next(self.team(side)), place);
    }

    /// Stops play, before a command.
    pub(crate) fn stop_for(&mut self, next: Command, place: (f32, f32)) {
        self.game.in_play = false;
        self.game.give(Command::Stop, Some(next));
        self.game.wait_steps = self.steps(2.0);
        self.game.designated_position = self.turn(place);
        self.settle();
    }

    /// Makes the present bodies those before the next step, as after a restart.
    pub(crate) fn settle(&mut self) {
        self.before.copy_from_slice(&self.row);
        self.game.stuck_position = self.sight().ball().position;
        self.game.stuck_steps = 0;
    }

    /// Judges a step that ends with the bodies where the test put them.
    pub(crate) fn step(&mut self) {
        let mut statistics = Statistics::default();
        let mut restart = vec![0.0; self.row.len()];
        self.referee
            .judge(
                &self.before,
                &self.row,
                &mut self.game,
                &mut statistics,
                &mut restart,
                &mut self.decisions,
            )
            .expect("rows of this layout");
        self.events = self.decisions.events.iter().map(|event| self.seen(event)).collect();
        self.restarted = self.decisions.restarts;
        if self.restarted {
            self.row = restart;
        }
        self.clear_touches();
        self.before.copy_from_slice(&self.row);
    }

    fn seen(&self, event: &rsim_referee::events::Event) -> Seen {
        let bot = event.robot.map(|index| {
            let team = self.referee.layout().team_of(index);
            (self.side(team), if team == Team::Blue { index } else { index - self.size() })
        });
        let side = event.team.map(|team| self.side(team));
        Seen { kind: event.kind, side, bot, at: self.back(event.position) }
    }

    fn clear_touches(&mut self) {
        for side in Side::BOTH {
            for number in 0..self.size() {
                for name in ["infrared", "touched_ball", "touched_opponent", "collision_speed"] {
                    *self.robot_column((side, number), name) = 0.0;
                }
            }
        }
    }

    /// Judges steps in which nothing moves, for a time. Returns all events.
    pub(crate) fn wait(&mut self, seconds: f32) -> Vec<Seen> {
        let mut events = Vec::new();
        for _ in 0..self.steps(seconds) {
            self.step();
            events.append(&mut self.events);
        }
        self.events.clone_from(&events);
        events
    }

    /// Judges steps in which nothing moves, until something is true. Returns all events.
    pub(crate) fn run(&mut self, seconds: f32, until: impl Fn(&Self) -> bool) -> Vec<Seen> {
        let mut events = Vec::new();
        for _ in 0..self.steps(seconds) {
            if until(self) {
                break;
            }
            self.step();
            events.append(&mut self.events);
        }
        assert!(until(self), "not within {seconds} s: {:?}", self.game);
        self.events.clone_from(&events);
        events
    }

    /// A robot kicks the ball from where it is to another place, in one step.
    pub(crate) fn kick(&mut self, bot: Bot, x: f32, y: f32) {
        self.touch(bot);
        self.ball(x, y);
        self.step();
    }

    // What the referee decided.

    /// Events of the last step, or of the last wait.
    pub(crate) fn events(&self) -> &[Seen] {
        &self.events
    }

    /// Events of a kind among them.
    pub(crate) fn count_of(&self, kind: EventKind) -> usize {
        self.events.iter().filter(|event| event.kind == kind).count()
    }

    /// The only event of a kind.
    pub(crate) fn only(&self, kind: EventKind) -> Seen {
        let mut found = self.events.iter().filter(|event| event.kind == kind);
        let first = *found.next().unwrap_or_else(|| panic!("no {kind:?} in {:?}", self.events));
        assert!(found.next().is_none(), "more than one {kind:?} in {:?}", self.events);
        first
    }

    /// Checks that a robot is at fault, or has scored, at a place.
    pub(crate) fn expect_bot(&self, kind: EventKind, bot: Bot, at: (f32, f32)) {
        let event = self.only(kind);
        assert_eq!((event.side, event.bot), (Some(bot.0), Some(bot)), "{event:?}");
        expect_near(event.at, at);
    }

    /// Checks that an event is about a team, and no robot of it.
    pub(crate) fn expect_team(&self, kind: EventKind, side: Option<Side>, at: (f32, f32)) {
        let event = self.only(kind);
        assert_eq!((event.side, event.bot), (side, None), "{event:?}");
        expect_near(event.at, at);
    }

    /// Checks that nothing happened, and play runs.
    pub(crate) fn expect_play(&self) {
        assert_eq!(self.events, [], "{:?}", self.game.command);
        assert!(self.game.is_running(), "{:?}", self.game.command);
    }

    /// Checks that play is stopped before a command for a team, with the ball at a place.
    pub(crate) fn expect_next(&self, next: fn(Team) -> Command, side: Side, place: (f32, f32)) {
        self.expect_next_for(next(self.team(side)), place);
    }

    /// Checks that play is stopped before a command, with the ball at a place.
    pub(crate) fn expect_next_for(&self, next: Command, place: (f32, f32)) {
        assert_eq!((self.game.command, self.game.next_command), (Command::Stop, Some(next)));
        expect_near(self.back(self.game.designated_position), place);
    }

    /// Checks the command.
    pub(crate) fn expect_command(&self, command: fn(Team) -> Command, side: Side) {
        assert_eq!(self.game.command, command(self.team(side)));
    }

    /// Checks the fouls of us and of them.
    pub(crate) fn expect_fouls(&self, us: i32, them: i32) {
        assert_eq!((self.fouls(Us), self.fouls(Them)), (us, them));
    }

    /// Fouls of a team.
    pub(crate) fn fouls(&self, side: Side) -> i32 {
        self.game.fouls[self.team(side)]
    }

    /// Goals of us and of them.
    pub(crate) fn score(&self) -> (i32, i32) {
        (self.game.score[self.team(Us)], self.game.score[self.team(Them)])
    }
}

/// Checks that two places are the same, but for rounding.
#[track_caller]
pub(crate) fn expect_near(got: (f32, f32), expected: (f32, f32)) {
    let distance = (got.0 - expected.0).hypot(got.1 - expected.1);
    assert!(distance < 2e-3, "expected {expected:?}, got {got:?}");
}

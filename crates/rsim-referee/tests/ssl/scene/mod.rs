//! Scenes of a match without physics: a test places ball and robots, says who touches what, and judges steps.
//!
//! A scene is described from the side of one team, "us", that attacks the goal at +x. [`views`] gives the same scene
//! for both teams, and reflected across the field, so that every test covers all sides.

mod bodies;
mod decisions;
mod field;
mod steps;

use rsim_referee::codes::Stage;
use rsim_referee::config::{Placement, RefereeConfig};
use rsim_referee::events::EventKind;
use rsim_referee::game::Game;
use rsim_referee::statistics::Statistics;
use rsim_referee::{Decisions, Referee, Team, Vector};

pub(crate) use bodies::{BALL, ROBOT};
pub(crate) use decisions::expect_near;
pub(crate) use field::{A, B, BALL_RADIUS, Division, ROBOT_RADIUS, TIME_STEP, referee};

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

/// A match in the hands of a test.
pub(crate) struct Scene {
    pub(crate) referee: Referee,
    pub(crate) game: Game,
    pub(crate) statistics: Statistics,
    us: Team,
    /// 1, or -1 in a scene that is reflected across the field.
    aside: f32,
    before: Vec<f32>,
    row: Vec<f32>,
    decisions: Decisions,
    events: Vec<Seen>,
    /// Speed and height that the test says of the next step.
    since_touch: Option<(f32, f32)>,
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
        referee.line_up(&mut row, 0).expect("a row of this layout");
        let mut scene = Self {
            referee,
            game: Game::new(us),
            statistics: Statistics::default(),
            us,
            aside,
            before: row.clone(),
            row,
            decisions: Decisions::default(),
            events: Vec::new(),
            since_touch: None,
            restarted: false,
        };
        scene.game.stage = Stage::FirstHalf;
        scene.game.stage_steps_left = scene.steps(300.0);
        scene.free();
        scene
    }

    /// Team of a side.
    pub(crate) fn team(&self, side: Side) -> Team {
        if side == Us { self.us } else { self.us.opponent() }
    }

    fn side(&self, team: Team) -> Side {
        if team == self.us { Us } else { Them }
    }

    /// Index of a robot in the order of a row.
    pub(crate) fn index(&self, (side, number): Bot) -> usize {
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

    /// A place on the field as one of the scene.
    pub(crate) fn back(&self, place: Vector) -> (f32, f32) {
        let turned = self.turn((place.x, place.y));
        (turned.x, turned.y)
    }

    /// Steps in a time.
    pub(crate) fn steps(&self, seconds: f32) -> i32 {
        self.referee.pitch().steps(seconds)
    }
}

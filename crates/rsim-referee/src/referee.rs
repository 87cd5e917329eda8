//! The referee of a match: judges a step, and restarts play.

use crate::cards;
use crate::codes::{Command, Stage};
use crate::config::{League, RefereeConfig};
use crate::draws::Draws;
use crate::error::RefereeError;
use crate::events::{Event, EventKind};
use crate::flow::{self, Arrangement};
use crate::game::Game;
use crate::line_up;
use crate::moment::Moment;
use crate::pitch::Pitch;
use crate::placing;
use crate::rules::{self, Rule};
use crate::ruling::{Ruling, Rulings};
use crate::sight::Layout;
use crate::statistics::Statistics;
use crate::team::Team;
use crate::tracking;

/// Most steps of a time: a row has exact whole numbers below 2^24, and some are sums of two times.
const MAX_STEPS: f32 = 8_388_608.0;

/// Referee of matches with the same rules, field and robots. It has no state of its own.
#[derive(Debug, Clone)]
pub struct Referee {
    config: RefereeConfig,
    pitch: Pitch,
    layout: Layout,
    rules: Vec<&'static Rule>,
}

/// Decisions of a step.
#[derive(Debug, Clone, Default)]
pub struct Decisions {
    /// Events, in the order of the rules.
    pub events: Vec<Event>,
    /// Whether play goes on from the row of the restart.
    pub restarts: bool,
    /// Decisions of the rules, of which the events are a part.
    pub rulings: Rulings,
}

impl Referee {
    /// A referee.
    ///
    /// # Errors
    /// A number or a name in the configuration that cannot be.
    pub fn new(config: RefereeConfig, pitch: Pitch, layout: Layout) -> Result<Self, RefereeError> {
        config.validate()?;
        for (&(name, unit, _), got) in RefereeConfig::NUMBERS.iter().zip(config.numbers()) {
            let most = MAX_STEPS * pitch.time_step;
            if unit == "s" && got > most {
                return Err(RefereeError::TooLong { name, most, got });
            }
        }
        let is_on = |rule: &&Rule| !config.off.iter().any(|name| name == rule.name);
        let rules = rules::of_league(config.league).iter().filter(is_on).collect();
        Ok(Self { config, pitch, layout, rules })
    }

    /// Numbers and switches of the rules.
    pub const fn config(&self) -> &RefereeConfig {
        &self.config
    }

    /// Field, sizes of bodies and time step.
    pub const fn pitch(&self) -> &Pitch {
        &self.pitch
    }

    /// Columns of a state row.
    pub const fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Fits a match to the state from which play begins or goes on.
    ///
    /// # Errors
    /// A row of another length.
    pub fn begin(&self, row: &[f32], game: &mut Game) -> Result<(), RefereeError> {
        let now = self.layout.sight(row)?;
        let ball = now.ball().position;
        (game.stuck_position, game.stuck_steps) = (ball, 0);
        if game.kicking_team().is_some() {
            game.kick_position = ball;
        }
        Ok(())
    }

    /// Puts all robots of a row that are present, and the ball, where a match begins. The seed draws the errors
    /// of the places.
    ///
    /// # Errors
    /// A row of another length.
    pub fn line_up(&self, row: &mut [f32], seed: u32) -> Result<(), RefereeError> {
        let copy = row.to_vec();
        let now = self.layout.sight(&copy)?;
        let moment = Moment::new(&self.config, &self.pitch, now, now);
        let mut game = Game { placements: Draws::new(seed), ..Game::new(Team::Blue) };
        self.layout.put_ball(row, game.designated_position);
        for placed in line_up::kickoff(&game, &moment) {
            self.layout.put_robot(row, &placed);
        }
        // Robots that have no place in the line-up, or not enough room, go to the nearest valid one.
        let copy = row.to_vec();
        let now = self.layout.sight(&copy)?;
        let moment = Moment::new(&self.config, &self.pitch, now, now);
        placing::arrange(&mut game, &moment, &self.layout, Arrangement::All, row);
        Ok(())
    }

    /// Judges a step: brings the state of the match up to its end, and returns the decisions. `restart` gets
    /// the row from which play goes on, where the referee arranges the bodies.
    ///
    /// # Errors
    /// Rows of another length. Nothing has changed.
    pub fn judge(
        &self,
        before: &[f32],
        after: &[f32],
        game: &mut Game,
        statistics: &mut Statistics,
        restart: &mut [f32],
        decisions: &mut Decisions,
    ) -> Result<(), RefereeError> {
        let (before, now) = (self.layout.sight(before)?, self.layout.sight(after)?);
        self.layout.sight(restart)?;
        decisions.events.clear();
        decisions.rulings.clear();
        decisions.restarts = false;
        if game.stage == Stage::PostGame {
            return Ok(()); // nothing is an offense any more
        }
        let moment = Moment::new(&self.config, &self.pitch, before, now);
        self.follow(game, &moment);
        for rule in &self.rules {
            (rule.judge)(game, &moment, &mut decisions.rulings);
        }
        remove_robots(game, &moment, &mut decisions.rulings);
        statistics.count(game, &moment);
        for ruling in decisions.rulings.iter() {
            decisions.events.push(ruling.event);
            if ruling.is_foul {
                cards::count_foul(game, &moment, ruling, &mut decisions.events);
            }
        }
        let arrangement = flow::advance(game, &moment, &decisions.rulings);
        if arrangement != Arrangement::None {
            restart.copy_from_slice(after);
            decisions.restarts =
                placing::arrange(game, &moment, &self.layout, arrangement, restart);
        }
        Ok(())
    }

    fn follow(&self, game: &mut Game, moment: &Moment) {
        tracking::follow(game, moment);
        match self.config.league {
            League::Ssl => tracking::follow_progress(game, moment),
            League::Vsss => rules::vsss::stuck_ball::follow(game, moment),
        }
    }
}

/// Stops play where a team has not taken its robots out in time, but for a penalty kick.
fn remove_robots(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    for team in Team::BOTH {
        let is_over =
            game.removal_steps_left[team] >= 0 && cards::pass_removal_time(game, moment, team);
        if is_over && game.is_running() && game.penalty_taker().is_none() {
            let place = moment.ball.position;
            let ruling = Ruling::of_team(EventKind::TooManyRobots, Some(team), place);
            // A kick that was not taken yet is repeated.
            let (command, place) = match game.kick.filter(|_| !game.in_play) {
                Some(kick) => (kick, game.designated_position),
                None => (Command::ForceStart, rules::ssl::kick_place(moment, place)),
            };
            rulings.add(ruling.stops(command, place));
        }
    }
}

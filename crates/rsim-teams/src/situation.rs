//! Knowledge of a team in a step, from which it decides.

use rsim_referee::Vector;

use crate::config::TeamConfig;
use crate::intercept::{Meeting, Meetings, Pace};
use crate::phase::{Mode, Phase, Restart};
use crate::pitch::Pitch;
use crate::random::Random;
use crate::rolling::BallPath;
use crate::skill::Skill;
use crate::tactics::Tactics;
use crate::view::{Player, View};

/// Index of the keeper in its team.
pub(crate) const KEEPER: usize = 0;
/// Share of the maximum acceleration with which own robots are expected to come to the ball.
const PACE: f32 = 0.85;

/// Knowledge of a team in a step.
pub(crate) struct Situation<'a> {
    pub(crate) config: &'a TeamConfig,
    pub(crate) pitch: &'a Pitch,
    pub(crate) skill: &'a Skill,
    pub(crate) tactics: &'a Tactics,
    pub(crate) view: &'a View,
    pub(crate) phase: Phase,
    /// Time since the referee's command, s.
    pub(crate) command_time: f32,
    /// Whether the ball is in play.
    pub(crate) in_play: bool,
    /// Place where the ball has to be, m.
    pub(crate) place: Vector,
    /// Own robot that may not touch the ball.
    pub(crate) barred: Option<usize>,
    /// Opponent that may not.
    pub(crate) barred_opponent: Option<usize>,
    /// Path of the ball.
    pub(crate) path: BallPath,
    /// Meetings of the own robots with the ball.
    pub(crate) own: Meetings,
    /// Meetings of the opponents.
    pub(crate) others: Meetings,
    /// Random numbers, which change every second.
    pub(crate) random: Random,
    /// Control steps since the beginning.
    pub(crate) step: i32,
}

impl<'a> Situation<'a> {
    /// Finds the meetings with a ball on its path.
    pub(crate) fn meet(&mut self) {
        let reach = self.config.robot.radius;
        let pace =
            Pace { speed: self.speed(), acceleration: PACE * self.config.robot.max_acceleration };
        let theirs =
            Pace { speed: self.tactics.their_speed, acceleration: self.tactics.their_acceleration };
        self.own = Meetings::new(&self.view.own, &self.path, self.pitch, pace, reach);
        self.others = Meetings::new(&self.view.others, &self.path, self.pitch, theirs, reach);
    }

    /// The opponent that is first at the ball, of those that may touch it.
    pub(crate) fn rival(&self) -> Option<(usize, Meeting)> {
        self.others.first(|index| Some(index) != self.barred_opponent)
    }

    /// Greatest speed of the own robots, m/s.
    pub(crate) fn speed(&self) -> f32 {
        self.skill.speed_with(self.tactics) * self.config.robot.max_speed
    }

    /// Position of the ball, m.
    pub(crate) fn ball(&self) -> Vector {
        self.view.ball.position
    }

    /// Radii of a robot and the ball together, m.
    pub(crate) fn body(&self) -> f32 {
        self.config.robot.radius + self.config.ball.radius
    }

    /// Distance of the nearest opponent from a place, m.
    pub(crate) fn nearest_opponent(&self, place: Vector) -> f32 {
        let distances = self.view.others.iter().map(|other| other.position.distance(place));
        distances.fold(f32::INFINITY, f32::min)
    }

    /// Whether a robot stays in the goal. A keeper without teammates leaves it, but for a penalty kick of the
    /// opponents.
    pub(crate) fn keeps(&self, index: usize) -> bool {
        let is_their_penalty = self.phase.restart == Restart::Penalty
            && !self.phase.ours
            && self.phase.mode != Mode::Play;
        index == KEEPER && (is_their_penalty || self.field_players().next().is_some())
    }

    /// The own robots but the keeper.
    pub(crate) fn field_players(&self) -> impl Iterator<Item = &'a Player> {
        self.view.own.iter().filter(|player| player.index != KEEPER)
    }
}

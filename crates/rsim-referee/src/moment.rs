//! A step of a match, as rules see it: the state before and after, field, numbers.

use crate::config::RefereeConfig;
use crate::lines::Lines;
use crate::pitch::Pitch;
use crate::sight::{Ball, Robot, Sight};
use crate::team::Team;
use crate::vector::Vector;

/// A step of a match.
#[derive(Debug, Clone, Copy)]
pub struct Moment<'a> {
    /// Numbers and switches of the rules.
    pub config: &'a RefereeConfig,
    /// Field, bodies and time step.
    pub pitch: &'a Pitch,
    /// State before the step.
    pub before: Sight<'a>,
    /// State after the step.
    pub now: Sight<'a>,
    /// The ball before the step.
    pub ball_before: Ball,
    /// The ball after the step.
    pub ball: Ball,
}

impl<'a> Moment<'a> {
    /// The step between two states.
    pub fn new(
        config: &'a RefereeConfig,
        pitch: &'a Pitch,
        before: Sight<'a>,
        now: Sight<'a>,
    ) -> Self {
        Self { config, pitch, before, now, ball_before: before.ball(), ball: now.ball() }
    }

    /// Lines of the field.
    pub const fn lines(&self) -> &'a Lines {
        &self.pitch.lines
    }

    /// Control steps in a time, s.
    pub fn steps(&self, seconds: f32) -> i32 {
        self.pitch.steps(seconds)
    }

    /// Team of a robot.
    pub fn team_of(&self, robot: usize) -> Team {
        self.now.team_of(robot)
    }

    /// The robot that touched the ball last, if it did so in the step.
    pub fn toucher(&self) -> Option<Robot> {
        self.ball
            .last_touch
            .and_then(|robot| self.now.robot(robot))
            .filter(|robot| robot.touched_ball)
    }

    /// The keeper of a team.
    pub fn keeper(&self, team: Team) -> usize {
        self.now.keeper(team)
    }

    /// Place of the ball when its last toucher touched it in the step: at the start of the step for one
    /// that began to touch it, so before its kick.
    pub fn touch_position(&self, toucher: &Robot) -> Vector {
        let touched_before =
            self.before.robot(toucher.index).is_some_and(|robot| robot.touched_ball);
        if touched_before { self.ball.position } else { self.ball_before.position }
    }

    /// Gap between a robot's hull, as rules measure it, and a place, m.
    pub fn hull_distance(&self, robot: &Robot, place: Vector) -> f32 {
        robot.position.distance(place) - self.pitch.robot_radius
    }
}

//! A ball that goes on from elsewhere in the middle of a match.

use crate::columns::BALL_COLUMNS;
use crate::crossing::Crossing;
use crate::placement::BallStart;
use crate::{PlaceError, World};

impl World {
    /// Puts the ball elsewhere; all else of the match goes on. Of `ball`, the ball's columns of a
    /// row, position, velocity and spin count. Nobody has touched it there, and it has crossed
    /// nothing.
    ///
    /// # Errors
    /// The ball outside the field or in a robot, or a state that became non-finite before; then
    /// nothing has changed.
    pub fn reposition_ball(&mut self, ball: &[f32]) -> Result<(), PlaceError> {
        let start = self.check_ball(ball)?;
        self.put_ball(&start);
        Ok(())
    }

    /// Where `ball` asks for the ball, checked.
    pub(crate) fn check_ball(&self, ball: &[f32]) -> Result<BallStart, PlaceError> {
        debug_assert_eq!(ball.len(), BALL_COLUMNS.len());
        if self.state.broken {
            return Err(PlaceError::Lost);
        }
        let bodies = 0..=self.state.robots.len();
        let motions = bodies.map(|body| self.state.engine.motion(body)).collect();
        self.rules.placement.read_ball(ball, motions, self.physique())
    }

    /// Has the ball go on from elsewhere.
    pub(crate) fn put_ball(&mut self, checked: &BallStart) {
        let state = &mut self.state;
        state.engine.set_ball(checked.motion.position, checked.motion.velocity);
        state.ball = checked.ball;
        state.touched.last = None;
        state.crossing = Crossing::default();
    }
}

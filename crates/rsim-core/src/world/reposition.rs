//! Repositioning of the ball during a match.

use crate::columns::BALL_COLUMNS;
use crate::error::PlaceError;
use crate::state::crossing::Crossing;
use crate::world::World;
use crate::world::placement::BallStart;

impl World {
    /// Moves the ball; everything else of the match continues. `ball` has the ball's columns of a row;
    /// position, velocity and spin are used. The records of the last touch and of the crossing are
    /// cleared.
    ///
    /// # Errors
    /// [`PlaceError`] for a ball outside the field or in a robot, or a match whose state became
    /// non-finite; then nothing has changed.
    pub fn reposition_ball(&mut self, ball: &[f32]) -> Result<(), PlaceError> {
        let start = self.check_ball(ball)?;
        self.set_ball(start);
        Ok(())
    }

    /// Reads and checks a start of the ball.
    pub(super) fn check_ball(&self, ball: &[f32]) -> Result<BallStart, PlaceError> {
        debug_assert_eq!(ball.len(), BALL_COLUMNS.len());
        if self.state.broken {
            return Err(PlaceError::Lost);
        }
        let bodies = &self.state.bodies;
        let motions = (0..bodies.len()).map(|body| bodies.motion(body)).collect();
        self.shared.placement.read_ball(ball, motions, self.params())
    }

    /// Moves the ball to a checked start.
    pub(super) fn set_ball(&mut self, checked: BallStart) {
        let state = &mut self.state;
        state.bodies.set_ball(checked.motion.position, checked.motion.velocity);
        state.ball = checked.ball;
        state.touches.last = None;
        state.crossing = Crossing::default();
    }
}

//! Repositioning of the ball, or of some robots, during a match.

use crate::blocks::{bits_of, robot, set_bits};
use crate::columns::BALL_COLUMNS;
use crate::error::PlaceError;
use crate::state::State;
use crate::state::crossing::Crossing;
use crate::world::World;
use crate::world::placement::{BallStart, Start};

/// New states of some robots.
pub(super) struct RobotsStart {
    /// All bodies of the match with these robots.
    start: Start,
    /// The robots, one bit each.
    mask: u64,
}

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
        self.shared.placement.read_ball(ball, motions, self.parameters())
    }

    /// Moves the robots of `mask` to their states in a row, or takes them off the field; everything else of
    /// the match continues. Positions, headings, velocities and `absent` of these robots are used. Their
    /// kickers are charged, and their touches and collisions in the last step are cleared.
    ///
    /// # Errors
    /// [`PlaceError`] for such a robot outside the field or in another body, or a match whose state
    /// became non-finite; then nothing has changed.
    pub fn reposition_robots(&mut self, mask: &[bool], row: &[f32]) -> Result<(), PlaceError> {
        let start = self.check_robots(mask, row)?;
        self.set_robots(start);
        Ok(())
    }

    /// Reads and checks new states of the robots of `mask`.
    pub(super) fn check_robots(
        &self,
        mask: &[bool],
        row: &[f32],
    ) -> Result<RobotsStart, PlaceError> {
        debug_assert_eq!(row.len(), self.config().row_size());
        debug_assert_eq!(mask.len(), self.config().n_robots());
        if self.state.broken {
            return Err(PlaceError::Lost);
        }
        let mask = bits_of((0..mask.len()).filter(|&index| mask[index]));
        let State { bodies, ball, absent, .. } = &*self.state;
        let motions = (0..bodies.len()).map(|body| bodies.motion(body)).collect();
        let now = Start { motions, ball: *ball, absent: *absent };
        let start = self.shared.placement.read_robots(row, mask, now, self.parameters())?;
        Ok(RobotsStart { start, mask })
    }

    /// Moves robots to a checked start.
    pub(super) fn set_robots(&mut self, RobotsStart { start, mask }: RobotsStart) {
        for index in set_bits(mask) {
            let is_absent = start.absent >> index & 1 == 1;
            self.state.replace_robot(index, &start.motions[robot(index)], is_absent);
        }
        self.look_again();
    }

    /// Moves the ball to a checked start.
    pub(super) fn set_ball(&mut self, checked: BallStart) {
        let state = &mut self.state;
        state.bodies.set_ball(checked.motion.position, checked.motion.velocity);
        state.ball = checked.ball;
        state.touches.last = None;
        state.crossing = Crossing::default();
        self.look_again();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::WarmStart;
    use crate::models::config::EngineKind;
    use crate::scenes::{self, Driver, Scene};

    fn warm_starts(world: &World) -> Vec<WarmStart> {
        let mut all = Vec::new();
        let bodies = &world.state.bodies;
        bodies.list_warm_starts(world.state.engine.warm_starts(), &mut all);
        all.into_iter().filter(|stored| stored.key != 0).collect()
    }

    #[test]
    fn impulses_of_a_moved_robot_are_forgotten_and_those_of_others_kept() {
        let mut scene = Scene::lined_up("crowd", scenes::vss(3, 3), Driver::Chase);
        scene.config.engine = EngineKind::Compact;
        let mut world = scene.world();
        let mut row = scene.start.clone();
        let of_first = |stored: &WarmStart| {
            [stored.key >> 8, stored.key & 0xff].contains(&u16::try_from(robot(0)).expect("small"))
        };
        let mut seen = [0, 0];
        for step in 0..200 {
            world.step(&scene.commands(&row, step, 0)).expect("finite");
            world.write_row(&mut row);
            let mut moved = world.clone();
            let mask = [true, false, false, false, false, false];
            moved.reposition_robots(&mask, &row).expect("where it is");
            let (before, after) = (warm_starts(&world), warm_starts(&moved));
            let kept = before.iter().filter(|stored| !of_first(stored)).count();
            assert_eq!(after.len(), kept);
            assert!(!after.iter().any(of_first));
            seen = [seen[0] + kept, seen[1] + before.len() - kept];
        }
        assert!(seen[0] > 20 && seen[1] > 20, "{seen:?}");
    }
}

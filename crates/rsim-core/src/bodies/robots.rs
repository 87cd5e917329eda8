//! Numbers that robots keep beside their motion and wheels: kickers, dribblers, collisions.

use super::Bodies;
use crate::blocks::{Lanes, place_of, robot};

impl Bodies {
    /// Gives a robot a charged kicker, and wheels and a dribbler that have done nothing yet.
    pub(crate) fn reset_robot(&mut self, index: usize) {
        let (block, lane) = place_of(robot(index));
        let block = &mut self.blocks[block];
        block.acceleration.clear(lane);
        block.drive.clear(lane);
        for number in [&mut block.recharging, &mut block.dribbling, &mut block.collision_speed] {
            number.as_mut_array()[lane] = 0.0;
        }
    }

    /// Time until the kicker of a robot is charged, s.
    pub(crate) fn recharging(&self, index: usize) -> f32 {
        let (block, lane) = place_of(robot(index));
        self.blocks[block].recharging.as_array()[lane]
    }

    pub(crate) fn set_recharging(&mut self, index: usize, time: f32) {
        let (block, lane) = place_of(robot(index));
        self.blocks[block].recharging.as_mut_array()[lane] = time;
    }

    /// Speed of a robot's dribbler by its maximum, 0 to 1.
    pub(crate) fn dribbling(&self, index: usize) -> f32 {
        let (block, lane) = place_of(robot(index));
        self.blocks[block].dribbling.as_array()[lane]
    }

    pub(crate) fn set_dribbling(&mut self, index: usize, speed: f32) {
        let (block, lane) = place_of(robot(index));
        self.blocks[block].dribbling.as_mut_array()[lane] = speed;
    }

    /// Closing speed of a robot's hardest contact with another robot since the control step began, m/s.
    pub(crate) fn collision_speed(&self, index: usize) -> f32 {
        let (block, lane) = place_of(robot(index));
        self.blocks[block].collision_speed.as_array()[lane]
    }

    /// Records that a robot touched another one at a closing speed, m/s.
    pub(crate) fn add_collision(&mut self, index: usize, closing: f32) {
        let (block, lane) = place_of(robot(index));
        let speed = &mut self.blocks[block].collision_speed.as_mut_array()[lane];
        *speed = speed.max(closing);
    }

    /// Clears the collision speeds for a new control step.
    pub(crate) fn clear_collisions(&mut self) {
        for block in &mut self.blocks {
            block.collision_speed = Lanes::ZERO;
        }
    }
}

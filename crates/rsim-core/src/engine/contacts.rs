//! Contacts with an impulse in the last tick, as both contact solvers report them.

use super::WALL_FRICTION;
use crate::body_parameters::BodyParameters;
use crate::math::Vector;

/// The other party of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Partner {
    Wall(usize),
    Robot(usize),
}

impl Partner {
    /// Coulomb friction of a robot against it.
    pub(crate) fn friction(self, robot: usize, parameters: &BodyParameters) -> f32 {
        let of = |index: usize| parameters.robots[index].model.friction;
        let other = if let Self::Robot(other) = self { of(other) } else { WALL_FRICTION };
        of(robot).midpoint(other)
    }
}

/// A contact of the ball with an impulse in the last tick.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BallContact {
    pub(crate) with: Partner,
    /// Unit vector from the partner to the ball.
    pub(crate) normal: Vector,
    /// Impulse along the normal, N s.
    pub(crate) impulse: f32,
    /// From the center of a partner that is a robot to the point that the ball touched, when it touched
    /// it, m: both move on within the tick.
    pub(crate) arm: Vector,
}

/// A contact of a robot with a wall or another robot, with an impulse in the last tick.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RobotContact {
    pub(crate) robot: usize,
    pub(crate) with: Partner,
    /// Unit vector from the robot to its partner.
    pub(crate) normal: Vector,
    /// Mean point of the contact, m.
    pub(crate) point: Vector,
}

/// Contacts with an impulse in the last tick, or in the last part of it.
#[derive(Debug, Default)]
pub(crate) struct Contacts {
    pub(crate) ball: Vec<BallContact>,
    pub(crate) robots: Vec<RobotContact>,
}

impl Contacts {
    pub(super) fn clear(&mut self) {
        self.ball.clear();
        self.robots.clear();
    }

    pub(super) fn len(&self) -> usize {
        self.ball.len() + self.robots.len()
    }
}

//! Order to a robot in a step.

use rsim_referee::Vector;

/// Acceleration without a limit of its own, m/s².
pub(crate) const FREELY: f32 = 1000.0;
/// Angular velocity without a limit of its own, rad/s.
pub(crate) const QUICKLY: f32 = 100.0;

/// Order to a robot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Order {
    /// Place where its center goes, m.
    pub(crate) target: Vector,
    /// Velocity of that place, m/s.
    pub(crate) moving: Vector,
    /// Direction that it faces, of any length.
    pub(crate) facing: Vector,
    /// m/s.
    pub(crate) max_speed: f32,
    /// m/s².
    pub(crate) acceleration: f32,
    /// rad/s.
    pub(crate) turning: f32,
    /// rad/s².
    pub(crate) turn_acceleration: f32,
    /// Speed of a kick along the heading and upward, m/s; 0 for none.
    pub(crate) kick: [f32; 2],
    /// Speed of the dribbler, 0 to 1.
    pub(crate) dribbler: f32,
    /// Distance that its center keeps from the ball on its way, m; 0 for none.
    pub(crate) ball_distance: f32,
    /// Whether it goes straight, whatever is in the way.
    pub(crate) straight: bool,
}

impl Order {
    /// Goes to a place, facing a direction, and keeps off the ball on its way.
    pub(crate) const fn to(target: Vector, facing: Vector) -> Self {
        Self {
            target,
            facing,
            moving: Vector::new(0.0, 0.0),
            max_speed: f32::INFINITY,
            acceleration: FREELY,
            turning: QUICKLY,
            turn_acceleration: FREELY,
            kick: [0.0; 2],
            dribbler: 0.0,
            ball_distance: 0.2,
            straight: false,
        }
    }
}

//! Robots whose commands are unknown: they are commanded to keep their velocities, within the forces of their
//! wheels. So they push, stall and are pushed as any robot.

use crate::blocks::{robot, set_bits};
use crate::bodies::Bodies;
use crate::body_parameters::BodyParameters;
use crate::drive::WheelMap;
use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::models::robot::Drive;

/// Robots that keep their velocities.
pub(crate) struct Coasting(Vec<Coaster>);

struct Coaster {
    index: usize,
    keeps: Keeps,
}

/// The part of its motion that a robot keeps.
enum Keeps {
    /// Speeds of its two wheels, rad/s: it rolls on along its arc.
    Wheels([f32; 2]),
    /// Its velocity on the field (m/s) and its angular velocity (rad/s), whose command depends on its heading.
    Velocity { velocity: Vector, turn: f32, wheels: Option<Box<WheelMap>> },
}

impl Coasting {
    /// The robots of a mask, one bit each, which now move as `bodies` do.
    pub(crate) fn new(mask: u64, bodies: &Bodies, parameters: &BodyParameters) -> Self {
        let each = set_bits(mask).map(|index| {
            let Motion { heading, velocity, angular_velocity: turn, .. } =
                bodies.motion(robot(index));
            let keeps = match &parameters.robots[index].model.drive {
                Drive::Differential(drive) => {
                    let forward = velocity.dot(heading);
                    let turning = turn * drive.track_width / 2.0;
                    Keeps::Wheels(
                        [forward - turning, forward + turning].map(|v| v / drive.wheel_radius),
                    )
                }
                Drive::Omni(_) => Keeps::Velocity { velocity, turn, wheels: None },
                Drive::OmniWheels(drive) => {
                    let wheels = Some(Box::new(WheelMap::of(drive)));
                    Keeps::Velocity { velocity, turn, wheels }
                }
            };
            Coaster { index, keeps }
        });
        Self(each.collect())
    }

    /// Writes their commands into those of all robots, `columns` numbers each. Returns whether there are any.
    pub(crate) fn command(&self, bodies: &Bodies, commands: &mut [f32], columns: usize) -> bool {
        for Coaster { index, keeps } in &self.0 {
            let command = &mut commands[index * columns..(index + 1) * columns];
            command.fill(0.0);
            match keeps {
                Keeps::Wheels(speeds) => command[..2].copy_from_slice(speeds),
                Keeps::Velocity { velocity, turn, wheels } => {
                    let heading = bodies.motion(robot(*index)).heading;
                    let own = [velocity.dot(heading), velocity.dot(heading.perp()), *turn];
                    match wheels {
                        None => command[..3].copy_from_slice(&own),
                        Some(map) => command[..4].copy_from_slice(&map.wheel_speeds(own)),
                    }
                }
            }
        }
        !self.0.is_empty()
    }
}

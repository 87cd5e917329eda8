//! Rules for contacts of the ball: it may fly, it is fast for its size, and robots have a flat front.

use super::contacts::Partner;
use crate::body_parameters::BodyParameters;
use crate::geometry::arena::Wall;
use crate::geometry::motion::{rotated, rotation};
use crate::geometry::outline::{NearestPoint, PlacedOutline};
use crate::math::{Rotation, Vector};

/// Gap up to which surfaces touch, m: then the contact is at the nearest point. For a larger gap the
/// contact is searched along the ball's path.
const TOUCHING: f32 = 1e-4;

/// Gap at which the search along the path ends, m.
const FOUND: f32 = 1e-5;

/// Maximum number of iterations of that search. A slow ball beside a fast corner needs the most.
const MAX_ITERATIONS: usize = 32;

/// Contact rules of the ball in one tick, or in a part of it.
pub(crate) struct BallRules<'a> {
    pub(crate) parameters: &'a BodyParameters,
    pub(crate) walls: &'a [Wall],
    pub(crate) phase: BallPhase,
    /// Set for a squeezed ball, which stays in contact with all bodies around it.
    pub(crate) squeezed: Option<SqueezedBall>,
    /// Length of the tick or its part, s.
    pub(crate) time: f32,
}

/// Height of the ball in a tick, which decides its contacts in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum BallPhase {
    /// On the floor: contacts with everything.
    Floor,
    /// In the air: no contacts here; `tick::flight` solves them.
    Air,
    /// In the air and jammed: contacts with everything as high as its center.
    JammedInAir {
        /// Height of the center, m.
        height: f32,
    },
}

/// Settings of the solver for a squeezed ball.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SqueezedBall {
    /// Mass of the ball in the solver, kg.
    pub(crate) mass: f32,
    /// Whether the ball cannot slip out.
    pub(crate) jammed: bool,
}

/// A body or wall that the ball approaches.
pub(super) struct Approached {
    pub(super) place: PlacedOutline,
    /// Velocity of the ball relative to the center of the approached body, m/s.
    pub(super) velocity: Vector,
    /// Angular velocity of the approached body, rad/s.
    pub(super) angular_velocity: f32,
}

/// A predicted contact: normal, distance to it now, and the ball's center at that instant.
pub(super) struct Touch {
    pub(super) normal: Vector,
    /// Distance along the normal, m.
    pub(super) distance: f32,
    pub(super) center: Vector,
}

impl BallRules<'_> {
    /// Whether the ball can touch a robot or wall in the plane.
    pub(super) fn meets(&self, with: Partner) -> bool {
        match self.phase {
            BallPhase::Floor => true,
            BallPhase::Air => false,
            BallPhase::JammedInAir { height } => match with {
                Partner::Robot(index) => height < self.parameters.robots[index].model.height,
                Partner::Wall(index) => height < self.walls[index].top,
            },
        }
    }
}

impl Touch {
    /// The nearest point of an outline, as touched by a ball that is just there.
    pub(super) fn of(nearest: &NearestPoint, center: Vector, radius: f32) -> Self {
        let distance = nearest.distance - radius;
        Self { normal: nearest.normal, distance, center: center - nearest.normal * distance }
    }
}

impl Approached {
    /// The contact of a ball at `center` within `time`, if both move straight and the approached body
    /// keeps turning.
    ///
    /// Each iteration advances by a time before which the two cannot touch: the distance to a convex
    /// outline shrinks at most by the speed along the normal and, by rotation, by the speed of its
    /// farthest corner. So the search converges to the contact and never passes it.
    pub(super) fn touch(&self, center: Vector, radius: f32, time: f32) -> Option<Touch> {
        let mut nearest = self.place.nearest(center);
        if nearest.distance - radius <= TOUCHING {
            return Some(Touch::of(&nearest, center, radius));
        }
        let corner_speed = self.angular_velocity.abs() * self.place.outline.turning_radius();
        let (mut place, mut after) = (self.place, 0.0);
        for _ in 0..MAX_ITERATIONS {
            let gap = nearest.distance - radius;
            if gap <= FOUND {
                break;
            }
            let closing = corner_speed - self.velocity.dot(nearest.normal);
            if closing <= 0.0 {
                return None;
            }
            after += gap / closing;
            if after > time {
                return None;
            }
            let Rotation { re, im } = self.place.heading;
            place.heading = rotation(rotated(Vector::new(re, im), self.angular_velocity * after));
            nearest = place.nearest(center + self.velocity * after);
        }
        let center = center + self.velocity * after;
        let arm = center - nearest.normal * radius - place.position;
        let closing = (arm.perp() * self.angular_velocity - self.velocity).dot(nearest.normal);
        let distance = (closing * after).max(0.0);
        Some(Touch { normal: nearest.normal, distance, center })
    }
}

//! The ball at the joint of two boxes: robots side by side, or a robot beside a wall.
//!
//! A contact is found for each body alone, so a ball that rolls along robots side by side meets the edge of
//! the next one at their joint, and its path within a tick may lead through the first to the side of the
//! second. An edge counts only if it protrudes from the face beside it, or lies apart from it. Otherwise
//! the ball meets the face behind the edge.

use super::ball_contact::{Approached, Touch};
use crate::geometry::outline::Outline;
use crate::math::Vector;

/// Gap, m, up to which two bodies have a joint. The ball turns a robot that it hits near a joint by up to two
/// degrees, which opens the joint by 1.3 mm; it sinks into a gap of 2.5 mm by 0.04 mm.
const GAP: f32 = 2.5e-3;

/// Height above the face beside it, m, from which an edge protrudes: real edges are not sharper. Robots that
/// slide along others sink into them by up to 0.1 mm, and a ball at 5 m/s moves a robot that it hits at 2
/// degrees by 0.2 mm before the next one is hit.
pub(super) const PROTRUDING: f32 = 5e-4;

/// Cosine of the angle between two faces, up to which they are one.
const FLUSH: f32 = 0.99;

/// The ball at the time of its search for contacts.
#[derive(Clone, Copy)]
pub(super) struct Ball {
    pub(super) center: Vector,
    pub(super) radius: f32,
    /// Time of the search, s; 0 if the ball has contacts with all around it.
    pub(super) time: f32,
}

impl Ball {
    /// The contact `touch` with a body, or with its face if an edge of it lies at a joint with one of `others`.
    pub(super) fn over_joints(
        &self,
        touch: Touch,
        met: &Approached,
        others: impl Iterator<Item = Approached>,
    ) -> Touch {
        let Outline::Box { half } = met.place.outline else { return touch };
        let on_met = touch.center - touch.normal * self.radius;
        for other in others {
            if other.place.nearest(on_met).distance > GAP {
                continue;
            }
            let beside = self.touch_beside(&other, touch.center);
            if let Some(face) = self.flush_face(met, half, &beside, touch.center) {
                return if face.normal.dot(touch.normal) < FLUSH_ENOUGH { face } else { touch };
            }
        }
        touch
    }

    /// The contact with the body at the other side of a joint, for a ball that touches this side at `center`.
    fn touch_beside(&self, other: &Approached, center: Vector) -> Touch {
        other
            .touch(self.center, self.radius, self.time)
            .unwrap_or_else(|| Touch::of(&other.place.nearest(center), center, self.radius))
    }

    /// The contact with the face of a box that continues the face of `beside`, if there is one that does not
    /// protrude.
    fn flush_face(
        &self,
        met: &Approached,
        half: Vector,
        beside: &Touch,
        center: Vector,
    ) -> Option<Touch> {
        let place = &met.place;
        let local = place.heading.inverse() * beside.normal;
        let along_x = local.x.abs() > local.y.abs();
        let axis = if along_x {
            Vector::new(1.0_f32.copysign(local.x), 0.0)
        } else {
            Vector::new(0.0, 1.0_f32.copysign(local.y))
        };
        let normal = place.heading * axis;
        let height = half.dot(axis.abs());
        let on_beside = beside.center - beside.normal * self.radius;
        let protrudes = (place.position - on_beside).dot(normal) + height;
        if normal.dot(beside.normal) < FLUSH || protrudes > PROTRUDING {
            return None;
        }
        let distance = (self.center - place.position).dot(normal) - height - self.radius;
        // The point of the face that is nearest to the touch.
        let at = (place.heading.inverse() * (center - place.position)).clamp(-half, half);
        let on_face = at * (Vector::ONE - axis.abs()) + axis * height;
        let center = place.position + place.heading * on_face + normal * self.radius;
        Some(Touch { normal, distance, center })
    }
}

/// Cosine of an angle between normals below which they are the same.
const FLUSH_ENOUGH: f32 = 1.0 - 1e-6;

//! A way around which a robot keeps its distance: the ball, or the way of a ball placement.

use rsim_referee::Vector;

use crate::plane::Plane;

/// Distance from the ball from which a robot may cross the way of a placement, m.
const FAR: f32 = 1.2;

/// A way around which a robot keeps its distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Avoided {
    /// Ends of the way, the ball first, m.
    pub(crate) ends: [Vector; 2],
    /// Distance from the way, m; 0 for none.
    pub(crate) distance: f32,
    /// Maximum of the absolute x and y of a robot before the walls, m.
    pub(crate) walls: Vector,
}

/// A limit near a robot.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limit {
    /// Distance from it, m; negative beyond it.
    pub(crate) distance: f32,
    /// Direction away from it.
    pub(crate) away: Vector,
}

impl Avoided {
    /// The limit at a place.
    pub(crate) fn limit(&self, place: Vector) -> Limit {
        if self.distance <= 0.0 {
            return Limit { distance: f32::INFINITY, away: Vector::new(1.0, 0.0) };
        }
        let nearest = self.nearest(place);
        let aside = (self.ends[1] - self.ends[0]).left().unit_or(Vector::new(-1.0, 0.0));
        let away = (place - nearest).unit_or(aside);
        let away = if self.is_within_walls(nearest + away * self.distance) {
            away
        } else {
            self.along_wall(place, nearest, away)
        };
        Limit { distance: place.distance(nearest) - self.distance, away }
    }

    /// Direction in which a robot gets away that has no room before a wall: along the wall, or past the way
    /// where the ball is far.
    fn along_wall(&self, place: Vector, nearest: Vector, away: Vector) -> Vector {
        let is_beside = (nearest + away * self.distance).y.abs() > self.walls.y;
        let offset = place - nearest;
        let along = if is_beside { Vector::new(offset.x, 0.0) } else { Vector::new(0.0, offset.y) };
        let inward = (nearest * -1.0).unit_or(Vector::new(-1.0, 0.0));
        let along = along.unit_or(inward);
        let is_far = place.distance(self.ends[0]) > FAR;
        if is_far || !self.is_within_walls(nearest + along * self.distance) {
            inward
        } else {
            along
        }
    }

    fn is_within_walls(&self, place: Vector) -> bool {
        place.x.abs() <= self.walls.x && place.y.abs() <= self.walls.y
    }

    /// The place on the avoided way that is nearest to a place.
    pub(crate) fn nearest(&self, place: Vector) -> Vector {
        let [start, end] = self.ends;
        let along = end - start;
        let square = along.dot(along);
        let share = if square > 0.0 { (place - start).dot(along) / square } else { 0.0 };
        start + along * share.clamp(0.0, 1.0)
    }
}

//! Ways past robots, the ball and areas: the next corner of a short way.

use rsim_referee::Vector;

use crate::config::MAX_ROBOTS;
use crate::pitch::{Area, Pitch};
use crate::plane::Plane;

/// Most discs: all other robots and the ball.
const MAX_DISCS: usize = 2 * MAX_ROBOTS;
/// Room between a corner and what it leads around, m.
const ROOM: f32 = 0.03;
/// Detour that a way is worth which comes too near to something, m for each m.
const BLOCKED_COST: f32 = 10.0;

/// The same for a corner at which the robot must not be.
const FORBIDDEN_COST: f32 = 100.0;

/// A disc in which the center of a robot must not be.
#[derive(Debug, Clone, Copy, Default)]
struct Disc {
    center: Vector,
    radius: f32,
}

/// Obstacle in the way of a robot.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Obstacles {
    discs: [Disc; MAX_DISCS],
    count: usize,
    /// Distances from both areas, m; none for one that the robot may enter.
    areas: [Option<f32>; 2],
}

impl Obstacles {
    /// No discs yet, and distances to keep from the own and the opponents' area, m.
    pub(crate) fn new(areas: [Option<f32>; 2]) -> Self {
        Self { areas, ..Self::default() }
    }

    /// Adds a disc, made so small that start and end of the way lie outside.
    pub(crate) fn add(&mut self, center: Vector, radius: f32, from: Vector, to: Vector) {
        let nearest = from.distance(center).min(to.distance(center)) - 1e-3;
        let radius = radius.min(nearest);
        if radius > 0.0 && self.count < MAX_DISCS {
            self.discs[self.count] = Disc { center, radius };
            self.count += 1;
        }
    }

    fn discs(&self) -> &[Disc] {
        &self.discs[..self.count]
    }

    /// The disc that a straight way meets first.
    fn first_on(&self, from: Vector, to: Vector) -> Option<&Disc> {
        let ahead = to - from;
        self.discs()
            .iter()
            .filter(|disc| disc.center.distance_to_segment(from, to) < disc.radius)
            .min_by(|a, b| {
                let along = |disc: &Disc| (disc.center - from).dot(ahead);
                along(a).total_cmp(&along(b))
            })
    }

    /// Distance by which a straight way comes too near to a disc, m.
    fn missing(&self, from: Vector, to: Vector) -> f32 {
        let missing = |disc: &Disc| disc.radius - disc.center.distance_to_segment(from, to);
        self.discs().iter().map(missing).fold(0.0, f32::max)
    }

    /// Distance by which a place is too near to an area or beyond the walls, m.
    fn forbidden(&self, place: Vector, pitch: &Pitch) -> f32 {
        let beyond = place.distance(pitch.within_walls(place, 0.1));
        let areas = [Area::Own, Area::Theirs].into_iter().zip(self.areas);
        let inside =
            areas.filter_map(|(area, margin)| Some(margin? - pitch.distance_to(area, place)));
        inside.fold(beyond, f32::max)
    }
}

/// The next corner of the way from `from` to `to`, or `to`.
pub(crate) fn next_corner(
    from: Vector,
    to: Vector,
    obstacles: &Obstacles,
    pitch: &Pitch,
) -> Vector {
    let mut goal = to;
    for (area, margin) in [Area::Own, Area::Theirs].into_iter().zip(obstacles.areas) {
        if let Some(margin) = margin {
            goal = around_area(from, goal, area, margin, pitch);
        }
    }
    let Some(first) = obstacles.first_on(from, goal) else { return goal };
    let corner = around_disc(from, goal, first, obstacles, pitch);
    // Another disc may be in the way to the corner.
    match obstacles.first_on(from, corner) {
        Some(second) => around_disc(from, corner, second, obstacles, pitch),
        None => corner,
    }
}

/// The better of the two corners beside a disc.
fn around_disc(
    from: Vector,
    to: Vector,
    disc: &Disc,
    obstacles: &Obstacles,
    pitch: &Pitch,
) -> Vector {
    let aside = (to - from).left().unit_or(Vector::new(0.0, 1.0)) * (disc.radius + ROOM);
    let cost = |corner: Vector| {
        let too_near = obstacles.missing(from, corner) + obstacles.missing(corner, to);
        let length = from.distance(corner) + corner.distance(to);
        let forbidden = obstacles.forbidden(corner, pitch).max(0.0);
        length + BLOCKED_COST * too_near + FORBIDDEN_COST * forbidden
    };
    let [left, right] = [disc.center + aside, disc.center - aside];
    if cost(left) <= cost(right) { left } else { right }
}

/// The corner of an area that leads around it, if the straight way crosses it.
fn around_area(from: Vector, to: Vector, area: Area, margin: f32, pitch: &Pitch) -> Vector {
    let front = pitch.lines.half_length - pitch.lines.area_depth - margin;
    let flank = pitch.lines.half_area_width + margin;
    // A little smaller than the area, so that corners and places at its border lie outside.
    let crosses = |start: Vector, end: Vector| {
        crosses_corner_box(start, end, area.side(), front + ROOM, flank - ROOM)
    };
    if !crosses(from, to) {
        return to;
    }
    let corners = [flank, -flank].map(|y| Vector::new(area.side() * front, y));
    let cost = |corner: Vector| {
        let blocked = if crosses(from, corner) { BLOCKED_COST } else { 0.0 };
        let detour = if crosses(corner, to) { 2.0 * flank } else { 0.0 };
        from.distance(corner) + corner.distance(to) + blocked + detour
    };
    let [left, right] = corners;
    if cost(left) <= cost(right) { left } else { right }
}

/// Whether a straight way meets the box beyond `front` on a side, within `flank` of the middle.
fn crosses_corner_box(start: Vector, end: Vector, side: f32, front: f32, flank: f32) -> bool {
    let way = end - start;
    let (mut first, mut last) = (0.0_f32, 1.0_f32);
    // Of each border: the speed into the box, and the distance still missing.
    for (speed, missing) in [
        (side * way.x, front - side * start.x),
        (way.y, -flank - start.y),
        (-way.y, start.y - flank),
    ] {
        if speed.abs() < 1e-6 {
            if missing > 0.0 {
                return false;
            }
        } else if speed > 0.0 {
            first = first.max(missing / speed);
        } else {
            last = last.min(missing / speed);
        }
    }
    first < last
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::pitch;

    const FROM: Vector = Vector::new(0.0, 0.0);

    fn walk(from: Vector, to: Vector, discs: &[(f32, f32)], areas: [Option<f32>; 2]) -> f32 {
        let (mut at, mut nearest) = (from, f32::INFINITY);
        for _ in 0..400 {
            let mut obstacles = Obstacles::new(areas);
            for (x, y) in discs {
                obstacles.add(Vector::new(*x, *y), 0.22, at, to);
            }
            let corner = next_corner(at, to, &obstacles, &pitch());
            at = at + (corner - at).limited(0.03);
            for (x, y) in discs {
                nearest = nearest.min(at.distance(Vector::new(*x, *y)));
            }
            for (area, margin) in [Area::Own, Area::Theirs].into_iter().zip(areas) {
                if margin.is_some() {
                    nearest = nearest.min(pitch().distance_to(area, at) + 0.1);
                }
            }
        }
        assert!(at.distance(to) < 0.03, "it arrives: {at:?}");
        nearest
    }

    #[test]
    fn a_free_way_is_straight() {
        let to = Vector::new(2.0, 1.0);
        assert_eq!(next_corner(FROM, to, &Obstacles::default(), &pitch()), to);
    }

    #[test]
    fn ways_lead_around_one_and_two_robots() {
        let to = Vector::new(2.0, 0.0);
        assert!(walk(FROM, to, &[(1.0, 0.05)], [None; 2]) > 0.2);
        assert!(walk(FROM, to, &[(1.0, 0.1), (1.0, -0.15)], [None; 2]) > 0.2);
        assert!(walk(FROM, to, &[(0.6, 0.0), (1.3, 0.1)], [None; 2]) > 0.2);
    }

    #[test]
    fn ways_lead_around_an_area() {
        let (from, to) = (Vector::new(-4.2, 1.3), Vector::new(-4.2, -1.3));
        assert!(walk(from, to, &[], [Some(0.1), Some(0.1)]) > 0.16);
        let (from, to) = (Vector::new(3.0, 1.3), Vector::new(4.2, -1.3));
        assert!(walk(from, to, &[], [Some(0.1), Some(0.1)]) > 0.16);
    }
}

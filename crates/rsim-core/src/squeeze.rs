//! A ball caught between bodies that come together: robots, or a robot and walls.
//!
//! A solver that takes one contact after the other cannot pass a push through a ball that weighs a
//! sixtieth of a robot: what is missing shrinks by a sixtieth in each pass, and robots sink into the
//! ball and are thrown back. Caught, the ball's own inertia does not matter. So it gets the velocity at
//! which all that catch it would move on together, and for the solver, as long as it is caught, a mass
//! that passes pushes on.

use rapier2d::math::Vector;

use crate::engine::{BALL, Engine, Room, robot, rotation};
use crate::physique::{Physique, RobotBody};

/// Things that a ball can be caught between: more than fit around one.
const MOST_SIDES: usize = 12;

/// What is this near in space or time counts as touching: m, and m/s of coming closer.
const NEAR: f32 = 5e-4;
const SLACK: f32 = 0.1;
/// The same for a ball that was caught already: what presses on it comes off slowly.
const HELD_SLACK: f32 = 0.5;

/// How nearly opposite two sides must be to jam a ball, as the cosine of the angle: out of a wider
/// wedge it slips by itself, with its own mass. At less than the second they leave it a way out.
const OPPOSITE: f32 = 0.9;
const ASLANT: f32 = 0.3;

/// Mass of a caught ball for the solver, by the lightest robot that catches it.
const CAUGHT_MASS: f32 = 0.5;

/// Pull of a wall on the velocity of a caught ball, by that of a robot.
const WALL_WEIGHT: f32 = 1e4;

/// One of the things around the ball.
#[derive(Debug, Clone, Copy)]
struct Side {
    /// From it to the ball, a unit vector.
    normal: Vector,
    /// m.
    gap: f32,
    /// Speed of its surface towards the ball, m/s.
    speed: f32,
    /// kg, that a push meets there; infinite for a wall.
    mass: f32,
}

impl Side {
    fn of_robot(
        engine: &Engine,
        index: usize,
        body: &RobotBody,
        center: Vector,
        radius: f32,
        tick: f32,
    ) -> Self {
        let motion = engine.motion(robot(index));
        let heading = rotation(motion.heading);
        let nearest = body.outline.nearest_at(motion.position, heading, center);
        let normal = nearest.normal;
        let arm = center - motion.position - normal * nearest.distance;
        let velocity = motion.velocity + engine.acceleration(robot(index)) * tick;
        let speed = (velocity + arm.perp() * motion.spin).dot(normal);
        let mass = 1.0 / body.yields(arm, normal);
        Self { normal, gap: nearest.distance - radius, speed, mass }
    }
}

/// The things around the ball in a tick.
struct Sides {
    all: [Option<Side>; MOST_SIDES],
    count: usize,
}

/// A ball that is caught in a tick.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Squeeze {
    /// m/s.
    pub(crate) velocity: Vector,
    /// For the solver, kg.
    pub(crate) mass: f32,
    /// Whether it cannot slip out.
    pub(crate) jammed: bool,
    /// Of the fastest around it, or its own, m/s.
    pub(crate) speed: f32,
}

impl Squeeze {
    /// Whether the ball, which moves with `velocity` and has its centre at a `height`, is caught in the
    /// coming `tick`.
    pub(crate) fn find(
        engine: &Engine,
        physique: &Physique,
        room: &Room,
        velocity: Vector,
        height: f32,
        tick: f32,
    ) -> Option<Self> {
        let sides = Sides::find(engine, physique, room, height, tick);
        if sides.count < 2 {
            return None;
        }
        let slack = if engine.was_caught() { HELD_SLACK } else { SLACK };
        let closes = |gap: f32, speed: f32| gap < NEAR + tick * (speed + slack);
        let own = physique.ball.mass;
        let close = sides.iter().filter(|side| side.gap < physique.ball.radius);
        let speeds = close.map(|side| side.speed.abs());
        let speed = speeds.fold(velocity.length(), f32::max);
        if let Some(velocity) = sides.jam(velocity, own, closes) {
            let mass = (CAUGHT_MASS * sides.lightest()).max(own);
            return Some(Self { velocity, mass, jammed: true, speed });
        }
        sides.wedge(closes).then_some(Self { velocity, mass: own, jammed: false, speed })
    }
}

impl Sides {
    fn find(engine: &Engine, physique: &Physique, room: &Room, height: f32, tick: f32) -> Self {
        let mut sides = Self { all: [None; MOST_SIDES], count: 0 };
        let (center, radius) = (engine.motion(BALL).position, physique.ball.radius);
        let bodies = || {
            let all = physique.robots.iter().enumerate();
            all.filter(|(_, body)| height < body.model.height)
        };
        // What comes from one side may press the ball against what stands on the other.
        let fastest =
            bodies().map(|(index, _)| engine.motion(robot(index)).velocity.length_squared());
        let fastest = fastest.fold(0.0, f32::max).sqrt();
        let reach = NEAR + (2.0 * fastest + HELD_SLACK) * tick;
        for (index, body) in bodies() {
            let apart = center - engine.motion(robot(index)).position;
            let near = radius + body.model.bounding_radius() + reach;
            if apart.length_squared() < near * near {
                sides.add(Side::of_robot(engine, index, body, center, radius, tick));
            }
        }
        if sides.count > 0 {
            for wall in room.walls_near(center, radius + reach).filter(|wall| height < wall.top) {
                let nearest = wall.place.nearest(center);
                let gap = nearest.distance - radius;
                sides.add(Side { normal: nearest.normal, gap, speed: 0.0, mass: f32::INFINITY });
            }
        }
        sides
    }

    fn add(&mut self, side: Side) {
        if let Some(slot) = self.all.get_mut(self.count) {
            *slot = Some(side);
            self.count += 1;
        }
    }

    fn iter(&self) -> impl Iterator<Item = &Side> {
        self.all.iter().flatten()
    }

    /// How the ball moves on if two or three of them leave it no room and no way out: with what comes
    /// together, or else as it did. `closes` says whether room (m) that shrinks (m/s) is gone at the
    /// end of the tick.
    fn jam(
        &self,
        velocity: Vector,
        mass: f32,
        closes: impl Fn(f32, f32) -> bool,
    ) -> Option<Vector> {
        let jam = self.pairs().filter(|[a, b]| {
            -a.normal.dot(b.normal) > OPPOSITE && closes(a.gap + b.gap, a.speed + b.speed)
        });
        // Of several, those that leave the least room.
        let room = |[a, b]: &[&Side; 2]| a.gap + b.gap;
        if let Some([a, b]) = jam.min_by(|one, other| room(one).total_cmp(&room(other))) {
            // Friction keeps it where the two sides are so nearly opposite: it moves with them along
            // their common normal, and across it as it did.
            let axis = (a.normal - b.normal).normalize();
            let [weight_a, weight_b] = [a, b].map(|side| self.weight(side));
            let own = velocity.dot(axis);
            let common = (weight_a * a.speed - weight_b * b.speed + mass * own)
                / (weight_a + weight_b + mass);
            return Some(velocity + axis * (common - own));
        }
        let held = self.pairs().any(|[a, b]| {
            self.iter().any(|c| around([a, b, c]).is_some_and(|(gap, speed)| closes(gap, speed)))
        });
        held.then(|| self.common(velocity, mass))
    }

    /// Whether two of them close on the ball from aslant: it slips out, but must stay in contact.
    fn wedge(&self, closes: impl Fn(f32, f32) -> bool) -> bool {
        self.pairs().any(|[a, b]| {
            -a.normal.dot(b.normal) > ASLANT && closes(a.gap + b.gap, a.speed + b.speed)
        })
    }

    fn pairs(&self) -> impl Iterator<Item = [&Side; 2]> {
        let all = self.iter().enumerate();
        all.flat_map(|(nth, first)| self.iter().take(nth).map(move |second| [first, second]))
    }

    /// kg; of a wall so much that nothing moves it.
    fn weight(&self, side: &Side) -> f32 {
        side.mass.min(WALL_WEIGHT * self.lightest())
    }

    /// Mass of the lightest robot, kg.
    fn lightest(&self) -> f32 {
        self.iter().map(|side| side.mass).fold(f32::INFINITY, f32::min)
    }

    /// The velocity at which all move on together, of a ball that is held from all around: the least
    /// squares of what each side misses, as a symmetric 2 x 2 system.
    fn common(&self, velocity: Vector, mass: f32) -> Vector {
        let (mut xx, mut xy, mut yy, mut right) = (mass, 0.0, mass, velocity * mass);
        for side in self.iter() {
            let weight = self.weight(side);
            let Vector { x, y } = side.normal;
            (xx, xy, yy) = (xx + weight * x * x, xy + weight * x * y, yy + weight * y * y);
            right += side.normal * (weight * side.speed);
        }
        let determinant = xx * yy - xy * xy;
        Vector::new(yy * right.x - xy * right.y, xx * right.y - xy * right.x) / determinant
    }
}

/// What three sides that hold a ball from all around leave of room (m), and how fast it shrinks
/// (m/s); `None` if there is a way out.
fn around(sides: [&Side; 3]) -> Option<(f32, f32)> {
    let [a, b, c] = sides.map(|side| side.normal);
    let determinant = a.perp_dot(b);
    if determinant.abs() < 0.1 {
        return None;
    }
    // -c as a sum of a and b, both shares positive.
    let (share_a, share_b) = (b.perp_dot(c) / determinant, c.perp_dot(a) / determinant);
    if share_a < 0.0 || share_b < 0.0 {
        return None;
    }
    let [a, b, c] = sides;
    Some((
        c.gap + share_a * a.gap + share_b * b.gap,
        c.speed + share_a * a.speed + share_b * b.speed,
    ))
}

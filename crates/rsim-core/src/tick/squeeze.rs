//! A ball squeezed between bodies that close on it: robots, or a robot and walls.
//!
//! A solver that treats one contact after the other cannot pass a push through a ball with a sixtieth
//! of a robot's mass: the error shrinks by a sixtieth in each pass, so robots sink into the ball and are
//! thrown back. The inertia of a jammed ball does not matter. So the ball gets the common velocity of
//! the bodies that jam it, and, as long as it is jammed, a mass in the solver that passes pushes on.

use crate::blocks::{BALL, robot, set_bits};
use crate::bodies::{Bodies, FastestRobot};
use crate::body_parameters::{BodyParameters, RobotParameters};
use crate::engine::SqueezedBall;
use crate::geometry::free_space::FreeSpace;
use crate::math::Vector;

/// Maximum number of bodies and walls around a ball; more do not fit.
const MAX_SIDES: usize = 12;

/// Gap (m) and closing speed (m/s) that count as touching.
const NEAR: f32 = 5e-4;
const SLACK: f32 = 0.1;
/// Closing speed that counts as touching for a ball that was jammed already, m/s: bodies that press on
/// it come off slowly.
const JAMMED_SLACK: f32 = 0.5;

/// Cosine of the angle between two sides above which they jam a ball; out of a wider wedge the ball
/// slips by itself, with its own mass. Below the second value the two sides leave it a way out.
const OPPOSITE: f32 = 0.9;
const WEDGE: f32 = 0.3;

/// Mass of a jammed ball in the solver, by the effective mass of the lightest robot around it.
const JAMMED_MASS_RATIO: f32 = 0.5;

/// Weight of a wall in the common velocity, by that of the lightest robot.
const WALL_WEIGHT: f32 = 1e4;

/// A body or wall around the ball.
#[derive(Debug, Clone, Copy, Default)]
struct Side {
    /// Unit vector from the side to the ball.
    normal: Vector,
    /// m.
    gap: f32,
    /// Speed of the surface toward the ball, m/s.
    speed: f32,
    /// Effective mass at the contact point, kg; infinite for a wall.
    mass: f32,
}

impl Side {
    fn of_robot(
        bodies: &Bodies,
        index: usize,
        body: &RobotParameters,
        center: Vector,
        radius: f32,
        tick: f32,
    ) -> Self {
        let motion = bodies.motion(robot(index));
        let nearest = body.outline.nearest_at(motion.position, motion.rotation(), center);
        let normal = nearest.normal;
        let arm = center - motion.position - normal * nearest.distance;
        let velocity = motion.velocity + bodies.acceleration(robot(index)).linear * tick;
        let speed = (velocity + arm.perp() * motion.angular_velocity).dot(normal);
        let mass = 1.0 / body.inverse_effective_mass(arm, normal);
        Self { normal, gap: nearest.distance - radius, speed, mass }
    }
}

/// The sides around the ball in a tick.
struct Sides {
    places: [Side; MAX_SIDES],
    /// Number of sides, which have the first places.
    count: usize,
}

/// A squeezed ball in a tick.
#[derive(Debug, Clone, Copy)]
pub(super) struct Squeeze {
    /// Velocity of the ball: of a jammed one, the common velocity of its sides, m/s.
    pub(super) velocity: Vector,
    /// Settings of the solver.
    pub(super) solver: SqueezedBall,
    /// Maximum of the ball's speed and those of the sides near it, m/s.
    pub(super) speed: f32,
}

impl Squeeze {
    /// The squeeze within the coming `tick` (s) of a ball that moves with `velocity` and has its center
    /// at `height`, if any.
    pub(super) fn find(
        bodies: &Bodies,
        parameters: &BodyParameters,
        free_space: &FreeSpace,
        velocity: Vector,
        height: f32,
        tick: f32,
        fastest: FastestRobot,
    ) -> Option<Self> {
        // A body from one side may press the ball against one at rest on the other.
        let reach = NEAR + (2.0 * fastest.within(0.0) + JAMMED_SLACK) * tick;
        let sides = Sides::find(bodies, parameters, free_space, height, tick, reach)?;
        if sides.count < 2 {
            return None;
        }
        let slack = if bodies.ball_was_jammed(parameters) { JAMMED_SLACK } else { SLACK };
        let closes = |gap: f32, speed: f32| gap < NEAR + tick * (speed + slack);
        let own = parameters.ball.mass;
        let close = sides.iter().filter(|side| side.gap < parameters.ball.radius);
        let speeds = close.map(|side| side.speed.abs());
        let speed = speeds.fold(velocity.length(), f32::max);
        if let Some(velocity) = sides.jam(velocity, own, closes) {
            let mass = (JAMMED_MASS_RATIO * sides.lightest()).max(own);
            return Some(Self { velocity, solver: SqueezedBall { mass, jammed: true }, speed });
        }
        let solver = SqueezedBall { mass: own, jammed: false };
        sides.wedge(closes).then_some(Self { velocity, solver, speed })
    }
}

impl Sides {
    /// The sides around a ball at `height` within `reach` (m) of it, if a robot is.
    fn find(
        bodies: &Bodies,
        parameters: &BodyParameters,
        free_space: &FreeSpace,
        height: f32,
        tick: f32,
        reach: f32,
    ) -> Option<Self> {
        let (center, radius) = (bodies.motion(BALL).position, parameters.ball.radius);
        let near = bodies.robots_near_ball(parameters, reach);
        if near == 0 {
            return None; // in most ticks
        }
        let mut sides = Self { places: [Side::default(); MAX_SIDES], count: 0 };
        for index in set_bits(near) {
            let body = &parameters.robots[index];
            if height < body.model.height {
                sides.add(Side::of_robot(bodies, index, body, center, radius, tick));
            }
        }
        if sides.count > 0 {
            let walls = free_space.walls_near(center, radius + reach);
            for wall in walls.filter(|wall| height < wall.top) {
                let nearest = wall.outline.nearest(center);
                let gap = nearest.distance - radius;
                sides.add(Side { normal: nearest.normal, gap, speed: 0.0, mass: f32::INFINITY });
            }
        }
        Some(sides)
    }

    fn add(&mut self, side: Side) {
        if let Some(place) = self.places.get_mut(self.count) {
            *place = side;
            self.count += 1;
        }
    }

    fn iter(&self) -> impl Iterator<Item = &Side> {
        self.places[..self.count].iter()
    }

    /// Velocity of a ball that two or three sides jam, m/s; `None` if it has a way out. `closes` says
    /// whether a gap (m) that shrinks at a speed (m/s) is closed at the end of the tick.
    fn jam(
        &self,
        velocity: Vector,
        mass: f32,
        closes: impl Fn(f32, f32) -> bool,
    ) -> Option<Vector> {
        let jam = self.pairs().filter(|[a, b]| {
            -a.normal.dot(b.normal) > OPPOSITE && closes(a.gap + b.gap, a.speed + b.speed)
        });
        // Of several pairs, the one with the smallest gap.
        let gap = |[a, b]: &[&Side; 2]| a.gap + b.gap;
        if let Some([a, b]) = jam.min_by(|one, other| gap(one).total_cmp(&gap(other))) {
            // Friction holds the ball between sides so nearly opposite: along their common normal it
            // moves with them, across it as before.
            let axis = (a.normal - b.normal).normalize();
            let [weight_a, weight_b] = [a, b].map(|side| self.weight(side));
            let own = velocity.dot(axis);
            let common = (weight_a * a.speed - weight_b * b.speed + mass * own)
                / (weight_a + weight_b + mass);
            return Some(velocity + axis * (common - own));
        }
        let enclosed = self.pairs().any(|[a, b]| {
            self.iter().any(|c| enclosing([a, b, c]).is_some_and(|(gap, speed)| closes(gap, speed)))
        });
        enclosed.then(|| self.common_velocity(velocity, mass))
    }

    /// Whether two sides close on the ball as a wedge: the ball slips out, but must stay in contact.
    fn wedge(&self, closes: impl Fn(f32, f32) -> bool) -> bool {
        self.pairs().any(|[a, b]| {
            -a.normal.dot(b.normal) > WEDGE && closes(a.gap + b.gap, a.speed + b.speed)
        })
    }

    fn pairs(&self) -> impl Iterator<Item = [&Side; 2]> {
        let all = self.iter().enumerate();
        all.flat_map(|(nth, first)| self.iter().take(nth).map(move |second| [first, second]))
    }

    /// Weight of a side in the common velocity, kg; that of a wall is so large that nothing moves it.
    fn weight(&self, side: &Side) -> f32 {
        side.mass.min(WALL_WEIGHT * self.lightest())
    }

    /// Effective mass of the lightest robot, kg.
    fn lightest(&self) -> f32 {
        self.iter().map(|side| side.mass).fold(f32::INFINITY, f32::min)
    }

    /// Common velocity of the ball and the sides that enclose it, m/s: the least-squares solution of
    /// all closing speeds, from a symmetric 2 x 2 system.
    fn common_velocity(&self, velocity: Vector, mass: f32) -> Vector {
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

/// Remaining gap between three sides that enclose a ball (m), and the speed at which it shrinks (m/s);
/// `None` if there is a way out.
fn enclosing(sides: [&Side; 3]) -> Option<(f32, f32)> {
    let [a, b, c] = sides.map(|side| side.normal);
    let determinant = a.perp_dot(b);
    if determinant.abs() < 0.1 {
        return None;
    }
    // -c as a sum of a and b with positive factors.
    let (factor_a, factor_b) = (b.perp_dot(c) / determinant, c.perp_dot(a) / determinant);
    if factor_a < 0.0 || factor_b < 0.0 {
        return None;
    }
    let [a, b, c] = sides;
    Some((
        c.gap + factor_a * a.gap + factor_b * b.gap,
        c.speed + factor_a * a.speed + factor_b * b.speed,
    ))
}

//! Constraint of a contact: its one or two points are solved together.
//!
//! Two points on one face share the load of the face. Solved one after the other, the first would take
//! more than its part and turn the body.

use super::body::SolverBody;
use super::impulses::Impulses;
use super::manifold::Manifold;
use super::pass::Pass;
use super::two_points::solve_two;
use crate::math::Vector;

/// Difference below which separations of two points on a face count as equal, m. Otherwise rounding would turn the
/// body.
const ROUNDING_OF_SEPARATION: f32 = 1e-6;

/// A contact point in the solver.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ConstraintPoint {
    /// From both bodies' centers to the point, m.
    pub(super) arms: [Vector; 2],
    feature: u32,
    /// Along the normal, N s.
    pub(super) impulse: f32,
    /// m.
    separation: f32,
    /// Levers of the normal about both bodies' centers, m.
    levers: [f32; 2],
    /// Speed by a unit impulse, 1/kg, and its inverse.
    response: f32,
    mass: f32,
}

/// Friction of a contact: the points that touch lie on one face, so that their friction has one lever.
#[derive(Debug, Clone, Copy, Default)]
struct Friction {
    coefficient: f32,
    /// Along the tangent, N s.
    impulse: f32,
    /// Levers of the tangent about both bodies' centers, m.
    levers: [f32; 2],
    /// kg.
    mass: f32,
}

/// The contact of two bodies, or of a body (`second`) with a wall.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Constraint {
    first: usize,
    pub(super) second: usize,
    /// Unit vector from the first to the second.
    pub(super) normal: Vector,
    friction: Friction,
    points: [ConstraintPoint; 2],
    count: usize,
    /// Speed at one point by a unit impulse at the other, 1/kg.
    coupling: f32,
}

/// Relative motion of the two bodies of a constraint.
struct Relative {
    /// Of the centers, along the normal and along the tangent, m/s.
    along: f32,
    aside: f32,
    /// rad/s.
    angular_velocities: [f32; 2],
}

impl Relative {
    /// Speed of a point along the normal, m/s.
    fn closing(&self, levers: [f32; 2]) -> f32 {
        self.along + self.angular_velocities[1] * levers[1] - self.angular_velocities[0] * levers[0]
    }
}

/// Impulses along the normal that a pass gives.
struct Push {
    /// Of all points, and by how much they changed, N s.
    total: f32,
    change: f32,
    /// Angular impulses on both bodies by the change, N m s.
    turns: [f32; 2],
    /// By how much the speed at a point changed, m/s.
    speed: f32,
}

impl Constraint {
    /// The constraint of `manifold` between two bodies, which starts from `impulses`.
    pub(super) fn new(
        [first, second]: [usize; 2],
        bodies: &[SolverBody],
        manifold: &Manifold,
        friction: f32,
        impulses: &Impulses,
    ) -> Self {
        let (a, b) = (&bodies[first], &bodies[second]);
        let normal = manifold.normal;
        let linear = a.inverse_mass + b.inverse_mass;
        let response = |[lever_a, lever_b]: [f32; 2], [other_a, other_b]: [f32; 2]| {
            linear + lever_a * other_a * a.inverse_inertia + lever_b * other_b * b.inverse_inertia
        };
        let found = manifold.points();
        let mut points = [ConstraintPoint::default(); 2];
        for (point, found) in points.iter_mut().zip(found) {
            let arms = found.arms;
            let levers = arms.map(|arm| arm.perp_dot(normal));
            let response = response(levers, levers);
            *point = ConstraintPoint {
                arms,
                feature: found.feature,
                impulse: impulses.normal_of(found.feature),
                separation: found.separation,
                levers,
                response,
                mass: 1.0 / response,
            };
        }
        let count = found.len();
        let coupling = if count == 2 { response(points[0].levers, points[1].levers) } else { 0.0 };
        let friction = if friction > 0.0 {
            // Of an edge at an angle to the face only one end touches.
            let nearest = found.iter().min_by(|a, b| a.separation.total_cmp(&b.separation));
            let levers = nearest.map_or([0.0; 2], |point| point.arms.map(|arm| arm.dot(normal)));
            let mass = 1.0 / response(levers, levers);
            Friction { coefficient: friction, impulse: impulses.tangent, levers, mass }
        } else {
            Friction::default()
        };
        Self { first, second, normal, friction, points, count, coupling }
    }

    pub(super) fn points(&self) -> &[ConstraintPoint] {
        &self.points[..self.count]
    }

    pub(super) fn impulses(&self) -> Impulses {
        let normals = self.points.map(|point| (point.feature, point.impulse));
        Impulses { normals, tangent: self.friction.impulse }
    }

    /// Notes that the bodies are within each other's reach.
    pub(super) fn note_reach(&self, bodies: &mut [SolverBody]) {
        for body in [self.first, self.second] {
            bodies[body].come_within_reach();
        }
    }

    /// Applies the impulses that the solution starts from.
    pub(super) fn warm_start(&mut self, bodies: &mut [SolverBody]) {
        let [one, two] = &self.points;
        let impulses = [one.impulse, two.impulse];
        if impulses[0] <= 0.0 && impulses[1] <= 0.0 {
            self.friction.impulse = 0.0;
            return;
        }
        let friction = self.friction.impulse;
        let turns = self.turns(impulses);
        let turns = [0, 1].map(|body| turns[body] + self.friction.levers[body] * friction);
        self.apply(bodies, impulses[0] + impulses[1], friction, turns);
    }

    /// Moves the points with the bodies for `time` (s).
    pub(super) fn close(&mut self, bodies: &[SolverBody], time: f32) {
        let relative = self.relative(bodies);
        for point in &mut self.points[..self.count] {
            point.separation += relative.closing(point.levers) * time;
        }
    }

    /// Corrects the velocities: along the normal, then by friction. Returns by how much the impulses
    /// along the normal changed speeds at the points, m/s.
    pub(super) fn solve(&mut self, bodies: &mut [SolverBody], pass: &Pass) -> f32 {
        let relative = self.relative(bodies);
        let pushed = if self.count == 1 {
            self.push_at_one(&relative, pass)
        } else {
            self.push_at_two(&relative, pass)
        };
        let Some(Push { total, change, mut turns, speed }) = pushed else { return 0.0 };
        let mut tangent = 0.0;
        let Friction { coefficient, impulse, levers, mass } = self.friction;
        if coefficient > 0.0 {
            // The impulses along the normal change the slip only by turning the bodies.
            let (a, b) = (&bodies[self.first], &bodies[self.second]);
            let angular_velocities = [
                relative.angular_velocities[0] - turns[0] * a.inverse_inertia,
                relative.angular_velocities[1] + turns[1] * b.inverse_inertia,
            ];
            let slip = relative.aside + angular_velocities[1] * levers[1]
                - angular_velocities[0] * levers[0];
            let limit = coefficient * total;
            self.friction.impulse = (impulse - mass * slip).clamp(-limit, limit);
            tangent = self.friction.impulse - impulse;
            turns = [turns[0] + levers[0] * tangent, turns[1] + levers[1] * tangent];
        }
        self.apply(bodies, change, tangent, turns);
        speed
    }

    /// Changes the impulse of a contact of one point. Returns `None` if it had none and gets none.
    fn push_at_one(&mut self, relative: &Relative, pass: &Pass) -> Option<Push> {
        let point = &mut self.points[0];
        let old = point.impulse;
        let row = pass.row(relative.closing(point.levers), point.separation);
        let total = ((point.response * old - row.speed) * (point.mass * row.mass_scale)).max(0.0);
        if old <= 0.0 && total <= 0.0 {
            return None;
        }
        point.impulse = total;
        let change = total - old;
        let turns = point.levers.map(|lever| lever * change);
        Some(Push { total, change, turns, speed: (change * point.response).abs() })
    }

    /// Changes the impulses of a contact of two points. Returns `None` if both had none and get none.
    fn push_at_two(&mut self, relative: &Relative, pass: &Pass) -> Option<Push> {
        let [one, two] = &mut self.points;
        let old = [one.impulse, two.impulse];
        let is_idle = old[0] <= 0.0 && old[1] <= 0.0;
        let mut separations = [one.separation, two.separation];
        if (separations[1] - separations[0]).abs() < ROUNDING_OF_SEPARATION {
            separations = [0.5 * (separations[0] + separations[1]); 2];
        }
        let row = pass.row(relative.closing(one.levers), separations[0]);
        let other = pass.row(relative.closing(two.levers), separations[1]);
        if is_idle && row.speed >= 0.0 && other.speed >= 0.0 {
            return None;
        }
        let offsets = [
            row.speed - one.response * old[0] - self.coupling * old[1],
            other.speed - two.response * old[1] - self.coupling * old[0],
        ];
        let diagonal = [one.response * row.stretch, two.response * other.stretch];
        let new = solve_two(diagonal, self.coupling, offsets);
        if is_idle && new[0] <= 0.0 && new[1] <= 0.0 {
            return None;
        }
        [one.impulse, two.impulse] = new;
        let changes = [new[0] - old[0], new[1] - old[1]];
        let speeds = [changes[0] * one.response, changes[1] * two.response];
        Some(Push {
            total: new[0] + new[1],
            change: changes[0] + changes[1],
            turns: self.turns(changes),
            speed: speeds[0].abs().max(speeds[1].abs()),
        })
    }

    fn relative(&self, bodies: &[SolverBody]) -> Relative {
        let (a, b) = (&bodies[self.first], &bodies[self.second]);
        let velocity = b.velocity - a.velocity;
        Relative {
            along: velocity.dot(self.normal),
            aside: self.normal.perp_dot(velocity),
            angular_velocities: [a.angular_velocity, b.angular_velocity],
        }
    }

    /// Angular impulses on both bodies by impulses at the points, N m s.
    fn turns(&self, impulses: [f32; 2]) -> [f32; 2] {
        let [one, two] = &self.points;
        [0, 1].map(|body| one.levers[body] * impulses[0] + two.levers[body] * impulses[1])
    }

    /// Applies impulses along the normal and the tangent (N s) and angular impulses (N m s).
    fn apply(&self, bodies: &mut [SolverBody], normal: f32, tangent: f32, turns: [f32; 2]) {
        let impulse = self.normal * normal + self.normal.perp() * tangent;
        let first = &mut bodies[self.first];
        first.velocity -= impulse * first.inverse_mass;
        first.angular_velocity -= turns[0] * first.inverse_inertia;
        let second = &mut bodies[self.second];
        second.velocity += impulse * second.inverse_mass;
        second.angular_velocity += turns[1] * second.inverse_inertia;
    }
}

//! Constraint of a contact: its one or two points are solved together.
//!
//! Two points on one face share the load of the face. Solved one after the other, the first would take
//! more than its part and turn the body.

use super::SolverBody;
use super::manifold::Manifold;
use crate::math::Vector;

/// Maximum speed at which overlapping bodies are pushed apart, m/s.
const MAX_PUSH_SPEED: f32 = 1.0;

/// Depth that is not corrected, m: contacts at rest stay in contact.
const ALLOWED_DEPTH: f32 = 5e-6;

/// Determinant of the two points' inverse masses, by the product of its diagonal, below which the
/// points are too near each other to be solved together.
const MIN_DETERMINANT: f32 = 1e-3;

/// Stiffness of contacts, Hz: the largest that a sub-step of 1.25 ms resolves, by
/// [`MAX_STIFFNESS`]. Half of it doubles the depths of crowds.
const STIFFNESS: f32 = 400.0;

/// Maximum stiffness by the rate of sub-steps.
const MAX_STIFFNESS: f32 = 0.5;

/// Damping ratio: a push out of an overlap does not overshoot.
const DAMPING: f32 = 2.0;

/// Response of a soft constraint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Softness {
    /// Speed of correction per depth, 1/s.
    bias_rate: f32,
    /// Speed that a unit impulse changes and leaves uncorrected, by the speed that it changes; and the
    /// inverse.
    stretch: f32,
    mass_scale: f32,
}

impl Softness {
    /// A damped spring in implicit integration with a step of `time` (s).
    pub(super) fn new(time: f32) -> Self {
        let omega = std::f32::consts::TAU * STIFFNESS.min(MAX_STIFFNESS / time);
        let a = 2.0 * DAMPING + time * omega;
        let stretch = 1.0 + 1.0 / (time * omega * a);
        Self { bias_rate: omega / a, stretch, mass_scale: 1.0 / stretch }
    }
}

/// Impulses of a contact point, N s.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Impulse {
    pub(super) normal: f32,
    pub(super) tangent: f32,
}

/// A contact point in the solver.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ConstraintPoint {
    /// On the field, m.
    pub(super) position: Vector,
    pub(super) feature: u32,
    pub(super) impulse: Impulse,
    /// m.
    separation: f32,
    /// Levers of the normal and of the tangent about both bodies' centres, m.
    normal_levers: [f32; 2],
    tangent_levers: [f32; 2],
    /// Speed by a unit impulse along the normal, 1/kg.
    inverse_mass: f32,
    /// kg.
    normal_mass: f32,
    tangent_mass: f32,
}

/// The contact of two bodies, or of a body (`second`) with a wall.
#[derive(Debug, Clone, Copy)]
pub(super) struct Constraint {
    /// Index of the pair.
    pub(super) link: usize,
    first: usize,
    second: usize,
    /// Unit vector from the first to the second.
    pub(super) normal: Vector,
    friction: f32,
    softness: Softness,
    points: [ConstraintPoint; 2],
    count: usize,
    /// Speed at one point by a unit impulse at the other, 1/kg.
    coupling: f32,
}

/// Velocities of the two bodies of a constraint.
struct Velocities {
    linear: [Vector; 2],
    spin: [f32; 2],
    inverse_mass: [f32; 2],
    inverse_inertia: [f32; 2],
}

impl Velocities {
    fn of(bodies: &[SolverBody], [first, second]: [usize; 2]) -> Self {
        let (a, b) = (&bodies[first], &bodies[second]);
        Self {
            linear: [a.velocity, b.velocity],
            spin: [a.spin, b.spin],
            inverse_mass: [a.inverse_mass, b.inverse_mass],
            inverse_inertia: [a.inverse_inertia, b.inverse_inertia],
        }
    }

    fn write(&self, bodies: &mut [SolverBody], [first, second]: [usize; 2]) {
        (bodies[first].velocity, bodies[first].spin) = (self.linear[0], self.spin[0]);
        (bodies[second].velocity, bodies[second].spin) = (self.linear[1], self.spin[1]);
    }

    /// Speed of the second body against the first along a direction.
    fn relative(&self, direction: Vector, levers: [f32; 2]) -> f32 {
        (self.linear[1] - self.linear[0]).dot(direction) + self.spin[1] * levers[1]
            - self.spin[0] * levers[0]
    }

    fn apply(&mut self, impulse: f32, direction: Vector, levers: [f32; 2]) {
        self.linear[0] -= direction * (impulse * self.inverse_mass[0]);
        self.linear[1] += direction * (impulse * self.inverse_mass[1]);
        self.spin[0] -= levers[0] * (impulse * self.inverse_inertia[0]);
        self.spin[1] += levers[1] * (impulse * self.inverse_inertia[1]);
    }
}

impl Constraint {
    /// The constraint of `manifold` between two bodies. `start` has the impulse to start from for a
    /// feature.
    pub(super) fn new(
        link: usize,
        [first, second]: [usize; 2],
        bodies: &[SolverBody],
        manifold: &Manifold,
        friction: f32,
        softness: Softness,
        start: impl Fn(u32) -> Impulse,
    ) -> Self {
        let (a, b) = (&bodies[first], &bodies[second]);
        let normal = manifold.normal;
        let linear = a.inverse_mass + b.inverse_mass;
        let inverse_mass = |[lever_a, lever_b]: [f32; 2], [other_a, other_b]: [f32; 2]| {
            linear + lever_a * other_a * a.inverse_inertia + lever_b * other_b * b.inverse_inertia
        };
        let mut points = [ConstraintPoint::default(); 2];
        for (point, found) in points.iter_mut().zip(manifold.points()) {
            let arms = [found.position - a.position, found.position - b.position];
            let normal_levers = arms.map(|arm| arm.perp_dot(normal));
            let tangent_levers = arms.map(|arm| arm.perp_dot(normal.perp()));
            let tangent_mass = if friction > 0.0 {
                1.0 / inverse_mass(tangent_levers, tangent_levers)
            } else {
                0.0
            };
            let response = inverse_mass(normal_levers, normal_levers);
            *point = ConstraintPoint {
                position: found.position,
                feature: found.feature,
                impulse: start(found.feature),
                separation: found.separation,
                normal_levers,
                tangent_levers,
                inverse_mass: response,
                normal_mass: 1.0 / response,
                tangent_mass,
            };
        }
        let coupling = inverse_mass(points[0].normal_levers, points[1].normal_levers);
        let count = manifold.points().len();
        Self { link, first, second, normal, friction, softness, points, count, coupling }
    }

    pub(super) fn points(&self) -> &[ConstraintPoint] {
        &self.points[..self.count]
    }

    /// Applies the impulses that the solution starts from.
    pub(super) fn warm_start(&self, bodies: &mut [SolverBody]) {
        let pair = [self.first, self.second];
        let mut velocities = Velocities::of(bodies, pair);
        for point in self.points() {
            velocities.apply(point.impulse.normal, self.normal, point.normal_levers);
            velocities.apply(point.impulse.tangent, self.normal.perp(), point.tangent_levers);
        }
        velocities.write(bodies, pair);
    }

    /// Moves the points with the bodies for `time` (s).
    pub(super) fn close(&mut self, bodies: &[SolverBody], time: f32) {
        let velocities = Velocities::of(bodies, [self.first, self.second]);
        for point in &mut self.points[..self.count] {
            point.separation += velocities.relative(self.normal, point.normal_levers) * time;
        }
    }

    /// Corrects the velocities: along the normal, then by friction. `bias` pushes overlapping bodies
    /// apart; without it only velocities are corrected. `inverse_time` is that of a sub-step, 1/s.
    pub(super) fn solve(&mut self, bodies: &mut [SolverBody], inverse_time: f32, bias: bool) {
        let pair = [self.first, self.second];
        let mut velocities = Velocities::of(bodies, pair);
        let row = |point: &ConstraintPoint, velocities: &Velocities| {
            let speed = velocities.relative(self.normal, point.normal_levers);
            self.softness.row(speed, point.separation, inverse_time, bias)
        };
        if self.count == 1 {
            let Row { speed, is_soft } = row(&self.points[0], &velocities);
            let point = &mut self.points[0];
            let old = point.impulse.normal;
            let scale = if is_soft { self.softness.mass_scale } else { 1.0 };
            let total = (point.inverse_mass * old - speed) * (point.normal_mass * scale);
            if total <= 0.0 && old == 0.0 {
                return;
            }
            point.impulse.normal = total.max(0.0);
            velocities.apply(point.impulse.normal - old, self.normal, point.normal_levers);
        } else {
            let rows = [row(&self.points[0], &velocities), row(&self.points[1], &velocities)];
            let [one, two] = &mut self.points;
            let old = [one.impulse.normal, two.impulse.normal];
            if old == [0.0; 2] && rows[0].speed >= 0.0 && rows[1].speed >= 0.0 {
                return;
            }
            let offsets = [
                rows[0].speed - one.inverse_mass * old[0] - self.coupling * old[1],
                rows[1].speed - two.inverse_mass * old[1] - self.coupling * old[0],
            ];
            let stretch = |row: &Row| if row.is_soft { self.softness.stretch } else { 1.0 };
            let diagonal =
                [one.inverse_mass * stretch(&rows[0]), two.inverse_mass * stretch(&rows[1])];
            let totals = solve_two(diagonal, self.coupling, offsets);
            [one.impulse.normal, two.impulse.normal] = totals;
            velocities.apply(totals[0] - old[0], self.normal, one.normal_levers);
            velocities.apply(totals[1] - old[1], self.normal, two.normal_levers);
        }
        if self.friction > 0.0 {
            self.solve_friction(&mut velocities);
        }
        velocities.write(bodies, pair);
    }

    fn solve_friction(&mut self, velocities: &mut Velocities) {
        let tangent = self.normal.perp();
        for point in &mut self.points[..self.count] {
            let slip = velocities.relative(tangent, point.tangent_levers);
            let limit = self.friction * point.impulse.normal;
            let total = point.impulse.tangent - point.tangent_mass * slip;
            let total = total.clamp(-limit, limit);
            let change = total - point.impulse.tangent;
            point.impulse.tangent = total;
            velocities.apply(change, tangent, point.tangent_levers);
        }
    }
}

/// A point's equation: its closing speed with the push, and whether it is soft.
struct Row {
    speed: f32,
    is_soft: bool,
}

impl Softness {
    fn row(&self, speed: f32, separation: f32, inverse_time: f32, bias: bool) -> Row {
        if separation > 0.0 {
            Row { speed: speed + separation * inverse_time, is_soft: false }
        } else if bias {
            let depth = (separation + ALLOWED_DEPTH).min(0.0);
            let push = (self.bias_rate * depth).max(-MAX_PUSH_SPEED);
            Row { speed: speed + push, is_soft: true }
        } else {
            Row { speed, is_soft: false }
        }
    }
}

/// Impulses x of two points, not negative, for which `diagonal * x + coupling * other x + offset` is
/// zero, or not negative where x is zero.
fn solve_two(diagonal: [f32; 2], coupling: f32, offset: [f32; 2]) -> [f32; 2] {
    let product = diagonal[0] * diagonal[1];
    let determinant = product - coupling * coupling;
    if determinant > MIN_DETERMINANT * product {
        let inverse = 1.0 / determinant;
        let both = [
            (coupling * offset[1] - diagonal[1] * offset[0]) * inverse,
            (coupling * offset[0] - diagonal[0] * offset[1]) * inverse,
        ];
        if both[0] >= 0.0 && both[1] >= 0.0 {
            return both;
        }
    }
    let alone = [-offset[0] / diagonal[0], -offset[1] / diagonal[1]];
    let second_is_free = coupling * alone[0] + offset[1] >= 0.0;
    if alone[0] >= 0.0 && (second_is_free || alone[1] < 0.0) {
        return [alone[0], 0.0];
    }
    [0.0, alone[1].max(0.0)]
}

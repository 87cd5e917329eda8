//! The nearest valid state to a row that cannot be placed, such as an estimate from noisy senses.
//!
//! Bodies are moved apart pair by pair, each half of the way, until no two overlap by more than a state
//! may have. That is a projection onto the valid states by Gauss and Seidel's method. Where it does not
//! settle, in a crowd without space, bodies are placed one after the other at the nearest free spots.

use crate::blocks::{BALL, robot};
use crate::body_parameters::BodyParameters;
use crate::columns::{
    MAX_PLACED_ANGULAR_VELOCITY, MAX_PLACED_HEIGHT, MAX_PLACED_SPEED, MAX_PLACED_SPIN,
};
use crate::error::PlaceError;
use crate::geometry::arena::Wall;
use crate::geometry::clearance::Clearance;
use crate::math::{Vec3, Vector};
use crate::world::placement::{Placement, Start, TOLERANCE, length, pose};

/// Depth to which overlapping bodies are moved apart, m, and the depth from which they are: the rest to
/// [`TOLERANCE`] is for rounding.
const LEFT: f32 = 0.9 * TOLERANCE;
const TOO_DEEP: f32 = 0.95 * TOLERANCE;

/// Maximum number of passes over all pairs. Of the rows in `tests/estimate.rs`, most of which mean nothing,
/// nineteen of twenty settle in as many; estimates with errors of some centimeters settle in two.
const MAX_PASSES: usize = 32;

/// Share of a wall's or robot's normal in the vertical above which the ball is moved up or down.
const MAINLY_VERTICAL: f32 = 0.7;

/// Number of directions in which free spots are sought.
const DIRECTIONS: u8 = 16;

/// A valid state, and by how much each body was moved, m: ball, then robots.
pub(super) struct Nearest {
    pub(super) start: Start,
    pub(super) moved: Vec<f32>,
}

impl Placement {
    /// The valid state nearest to a row of finite numbers: the row itself if it is valid.
    pub(super) fn nearest(
        &self,
        row: &[f32],
        parameters: &BodyParameters,
    ) -> Result<Nearest, PlaceError> {
        let given = self.parse(row)?;
        let mut start = given.clone();
        if self.check(&mut start, parameters).is_err() {
            start = given.clone();
            tidy(&mut start);
            if !self.separate(&mut start, parameters) || self.check(&mut start, parameters).is_err()
            {
                self.find_spots(&mut start, parameters);
            }
        }
        Ok(Nearest { moved: distances(&given, &start), start })
    }

    /// Moves bodies apart, and returns whether that settled.
    fn separate(&self, start: &mut Start, parameters: &BodyParameters) -> bool {
        for who in start.present().chain([BALL]) {
            if self.is_behind_a_face(who, start) {
                self.find_spot(who, start, |_| true);
            }
        }
        for _ in 0..MAX_PASSES {
            let mut settled = true;
            let mut before = Vec::new();
            for who in start.present() {
                for first in before.iter().copied() {
                    settled &= self.part_robots([first, who], start);
                }
                before.push(who);
            }
            for who in before {
                settled &= self.part_from_ball(who, start, parameters);
                settled &= self.leave_walls(who, start);
            }
            settled &= self.move_ball_out(start);
            if settled {
                return true;
            }
        }
        false
    }

    /// Whether the center of a body is outside the field or in a wall. The shortest way out of a wall may
    /// then lead into the next one, and passes would not settle: most such rows would take the slower search
    /// for spots.
    fn is_behind_a_face(&self, who: usize, start: &Start) -> bool {
        let (center, z) = (start.motions[who].position, start.ball.z);
        let is_inside = |wall: &Wall| match who {
            BALL => self.ball_and_wall(wall, center, z).distance < -self.bounding_radius(BALL),
            _ => wall.stands_on_floor() && wall.placed().nearest(center).distance < 0.0,
        };
        !center.abs().cmple(self.limit(who, z)).all()
            || self.walls.iter().any(|(wall, _)| is_inside(wall))
    }

    /// Moves two robots apart, and returns whether they already were.
    fn part_robots(&self, pair: [usize; 2], start: &mut Start) -> bool {
        let [a, b] = pair;
        let apart = start.motions[b].position - start.motions[a].position;
        let reach = self.bounding_radius(a) + self.bounding_radius(b);
        if apart.length_squared() > reach * reach {
            return true;
        }
        let [place_a, place_b] = pair.map(|who| pose(&start.motions[who]));
        let Some((depth, normal)) =
            self.shape(a).penetration(&place_a, self.shape(b), &place_b, TOO_DEEP)
        else {
            return true;
        };
        let half_way = normal * ((depth - LEFT) / 2.0);
        start.motions[a].position -= half_way;
        start.motions[b].position += half_way;
        false
    }

    /// Moves the ball and a robot apart, and returns whether they already were.
    fn part_from_ball(&self, who: usize, start: &mut Start, parameters: &BodyParameters) -> bool {
        let clearance = self.ball_and_robot(who, &start.motions, start.ball.z, parameters);
        let Some(way) = way_out(&clearance) else { return true };
        if way.z == 0.0 {
            start.motions[who].position -= way.truncate() / 2.0;
            move_ball(start, way / 2.0);
        } else {
            move_ball(start, way);
        }
        false
    }

    /// Moves a robot into the field and out of walls, and returns whether it already was.
    fn leave_walls(&self, who: usize, start: &mut Start) -> bool {
        let limit = self.limit(who, 0.0);
        let motion = &mut start.motions[who];
        let mut settled = motion.position.abs().cmple(limit).all();
        motion.position = motion.position.clamp(-limit, limit);
        for (wall, shape) in self.walls.iter().filter(|(wall, _)| wall.stands_on_floor()) {
            if wall.placed().nearest(motion.position).distance > self.bounding_radius(who) {
                continue;
            }
            let found = shape.penetration(&wall.pose, self.shape(who), &pose(motion), TOO_DEEP);
            if let Some((depth, normal)) = found {
                motion.position += normal * (depth - LEFT);
                settled = false;
            }
        }
        settled
    }

    /// Moves the ball into the field and out of walls, and returns whether it already was.
    fn move_ball_out(&self, start: &mut Start) -> bool {
        let limit = self.limit(BALL, start.ball.z);
        let position = start.motions[BALL].position;
        let mut settled = position.abs().cmple(limit).all();
        start.motions[BALL].position = position.clamp(-limit, limit);
        for (wall, _) in &self.walls {
            let center = start.motions[BALL].position;
            if let Some(way) = way_out(&self.ball_and_wall(wall, center, start.ball.z)) {
                move_ball(start, way);
                settled = false;
            }
        }
        settled
    }

    /// Places the robots and then the ball one after the other, each at the free spot that is nearest to
    /// where it is. If there is none, all bodies go to their default line-up.
    fn find_spots(&self, start: &mut Start, parameters: &BodyParameters) {
        let present: Vec<usize> = start.present().collect();
        let found = present.iter().enumerate().all(|(placed, &who)| {
            self.find_spot(who, start, |start| {
                let mut others = present[..placed].iter();
                others.all(|&other| self.are_apart([other, who], start))
            })
        });
        let found = found
            && self.find_spot(BALL, start, |start| {
                let mut robots = present.iter();
                robots.all(|&who| {
                    self.check_ball(who, &start.motions, &start.ball, parameters).is_ok()
                })
            });
        if !found {
            for who in present.into_iter().chain([BALL]) {
                let lined_up = &self.line_up[who];
                let motion = &mut start.motions[who];
                (motion.position, motion.heading) = (lined_up.position, lined_up.heading);
            }
            start.ball.z = 0.0;
        }
    }

    /// Moves a body to the nearest spot in the field at which it fulfils a condition, in the directions
    /// that are sought. Returns whether there is one.
    fn find_spot(&self, who: usize, start: &mut Start, fits: impl Fn(&Start) -> bool) -> bool {
        let (limit, stride) = (self.limit(who, start.ball.z), self.bounding_radius(who) / 2.0);
        let center = start.motions[who].position.clamp(-limit, limit);
        let rings = (0..).map(|ring| stride * ring as f32);
        for radius in rings.take_while(|radius| *radius < 2.0 * limit.length()) {
            for direction in 0..DIRECTIONS {
                let turn = std::f32::consts::TAU / f32::from(DIRECTIONS) * f32::from(direction);
                let (sin, cos) = libm::sincosf(turn);
                start.motions[who].position = center + Vector::new(cos, sin) * radius;
                let mut motion = start.motions[who];
                let z = if who == BALL { start.ball.z } else { 0.0 };
                if self.check_alone(who, &mut motion, z).is_ok() && fits(start) {
                    return true;
                }
            }
        }
        false
    }

    fn are_apart(&self, pair: [usize; 2], start: &Start) -> bool {
        let [a, b] = pair.map(|who| (self.shape(who), pose(&start.motions[who])));
        a.0.penetration(&a.1, b.0, &b.1, TOLERANCE).is_none()
    }
}

/// Brings everything but positions in the plane into its range.
fn tidy(start: &mut Start) {
    let ball = &mut start.ball;
    ball.z = ball.z.clamp(0.0, MAX_PLACED_HEIGHT);
    let velocity = at_most(start.motions[BALL].velocity.extend(ball.v_z), MAX_PLACED_SPEED);
    (start.motions[BALL].velocity, ball.v_z) = (velocity.truncate(), velocity.z);
    ball.spin = at_most(ball.spin, MAX_PLACED_SPIN);
    for motion in &mut start.motions[robot(0)..] {
        motion.velocity = at_most(motion.velocity.extend(0.0), MAX_PLACED_SPEED).truncate();
        motion.angular_velocity = motion
            .angular_velocity
            .clamp(-MAX_PLACED_ANGULAR_VELOCITY, MAX_PLACED_ANGULAR_VELOCITY);
        // A heading of no length has no direction.
        motion.heading = direction(motion.heading).unwrap_or(Vector::X);
    }
}

/// A vector of at most a length.
fn at_most(vector: Vec3, limit: f32) -> Vec3 {
    let length = length(vector);
    if length <= limit { vector } else { scaled(vector, f64::from(limit) / f64::from(length)) }
}

fn direction(vector: Vector) -> Option<Vector> {
    let length = length(vector.extend(0.0));
    (length > 0.0).then(|| scaled(vector.extend(0.0), 1.0 / f64::from(length)).truncate())
}

#[allow(clippy::cast_possible_truncation)] // to the precision of all states
fn scaled(vector: Vec3, factor: f64) -> Vec3 {
    Vec3::from_array(vector.to_array().map(|part| (f64::from(part) * factor) as f32))
}

/// The way that the ball must move out of a body, m, if it is too deep in it: beside it, above or below.
fn way_out(clearance: &Clearance) -> Option<Vec3> {
    let depth = -clearance.distance;
    if depth <= TOO_DEEP {
        return None;
    }
    let normal = clearance.normal;
    let is_vertical = normal.z.abs() > MAINLY_VERTICAL;
    let axis = if is_vertical { Vec3::Z * normal.z.signum() } else { normal.with_z(0.0) };
    Some(axis.normalize() * (depth - LEFT))
}

fn move_ball(start: &mut Start, way: Vec3) {
    start.motions[BALL].position += way.truncate();
    start.ball.z = (start.ball.z + way.z).max(0.0);
}

/// Distance of each body between two states, m.
fn distances(from: &Start, to: &Start) -> Vec<f32> {
    let rise = f64::from(to.ball.z) - f64::from(from.ball.z);
    let pairs = from.motions.iter().zip(&to.motions);
    pairs
        .enumerate()
        .map(|(who, (from, to))| {
            let [x, y] = [[from.position.x, to.position.x], [from.position.y, to.position.y]]
                .map(|[from, to]| f64::from(to) - f64::from(from));
            let z = if who == BALL { rise } else { 0.0 };
            #[allow(clippy::cast_possible_truncation)] // to the precision of all states
            let distance = (x * x + y * y + z * z).sqrt() as f32;
            distance
        })
        .collect()
}

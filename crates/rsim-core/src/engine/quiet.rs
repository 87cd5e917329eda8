//! Ticks in which nothing can touch: bodies coast, and the solver rests.
//!
//! Coasting computes what the solver would, in its own sub-steps. Whether it is allowed is decided on
//! the safe side, first by circles grown by all that they may move, then, where those meet, by a line
//! that keeps the two bodies apart for the whole tick.

use rapier2d::math::Vector;

use super::{BALL, BallHooks, Engine, Inverse, Motion, Push, robot};
use crate::Field;
use crate::arena::Wall;
use crate::outline::Outline;
use crate::physique::Physique;
use crate::robot_model::Body;

/// Bodies that stay farther apart than this do not touch, m: the solver's own prediction, and a tenth.
/// Nearer ones do to the solver: it has them bounce in the tick before they meet.
const MARGIN: f32 = 0.002_2;

/// More bodies than the leagues allow: then every tick is solved.
const MOST: usize = 32;

/// The part of a field that is free of walls, and the walls around it.
#[derive(Debug, Clone)]
pub(crate) struct Room {
    /// A body that stays within is far from every wall.
    free: Vector,
    walls: Vec<(Outline, Wall)>,
}

impl Room {
    pub(crate) fn of(field: &Field, walls: &[Wall]) -> Self {
        let standing = walls.iter().filter(|wall| wall.stands_on_floor());
        // Goals and corner blocks begin at the goal line, or a corner's leg before it.
        let free_x = field.half_length() - field.corner;
        Self {
            free: Vector::new(free_x, field.reach_y()),
            walls: standing.map(|wall| (wall.outline(), wall.clone())).collect(),
        }
    }

    /// Whether a body may touch a wall.
    fn may_touch(&self, body: &Moving) -> bool {
        let beyond = body.center.abs() + Vector::splat(body.reach);
        if beyond.x < self.free.x && beyond.y < self.free.y {
            return false;
        }
        self.walls.iter().any(|(outline, wall)| {
            let (at, facing) = (wall.pose.translation, wall.pose.rotation);
            let nearest = outline.nearest_at(at, facing, body.center);
            // A wall is convex: all of it lies behind the line through its nearest point.
            nearest.distance < body.reach
                && nearest.distance + body.way.dot(nearest.normal).min(0.0)
                    < body.extent(nearest.normal) + body.slack
        })
    }
}

/// A body during a tick, on the safe side.
#[derive(Clone, Copy)]
struct Moving {
    center: Vector,
    /// Where its centre goes, m.
    way: Vector,
    /// Half the side of a square along its heading and across; none of a disc.
    side: Option<Vector>,
    /// Of the circle around it, m.
    radius: f32,
    /// How far any point of it strays from that way, m, and half the margin.
    slack: f32,
    /// Of the circle that it stays in.
    reach: f32,
}

impl Moving {
    const NOTHING: Self = Self {
        center: Vector::ZERO,
        way: Vector::ZERO,
        side: None,
        radius: 0.0,
        slack: 0.0,
        reach: 0.0,
    };

    /// From the centre to the farthest point in a direction, at the start of the tick.
    fn extent(&self, direction: Vector) -> f32 {
        self.side
            .map_or(self.radius, |side| side.dot(direction).abs() + side.perp_dot(direction).abs())
    }

    /// Whether the two may touch.
    fn may_touch(&self, other: &Self) -> bool {
        let apart = other.center - self.center;
        let reach = self.reach + other.reach;
        if apart.length_squared() >= reach * reach {
            return false;
        }
        let way = other.way - self.way;
        let slack = self.slack + other.slack;
        let is_between = |direction: Vector| {
            let gap = apart.dot(direction);
            let least = gap.abs() + (way.dot(direction) * 1.0_f32.copysign(gap)).min(0.0);
            least > self.extent(direction) + other.extent(direction) + slack
        };
        let lines = [Some(apart), self.side, other.side];
        !lines.into_iter().flatten().any(|line| {
            let direction = line.normalize_or_zero();
            is_between(direction) || is_between(direction.perp())
        })
    }
}

impl Engine {
    /// Whether nothing can touch anything in the coming tick.
    pub(super) fn is_quiet(&self, ball: &BallHooks, room: &Room) -> bool {
        let mut bodies = [Moving::NOTHING; MOST];
        let robots = ball.physique.robots.len();
        if robots >= MOST {
            return false;
        }
        // A ball in the air touches others elsewhere.
        let first = if ball.flies { robot(0) } else { BALL };
        for (count, index) in (first..=robots).enumerate() {
            let body = self.moving(index, ball.physique);
            if bodies[..count].iter().any(|other| body.may_touch(other)) || room.may_touch(&body) {
                return false;
            }
            bodies[count] = body;
        }
        true
    }

    fn moving(&self, body: usize, physique: &Physique) -> Moving {
        let (motion, push, inverse) =
            (&self.motions[body], &self.pushes[body], &self.inverses[body]);
        let (radius, side) = if body == BALL {
            (physique.ball.radius, None)
        } else {
            let model = &physique.robots[body - 1].model;
            let side = match model.body {
                Body::Square { side } => Some(motion.heading * (side / 2.0)),
                Body::Round { .. } => None,
            };
            (model.bounding_radius(), side)
        };
        let tick = self.parameters.dt;
        let way = motion.velocity * tick;
        let pushed = push.force.length() * inverse.mass * tick * tick;
        let turned = (motion.spin.abs() + push.torque.abs() * inverse.inertia * tick) * tick;
        let swings = if side.is_some() { turned * radius } else { 0.0 };
        let slack = pushed + swings + MARGIN / 2.0;
        Moving {
            center: motion.position,
            way,
            side,
            radius,
            slack,
            reach: radius + way.length() + slack,
        }
    }

    /// A tick without contacts.
    pub(super) fn coast(&mut self) {
        let sub_steps = self.parameters.num_solver_iterations;
        let length = self.parameters.dt / sub_steps as f32;
        for (index, motion) in self.motions.iter_mut().enumerate() {
            coast(motion, &self.pushes[index], self.inverses[index], length, sub_steps);
        }
        self.moved.fill(true);
    }
}

fn coast(motion: &mut Motion, push: &Push, inverse: Inverse, length: f32, sub_steps: usize) {
    let faster = push.force * inverse.mass * length;
    let turns = push.torque * inverse.inertia * length;
    for _ in 0..sub_steps {
        motion.velocity += faster;
        motion.spin += turns;
        motion.position += motion.velocity * length;
        let angle = motion.spin * length;
        let heading = motion.heading;
        let turned = Vector::new(heading.x - angle * heading.y, heading.y + angle * heading.x);
        motion.heading = turned.normalize();
    }
}

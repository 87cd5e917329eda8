//! Ticks in which nothing can touch: bodies coast, and the solver rests.
//!
//! Coasting computes what the solver would, in its own sub-steps. Whether it is allowed is decided on
//! the safe side: bodies count as the circles around them, grown by all that they may move.

use rapier2d::math::Vector;

use super::{BALL, BallHooks, Engine, Inverse, Motion, Push, robot};
use crate::Field;
use crate::arena::Wall;
use crate::outline::Outline;
use crate::physique::Physique;

/// Farther apart than this nothing is looked at by the solver, m: twice its own prediction.
const MARGIN: f32 = 0.004;

/// Sub-steps of the solver in a tick.
pub(super) const SUB_STEPS: u8 = 4;

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

    /// Whether a circle may touch a wall.
    fn is_near(&self, center: Vector, reach: f32) -> bool {
        let beyond = center.abs() + Vector::splat(reach);
        if beyond.x < self.free.x && beyond.y < self.free.y {
            return false;
        }
        self.walls.iter().any(|(outline, wall)| {
            let (at, facing) = (wall.pose.translation, wall.pose.rotation);
            outline.nearest_at(at, facing, center).distance < reach
        })
    }
}

/// A body as the circle that it can be in during a tick.
#[derive(Clone, Copy)]
struct Circle {
    center: Vector,
    radius: f32,
}

impl Engine {
    /// Whether nothing can touch anything in the coming tick.
    pub(super) fn is_quiet(&self, ball: &BallHooks, room: &Room) -> bool {
        // More robots than the leagues allow: then every tick is solved.
        let mut circles = [Circle { center: Vector::ZERO, radius: 0.0 }; 32];
        let robots = ball.physique.robots.len();
        if robots >= circles.len() {
            return false;
        }
        // A ball in the air touches others elsewhere.
        let first = if ball.flies { robot(0) } else { BALL };
        for (count, body) in (first..=robots).enumerate() {
            let circle = self.circle(body, ball.physique);
            let meets = |other: &Circle| {
                let apart = circle.radius + other.radius;
                (circle.center - other.center).length_squared() < apart * apart
            };
            if circles[..count].iter().any(meets) || room.is_near(circle.center, circle.radius) {
                return false;
            }
            circles[count] = circle;
        }
        true
    }

    fn circle(&self, body: usize, physique: &Physique) -> Circle {
        let (motion, push) = (&self.motions[body], &self.pushes[body]);
        let radius = match body {
            BALL => physique.ball.radius,
            _ => physique.robots[body - 1].model.bounding_radius(),
        };
        let tick = self.parameters.dt;
        let faster = push.force.length() * self.inverses[body].mass * tick;
        let moves = (motion.velocity.length() + faster) * tick;
        Circle { center: motion.position, radius: radius + moves + MARGIN / 2.0 }
    }

    /// A tick without contacts.
    pub(super) fn coast(&mut self) {
        let length = self.parameters.dt / f32::from(SUB_STEPS);
        for (index, motion) in self.motions.iter_mut().enumerate() {
            coast(motion, &self.pushes[index], self.inverses[index], length);
        }
        self.moved.fill(true);
    }
}

fn coast(motion: &mut Motion, push: &Push, inverse: Inverse, length: f32) {
    let faster = push.force * inverse.mass * length;
    let turns = push.torque * inverse.inertia * length;
    for _ in 0..SUB_STEPS {
        motion.velocity += faster;
        motion.spin += turns;
        motion.position += motion.velocity * length;
        let angle = motion.spin * length;
        let heading = motion.heading;
        let turned = Vector::new(heading.x - angle * heading.y, heading.y + angle * heading.x);
        motion.heading = turned.normalize();
    }
}

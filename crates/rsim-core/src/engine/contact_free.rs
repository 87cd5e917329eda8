//! Ticks without contacts: bodies move freely, and the solver does not run.
//!
//! Free motion is computed as the solver would, in its own sub-steps. The separation of bodies that
//! can meet in the tick is tested before the first sub-step, after each, and one beyond the last, since
//! the solver stops bodies one sub-step ahead. If a test fails, the tick is rolled back and solved
//! normally.

use super::{AppliedForce, BALL, Engine, InverseInertia, robot};
use crate::body_params::BodyParams;
use crate::geometry::free_space::FreeSpace;
use crate::geometry::motion::{Motion, rotated};
use crate::geometry::outline::{Outline, PlacedOutline};
use crate::math::Vector;

/// Separation, m, above which two bodies do not touch. Of 40,000 ticks of VSSS random play, 11
/// differed from the solver's at 0.2 mm, all with corners that pass each other, and none at 0.4 mm; at
/// 0.8 mm a twentieth fewer ticks are contact-free.
const MARGIN: f32 = 4e-4;

/// A circle around all points that a body can reach in a tick.
#[derive(Debug, Clone, Copy)]
struct Reach {
    center: Vector,
    radius: f32,
    /// Maximum speed in the tick, m/s.
    speed: f32,
}

impl Reach {
    fn meets(&self, other: &Self) -> bool {
        let reach = self.radius + other.radius;
        (self.center - other.center).length_squared() < reach * reach
    }
}

/// A body, and a body or wall that it can meet in the tick.
#[derive(Debug, Clone, Copy)]
struct Pair {
    one: Solid,
    other: Other,
    /// Separation at which the two do not touch, m.
    margin: f32,
}

#[derive(Debug, Clone, Copy)]
enum Other {
    Body(Solid),
    Wall(PlacedOutline),
}

/// A body with the outline that others touch.
#[derive(Debug, Clone, Copy)]
struct Solid {
    body: usize,
    outline: Outline,
}

impl Solid {
    /// A body as robots and walls meet it.
    fn of(body: usize, params: &BodyParams) -> Self {
        if body == BALL {
            return Self { body, outline: Outline::Disc { radius: params.ball.radius } };
        }
        let outline = match params.robots[body - 1].outline {
            Outline::CutDisc { radius, .. } => Outline::Disc { radius },
            whole => whole,
        };
        Self { body, outline }
    }

    /// A robot as the ball meets it.
    fn as_met_by_ball(self, params: &BodyParams) -> Self {
        Self { outline: params.robots[self.body - 1].outline, ..self }
    }

    fn placed(&self, motions: &[Motion]) -> PlacedOutline {
        let motion = &motions[self.body];
        PlacedOutline {
            outline: self.outline,
            position: motion.position,
            heading: motion.rotation(),
        }
    }
}

/// Buffers of [`Engine::try_contact_free`]; their contents are of no use between ticks.
#[derive(Default)]
pub(super) struct ContactFreeBuffers {
    reaches: Vec<Reach>,
    near: Vec<Pair>,
    now: Vec<Motion>,
    end: Vec<Motion>,
}

impl ContactFreeBuffers {
    /// Whether all pairs that can meet are separated now.
    fn is_separated(&self) -> bool {
        self.near.iter().all(|pair| {
            let one = pair.one.placed(&self.now);
            let gap = match &pair.other {
                Other::Body(other) => one.gap(&other.placed(&self.now)),
                Other::Wall(wall) => one.gap(wall),
            };
            gap > pair.margin
        })
    }
}

impl Engine {
    /// Advances all bodies by a tick without the solver if nothing touches in it. Otherwise nothing
    /// changes, and the result is false.
    pub(super) fn try_contact_free(
        &mut self,
        buffers: &mut ContactFreeBuffers,
        params: &BodyParams,
        ball_flies: bool,
        free_space: &FreeSpace,
    ) -> bool {
        // Contacts of a ball in the air are solved elsewhere.
        self.find_near(buffers, params, if ball_flies { robot(0) } else { BALL }, free_space);
        let (sub_steps, length) = (self.parameters.num_solver_iterations, self.sub_step());
        if buffers.near.is_empty() {
            move_freely(&mut self.motions, &self.forces, &self.inverses, length, sub_steps);
        } else if !self.move_if_separated(buffers, sub_steps) {
            return false;
        }
        self.moved.fill(true);
        true
    }

    /// Moves all bodies freely unless two come too near on the way or one sub-step beyond.
    fn move_if_separated(&mut self, buffers: &mut ContactFreeBuffers, sub_steps: usize) -> bool {
        buffers.now.clone_from(&self.motions);
        for sub_step in 0..=sub_steps {
            if !buffers.is_separated() {
                return false;
            }
            if sub_step == sub_steps {
                buffers.end.clone_from(&buffers.now);
            }
            move_freely(&mut buffers.now, &self.forces, &self.inverses, self.sub_step(), 1);
        }
        let separated = buffers.is_separated();
        if separated {
            self.motions.copy_from_slice(&buffers.end);
        }
        separated
    }

    /// Length of a sub-step, s.
    fn sub_step(&self) -> f32 {
        self.parameters.dt / self.parameters.num_solver_iterations as f32
    }

    /// Lists the pairs that can meet in the tick, of the bodies from `first` on.
    fn find_near(
        &self,
        buffers: &mut ContactFreeBuffers,
        params: &BodyParams,
        first: usize,
        free_space: &FreeSpace,
    ) {
        let ContactFreeBuffers { reaches, near, .. } = buffers;
        reaches.clear();
        near.clear();
        for index in first..self.motions.len() {
            let reach = self.reach(index, params);
            let body = Solid::of(index, params);
            for (other, met) in reaches.iter().enumerate().filter(|(_, met)| met.meets(&reach)) {
                let other = Solid::of(first + other, params);
                let (one, margin) = if other.body == BALL {
                    let speed = met.speed + reach.speed;
                    (body.as_met_by_ball(params), self.margin_of_ball(params, speed))
                } else {
                    (body, MARGIN)
                };
                near.push(Pair { one, other: Other::Body(other), margin });
            }
            let margin =
                if index == BALL { self.margin_of_ball(params, reach.speed) } else { MARGIN };
            let walls = free_space.walls_near(reach.center, reach.radius);
            near.extend(walls.map(|wall| Pair {
                one: body,
                other: Other::Wall(wall.outline),
                margin,
            }));
            reaches.push(reach);
        }
    }

    /// Separation at which a ball of this speed touches nothing, m. A fast ball that passes a corner
    /// can be nearer to it between two tests than at both, by the height of its arc over half a
    /// sub-step.
    fn margin_of_ball(&self, params: &BodyParams, speed: f32) -> f32 {
        let half_way = 0.5 * speed * self.sub_step();
        MARGIN + half_way * half_way / (2.0 * params.ball.radius)
    }

    fn reach(&self, body: usize, params: &BodyParams) -> Reach {
        let radius = if body == BALL {
            params.ball.radius
        } else {
            params.robots[body - 1].model.bounding_radius()
        };
        let (motion, force) = (&self.motions[body], &self.forces[body]);
        // Up to the last test, one sub-step beyond the tick.
        let time = self.parameters.dt + self.sub_step();
        let speed_gain = force.force.length() * self.inverses[body].mass * time;
        let speed = motion.velocity.length() + speed_gain;
        let mut reach = radius + speed * time + MARGIN;
        if body == BALL {
            reach += self.margin_of_ball(params, speed);
        }
        Reach { center: motion.position, radius: reach, speed }
    }
}

/// Moves bodies by sub-steps without contacts.
fn move_freely(
    motions: &mut [Motion],
    forces: &[AppliedForce],
    inverses: &[InverseInertia],
    length: f32,
    sub_steps: usize,
) {
    for ((motion, force), inverse) in motions.iter_mut().zip(forces).zip(inverses) {
        let velocity_change = force.force * inverse.mass * length;
        let spin_change = force.torque * inverse.inertia * length;
        for _ in 0..sub_steps {
            motion.velocity += velocity_change;
            motion.spin += spin_change;
            motion.position += motion.velocity * length;
            motion.heading = rotated(motion.heading, motion.spin * length);
        }
    }
}

//! Ticks in which nothing touches: bodies coast, and the solver rests.
//!
//! Coasting computes what the solver would, in its own sub-steps. Bodies that can meet in the tick
//! are looked at when the solver would look: before the first sub-step, after each, and where they
//! would be one sub-step later, as it stops bodies one ahead. If two come too near, the solver gets
//! the tick from its start.

use rapier2d::math::Vector;

use super::{BALL, Engine, Inverse, Motion, Push, robot, rotation, turned};
use crate::Field;
use crate::arena::Wall;
use crate::outline::{Outline, Placed};
use crate::physique::Physique;

/// Bodies that stay farther apart than this at every look do not touch, m. Of 40,000 ticks of VSSS
/// random play, 11 differed from the solver's at 0.2 mm, all of corners that pass each other; 0 at
/// this; and at 0.8 mm a twentieth fewer ticks go without it.
const MARGIN: f32 = 4e-4;

/// The part of a field that is free of walls, and the walls around it.
#[derive(Debug, Clone)]
pub(crate) struct Room {
    /// A body that stays within is far from every wall.
    free: Vector,
    walls: Vec<Standing>,
}

/// A wall that stands on the floor.
#[derive(Debug, Clone)]
pub(crate) struct Standing {
    pub(crate) place: Placed,
    /// m.
    pub(crate) top: f32,
}

impl Room {
    pub(crate) fn of(field: &Field, walls: &[Wall]) -> Self {
        let standing = walls.iter().filter(|wall| wall.stands_on_floor());
        // Goals and corner blocks begin at the goal line, or a corner's leg before it.
        let free_x = field.half_length() - field.corner;
        Self {
            free: Vector::new(free_x, field.reach_y()),
            walls: standing.map(|wall| Standing { place: wall.placed(), top: wall.top }).collect(),
        }
    }

    /// Walls that reach into a circle.
    pub(crate) fn walls_near(
        &self,
        center: Vector,
        radius: f32,
    ) -> impl Iterator<Item = &Standing> {
        let beyond = center.abs() + Vector::splat(radius);
        let is_free = beyond.x < self.free.x && beyond.y < self.free.y;
        let walls = if is_free { &[] } else { self.walls.as_slice() };
        walls.iter().filter(move |wall| wall.place.nearest(center).distance < radius)
    }
}

/// All that a body can cover in a tick.
#[derive(Debug, Clone, Copy)]
struct Circle {
    center: Vector,
    radius: f32,
    /// At most, m/s.
    speed: f32,
}

impl Circle {
    fn meets(&self, other: &Self) -> bool {
        let reach = self.radius + other.radius;
        (self.center - other.center).length_squared() < reach * reach
    }
}

/// A body, and what it can meet in a tick.
#[derive(Debug, Clone, Copy)]
struct Pair {
    one: Solid,
    other: Other,
    /// What keeps them from touching, m.
    margin: f32,
}

#[derive(Debug, Clone, Copy)]
enum Other {
    Body(Solid),
    Wall(Placed),
}

/// A body, and the outline that others touch.
#[derive(Debug, Clone, Copy)]
struct Solid {
    body: usize,
    outline: Outline,
}

impl Solid {
    /// As robots and walls meet it.
    fn of(body: usize, physique: &Physique) -> Self {
        if body == BALL {
            return Self { body, outline: Outline::Disc { radius: physique.ball.radius } };
        }
        let outline = match physique.robots[body - 1].outline {
            Outline::CutDisc { radius, .. } => Outline::Disc { radius },
            whole => whole,
        };
        Self { body, outline }
    }

    /// A robot as the ball meets it.
    fn for_the_ball(self, physique: &Physique) -> Self {
        Self { outline: physique.robots[self.body - 1].outline, ..self }
    }

    fn placed(&self, motions: &[Motion]) -> Placed {
        let Motion { position, heading, .. } = motions[self.body];
        Placed { outline: self.outline, position, heading: rotation(heading) }
    }
}

/// What a tick without the solver is tried with. What is in it means nothing between ticks.
#[derive(Default)]
pub(super) struct Trial {
    circles: Vec<Circle>,
    near: Vec<Pair>,
    now: Vec<Motion>,
    end: Vec<Motion>,
}

impl Trial {
    /// Whether all that can meet are apart now.
    fn is_apart(&self) -> bool {
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
    /// Plays a tick without the solver, if nothing touches in it; else nothing has changed.
    pub(super) fn try_coasting(
        &mut self,
        trial: &mut Trial,
        physique: &Physique,
        flies: bool,
        room: &Room,
    ) -> bool {
        // A ball in the air touches others elsewhere.
        self.find_near(trial, physique, if flies { robot(0) } else { BALL }, room);
        let (sub_steps, length) = (self.parameters.num_solver_iterations, self.sub_step());
        if trial.near.is_empty() {
            coast(&mut self.motions, &self.pushes, &self.inverses, length, sub_steps);
        } else if !self.coast_apart(trial, sub_steps) {
            return false;
        }
        self.moved.fill(true);
        true
    }

    /// Coasts unless two come too near on the way, or would in one sub-step more.
    fn coast_apart(&mut self, trial: &mut Trial, sub_steps: usize) -> bool {
        trial.now.clone_from(&self.motions);
        for sub_step in 0..=sub_steps {
            if !trial.is_apart() {
                return false;
            }
            if sub_step == sub_steps {
                trial.end.clone_from(&trial.now);
            }
            coast(&mut trial.now, &self.pushes, &self.inverses, self.sub_step(), 1);
        }
        let apart = trial.is_apart();
        if apart {
            self.motions.copy_from_slice(&trial.end);
        }
        apart
    }

    /// Length of a sub-step, s.
    fn sub_step(&self) -> f32 {
        self.parameters.dt / self.parameters.num_solver_iterations as f32
    }

    fn find_near(&self, trial: &mut Trial, physique: &Physique, first: usize, room: &Room) {
        let Trial { circles, near, .. } = trial;
        circles.clear();
        near.clear();
        for index in first..self.motions.len() {
            let circle = self.circle(index, physique);
            let body = Solid::of(index, physique);
            for (other, met) in circles.iter().enumerate().filter(|(_, met)| met.meets(&circle)) {
                let other = Solid::of(first + other, physique);
                let (one, margin) = if other.body == BALL {
                    let speed = met.speed + circle.speed;
                    (body.for_the_ball(physique), self.margin_of_ball(physique, speed))
                } else {
                    (body, MARGIN)
                };
                near.push(Pair { one, other: Other::Body(other), margin });
            }
            let margin =
                if index == BALL { self.margin_of_ball(physique, circle.speed) } else { MARGIN };
            let walls = room.walls_near(circle.center, circle.radius);
            near.extend(walls.map(|wall| Pair {
                one: body,
                other: Other::Wall(wall.place),
                margin,
            }));
            circles.push(circle);
        }
    }

    /// A ball that passes a corner so fast can be nearer to it between two looks than at both, by the
    /// height of its arc over half a sub-step's way.
    fn margin_of_ball(&self, physique: &Physique, speed: f32) -> f32 {
        let half_way = 0.5 * speed * self.sub_step();
        MARGIN + half_way * half_way / (2.0 * physique.ball.radius)
    }

    fn circle(&self, body: usize, physique: &Physique) -> Circle {
        let radius = if body == BALL {
            physique.ball.radius
        } else {
            physique.robots[body - 1].model.bounding_radius()
        };
        let (motion, push) = (&self.motions[body], &self.pushes[body]);
        // To where the look ahead ends.
        let time = self.parameters.dt + self.sub_step();
        let faster = push.force.length() * self.inverses[body].mass * time;
        let speed = motion.velocity.length() + faster;
        let mut reach = radius + speed * time + MARGIN;
        if body == BALL {
            reach += self.margin_of_ball(physique, speed);
        }
        Circle { center: motion.position, radius: reach, speed }
    }
}

/// So many sub-steps without contacts.
fn coast(motions: &mut [Motion], pushes: &[Push], inverses: &[Inverse], length: f32, times: usize) {
    for ((motion, push), inverse) in motions.iter_mut().zip(pushes).zip(inverses) {
        let faster = push.force * inverse.mass * length;
        let turns = push.torque * inverse.inertia * length;
        for _ in 0..times {
            motion.velocity += faster;
            motion.spin += turns;
            motion.position += motion.velocity * length;
            motion.heading = turned(motion.heading, motion.spin * length);
        }
    }
}

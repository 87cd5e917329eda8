//! Pairs of bodies, or of a body and a wall, that can meet in a tick.

use super::bodies::Bodies;
use super::{BALL, BallPhase, BallRules, SubSteps, robot};
use crate::body_params::BodyParams;
use crate::geometry::free_space::FreeSpace;
use crate::geometry::motion::Motion;
use crate::geometry::outline::{Outline, PlacedOutline};
use crate::math::Vector;

/// Separation, m, above which two bodies do not touch. Of 40,000 ticks of VSSS random play, 11
/// differed from the solver's at 0.2 mm, all with corners that pass each other, and none at 0.4 mm; at
/// 0.8 mm a twentieth fewer ticks are contact-free.
const MARGIN: f32 = 4e-4;

/// A circle around all points that a body can reach.
#[derive(Debug, Clone, Copy)]
struct Reach {
    center: Vector,
    radius: f32,
    /// Maximum speed, m/s.
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
pub(super) struct Pair {
    pub(super) one: Solid,
    pub(super) other: Other,
    /// Separation at which the two do not touch, m.
    pub(super) margin: f32,
}

#[derive(Debug, Clone, Copy)]
pub(super) enum Other {
    Body(Solid),
    /// Index and outline.
    Wall(usize, PlacedOutline),
}

/// A body with the outline that others touch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Solid {
    pub(super) body: usize,
    pub(super) outline: Outline,
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

    pub(super) fn placed(&self, motions: &[Motion]) -> PlacedOutline {
        let motion = &motions[self.body];
        PlacedOutline {
            outline: self.outline,
            position: motion.position,
            heading: motion.rotation(),
        }
    }
}

/// Settings of the search for pairs.
pub(super) struct Search {
    /// s.
    time: f32,
    /// Time between two tests of the separation, s.
    between: f32,
    /// Speed that every body may have, m/s: a robot at rest may be pushed. If there is none, no body
    /// gets faster than it is.
    pub(super) speed: Option<f32>,
    /// A flying ball has no pairs: its contacts are solved elsewhere.
    ball_flies: bool,
}

impl Search {
    /// Pairs for a tick without contacts: up to its last test, one sub-step beyond the tick.
    pub(super) fn before_rapier(rules: &BallRules, sub_steps: SubSteps) -> Self {
        Self {
            time: rules.time + sub_steps.time,
            between: sub_steps.time,
            speed: None,
            ball_flies: rules.phase != BallPhase::Floor,
        }
    }

    /// Pairs for the compact solver, which sweeps the ball along its path.
    pub(super) fn before_compact(bodies: &Bodies, rules: &BallRules) -> Self {
        Self {
            time: rules.time,
            between: 0.0,
            speed: Some(bodies.fastest_robot(rules.time)),
            ball_flies: rules.phase == BallPhase::Air,
        }
    }
}

/// Pairs that can meet, and the buffer of the search.
#[derive(Default)]
pub(super) struct NearPairs {
    reaches: Vec<Reach>,
    pub(super) pairs: Vec<Pair>,
}

impl NearPairs {
    /// Finds all pairs that can meet within the time of `search`.
    pub(super) fn find(
        &mut self,
        bodies: &Bodies,
        rules: &BallRules,
        free_space: &FreeSpace,
        search: &Search,
    ) {
        let params = rules.params;
        let first = if search.ball_flies { robot(0) } else { BALL };
        let margin_of_ball = |speed: f32| margin_of_ball(speed, params, search.between);
        self.reaches.clear();
        self.pairs.clear();
        for index in first..bodies.motions.len() {
            let mut reach = reach_of(bodies, index, params, search.time, search.speed);
            if index == BALL {
                reach.radius += margin_of_ball(reach.speed);
            }
            let body = Solid::of(index, params);
            let met = self.reaches.iter().enumerate().filter(|(_, met)| met.meets(&reach));
            for (other, met) in met {
                let other = Solid::of(first + other, params);
                let (one, margin) = if other.body == BALL {
                    (body.as_met_by_ball(params), margin_of_ball(met.speed + reach.speed))
                } else {
                    (body, MARGIN)
                };
                self.pairs.push(Pair { one, other: Other::Body(other), margin });
            }
            let margin = if index == BALL { margin_of_ball(reach.speed) } else { MARGIN };
            let walls = free_space.walls_near(reach.center, reach.radius);
            self.pairs.extend(walls.map(|wall| Pair {
                one: body,
                other: Other::Wall(wall.index, wall.outline),
                margin,
            }));
            self.reaches.push(reach);
        }
    }

    /// Whether all pairs are separated by more than their margins.
    pub(super) fn are_separated(&self, motions: &[Motion]) -> bool {
        self.pairs.iter().all(|pair| {
            let one = pair.one.placed(motions);
            let gap = match &pair.other {
                Other::Body(other) => one.gap(&other.placed(motions)),
                Other::Wall(_, wall) => one.gap(wall),
            };
            gap > pair.margin
        })
    }
}

/// Separation at which a ball of this speed touches nothing, m. A fast ball that passes a corner can
/// be nearer to it between two tests than at both, by the height of its arc over half a sub-step.
fn margin_of_ball(speed: f32, params: &BodyParams, sub_step: f32) -> f32 {
    let half_way = 0.5 * speed * sub_step;
    MARGIN + half_way * half_way / (2.0 * params.ball.radius)
}

/// Reach of a body. `speed` is a bound that holds for all robots, if there is one.
fn reach_of(
    bodies: &Bodies,
    body: usize,
    params: &BodyParams,
    time: f32,
    speed: Option<f32>,
) -> Reach {
    let radius =
        if body == BALL { params.ball.radius } else { params.robots[body - 1].bounding_radius };
    let motion = &bodies.motions[body];
    let own = || {
        let speed_gain = bodies.forces[body].force.length() * bodies.inverses[body].mass * time;
        motion.velocity.length() + speed_gain
    };
    let speed = match speed {
        Some(speed) if body == BALL => motion.velocity.length().max(speed),
        Some(speed) => speed,
        None => own(),
    };
    Reach { center: motion.position, radius: radius + speed * time + MARGIN, speed }
}

//! Pairs of bodies, or of a body and a wall, that can meet in a tick.

use super::{BallPhase, BallRules};
use crate::blocks::{BALL, LANES, Lanes, VectorLanes, lanes_of, place_of, robot, set_bits};
use crate::bodies::{Bodies, BodyBlock, FastestRobot, SubSteps};
use crate::body_parameters::BodyParameters;
use crate::geometry::free_space::FreeSpace;
use crate::geometry::motion_block::MotionBlock;
use crate::geometry::outline::{Outline, PlacedOutline};
use crate::math::Vector;

/// Separation, m, above which two bodies do not touch. Of 40,000 ticks of VSSS random play, 11
/// differed from the solver's at 0.2 mm, all with corners that pass each other, and none at 0.4 mm; at
/// 0.8 mm a twentieth fewer ticks are contact-free.
const MARGIN: f32 = 4e-4;

/// Circles around all points that the bodies of a block can reach.
#[derive(Debug, Clone, Copy)]
struct BlockReach {
    /// Centers (m) and radii (m).
    x: Cycle,
    y: Cycle,
    radius: Cycle,
    /// Maximum speeds, m/s.
    speed: Lanes,
}

impl BlockReach {
    fn of(center: VectorLanes, radius: Lanes, speed: Lanes) -> Self {
        Self { x: Cycle::of(center.x), y: Cycle::of(center.y), radius: Cycle::of(radius), speed }
    }

    fn center(&self, lane: usize) -> Vector {
        Vector::new(self.x.get(lane), self.y.get(lane))
    }

    /// Whether the circle in each lane meets that of `other` which is `shift` lanes further, one bit each.
    fn meets(&self, other: &Self, shift: usize) -> u32 {
        let x = self.x.shifted(0) - other.x.shifted(shift);
        let y = self.y.shifted(0) - other.y.shifted(shift);
        let both = self.radius.shifted(0) + other.radius.shifted(shift);
        (x * x + y * y).simd_lt(both * both).to_bitmask()
    }
}

/// The numbers of a block, twice in a row, from which the numbers of other lanes are read at once.
#[derive(Debug, Clone, Copy)]
struct Cycle([f32; 2 * LANES]);

impl Cycle {
    fn of(numbers: Lanes) -> Self {
        let numbers = numbers.to_array();
        Self(std::array::from_fn(|index| numbers[index % LANES]))
    }

    fn get(&self, lane: usize) -> f32 {
        self.0[lane]
    }

    /// The numbers that lie `shift` lanes further, from 0 to 3.
    fn shifted(&self, shift: usize) -> Lanes {
        lanes_of(|lane| self.0[lane + shift])
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

impl Pair {
    /// The bodies of the pair, one bit each.
    pub(super) fn bodies(&self) -> u64 {
        let other = if let Other::Body(other) = &self.other { 1 << other.body } else { 0 };
        1 << self.one.body | other
    }
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
    fn of(body: usize, parameters: &BodyParameters) -> Self {
        if body == BALL {
            return Self { body, outline: Outline::Disc { radius: parameters.ball.radius } };
        }
        let outline = match parameters.robots[body - 1].outline {
            Outline::CutDisc { radius, .. } => Outline::Disc { radius },
            whole => whole,
        };
        Self { body, outline }
    }

    /// A robot as the ball meets it.
    fn as_met_by_ball(self, parameters: &BodyParameters) -> Self {
        Self { outline: parameters.robots[self.body - 1].outline, ..self }
    }

    fn placed(&self, motions: &[MotionBlock]) -> PlacedOutline {
        let (block, lane) = place_of(self.body);
        let motion = motions[block].get(lane);
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
    pub(super) fn before_compact(fastest: FastestRobot, rules: &BallRules) -> Self {
        Self {
            time: rules.time,
            between: 0.0,
            speed: Some(fastest.within(rules.time)),
            ball_flies: rules.phase == BallPhase::Air,
        }
    }
}

/// Pairs that can meet, and the buffers of the search.
pub(super) struct NearPairs {
    reaches: Vec<BlockReach>,
    /// For each body, those before it that it can meet, one bit each.
    met: [u64; MAX_BODIES],
    pub(super) pairs: Vec<Pair>,
}

impl Default for NearPairs {
    fn default() -> Self {
        Self { reaches: Vec::new(), met: [0; MAX_BODIES], pairs: Vec::new() }
    }
}

/// Maximum number of bodies: one bit each.
const MAX_BODIES: usize = 64;

impl NearPairs {
    /// Finds all pairs that can meet within the time of `search`.
    pub(super) fn find(
        &mut self,
        bodies: &Bodies,
        rules: &BallRules,
        free_space: &FreeSpace,
        search: &Search,
    ) {
        let parameters = rules.parameters;
        self.pairs.clear();
        let at_walls = self.find_reaches(bodies, parameters, free_space, search);
        let first = if search.ball_flies { robot(0) } else { BALL };
        let near = (self.find_met() | at_walls) & bodies.all();
        for body in set_bits(near >> first << first) {
            let (block, lane) = place_of(body);
            let reach = &self.reaches[block];
            let (center, radius) = (reach.center(lane), reach.radius.get(lane));
            let speed = reach.speed.as_array()[lane];
            let is_at_wall = at_walls >> body & 1 == 1;
            let met = self.met[body] >> first << first;
            let solid = Solid::of(body, parameters);
            for other in set_bits(met) {
                let (one, margin) = if other == BALL {
                    let ball_speed = self.reaches[0].speed.as_array()[BALL];
                    let margin = margin_of_ball(ball_speed + speed, parameters, search.between);
                    (solid.as_met_by_ball(parameters), margin)
                } else {
                    (solid, MARGIN)
                };
                let other = Other::Body(Solid::of(other, parameters));
                self.pairs.push(Pair { one, other, margin });
            }
            if is_at_wall {
                let margin = if body == BALL {
                    margin_of_ball(speed, parameters, search.between)
                } else {
                    MARGIN
                };
                let walls = free_space.walls_near(center, radius);
                self.pairs.extend(walls.map(|wall| Pair {
                    one: solid,
                    other: Other::Wall(wall.index, wall.outline),
                    margin,
                }));
            }
        }
    }

    /// Computes the reaches of all bodies. Returns those that can meet walls, one bit each.
    fn find_reaches(
        &mut self,
        bodies: &Bodies,
        parameters: &BodyParameters,
        free_space: &FreeSpace,
        search: &Search,
    ) -> u64 {
        self.reaches.clear();
        let time = Lanes::splat(search.time);
        let mut at_walls = 0;
        let blocks = bodies.blocks.iter().zip(&parameters.inertia);
        for (block, (body, inertia)) in blocks.enumerate() {
            let BodyBlock { motion, acceleration, .. } = body;
            let mut speed = if let Some(speed) = search.speed {
                Lanes::splat(speed)
            } else {
                let gain = acceleration.linear.length_squared().sqrt();
                motion.velocity.length_squared().sqrt() + gain * time
            };
            let mut margin = Lanes::splat(MARGIN);
            if block == 0 {
                let ball = &mut speed.as_mut_array()[BALL];
                *ball = ball.max(motion.velocity.get(BALL).length());
                margin.as_mut_array()[BALL] += margin_of_ball(*ball, parameters, search.between);
            }
            let radius = inertia.bounding_radius + speed * time + margin;
            at_walls |= free_space.left_by(motion.position, radius) << (block * LANES);
            self.reaches.push(BlockReach::of(motion.position, radius, speed));
        }
        at_walls
    }

    /// Finds the bodies that can meet each other, and returns those that can meet one before them, one bit each.
    fn find_met(&mut self) -> u64 {
        let Self { reaches, met, .. } = self;
        met[..reaches.len() * LANES].fill(0);
        let mut near = 0;
        let mut add = |block: usize, other: usize, shift: usize, lanes: u32| {
            for lane in set_bits(u64::from(lanes)) {
                let one = block * LANES + lane;
                let other = other * LANES + (lane + shift) % LANES;
                let (earlier, later) = (one.min(other), one.max(other));
                met[later] |= 1 << earlier;
                near |= 1 << later;
            }
        };
        for (block, reach) in reaches.iter().enumerate() {
            // Two and three lanes on are the same pairs as two and one lanes back.
            for shift in [1, 2] {
                add(block, block, shift, reach.meets(reach, shift));
            }
            for (before, other) in reaches[..block].iter().enumerate() {
                for shift in 0..LANES {
                    add(block, before, shift, reach.meets(other, shift));
                }
            }
        }
        near
    }

    /// Whether all pairs are separated by more than their margins.
    pub(super) fn are_separated(&self, motions: &[MotionBlock]) -> bool {
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
fn margin_of_ball(speed: f32, parameters: &BodyParameters, sub_step: f32) -> f32 {
    let half_way = 0.5 * speed * sub_step;
    MARGIN + half_way * half_way / (2.0 * parameters.ball.radius)
}

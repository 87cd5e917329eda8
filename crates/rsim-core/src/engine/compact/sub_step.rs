//! Length and settings of the solver's sub-steps in a tick.

use super::NearBodies;
use super::body::SolverBody;
use super::manifold::Window;
use super::pass::Pass;
use crate::blocks::BALL;
use crate::bodies::SubSteps;
use crate::engine::near::{Other, Pair, Solid};
use crate::math::Vector;

/// Number of sub-steps that are solved as one where no two bodies that can meet move far against each other.
const MERGED: usize = 2;

/// Maximum length of merged sub-steps, s: in one of 5 ms rows of robots that press keep moving, and a ball falls
/// behind the robots that it pushes.
const MAX_MERGED_TIME: f32 = 2.5e-3;

/// Maximum way of two bodies against each other in merged sub-steps, m: with 7 mm, a robot at 3 m/s turns
/// another one by 3% too little.
const MAX_WAY: f32 = 4e-3;

/// The same for a squeezed ball and those that squeeze it: with 1 mm, a push through the ball is 3% too weak.
const MAX_WAY_OF_SQUEEZED_BALL: f32 = 5e-4;

/// Settings of the sub-steps of a tick.
pub(super) struct SubStep {
    pub(super) window: Window,
    pub(super) pushing: Pass,
    pub(super) pushing_ball: Pass,
    pub(super) relaxing: Pass,
    /// Whether the ball is squeezed.
    pub(super) squeezed: bool,
    /// Time, s, by which a body with nothing within reach gains its speed later than at the start of the
    /// sub-step: then it moves as in the sub-steps that are merged, which ticks without contacts have, too.
    pub(super) lag: f32,
    /// Number of sub-steps in the tick.
    pub(super) count: usize,
}

impl SubStep {
    /// Settings for a tick of `unmerged` sub-steps in which those of `bodies` that are `near` can meet. `squeezed`
    /// says whether the ball is squeezed.
    pub(super) fn of(
        unmerged: SubSteps,
        bodies: &[SolverBody],
        near: NearBodies,
        squeezed: bool,
    ) -> Self {
        let merged = SubSteps {
            #[allow(clippy::cast_precision_loss)] // a small number
            time: unmerged.time * MERGED as f32,
            count: unmerged.count / MERGED,
        };
        let may_merge = unmerged.count % MERGED == 0
            && merged.time <= MAX_MERGED_TIME
            && near.pairs.iter().all(|pair| is_slow(pair, bodies, merged.time, squeezed));
        let SubSteps { time, count } = if may_merge { merged } else { unmerged };
        Self {
            window: Window { time, reach: 2.0 * near.fastest * time },
            pushing: Pass::pushing(time),
            pushing_ball: Pass::pushing_ball(time),
            relaxing: Pass::relaxing(time),
            squeezed,
            lag: 0.5 * (time - unmerged.time),
            count,
        }
    }

    /// Length of a sub-step, s.
    pub(super) fn time(&self) -> f32 {
        self.window.time
    }
}

/// Whether no point of the two moves far against the other within `time` (s). Contacts of a ball that nothing
/// squeezes are exact in sub-steps of any length.
fn is_slow(pair: &Pair, bodies: &[SolverBody], time: f32, squeezed: bool) -> bool {
    let is_ball = pair.bodies() & 1 << BALL != 0;
    if is_ball && !squeezed {
        return true;
    }
    let speeds = |solid: &Solid| {
        let body = &bodies[solid.body];
        (body.velocity, body.angular_velocity.abs() * solid.outline.turning_radius())
    };
    let (velocity, rim) = speeds(&pair.one);
    let (other, other_rim) = match &pair.other {
        Other::Body(other) => speeds(other),
        Other::Wall(..) => (Vector::ZERO, 0.0),
    };
    let max_way = if is_ball { MAX_WAY_OF_SQUEEZED_BALL } else { MAX_WAY };
    ((velocity - other).length() + rim + other_rim) * time < max_way
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::outline::Outline;

    /// Length of an unmerged sub-step, s.
    const TIME: f32 = 1.25e-3;
    const ROBOT: Outline = Outline::Box { half: Vector::new(0.04, 0.04) };

    /// Sub-steps of a tick of `count` sub-steps in which `body` moves toward a robot at rest.
    fn sub_steps(
        body: usize,
        velocity: Vector,
        spin: f32,
        count: usize,
        squeezed: bool,
    ) -> SubStep {
        let mut bodies = [SolverBody::default(); 3];
        (bodies[body].velocity, bodies[body].angular_velocity) = (velocity, spin);
        let solid = |body| Solid { body, outline: ROBOT };
        let ball = Solid { body: BALL, outline: Outline::Disc { radius: 0.02 } };
        let one = if body == BALL { ball } else { solid(body) };
        let pair = Pair { one, other: Other::Body(solid(2)), margin: 0.0 };
        let near = NearBodies { pairs: &[pair], fastest: 1.0 };
        SubStep::of(SubSteps { time: TIME, count }, &bodies, near, squeezed)
    }

    fn count(body: usize, velocity: Vector, spin: f32, squeezed: bool) -> usize {
        sub_steps(body, velocity, spin, 4, squeezed).count
    }

    #[test]
    fn slow_bodies_take_half_as_many_sub_steps_of_twice_the_length() {
        let slow = sub_steps(1, Vector::new(1.5, 0.0), 0.0, 4, false);
        let fast = sub_steps(1, Vector::new(1.7, 0.0), 0.0, 4, false);
        assert_eq!([slow.count, fast.count], [2, 4]);
        let bits = |numbers: [f32; 4]| numbers.map(f32::to_bits);
        let measured = bits([slow.time(), fast.time(), slow.lag, fast.lag]);
        assert_eq!(measured, bits([2.0 * TIME, TIME, 0.5 * TIME, 0.0]));
    }

    #[test]
    fn a_corner_that_turns_counts_as_one_that_moves() {
        assert_eq!([20.0, 40.0].map(|spin| count(1, Vector::ZERO, spin, false)), [2, 4]);
    }

    #[test]
    fn only_a_squeezed_ball_counts_and_sooner_than_a_robot() {
        let speeds = [0.19, 0.21].map(|speed| Vector::new(0.0, speed));
        assert_eq!(speeds.map(|velocity| count(BALL, velocity, 0.0, true)), [2, 4]);
        assert_eq!(count(BALL, Vector::new(8.0, 0.0), 0.0, false), 2);
    }

    #[test]
    fn merged_sub_steps_are_at_most_two_and_a_half_milliseconds_long() {
        let count = |time| {
            SubStep::of(
                SubSteps { time, count: 2 },
                &[],
                NearBodies { pairs: &[], fastest: 1.0 },
                false,
            )
            .count
        };
        assert_eq!([5e-4, 1.25e-3, 2.5e-3].map(count), [1, 1, 2]);
    }

    #[test]
    fn a_part_of_a_tick_that_is_one_sub_step_stays_so() {
        let [one, three] = [1, 3].map(|count| sub_steps(1, Vector::ZERO, 0.0, count, false));
        assert_eq!([one.count, three.count], [1, 3]);
        assert!(one.lag <= 0.0 && three.lag <= 0.0);
    }
}

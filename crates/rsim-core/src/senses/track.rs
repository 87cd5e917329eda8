//! Estimates of four bodies from their detections, by the filters of [`crate::senses::filter`].

use serde::{Deserialize, Serialize};

use crate::blocks::{
    LANES, Lanes, VectorLanes, alternating_series, mask_of_bits, set_bits, smaller,
};
use crate::geometry::motion::{Motion, direction};
use crate::geometry::motion_block::MotionBlock;
use crate::math::Vector;
use crate::senses::detections::DetectedBlock;
use crate::senses::fetch::Fetched;
use crate::senses::filter::{Filter, Gains, LONG};

/// Time without a detection after which a body is taken to stand still, s.
pub(super) const LOST: f32 = 0.3;

/// Time between two frames over which bodies are expected to go on as before, s. Seldom frames, or many that are
/// lost, need more than [`LOST`]; over longer gaps nothing is known.
const GAP: f32 = 1.0;

/// Change of the velocity by a push at an unknown instant of an interval, by the mean change over it.
const PUSH_PART: f32 = 1.5;

/// Cosine of the difference beyond which a heading is misread: 50 degrees, which no robot turns unexpectedly
/// between two frames.
const MISREAD: f32 = 0.643;

/// Number of detections in a row after which a heading is not misread, but has changed.
const BELIEVED: f32 = 4.0;

/// Estimated motions of four bodies.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(super) struct TrackBlock {
    motion: MotionBlock,
    /// Number of positions since a push.
    positions: Lanes,
    /// Number of headings since a push.
    headings: Lanes,
    /// Number of headings in a row that were taken for misread ones.
    refused: Lanes,
    /// Time since the last detection, s.
    unseen: Lanes,
}

impl TrackBlock {
    /// Bodies that were never seen.
    pub(super) fn new() -> Self {
        let long = Lanes::splat(LONG);
        Self {
            motion: MotionBlock::AT_REST,
            positions: long,
            headings: long,
            refused: Lanes::ZERO,
            unseen: Lanes::ZERO,
        }
    }

    /// Fetches the estimates.
    pub(super) fn fetch(&self, fetched: &mut Fetched) {
        let MotionBlock { position, velocity, heading, angular_velocity, .. } = &self.motion;
        for lanes in [&position.x, &velocity.x, &heading.x, angular_velocity, &self.unseen] {
            fetched.lanes(lanes);
        }
    }

    /// The estimated motion of a body.
    pub(super) fn motion(&self, lane: usize) -> Motion {
        self.motion.get(lane)
    }

    /// Estimated motions of all bodies.
    pub(super) fn motions(&self) -> &MotionBlock {
        &self.motion
    }

    /// The mask of the bodies that their last position has shown to be pushed.
    pub(super) fn pushed(&self) -> Lanes {
        self.positions.simd_eq(Lanes::ONE)
    }

    /// Time since the last detection of a body, s.
    pub(super) fn unseen(&self, lane: usize) -> f32 {
        self.unseen.as_array()[lane]
    }

    /// Begins with a body that has been watched for some time. The heading may have any length.
    pub(super) fn begin(&mut self, lane: usize, motion: &Motion) {
        let heading = unit(motion.heading);
        self.motion.set(lane, &Motion { heading, ..*motion });
        self.headings.as_mut_array()[lane] = LONG;
        self.refused.as_mut_array()[lane] = 0.0;
        self.watched_at(lane);
    }

    /// Begins with the position and velocity of a body that has been watched for some time.
    pub(super) fn move_to(&mut self, lane: usize, position: Vector, velocity: Vector) {
        self.motion.position.set(lane, position);
        self.motion.velocity.set(lane, velocity);
        self.watched_at(lane);
    }

    fn watched_at(&mut self, lane: usize) {
        self.positions.as_mut_array()[lane] = LONG;
        self.unseen.as_mut_array()[lane] = 0.0;
    }

    /// Goes on by `elapsed`, s, with constant velocities; at most by [`GAP`], after which bodies stand still.
    pub(super) fn coast(&mut self, elapsed: f32) {
        self.wait(Lanes::splat(elapsed));
        let time = Lanes::splat(elapsed.min(GAP));
        let motion = &mut self.motion;
        motion.position += motion.velocity * time;
        motion.heading = turned(motion.heading, motion.angular_velocity * time);
        if elapsed > GAP {
            (motion.velocity, motion.angular_velocity) = (VectorLanes::ZERO, Lanes::ZERO);
        }
    }

    /// Goes on by `elapsed`, s, to predicted motions.
    pub(super) fn go_on(&mut self, elapsed: f32, predicted: &MotionBlock) {
        let before = self.motion;
        self.motion = *predicted;
        let lost = self.wait(Lanes::splat(elapsed));
        let motion = &mut self.motion;
        motion.position = before.position.where_else(lost, motion.position);
        motion.heading = before.heading.where_else(lost, motion.heading);
    }

    /// Lets time pass. Returns the mask of the bodies that the frames up to the last one have not shown for long, which
    /// now stand still.
    fn wait(&mut self, elapsed: Lanes) -> Lanes {
        let lost = self.unseen.simd_gt(Lanes::splat(LOST));
        self.unseen += elapsed;
        let motion = &mut self.motion;
        motion.velocity = VectorLanes::ZERO.where_else(lost, motion.velocity);
        motion.angular_velocity = lost.bitselect(Lanes::ZERO, motion.angular_velocity);
        lost
    }

    /// Takes in detections of robots, each the first one at its instant. One that is not expected tells of a push
    /// since the last one, in whose middle the velocity changed. Of robots that were already seen at this instant the
    /// positions are averaged.
    pub(super) fn update(&mut self, seen: &DetectedBlock, position: &Filter, heading: &Filter) {
        let mask = mask_of_bits(seen.bodies.into());
        if seen.moved != 0 {
            let moved = mask_of_bits(seen.moved.into());
            self.motion.position = seen.position.where_else(moved, self.motion.position);
        }
        let new = self.unseen.simd_gt(Lanes::ZERO);
        let again = (mask & !new).to_bitmask();
        // Filters of one tracker count with the same period.
        let rate = position.rate(self.unseen);
        self.update_headings(mask & new, seen.heading, rate, heading);
        self.update_positions(mask & new, seen.position, rate, position);
        for lane in set_bits(again.into()) {
            self.average(lane, seen.position.get(lane), position);
        }
    }

    /// Takes in a detection of a body without a heading.
    pub(super) fn update_position(&mut self, lane: usize, position: Vector, filter: &Filter) {
        let (mask, detected) = (mask_of_bits(1 << lane), VectorLanes::splat(position));
        self.update_positions(mask, detected, filter.rate(self.unseen), filter);
    }

    fn update_positions(
        &mut self,
        seen: Lanes,
        detected: VectorLanes,
        rate: Lanes,
        filter: &Filter,
    ) {
        let motion = &mut self.motion;
        let Gains { alpha, beta, gate } = filter.gains(self.positions);
        // Bodies that were not seen have no difference.
        let difference = VectorLanes {
            x: (detected.x - motion.position.x) & seen,
            y: (detected.y - motion.position.y) & seen,
        };
        let pushed = difference.length_squared().simd_gt(gate);
        let alpha = pushed.bitselect(Lanes::ONE, alpha);
        let beta = pushed.bitselect(Lanes::splat(PUSH_PART), beta);
        motion.position += difference * alpha;
        motion.velocity += difference * (beta * rate);
        self.positions = counted(self.positions, seen, pushed);
        self.unseen = seen.bitselect(Lanes::ZERO, self.unseen);
    }

    fn update_headings(
        &mut self,
        seen: Lanes,
        detected: VectorLanes,
        rate: Lanes,
        filter: &Filter,
    ) {
        let motion = &mut self.motion;
        let VectorLanes { x: cos, y: sin } = detected.seen_from(motion.heading);
        let misread = seen & cos.simd_lt(Lanes::splat(MISREAD));
        let read = seen & !misread;
        // The angle of a sine up to that of the limit, to a hundredth.
        let sin = sin & read;
        let square = sin * sin;
        let [sixth, next] = [1.0 / 6.0, 3.0 / 40.0].map(Lanes::splat);
        let difference = sin * (Lanes::ONE + square * (sixth + square * next));
        let Gains { alpha, beta, gate } = filter.gains(self.headings);
        let pushed = (difference * difference).simd_gt(gate);
        let beta = pushed.bitselect(Lanes::splat(PUSH_PART), beta);
        motion.heading = turned(motion.heading, difference * alpha);
        if pushed.any() {
            // The length of a detected heading may be far from 1.
            let detected = detected * (Lanes::ONE / detected.length_squared().sqrt());
            motion.heading = detected.where_else(pushed, motion.heading);
        }
        motion.angular_velocity += difference * (beta * rate);
        self.headings = counted(self.headings, read, pushed);
        self.refused = (self.refused + (Lanes::ONE & misread)) & !read;
        if misread.any() {
            self.believe(detected);
        }
    }

    /// Takes headings for right that have changed for some time.
    fn believe(&mut self, detected: VectorLanes) {
        for lane in 0..LANES {
            if self.refused.as_array()[lane] >= BELIEVED {
                self.motion.heading.set(lane, unit(detected.get(lane)));
                self.motion.angular_velocity.as_mut_array()[lane] = 0.0;
                self.headings.as_mut_array()[lane] = 1.0;
                self.refused.as_mut_array()[lane] = 0.0;
            }
        }
    }

    /// Moves a body by the difference of two cameras' errors: the second one sees it now at `detected`.
    pub(super) fn shift(&mut self, lane: usize, detected: Vector) {
        self.motion.position.set(lane, detected);
        self.unseen.as_mut_array()[lane] = 0.0;
    }

    /// Slows a body down to a speed, m/s.
    pub(super) fn limit_speed(&mut self, lane: usize, speed: f32) {
        let velocity = self.motion.velocity.get(lane);
        self.motion.velocity.set(lane, velocity.clamp_length_max(speed));
    }

    /// Takes in one more detection at the instant of the last one.
    pub(super) fn average(&mut self, lane: usize, detected: Vector, filter: &Filter) {
        let part = 0.5 * filter.gains(self.positions).alpha.as_array()[lane];
        let position = self.motion.position.get(lane);
        self.motion.position.set(lane, position + (detected - position) * part);
    }
}

/// Numbers of detections since a push, once those of `seen` bodies are taken in.
fn counted(counts: Lanes, seen: Lanes, pushed: Lanes) -> Lanes {
    let next = smaller(counts + (Lanes::ONE & seen), Lanes::splat(LONG));
    pushed.bitselect(Lanes::ONE, next)
}

/// A heading of length 1. One that already has it keeps its bits.
pub(super) fn unit(heading: Vector) -> Vector {
    let is_unit = (heading.length_squared() - 1.0).abs() < 1e-6;
    if is_unit { heading } else { heading.normalize() }
}

/// Angles up to which the series of [`turned`] holds, rad.
const SERIES: f32 = 1.0;

/// Headings turned by angles, rad, to a thousandth for the largest and far better for usual ones. Cosine and sine
/// are series. A step of Newton's method brings the length of the headings that come in back to 1; an angle of 1 changes
/// it by some ten-thousandths.
pub(super) fn turned(heading: VectorLanes, angle: Lanes) -> VectorLanes {
    let square = angle * angle;
    let mut turn = VectorLanes {
        x: alternating_series(square, [2.0, 12.0, 30.0]),
        y: angle * alternating_series(square, [6.0, 20.0]),
    };
    for lane in set_bits(square.simd_gt(Lanes::splat(SERIES * SERIES)).to_bitmask().into()) {
        turn.set(lane, direction(angle.as_array()[lane]));
    }
    let more = Lanes::splat(1.5) - Lanes::HALF * heading.length_squared();
    heading.rotated_by(turn) * more
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::senses::detections::DetectedRobot;
    use crate::senses::random::{Draws, Purpose};

    const PERIOD: f32 = 0.015;
    const LANE: usize = 2;

    /// A robot in a lane of a block.
    fn seen(position: Vector, heading: Vector) -> DetectedBlock {
        let mut block = DetectedBlock::NONE;
        block.set(LANE, &DetectedRobot { position, heading, robot: 1, camera: 0 });
        block
    }

    /// The ball under RC2021.
    fn ball() -> Filter {
        Filter::new(0.001, PERIOD, 3.0)
    }

    /// Error of the estimated speed after `frames` frames of a ball at `speed` (m/s), by its speed, over many
    /// sequences of detections; the ball was kicked before the first frame if `kicked`.
    fn errors(speed: f32, frames: u8, kicked: bool) -> f32 {
        let (count, filter) = (200_u8, ball());
        let mut sum = 0.0;
        for run in 0..count {
            let mut draws = Draws::of(9, Purpose::Frame, u64::from(run));
            let before = if kicked { 0.0 } else { speed };
            let mut track = TrackBlock::new();
            track.move_to(LANE, Vector::ZERO, Vector::new(before, 0.0));
            // The kick is somewhere between the last frame and the first that shows it.
            let start = if kicked { PERIOD * draws.uniform() } else { 0.0 };
            for frame in 1..=frames {
                let x = speed * (f32::from(frame) * PERIOD - start);
                let seen = Vector::new(x + draws.normal(0.001), draws.normal(0.001));
                track.coast(PERIOD);
                track.update_position(LANE, seen, &filter);
            }
            sum += (track.motion(LANE).velocity.length() / speed - 1.0).powi(2);
        }
        (sum / f32::from(count)).sqrt()
    }

    #[test]
    fn speed_is_right_three_frames_after_a_kick_and_settles() {
        assert!(errors(4.0, 3, true) < 0.05, "{}", errors(4.0, 3, true));
        assert!(errors(4.0, 20, true) < 0.01, "{}", errors(4.0, 20, true));
        assert!(errors(4.0, 100, false) < 0.01, "{}", errors(4.0, 100, false));
    }

    #[test]
    fn noise_is_seldom_taken_for_a_push() {
        let filter = ball();
        let mut track = TrackBlock::new();
        let mut pushes = 0;
        let mut draws = Draws::of(3, Purpose::Frame, 0);
        for _ in 0..10_000 {
            track.coast(PERIOD);
            let seen = Vector::new(draws.normal(0.001), draws.normal(0.001));
            track.update_position(LANE, seen, &filter);
            pushes += u32::from(track.pushed().as_array()[LANE] != 0.0);
        }
        assert!(pushes < 30, "{pushes}");
    }

    #[test]
    fn bodies_that_are_not_detected_go_on_and_stand_still_after_some_time() {
        let mut track = TrackBlock::new();
        let moving = Motion { velocity: Vector::X, ..Motion::at_rest(Vector::ZERO, Vector::X) };
        (0..LANES).for_each(|lane| track.begin(lane, &moving));
        let filter = ball();
        let seen = seen(Vector::new(1.0, 0.0), Vector::Y);
        for _ in 0..30 {
            track.coast(PERIOD);
            track.update(&seen, &filter, &filter);
        }
        let [other, own] = [0, LANE].map(|lane| track.motion(lane));
        assert!((other.position.x - LOST).abs() < 2.0 * PERIOD && other.velocity == Vector::ZERO);
        assert!((own.position.x - 1.0).abs() < 1e-3 && own.heading.y > 0.99);
    }

    #[test]
    fn bodies_do_not_go_on_over_a_long_gap() {
        let moving = Motion {
            velocity: Vector::X,
            angular_velocity: 1.0,
            ..Motion::at_rest(Vector::ZERO, Vector::X)
        };
        for gap in [10.0, 1e30, f32::INFINITY] {
            let mut track = TrackBlock::new();
            (0..LANES).for_each(|lane| track.begin(lane, &moving));
            track.coast(gap);
            let Motion { position, velocity, heading, angular_velocity } = track.motion(LANE);
            assert!((position.x - GAP).abs() < 1e-6 && velocity == Vector::ZERO, "{position}");
            assert!((heading.y - GAP.sin()).abs() < 1e-3 && angular_velocity == 0.0, "{heading}");
            track.coast(PERIOD);
            assert_eq!(track.motion(LANE).position, position);
        }
    }

    #[test]
    fn a_turning_heading_is_followed_and_a_misread_one_ignored() {
        let filter = Filter::new(0.01, PERIOD, 50.0);
        let mut track = TrackBlock::new();
        let at = |angle: f32| Vector::new(libm::cosf(angle), libm::sinf(angle));
        let mut angle = 0.0;
        for frame in 0..60 {
            angle += 8.0 * PERIOD;
            track.coast(PERIOD);
            let misread = frame % 10 == 5;
            let seen = seen(Vector::ZERO, at(if misread { angle + 1.57 } else { angle }));
            track.update(&seen, &filter, &filter);
        }
        let Motion { heading, angular_velocity, .. } = track.motion(LANE);
        assert!((angular_velocity - 8.0).abs() < 0.3, "{angular_velocity}");
        assert!(heading.dot(at(angle)) > 0.999);
    }

    #[test]
    fn a_heading_that_stays_changed_is_believed() {
        let filter = Filter::new(0.01, PERIOD, 50.0);
        let mut track = TrackBlock::new();
        let seen = seen(Vector::ZERO, Vector::Y);
        for _ in 0..4 {
            assert!(track.motion(LANE).heading.x > 0.99);
            track.coast(PERIOD);
            track.update(&seen, &filter, &filter);
        }
        assert!(track.motion(LANE).heading.y > 0.99);
    }

    #[test]
    fn turns_are_accurate() {
        for angle in [-2.0, -1.6, -1.0, -0.5, -0.1, 0.0, 0.3, 0.5, 1.0, 1.3] {
            let turned = turned(VectorLanes::splat(Vector::new(0.6, 0.8)), Lanes::splat(angle));
            let expected = libm::atan2f(0.8, 0.6) + angle;
            let (sin, cos) = libm::sincosf(expected);
            assert!((turned.get(LANE) - Vector::new(cos, sin)).length() < 1e-3, "{angle}");
        }
    }
}

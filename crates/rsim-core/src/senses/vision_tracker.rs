//! The tracker on its own, for detections of cameras that watch other simulators and real robots.

use crate::blocks::{blocks_of, place_of, robot as body_of};
use crate::body_parameters::BodyParameters;
use crate::error::ConfigError;
use crate::forecast::MAX_FORECAST;
use crate::forecast::commands::CommandLog;
use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::models::config::SimConfig;
use crate::models::sensing::Sensing;
use crate::senses::detections::{DetectedBall, DetectedBlock, DetectedRobot};
use crate::senses::driven::{DrivenRobots, Orders, Tracked};
use crate::senses::followed::{Followed, OtherDetections};
use crate::senses::frames::Frame;
use crate::senses::held::Beams;
use crate::senses::reports::Reported;
use crate::senses::row;
use crate::senses::track::unit;
use crate::senses::tracker::Tracker;

/// Frame rate that filters count with unless the senses have one, Hz.
const FRAME_RATE: f32 = 60.0;

/// Time without a detection after which a robot counts as absent, s.
const ABSENT: f64 = 0.5;

/// A robot that a camera detected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenRobot {
    /// Index of the robot in a state row.
    pub robot: usize,
    /// x and y, m.
    pub position: [f32; 2],
    /// Cosine and sine; any length above 0.
    pub heading: [f32; 2],
}

/// Estimates of all bodies from detections of cameras, by the filters of the senses.
#[derive(Debug, Clone)]
pub struct VisionTracker {
    config: SimConfig,
    parameters: BodyParameters,
    sensing: Sensing,
    followed: Followed,
    tracker: Tracker,
    driven: DrivenRobots,
    /// Commands that were sent, and the robots to which, one bit each.
    sent: CommandLog,
    commanded: u64,
    /// Time of the last frame, s; `None` before the first.
    time: Option<f64>,
    has_ball: bool,
    /// Time of the last detection of each robot, s.
    robots_seen: Vec<f64>,
}

impl VisionTracker {
    /// A tracker that has seen nothing. Its filters are those for the noise and frame rate of the senses of the
    /// configuration. Noise that these do not tell is that of [`Sensing::RC2021`], and the rate 60 Hz: policies that
    /// play from exact detections lose nothing by it, and those from noisy ones much without it.
    ///
    /// # Errors
    /// As [`SimConfig::validate`].
    pub fn new(config: &SimConfig) -> Result<Self, ConfigError> {
        config.validate()?;
        let mut sensing = config.sensing.clone().map_or_else(|| Sensing::preset("none"), Ok)?;
        sensing.tracker = 1.0;
        let usual = Sensing::RC2021;
        for (noise, usual) in [
            (&mut sensing.ball_position_noise, usual.ball_position_noise),
            (&mut sensing.robot_position_noise, usual.robot_position_noise),
            (&mut sensing.heading_noise, usual.heading_noise),
        ] {
            *noise = if *noise > 0.0 { *noise } else { usual };
        }
        let rate = if sensing.frame_rate > 0.0 { sensing.frame_rate } else { FRAME_RATE };
        let robots = config.n_robots();
        let followed = Followed::new(blocks_of(robots), 1.0 / rate);
        let tracker = Tracker::new(robots, &sensing, 1.0 / rate);
        let driven = DrivenRobots::new(robots, &sensing, 1.0 / rate);
        let (parameters, robots_seen) =
            (BodyParameters::of(config), vec![f64::NEG_INFINITY; robots]);
        Ok(Self {
            config: config.clone(),
            parameters,
            sensing,
            followed,
            tracker,
            driven,
            sent: CommandLog::default(),
            commanded: 0,
            time: None,
            has_ball: false,
            robots_seen,
        })
    }

    /// Configuration of the match.
    pub fn config(&self) -> &SimConfig {
        &self.config
    }

    /// Time of the last frame, s; `None` before the first.
    pub fn time(&self) -> Option<f64> {
        self.time
    }

    /// Whether a ball has been seen.
    pub fn has_ball(&self) -> bool {
        self.has_ball
    }

    /// Whether a robot was seen not long before the last frame.
    pub fn has_robot(&self, robot: usize) -> bool {
        self.time.is_some_and(|time| self.is_in_sight(robot, time))
    }

    /// Whether a robot was seen not long before a time, s.
    fn is_in_sight(&self, robot: usize, time: f64) -> bool {
        time - self.robots_seen[robot] <= ABSENT
    }

    /// Robots that were seen not long before a time (s), one bit each.
    fn in_sight(&self, time: f64) -> u64 {
        (0..self.robots_seen.len())
            .filter(|robot| self.is_in_sight(*robot, time))
            .fold(0, |bits, robot| bits | 1 << robot)
    }

    /// Takes note of commands of all robots that were sent at a time (s, on the clock of the frames) to `robots`, one
    /// bit each; they act `command_delay` of the senses later. From the first on, the drives of the models carry these
    /// robots from one frame to the next. Returns false, and changes nothing, if they are older than the last ones.
    pub fn send(&mut self, time: f64, commands: &[f32], robots: u64) -> bool {
        let delay = f64::from(self.sensing.command_delay);
        if self.sent.last().is_some_and(|last| time + delay < last) {
            return false;
        }
        let seen = self.time.unwrap_or(f64::NEG_INFINITY);
        self.sent.forget_before(seen.max(time + delay - MAX_FORECAST));
        self.sent.add(time + delay, commands);
        self.commanded = robots;
        true
    }

    /// Takes in the detections of a camera with this index: balls, of which one may be real, with the likeliest first,
    /// and robots. `cut` has a bit for each robot whose break beam is known to be cut, and is `None` where robots report
    /// nothing: a ball that was seen before the mouth of such a robot moves with it, also where no camera sees it.
    /// Returns false, and changes nothing, if it is older than the last one.
    pub fn take(
        &mut self,
        camera: u8,
        time: f64,
        balls: &[[f32; 2]],
        robots: &[SeenRobot],
        cut: Option<u64>,
    ) -> bool {
        if self.time.is_some_and(|last| time < last) {
            return false;
        }
        let balls: Vec<DetectedBall> =
            balls.iter().map(|ball| detected_ball(camera, *ball)).collect();
        let (known, new): (Vec<&SeenRobot>, Vec<&SeenRobot>) =
            robots.iter().partition(|seen| self.is_in_sight(seen.robot, time));
        let [mut known, new] = [known, new].map(|robots| self.detected_robots(camera, &robots));
        if self.time.is_some() {
            let balls = if self.has_ball { &balls[..] } else { &[] };
            // Of robots that were not seen no place is known that the ball could be at.
            let cut = cut.filter(|_| self.has_ball).map(|cut| cut & self.in_sight(time));
            self.followed.choose(time, &mut known, &mut Unused);
            let frame = Frame::of_positions(time, balls, &known);
            let beams = cut.map(|cut| Beams { cut, parameters: &self.parameters });
            self.tracker.take(&self.sensing, frame, self.config.ball.radius, beams);
            let held = self.tracker.held();
            let orders = Orders::new(&self.sent, &self.config, &self.sensing, &self.parameters);
            self.driven.take(Tracked { frame, held, beams, sensing: &self.sensing }, orders);
        }
        // A body that has just come into sight rests until it is seen again.
        let first = balls.len().min(usize::from(!self.has_ball));
        let frame = Frame::of_positions(time, &balls[..first], &new);
        self.followed.begin(frame.time, frame.blocks);
        self.tracker.begin(frame);
        self.driven.begin(frame);
        self.time = Some(time);
        self.has_ball |= first > 0;
        for seen in robots {
            self.robots_seen[seen.robot] = time;
        }
        true
    }

    /// Robots that a camera detected, by block: of each the first detection.
    fn detected_robots(&self, camera: u8, robots: &[&SeenRobot]) -> Vec<DetectedBlock> {
        let mut blocks = vec![DetectedBlock::NONE; blocks_of(self.robots_seen.len())];
        for seen in robots {
            #[expect(clippy::cast_possible_truncation, reason = "at most 63 robots")]
            let robot = seen.robot as u8;
            let heading = unit(Vector::from(seen.heading));
            let position = Vector::from(seen.position);
            let (block, lane) = place_of(body_of(seen.robot));
            if blocks[block].bodies >> lane & 1 == 0 {
                blocks[block].set(lane, &DetectedRobot { position, heading, robot, camera });
            }
        }
        blocks
    }

    /// Writes the state at the last frame, for a reader who knows the commands of `robots`, one bit each, of those that
    /// were sent. Robots that were not seen for half a second are absent, where they were seen last.
    ///
    /// # Panics
    /// If `out` is no row.
    pub fn write_row(&self, robots: u64, out: &mut [f32]) {
        let unseen = (0..self.robots_seen.len()).filter(|index| !self.has_robot(*index));
        let absent = unseen.map(|index| {
            let Motion { position, heading, .. } = self.tracker.motion(body_of(index));
            (index, position, heading)
        });
        row::write_known(&self.tracker, Reported { cut: 0, motions: &[] }, absent, out);
        if let Some(time) = self.time.filter(|_| self.commanded != 0) {
            let in_sight = self.in_sight(time);
            let known = self.commanded & robots;
            row::write_driven(&self.driven, known, in_sight, out);
        }
    }
}

/// Detections of another camera than the one that counts, at about the same time.
struct Unused;

impl OtherDetections for Unused {
    fn exchange(&mut self, _wanted: u8, _given: &mut DetectedRobot) -> bool {
        false
    }

    fn add(&mut self, _seen: DetectedRobot) {}
}

/// A ball that a camera detected.
fn detected_ball(camera: u8, place: [f32; 2]) -> DetectedBall {
    DetectedBall { position: Vector::from(place), z: 0.0, camera }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::{ABSENT_COLUMN, BALL_COLUMNS};
    use crate::senses::random::{Draws, Purpose};

    const PERIOD: f64 = 1.0 / 60.0;
    const ROBOT: usize = BALL_COLUMNS.len();

    fn tracker() -> VisionTracker {
        VisionTracker::new(&SimConfig::ssl(1, 1)).expect("a valid configuration")
    }

    fn row(tracker: &VisionTracker) -> Vec<f32> {
        let mut out = vec![f32::NAN; tracker.config().row_size()];
        tracker.write_row(u64::MAX, &mut out);
        assert!(out.iter().all(|number| number.is_finite()));
        out
    }

    fn seen(x: f32) -> SeenRobot {
        SeenRobot { robot: 0, position: [x, 1.0], heading: [2.0, 0.0] }
    }

    #[test]
    fn velocities_of_bodies_in_steady_motion_are_found() {
        let mut tracker = tracker();
        for frame in 0..60_u8 {
            let x = f32::from(frame) / 60.0;
            assert!(tracker.take(0, f64::from(frame) * PERIOD, &[[x, 0.5 * x]], &[seen(-x)], None));
        }
        let row = row(&tracker);
        let near = |column: usize, expected: f32| (row[column] - expected).abs() < 0.02;
        assert!(near(3, 1.0) && near(4, 0.5), "{row:?}");
        assert!(near(ROBOT + 4, -1.0) && near(ROBOT + 5, 0.0), "{row:?}");
        assert!(near(ROBOT, -59.0 / 60.0) && row[ROBOT + ABSENT_COLUMN] == 0.0, "{row:?}");
        assert!(tracker.has_ball() && tracker.has_robot(0) && !tracker.has_robot(1));
    }

    #[test]
    fn nothing_is_known_before_it_is_seen_and_robots_out_of_sight_are_absent() {
        let mut tracker = tracker();
        assert!(tracker.time().is_none() && !tracker.has_ball() && !tracker.has_robot(0));
        assert!(tracker.take(0, 5.0, &[], &[seen(0.3)], None));
        assert!(row(&tracker)[ROBOT + ABSENT_COLUMN] == 0.0);
        assert!(tracker.take(0, 5.6, &[[1.0, 2.0]], &[], None));
        let gone = row(&tracker);
        assert!(gone[ROBOT + ABSENT_COLUMN] > 0.0 && (gone[ROBOT] - 0.3).abs() < 1e-6);
        assert!(tracker.take(0, 5.7, &[], &[seen(-2.0)], None));
        let back = row(&tracker);
        assert!(back[ROBOT..ROBOT + 6] == [-2.0, 1.0, 1.0, 0.0, 0.0, 0.0], "{back:?}");
    }

    #[test]
    fn a_ball_that_no_camera_sees_moves_with_the_robot_whose_beam_it_cuts() {
        let last = |cut: Option<u64>| {
            let mut tracker = tracker();
            let mouth = tracker.config().robots().next().expect("a robot").front_distance()
                + tracker.config().ball.radius;
            for frame in 0..90_u8 {
                let time = f64::from(frame) * PERIOD;
                let x = (f32::from(frame) / 60.0 - 0.25).max(0.0);
                let balls: &[[f32; 2]] = if frame < 15 { &[[mouth + 0.005, 1.0]] } else { &[] };
                assert!(tracker.take(0, time, balls, &[seen(x)], cut));
            }
            let row = row(&tracker);
            (row[0] - row[ROBOT] - mouth, row[3])
        };
        let (gap, velocity) = last(Some(0b1));
        assert!(gap > -1e-3 && gap < 0.02 && (velocity - 1.0).abs() < 0.05, "{gap} {velocity}");
        for reported in [None, Some(0), Some(0b10)] {
            assert!(last(reported).0 < -1.0, "without a report it stays where it was seen");
        }
    }

    /// Velocity of a held ball in the robot's frame, m/s, the mean over frames by cameras with 1 mm of noise that sees
    /// it in `share` of them.
    fn slip(share: f32) -> f32 {
        let mut tracker = tracker();
        let robot = tracker.config().robots().next().expect("a robot").clone();
        let mouth = robot.front_distance() + tracker.config().ball.radius + 0.004;
        let mut draws = Draws::of(7, Purpose::Frame, 0);
        let mut sum = 0.0;
        for frame in 0..300_u16 {
            let ball = [mouth + draws.normal(0.001), 1.0 + draws.normal(0.001)];
            let balls: &[[f32; 2]] = if draws.happens(share) || frame < 30 { &[ball] } else { &[] };
            assert!(tracker.take(0, f64::from(frame) * PERIOD, balls, &[seen(0.0)], Some(1)));
            let row = row(&tracker);
            let [x, y] = [row[3] - row[ROBOT + 4], row[4] - row[ROBOT + 5]];
            sum += (x * x + y * y).sqrt();
        }
        sum / 300.0
    }

    #[test]
    fn noise_that_is_not_known_gives_a_held_ball_little_velocity() {
        assert!(slip(1.0) < 0.08, "{}", slip(1.0));
        assert!(slip(0.5) < 0.08, "{}", slip(0.5));
    }

    #[test]
    fn copies_of_a_frame_do_not_let_a_robot_rest() {
        let knows = |copies: u8| {
            let mut tracker = tracker();
            assert!(tracker.send(0.0, &[0.0; 12], 0b10));
            for frame in 0..20_u8 {
                let x = 0.002 * f32::from(frame);
                for copy in 0..copies {
                    let time = f64::from(frame) * PERIOD + f64::from(copy) * 1e-4;
                    assert!(tracker.take(0, time, &[], &[seen(x)], None));
                }
            }
            row(&tracker)[ROBOT + 4]
        };
        for copies in [1, 20] {
            assert!(knows(copies) > 0.05, "{copies} copies: it moves at 0.12 m/s");
        }
    }

    #[test]
    fn readers_know_the_commands_of_their_own_robots() {
        let mut tracker = tracker();
        assert!(tracker.take(0, 0.0, &[], &[seen(0.0)], None));
        let mut commands = [0.0; 12];
        commands[0] = 1.0;
        assert!(tracker.send(0.0, &commands, 0b1));
        for frame in 1..3_u8 {
            assert!(tracker.take(0, f64::from(frame) * PERIOD, &[], &[seen(0.0)], None));
        }
        let speed = |robots: u64| {
            let mut out = vec![f32::NAN; tracker.config().row_size()];
            tracker.write_row(robots, &mut out);
            out[ROBOT + 4]
        };
        assert!(speed(0b1) > 0.02 && speed(u64::MAX).to_bits() == speed(0b1).to_bits());
        assert!(speed(0b10).abs() < 1e-3 && speed(0).abs() < 1e-3, "cameras alone");
    }

    #[test]
    fn reports_that_end_end_the_hold() {
        let mut tracker = tracker();
        let robot = tracker.config().robots().next().expect("a robot").clone();
        let mouth = robot.front_distance() + tracker.config().ball.radius;
        let mut at = 0.0;
        let mut take = |x: Option<f32>, cut: Option<u64>| {
            at += PERIOD;
            let ball = x.map(|x| [x, 1.0]);
            assert!(tracker.take(0, at, ball.as_slice(), &[seen(0.0)], cut));
            row(&tracker)[0]
        };
        for _ in 0..10 {
            take(Some(mouth + 0.005), Some(1));
        }
        for frame in 0..40_u8 {
            take(Some(mouth + 0.03 * f32::from(frame)), None);
        }
        let found = take(None, Some(1));
        assert!(found > 1.0, "the ball that rolled away does not come back to {found}");
    }

    #[test]
    fn reports_of_robots_out_of_sight_hold_nothing() {
        let mut tracker = tracker();
        let robot = tracker.config().robots().next().expect("a robot").clone();
        let ball = [robot.front_distance() + tracker.config().ball.radius, 0.0];
        for frame in 0..30_u8 {
            let x = ball[0] + 0.01 * f32::from(frame);
            assert!(tracker.take(0, f64::from(frame) * PERIOD, &[[x, 0.0]], &[], Some(0b11)));
        }
        assert!(row(&tracker)[0] > ball[0] + 0.25, "robot 0 was never seen at the origin");
    }

    #[test]
    fn a_second_camera_at_another_place_gives_bodies_no_velocity() {
        for (late, away) in [(0.0, 0.03), (0.004, 0.03), (0.008, -0.05)] {
            let mut tracker = tracker();
            for frame in 0..90_u8 {
                let time = f64::from(frame) * PERIOD;
                // The first camera misses the bodies now and then, and in the end for good.
                let (balls, robots) = ([[1.0, 0.5]], [seen(0.2)]);
                let sees = frame % 7 != 3 && frame < 60;
                let count = usize::from(sees);
                assert!(tracker.take(0, time, &balls[..count], &robots[..count], None));
                let (balls, robots) = ([[1.0 + away, 0.5]], [seen(0.2 + away)]);
                assert!(tracker.take(1, time + late, &balls, &robots, None));
                let row = row(&tracker);
                let speeds = [row[3].hypot(row[4]), row[ROBOT + 4].hypot(row[ROBOT + 5])];
                assert!(speeds.iter().all(|speed| *speed < 0.02), "{late} {frame}: {speeds:?}");
            }
            let row = row(&tracker);
            assert!((row[0] - 1.0 - away).abs() < 1e-3 && (row[ROBOT] - 0.2 - away).abs() < 1e-3);
        }
    }

    #[test]
    fn a_body_that_goes_from_one_camera_to_the_other_keeps_its_velocity() {
        let mut tracker = tracker();
        for frame in 0..90_u8 {
            let (time, x) = (f64::from(frame) * PERIOD, f32::from(frame) / 60.0);
            let (near, far) = (usize::from(x < 0.8), usize::from(x > 0.6));
            let (balls, robots) = ([[x, 0.0]], [seen(x)]);
            assert!(tracker.take(0, time, &balls[..near], &robots[..near], None));
            let (balls, robots) = ([[x + 0.03, 0.0]], [seen(x + 0.03)]);
            assert!(tracker.take(1, time, &balls[..far], &robots[..far], None));
            if frame > 20 {
                let row = row(&tracker);
                let speeds = [row[3], row[ROBOT + 4]];
                assert!(speeds.iter().all(|v| (v - 1.0).abs() < 0.03), "{frame}: {speeds:?}");
            }
        }
    }

    #[test]
    fn a_ghost_far_away_is_no_ball_after_a_kick_either() {
        for others in [&[][..], &[[-3.0, -2.0]][..]] {
            let mut tracker = tracker();
            for frame in 0..40_u8 {
                let x = 4.0 * (f32::from(frame) - 19.5).max(0.0) / 60.0;
                // Just after the kick it is missed once.
                let seen = usize::from(frame != 21);
                let balls = [&[[x, 0.0]][..seen], others].concat();
                assert!(tracker.take(0, f64::from(frame) * PERIOD, &balls, &[], None));
                let row = row(&tracker);
                assert!(row[3].hypot(row[4]) < 6.0, "{frame}: {row:?}");
                assert!(frame == 20 || (row[0] - x).abs() < 0.1, "{frame}: {} {x}", row[0]);
            }
        }
    }

    #[test]
    fn a_frame_of_the_past_changes_nothing() {
        let mut tracker = tracker();
        assert!(tracker.take(0, 5.0, &[[1.0, 2.0]], &[seen(0.3)], None));
        let before = row(&tracker);
        assert!(!tracker.take(0, 4.9, &[[2.0, 2.0]], &[seen(0.5)], None));
        assert!(row(&tracker) == before && tracker.time() == Some(5.0));
    }
}

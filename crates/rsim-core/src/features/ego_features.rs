//! Egocentric features: a robot's view scaled for a network, with ball and goal also relative to its
//! position and heading.
//!
//! The relative blocks follow from the others, but networks learn products slowly, and a rotation of
//! vectors takes products. The features are in the core, and not with the tasks, because they are
//! computed for every robot of every world in every step.

use std::mem::take;

use crate::features::viewpoint::{Observer, Presence, ViewedBall, ViewedRobot};
use crate::math::Vector;
use crate::models::field::Field;
use crate::models::robot::RobotModel;

/// Name and shape of a block of features.
pub type Block = (&'static str, Vec<usize>);

/// Egocentric features, in half lengths of the field and top speeds of a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct EgoFeatures {
    n_teammates: usize,
    /// Number of robots in a view: itself, teammates, opponents.
    n_slots: usize,
    /// Middle of the attacked goal, m.
    goal: Vector,
    /// Scales of positions (1/m), velocities (s/m) and angular velocities (s/rad).
    position_scale: f32,
    velocity_scale: f32,
    angular_velocity_scale: f32,
    /// Whether robots have a mouth, so that break beams and the ball's height matter.
    have_mouths: bool,
    /// Whether the block `presence` is written.
    presence: bool,
}

/// Decay rate of the nearness of the ball in the block `shot`, 1/m: it is 1/e at 12.5 cm.
const NEARNESS_DECAY: f32 = 8.0;

/// Minimum length of a vector that is divided by its length, m.
const MIN_LENGTH: f32 = 1e-6;

/// Writes numbers one after the other.
struct Writer<'a>(&'a mut [f32]);

impl Writer<'_> {
    fn write<const N: usize>(&mut self, numbers: [f32; N]) {
        // All at once: a check of the end before each number would take half the time of an encoding.
        let (to, rest) = take(&mut self.0).split_first_chunk_mut().expect("room for all features");
        *to = numbers;
        self.0 = rest;
    }
}

/// Position and heading of the observing robot.
struct BodyFrame {
    position: Vector,
    heading: Vector,
}

impl BodyFrame {
    /// A vector of the field in the robot's own frame: forward, left.
    fn rotate(&self, vector: Vector) -> Vector {
        let (cos, sin) = (self.heading.x, self.heading.y);
        Vector::new(vector.x * cos + vector.y * sin, vector.y * cos - vector.x * sin)
    }

    /// Scaled distance, and cosine and sine of the bearing, of a point at `offset`.
    fn polar(&self, offset: Vector, scale: f32) -> [f32; 3] {
        let distance = offset.length();
        let bearing = self.rotate(offset) / distance.max(MIN_LENGTH);
        [distance * scale, bearing.x, bearing.y]
    }
}

impl EgoFeatures {
    /// Features of robots like `robot` on `field`, for views with these numbers of other robots. `presence`
    /// says whether they have the block of that name.
    pub fn new(
        field: &Field,
        robot: &RobotModel,
        n_teammates: usize,
        n_opponents: usize,
        presence: bool,
    ) -> Self {
        Self {
            n_teammates,
            n_slots: 1 + n_teammates + n_opponents,
            goal: Vector::new(field.half_length(), 0.0),
            position_scale: 1.0 / field.half_length(),
            velocity_scale: 1.0 / robot.top_speed(),
            angular_velocity_scale: 1.0 / robot.top_angular_velocity(),
            have_mouths: robot.mouth.is_some(),
            presence,
        }
    }

    /// Number of robots in a view: itself, teammates, opponents.
    pub fn slots(&self) -> usize {
        self.n_slots
    }

    /// Names and shapes of the blocks, in order.
    ///
    /// | block | numbers |
    /// | --- | --- |
    /// | `ball` | position and velocity, in the plane, or in space for robots with a mouth |
    /// | `ego`, `teammates`, `opponents` | x, y, cos, sin, velocity, angular velocity, and the break beam of robots with a mouth |
    /// | `ball_polar`, `goal_polar` | distance, cosine and sine of the bearing |
    /// | `shot` | cosine and sine of the bearing from the ball to the goal; nearness of the ball, falling from 1 to 0; nearness times the cosine of the angle between ball and goal |
    /// | `own_goal_polar` | as `goal_polar`, of the goal that the robot's team defends; only for robots without a mouth |
    /// | `own_goal_shot` | as `shot`, of that goal, without the nearness; only for robots without a mouth |
    /// | `body_velocities` | own velocity and the ball's, forward and left |
    /// | `body_positions` | offsets of ball, teammates, opponents, forward and left |
    /// | `presence` | 1 for each robot of the view that is on the field, itself first, and 0 for others; only on demand |
    pub fn blocks(&self) -> Vec<Block> {
        let robot = if self.have_mouths { 8 } else { 7 };
        let mut blocks = vec![
            ("ball", vec![if self.have_mouths { 6 } else { 4 }]),
            ("ego", vec![robot]),
            ("teammates", vec![self.n_teammates, robot]),
            ("opponents", vec![self.n_slots - 1 - self.n_teammates, robot]),
            ("ball_polar", vec![3]),
            ("goal_polar", vec![3]),
            ("shot", vec![4]),
        ];
        if self.observe_own_goal() {
            blocks.extend([("own_goal_polar", vec![3]), ("own_goal_shot", vec![3])]);
        }
        blocks.extend([("body_velocities", vec![2, 2]), ("body_positions", vec![self.n_slots, 2])]);
        if self.presence {
            blocks.push(("presence", vec![self.n_slots]));
        }
        blocks
    }

    /// Whether the own goal is observed in the robot's frame, too.
    ///
    /// Robots that can only push the ball push it into their own goal, too. Trained to beat noise, they did
    /// so in .9% of the matches without these numbers and do in .1% with them (docs/learning.md). Robots
    /// with a mouth seldom do.
    fn observe_own_goal(&self) -> bool {
        !self.have_mouths
    }

    /// Number of features.
    pub fn size(&self) -> usize {
        self.blocks().iter().map(|(_, shape)| shape.iter().product::<usize>()).sum()
    }

    /// Writes the features of an observer of a row, in its view, which attacks +x. An empty slot and an
    /// absent robot have zeros, and an absent observer observes nothing but zeros.
    pub fn encode(&self, observer: &Observer, row: &[f32], out: &mut [f32]) {
        debug_assert_eq!(observer.slots.len(), self.n_slots);
        debug_assert_eq!(out.len(), self.size());
        if observer.is_absent(row) {
            return out.fill(0.0);
        }
        let mut writer = Writer(out);
        let ball = observer.ball(row);
        self.encode_ball(&ball, &mut writer);
        for robot in observer.robots(row) {
            self.encode_robot(&robot, &mut writer);
        }
        self.encode_relative(&ball, observer.robots(row), &mut writer);
        if self.presence {
            for robot in observer.robots(row) {
                writer.write([f32::from(u8::from(robot.presence == Presence::Present))]);
            }
        }
    }

    fn encode_ball(&self, ball: &ViewedBall, writer: &mut Writer) {
        let (position, velocity) =
            (ball.position * self.position_scale, ball.velocity * self.velocity_scale);
        if self.have_mouths {
            let height = ball.height * self.position_scale;
            let vertical_velocity = ball.vertical_velocity * self.velocity_scale;
            writer.write([position.x, position.y, height]);
            writer.write([velocity.x, velocity.y, vertical_velocity]);
        } else {
            writer.write([position.x, position.y, velocity.x, velocity.y]);
        }
    }

    fn encode_robot(&self, robot: &ViewedRobot, writer: &mut Writer) {
        let (position, heading) = (robot.position * self.position_scale, robot.heading);
        let velocity = robot.velocity * self.velocity_scale;
        writer.write([position.x, position.y, heading.x, heading.y]);
        writer.write([
            velocity.x,
            velocity.y,
            robot.angular_velocity * self.angular_velocity_scale,
        ]);
        if self.have_mouths {
            writer.write([robot.beam]);
        }
    }

    /// Writes the blocks relative to the robot.
    fn encode_relative(
        &self,
        ball: &ViewedBall,
        mut robots: impl Iterator<Item = ViewedRobot>,
        writer: &mut Writer,
    ) {
        let own = robots.next().unwrap_or_default();
        let frame = BodyFrame { position: own.position, heading: own.heading };
        let to_ball = ball.position - frame.position;
        writer.write(frame.polar(to_ball, self.position_scale));
        writer.write(frame.polar(self.goal - frame.position, self.position_scale));
        // Not the system's `exp`, whose last bit differs between platforms.
        let nearness = libm::expf(to_ball.length().max(MIN_LENGTH) * -NEARNESS_DECAY);
        let [cos, sin, alignment] = shot(&frame, to_ball, self.goal - ball.position);
        writer.write([cos, sin, nearness, nearness * alignment]);
        if self.observe_own_goal() {
            let own_goal = Vector::new(-self.goal.x, self.goal.y);
            writer.write(frame.polar(own_goal - frame.position, self.position_scale));
            let [cos, sin, alignment] = shot(&frame, to_ball, own_goal - ball.position);
            writer.write([cos, sin, nearness * alignment]);
        }
        for velocity in [own.velocity, ball.velocity] {
            writer.write((frame.rotate(velocity) * self.velocity_scale).to_array());
        }
        writer.write((frame.rotate(to_ball) * self.position_scale).to_array());
        for other in robots {
            let absent = other.presence == Presence::Absent;
            let offset = if absent { Vector::ZERO } else { other.position - frame.position };
            writer.write((frame.rotate(offset) * self.position_scale).to_array());
        }
    }
}

/// Cosine and sine of the bearing from the ball to a goal, and cosine of the angle between the directions
/// from robot to ball and from ball to goal.
fn shot(frame: &BodyFrame, to_ball: Vector, to_goal: Vector) -> [f32; 3] {
    let goal_distance = to_goal.length().max(MIN_LENGTH);
    let ball_distance = to_ball.length().max(MIN_LENGTH);
    let bearing = frame.rotate(to_goal) / goal_distance;
    let along = to_ball.x * to_goal.x + to_ball.y * to_goal.y;
    [bearing.x, bearing.y, along / (goal_distance * ball_distance)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::{BALL_COLUMNS, row_size};

    #[test]
    fn all_features_are_written_and_their_number_is_that_of_the_blocks() {
        for (field, robot) in
            [(Field::VSS_3V3, RobotModel::VSS_440RPM), (Field::SSL_B, RobotModel::SSL_GENERIC)]
        {
            let features = EgoFeatures::new(&field, &robot, 2, 3, true);
            let slots = vec![Some(4), Some(5), None, Some(0), Some(1), Some(2)];
            let observer = Observer { rotated: true, slots };
            let mut out = vec![f32::NAN; features.size()];
            features.encode(&observer, &vec![0.25; row_size(6)], &mut out);
            assert!(out.iter().all(|number| number.is_finite()), "{out:?}");
        }
    }

    #[test]
    fn ball_and_goal_straight_ahead_are_a_straight_shot_away_from_the_own_goal() {
        let features = EgoFeatures::new(&Field::VSS_3V3, &RobotModel::VSS_440RPM, 0, 0, false);
        for (rotated, sign) in [(false, 1.0), (true, -1.0)] {
            let observer = Observer { rotated, slots: vec![Some(0)] };
            let mut row = vec![0.0; row_size(1)];
            row[0] = 0.375 * sign;
            row[BALL_COLUMNS.len() + 2] = sign;
            let mut out = vec![0.0; features.size()];
            features.encode(&observer, &row, &mut out);
            let first = 4 + 7;
            assert_eq!(out[first..first + 6], [0.5, 1.0, 0.0, 1.0, 1.0, 0.0]);
            let near = (-3.0_f32).exp();
            let shots = &out[first + 6..first + 16];
            let expected = [1.0, 0.0, near, near, 1.0, -1.0, 0.0, -1.0, 0.0, -near];
            assert!(shots.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{shots:?}");
        }
    }
}

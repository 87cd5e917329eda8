//! The game as a robot sees it, scaled for a network: all motion in its side's view, and ball and
//! goal from where it stands and faces.
//!
//! The latter say nothing that the former do not, but turning vectors takes products, which networks
//! learn slowly. It is here, and not with the tasks, because it is worked out for every robot of
//! every world in every step.

use rapier2d::math::Vector;

use crate::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use crate::{Field, RobotModel};

/// A block of the numbers that are written: its name and shape.
pub type Block = (&'static str, Vec<usize>);

/// What a robot sees, in half lengths of the field and top speeds of a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Sight {
    mates: usize,
    /// Itself, mates, foes.
    slots: usize,
    /// Middle of the goal attacked, m.
    goal: Vector,
    per_metre: f32,
    per_speed: f32,
    per_turn: f32,
    /// Whether robots have a break beam, and the ball's height matters.
    mouths: bool,
}

/// Per metre: at 12 cm the ball is a third as near as at none.
const NEAR: f32 = 8.0;

/// Keeps directions finite, m.
const TINY: f32 = 1e-6;

/// Writes numbers one after the other.
struct Pen<'a>(std::slice::IterMut<'a, f32>);

impl Pen<'_> {
    fn write(&mut self, numbers: &[f32]) {
        for (number, to) in numbers.iter().zip(&mut self.0) {
            *to = *number;
        }
    }
}

/// Where a robot stands and faces.
struct Eye {
    position: Vector,
    heading: Vector,
}

impl Eye {
    /// Ahead and left in place of x and y.
    fn turn(&self, vector: Vector) -> Vector {
        let (cos, sin) = (self.heading.x, self.heading.y);
        Vector::new(vector.x * cos + vector.y * sin, vector.y * cos - vector.x * sin)
    }

    /// Distance, and cosine and sine of the bearing, of what lies `offset` away.
    fn polar(&self, offset: Vector, per_metre: f32) -> [f32; 3] {
        let distance = offset.length();
        let bearing = self.turn(offset) / distance.max(TINY);
        [distance * per_metre, bearing.x, bearing.y]
    }
}

impl Sight {
    /// The sight of robots like `robot`, of a side that has at most so many other robots and foes.
    pub fn new(field: &Field, robot: &RobotModel, mates: usize, foes: usize) -> Self {
        Self {
            mates,
            slots: 1 + mates + foes,
            goal: Vector::new(field.half_length(), 0.0),
            per_metre: 1.0 / field.half_length(),
            per_speed: 1.0 / robot.top_speed(),
            per_turn: 1.0 / robot.top_turn_rate(),
            mouths: robot.mouth.is_some(),
        }
    }

    /// Robots in a view: itself, mates, foes.
    pub fn slots(&self) -> usize {
        self.slots
    }

    /// What is written, in order.
    ///
    /// `ball`: place and velocity, in the plane or, for robots with a break beam, in space. `me`,
    /// `mates`, `foes`: x, y, cos, sin, velocity, turn rate, and the beam where there is one.
    /// `ball_from_me`, `goal_from_me`: distance, cosine and sine of the bearing. `shot`: bearing of
    /// the goal from the ball; how near the ball is, 1 falling to 0; the latter times 1 where ball
    /// and goal lie in one direction, -1 where in opposite ones. `motion_from_me`: own velocity and
    /// the ball's, ahead and left. `places_from_me`: ball, mates, foes, likewise.
    pub fn blocks(&self) -> Vec<Block> {
        let robot = if self.mouths { 8 } else { 7 };
        vec![
            ("ball", vec![if self.mouths { 6 } else { 4 }]),
            ("me", vec![robot]),
            ("mates", vec![self.mates, robot]),
            ("foes", vec![self.slots - 1 - self.mates, robot]),
            ("ball_from_me", vec![3]),
            ("goal_from_me", vec![3]),
            ("shot", vec![4]),
            ("motion_from_me", vec![2, 2]),
            ("places_from_me", vec![self.slots, 2]),
        ]
    }

    /// Numbers that are written.
    pub fn size(&self) -> usize {
        self.blocks().iter().map(|(_, shape)| shape.iter().product::<usize>()).sum()
    }

    /// Writes what one robot sees. `ball` and `robots` are its view: columns as
    /// [`crate::columns`] names them, attacking +x; itself, mates, foes, zeros where nobody is.
    pub fn write(&self, ball: &[f32], robots: &[f32], out: &mut [f32]) {
        debug_assert_eq!(ball.len(), BALL_COLUMNS.len());
        debug_assert_eq!(robots.len(), self.slots * ROBOT_COLUMNS.len());
        debug_assert_eq!(out.len(), self.size());
        let mut pen = Pen(out.iter_mut());
        let (place, speed) = (self.per_metre, self.per_speed);
        let &[x, y, z, v_x, v_y, v_z, ..] = ball else { unreachable!("{BALL_COLUMNS:?}") };
        if self.mouths {
            pen.write(&[x * place, y * place, z * place, v_x * speed, v_y * speed, v_z * speed]);
        } else {
            pen.write(&[x * place, y * place, v_x * speed, v_y * speed]);
        }
        for robot in robots.chunks_exact(ROBOT_COLUMNS.len()) {
            let &[x, y, cos, sin, v_x, v_y, v_theta, beam, ..] = robot else {
                unreachable!("{ROBOT_COLUMNS:?}")
            };
            let turns = v_theta * self.per_turn;
            pen.write(&[x * place, y * place, cos, sin, v_x * speed, v_y * speed, turns]);
            if self.mouths {
                pen.write(&[beam]);
            }
        }
        self.write_from_me([Vector::new(x, y), Vector::new(v_x, v_y)], robots, &mut pen);
    }

    fn write_from_me(&self, [ball, ball_velocity]: [Vector; 2], robots: &[f32], pen: &mut Pen) {
        let (me, others) = robots.split_at(ROBOT_COLUMNS.len());
        let eye = Eye { position: Vector::new(me[0], me[1]), heading: Vector::new(me[2], me[3]) };
        let to_ball = ball - eye.position;
        pen.write(&eye.polar(to_ball, self.per_metre));
        pen.write(&eye.polar(self.goal - eye.position, self.per_metre));
        pen.write(&shot(&eye, to_ball, self.goal - ball));
        for velocity in [Vector::new(me[4], me[5]), ball_velocity] {
            pen.write(&(eye.turn(velocity) * self.per_speed).to_array());
        }
        pen.write(&(eye.turn(to_ball) * self.per_metre).to_array());
        for other in others.chunks_exact(ROBOT_COLUMNS.len()) {
            let away = Vector::new(other[0], other[1]) - eye.position;
            pen.write(&(eye.turn(away) * self.per_metre).to_array());
        }
    }
}

/// Bearing of the goal from the ball, how near the ball is, and how well the robot stands behind it.
fn shot(eye: &Eye, to_ball: Vector, to_goal: Vector) -> [f32; 4] {
    let way = to_goal.length().max(TINY);
    let distance = to_ball.length().max(TINY);
    let bearing = eye.turn(to_goal) / way;
    // Not the system's: it would differ in the last bit between platforms.
    let near = libm::expf(distance * -NEAR);
    let along = to_ball.x * to_goal.x + to_ball.y * to_goal.y;
    [bearing.x, bearing.y, near, near * (along / (way * distance))]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_is_written_and_as_many_as_the_blocks_say() {
        for (field, robot) in
            [(Field::VSS_3V3, RobotModel::VSS_440RPM), (Field::SSL_B, RobotModel::SSL_GENERIC)]
        {
            let sight = Sight::new(&field, &robot, 2, 3);
            let ball = vec![0.5; BALL_COLUMNS.len()];
            let robots = vec![0.25; sight.slots() * ROBOT_COLUMNS.len()];
            let mut out = vec![f32::NAN; sight.size()];
            sight.write(&ball, &robots, &mut out);
            assert!(out.iter().all(|number| number.is_finite()), "{out:?}");
        }
    }

    #[test]
    fn the_ball_ahead_and_before_the_goal_is_a_straight_shot() {
        let sight = Sight::new(&Field::VSS_3V3, &RobotModel::VSS_440RPM, 0, 0);
        let mut ball = vec![0.0; BALL_COLUMNS.len()];
        ball[0] = 0.375;
        let mut robot = vec![0.0; ROBOT_COLUMNS.len()];
        robot[2] = 1.0;
        let mut out = vec![0.0; sight.size()];
        sight.write(&ball, &robot, &mut out);
        let first = 4 + 7;
        assert_eq!(out[first..first + 6], [0.5, 1.0, 0.0, 1.0, 1.0, 0.0]);
        let near = (-3.0_f32).exp();
        let shot = &out[first + 6..first + 10];
        assert!(shot.iter().zip([1.0, 0.0, near, near]).all(|(a, b)| (a - b).abs() < 1e-6));
    }
}

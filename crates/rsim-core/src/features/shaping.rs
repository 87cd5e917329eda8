//! Potential functions for reward shaping, one value per robot. Tasks weight and sum them.
//!
//! Shaping by differences of a potential keeps the optimal policy (Ng, Harada and Russell, 1999): going
//! back and forth gains nothing.

use crate::columns::{BALL_COLUMNS, ROBOT_COLUMNS, is_absent};
use crate::features::viewpoint::{Observer, Presence, ViewedRobot};
use crate::math::Vector;
use crate::models::ball::BallModel;
use crate::models::field::Field;
use crate::models::robot::RobotModel;

/// A potential function, in meters, of a robot's view, which attacks +x.
#[derive(Debug, Clone, PartialEq)]
pub enum Potential {
    /// Half the difference of the ball's distances to the own goal and to the attacked goal, so that the
    /// gain of one team is the loss of the other.
    BallToGoal {
        /// Half the length of the field, m.
        goal_x: f32,
    },
    /// Negative distance of the robot to the point behind the ball, opposite to the attacked goal.
    BehindBall {
        /// Half the length of the field, m.
        goal_x: f32,
        /// Distance from the ball to that point, m.
        distance: f32,
        /// Bounds of that point, m: a ball at the wall has no space behind it.
        bounds: Vector,
    },
    /// Negative distance of the ball to its place in the robot's mouth. It is maximal only with the ball
    /// directly in front, so it pulls the robot close and turns it to face the ball.
    AtMouth {
        /// Distance of that place from the robot's center, m.
        reach: f32,
    },
}

impl Potential {
    /// Potential of the ball's position between the goals.
    pub fn ball_to_goal(field: &Field) -> Self {
        Self::BallToGoal { goal_x: field.half_length() }
    }

    /// Potential of a robot's distance to the point `distance` (m) behind the ball.
    pub fn behind_ball(field: &Field, distance: f32) -> Self {
        let bounds = Vector::new(field.half_length() - distance, field.half_width() - distance);
        Self::BehindBall { goal_x: field.half_length(), distance, bounds }
    }

    /// Potential of the ball's distance to the robot's mouth.
    pub fn at_mouth(robot: &RobotModel, ball: &BallModel) -> Self {
        Self::AtMouth { reach: robot.front_distance() + ball.radius }
    }

    /// Increase from `last_row` to `row` for an observer, in its view, which attacks +x; 0 for a robot that
    /// is absent in one of them.
    pub fn difference(&self, observer: &Observer, last_row: &[f32], row: &[f32]) -> f32 {
        let of = |row| {
            let own = observer.robots(row).next().unwrap_or_default();
            (own.presence != Presence::Absent).then(|| self.of(observer.ball(row).position, &own))
        };
        of(last_row).zip(of(row)).map_or(0.0, |(before, now)| now - before)
    }

    /// Value for a robot and the position of the ball in its view.
    fn of(&self, ball: Vector, robot: &ViewedRobot) -> f32 {
        let own = robot.position;
        match *self {
            Self::BallToGoal { goal_x } => {
                let to = |x: f32| Vector::new(x, ball.y).length();
                0.5 * (to(goal_x + ball.x) - to(goal_x - ball.x))
            }
            Self::BehindBall { goal_x, distance, bounds } => {
                let to_goal = Vector::new(goal_x - ball.x, -ball.y);
                let scale = distance / to_goal.length().max(distance);
                let point = ball - to_goal * scale;
                let y = point.y.max(-bounds.y).min(bounds.y);
                let point = Vector::new(point.x.max(-bounds.x), y);
                -(point - own).length()
            }
            Self::AtMouth { reach } => {
                let mouth = own + robot.heading * reach;
                -(ball - mouth).length()
            }
        }
    }
}

/// Writes whether each robot of a row is its team's nearest to the ball; the first `n_blue` are one team.
/// An absent robot is not.
pub fn nearest_to_ball(row: &[f32], n_blue: usize, out: &mut [bool]) {
    let (ball, robots) = row.split_at(BALL_COLUMNS.len());
    let distance = |robot: usize| {
        let at = &robots[robot * ROBOT_COLUMNS.len()..][..ROBOT_COLUMNS.len()];
        if is_absent(at) {
            return f32::INFINITY;
        }
        Vector::new(at[0] - ball[0], at[1] - ball[1]).length()
    };
    let split = n_blue.min(out.len());
    let (blue, yellow) = out.split_at_mut(split);
    for (first, team) in [(0, blue), (split, yellow)] {
        let places = first..first + team.len();
        let least = places.clone().map(distance).fold(f32::INFINITY, f32::min);
        for (robot, nearest) in places.zip(team) {
            *nearest = least < f32::INFINITY && distance(robot) <= least;
        }
    }
}

/// Mean magnitude of the numbers of an action.
pub fn mean_magnitude(action: &[f32]) -> f32 {
    let total: f32 = action.iter().map(|number| number.abs()).sum();
    total / action.len() as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::columns::{robot_column, row_size};

    const FIELD: Field = Field::VSS_3V3;

    #[test]
    fn an_absent_robot_neither_gains_nor_loses() {
        let observer = Observer { rotated: false, slots: vec![Some(0)] };
        let (mut last, mut row) = (vec![0.25; row_size(1)], vec![0.5; row_size(1)]);
        let absent = BALL_COLUMNS.len() + robot_column("absent");
        let potential = Potential::ball_to_goal(&FIELD);
        for (before, now) in [(0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0)] {
            (last[absent], row[absent]) = (before, now);
            let gain = potential.difference(&observer, &last, &row);
            assert!((gain > 0.1) == (before + now == 0.0), "{before} {now}: {gain}");
        }
    }

    fn value(potential: &Potential, [x, y]: [f32; 2], own: [f32; 4]) -> f32 {
        let robot = ViewedRobot {
            position: Vector::new(own[0], own[1]),
            heading: Vector::new(own[2], own[3]),
            ..ViewedRobot::default()
        };
        potential.of(Vector::new(x, y), &robot)
    }

    #[test]
    fn each_potential_is_maximal_where_its_name_says() {
        let robot = &RobotModel::SSL_GENERIC;
        let in_mouth = robot.front_distance() + BallModel::SSL_TIGERS.radius;
        let cases = [
            (Potential::ball_to_goal(&FIELD), [0.7, 0.0], [0.0, 0.0, 1.0, 0.0], [0.6, 0.0]),
            (Potential::behind_ball(&FIELD, 0.08), [0.0, 0.0], [-0.08, 0.0, 1.0, 0.0], [0.0, 0.1]),
            (
                Potential::at_mouth(robot, &BallModel::SSL_TIGERS),
                [in_mouth, 0.0],
                [0.0, 0.0, 1.0, 0.0],
                [-in_mouth, 0.0],
            ),
        ];
        for (potential, best, me, worse) in cases {
            let of = |ball| value(&potential, ball, me);
            assert!(of(best) > of(worse) + 0.05, "{potential:?}");
        }
    }

    #[test]
    fn the_point_behind_a_ball_at_the_wall_is_inside_the_field() {
        let potential = Potential::behind_ball(&FIELD, 0.08);
        let place = [0.08 - FIELD.half_length(), 0.0, 1.0, 0.0];
        let ball = [0.02 - FIELD.half_length(), 0.0];
        assert!(value(&potential, ball, place).abs() < 1e-6);
    }

    #[test]
    fn the_nearest_of_each_team_is_found_also_in_a_team_of_one() {
        let mut row = vec![0.0; crate::columns::row_size(3)];
        for (robot, x) in [0.5, -0.2, 0.9].into_iter().enumerate() {
            row[BALL_COLUMNS.len() + robot * ROBOT_COLUMNS.len()] = x;
        }
        for (n_blue, expected) in [
            (2, [false, true, true]),
            (3, [false, true, false]),
            (1, [true, true, false]),
            (0, [false, true, false]),
        ] {
            let mut nearest = [false; 3];
            nearest_to_ball(&row, n_blue, &mut nearest);
            assert_eq!(nearest, expected, "{n_blue} of the first team");
        }
        for (absent, expected) in [(0, [false, true, true]), (1, [true, false, true])] {
            let mut row = row.clone();
            row[BALL_COLUMNS.len() + absent * ROBOT_COLUMNS.len() + robot_column("absent")] = 1.0;
            let mut nearest = [false; 3];
            nearest_to_ball(&row, 2, &mut nearest);
            assert_eq!(nearest, expected, "without robot {absent}");
        }
        row[BALL_COLUMNS.len() + 2 * ROBOT_COLUMNS.len() + robot_column("absent")] = 1.0;
        let mut nearest = [false; 3];
        nearest_to_ball(&row, 2, &mut nearest);
        assert_eq!(nearest, [false, true, false], "a team without robots");
    }
}

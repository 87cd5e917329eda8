//! What rewards that guide are made of, as each robot has it. Tasks weigh it and add it up.
//!
//! Guiding by differences of a potential leaves the best policy what it was (Ng, Harada and Russell,
//! 1999): going back and forth pays nothing.

use rapier2d::math::Vector;

use crate::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use crate::{BallModel, Field, RobotModel};

/// What a robot is to raise, in metres; worked out of its view, which attacks +x.
#[derive(Debug, Clone, PartialEq)]
pub enum Potential {
    /// How much nearer the ball is to the goal attacked than to the own one: half the difference,
    /// so what one side wins the other loses.
    BallToGoal {
        /// Half the length of the field, m.
        goal_x: f32,
    },
    /// How near the robot is to the point behind the ball from which it drives it at the goal.
    BehindBall {
        /// Half the length of the field, m.
        goal_x: f32,
        /// From the ball to that point, m.
        behind: f32,
        /// That point is kept within, m: a ball at the wall has no room behind it.
        most: Vector,
    },
    /// How near the ball is to where it would be in the robot's mouth.
    AtMouth {
        /// From the robot's centre to there, m.
        reach: f32,
    },
}

impl Potential {
    /// The ball on its way to the goal.
    pub fn ball_to_goal(field: &Field) -> Self {
        Self::BallToGoal { goal_x: field.half_length() }
    }

    /// A robot on its way to a point so far behind the ball, m.
    pub fn behind_ball(field: &Field, behind: f32) -> Self {
        let most = Vector::new(field.half_length() - behind, field.half_width() - behind);
        Self::BehindBall { goal_x: field.half_length(), behind, most }
    }

    /// A robot that is to take the ball into its mouth: nothing is left to raise only for who faces
    /// it.
    pub fn at_mouth(robot: &RobotModel, ball: &BallModel) -> Self {
        Self::AtMouth { reach: robot.front() + ball.radius }
    }

    /// What it is for a robot that sees the ball, and itself first of `robots`.
    pub fn of(&self, ball: &[f32], robots: &[f32]) -> f32 {
        let ball = Vector::new(ball[0], ball[1]);
        let me = Vector::new(robots[0], robots[1]);
        match *self {
            Self::BallToGoal { goal_x } => {
                let to = |x: f32| Vector::new(x, ball.y).length();
                0.5 * (to(goal_x + ball.x) - to(goal_x - ball.x))
            }
            Self::BehindBall { goal_x, behind, most } => {
                let to_goal = Vector::new(goal_x - ball.x, -ball.y);
                let per = behind / to_goal.length().max(behind);
                let at = ball - to_goal * per;
                let at = Vector::new(at.x.max(-most.x), at.y.max(-most.y).min(most.y));
                -(at - me).length()
            }
            Self::AtMouth { reach } => {
                let mouth = me + Vector::new(robots[2], robots[3]) * reach;
                -(ball - mouth).length()
            }
        }
    }
}

/// Whether each robot of a row is its team's nearest to the ball; the first `n_blue` are a team.
pub fn nearest_to_ball(row: &[f32], n_blue: usize, out: &mut [bool]) {
    let (ball, robots) = row.split_at(BALL_COLUMNS.len());
    let distance = |robot: usize| {
        let at = &robots[robot * ROBOT_COLUMNS.len()..];
        Vector::new(at[0] - ball[0], at[1] - ball[1]).length()
    };
    let split = n_blue.min(out.len());
    let (blue, yellow) = out.split_at_mut(split);
    for (first, team) in [(0, blue), (split, yellow)] {
        let places = first..first + team.len();
        let least = places.clone().map(distance).fold(f32::INFINITY, f32::min);
        for (robot, nearest) in places.zip(team) {
            *nearest = distance(robot) <= least;
        }
    }
}

/// Mean magnitude of an action's numbers.
pub fn effort(action: &[f32]) -> f32 {
    let total: f32 = action.iter().map(|number| number.abs()).sum();
    total / action.len() as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIELD: Field = Field::VSS_3V3;

    fn view(ball: [f32; 2], me: [f32; 4]) -> (Vec<f32>, Vec<f32>) {
        let mut robots = vec![0.0; ROBOT_COLUMNS.len()];
        robots[..4].copy_from_slice(&me);
        (ball.to_vec(), robots)
    }

    #[test]
    fn each_potential_is_highest_where_its_name_says() {
        let robot = &RobotModel::SSL_GENERIC;
        let in_mouth = robot.front() + BallModel::SSL_TIGERS.radius;
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
            let of = |ball| {
                let (ball, robots) = view(ball, me);
                potential.of(&ball, &robots)
            };
            assert!(of(best) > of(worse) + 0.05, "{potential:?}");
        }
    }

    #[test]
    fn behind_a_ball_at_the_wall_is_the_nearest_place_inside() {
        let potential = Potential::behind_ball(&FIELD, 0.08);
        let place = [0.08 - FIELD.half_length(), 0.0, 1.0, 0.0];
        let (ball, robots) = view([0.02 - FIELD.half_length(), 0.0], place);
        assert!(potential.of(&ball, &robots).abs() < 1e-6);
    }

    #[test]
    fn the_nearest_of_each_team_is_told_also_when_it_is_alone() {
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
    }
}
